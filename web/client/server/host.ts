/** State shared by the handlers of all calls. */
import type { Engine } from "../../engine/engine";
import type { Performed } from "../protocol";
import type { BuiltInMotions } from "./built_in_motions";
import type { Registry } from "./registry";

/** Returns a built-in motion in a style, if it is known. */
export type Counterparts = (motion: string, style: string) => Performed | undefined;

export interface Host {
  readonly engine: Engine;
  readonly builtIn: BuiltInMotions;
  readonly counterparts: Counterparts;
  readonly open: Registry;
}
