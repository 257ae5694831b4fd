/** What the handlers of all calls share. */
import type { Engine } from "../../engine/engine";
import type { Performed } from "../protocol";
import type { BuiltInMotions } from "./built_in_motions";
import type { Registry } from "./registry";

/** How a built-in motion looks in a style, where that is known. */
export type Counterparts = (motion: string, style: string) => Performed | undefined;

export interface Host {
  readonly engine: Engine;
  readonly builtIn: BuiltInMotions;
  readonly counterparts: Counterparts;
  readonly open: Registry;
}
