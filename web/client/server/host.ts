/** What the handlers of all calls share. */
import type { Database } from "../../engine/database";
import type { Engine } from "../../engine/engine";
import type { Input } from "../../engine/input";
import type { Performed } from "../protocol";
import type { BuiltInMotions } from "./built_in_motions";
import type { Registry } from "./registry";

/** How a built-in motion looks in a style, where that is known. */
export type Counterparts = (motion: string, style: string) => Performed | undefined;

/** Both searches of an input, in portions: as much of `SearchComparison` (`engine/compare/`) as is needed. */
export interface SearchJob {
  take(frames: number): number;
  searchExactly(): void;
  searchTrees(): void;
  count(): void;
  recall(): number;
  dispose(): void;
}

/** A search by kd-trees beside the exact one, where the package has them. */
export type Searches = (
  database: Database,
  input: Input,
  neighbours: number,
  candidates: number,
) => SearchJob | undefined;

export interface Host {
  readonly engine: Engine;
  readonly builtIn: BuiltInMotions;
  readonly counterparts: Counterparts;
  readonly searches: Searches;
  readonly open: Registry;
}
