/** The WASM package of the lessons: that of the Compare view, plus inspection of single frames. */
import { assetOf } from "../assets";
import { Database } from "../database";
import { Input } from "../input";
import { performedBy } from "../performed";
import type { Performed } from "../types";
import { type Glue, guarded, servePackage } from "../wasm";
import * as glue from "./pkg/strut_learn.js";

/** Uses this package as the engine's on this thread. Call it before anything is loaded. */
export function serveLearnPackage(): void {
  // The package has the engine's classes and more. TypeScript treats the classes of two packages as different types.
  servePackage(glue as unknown as Glue, () =>
    assetOf("strut_learn_bg.wasm", () => new URL("./pkg/strut_learn_bg.wasm", import.meta.url)),
  );
}

/** Casts an object of this package to the engine's type of the same class. */
const own = <T>(raw: unknown): T => raw as T;

/** A built-in input, or a take of the built-in database, as performed in a style; `undefined` if there is none. */
export function performedIn(name: string, style: string): Performed | undefined {
  return performedBy(glue, name, style);
}

/**
 * The built-in database in all styles without some takes, such as "walk-pace". The database is generated again, which
 * takes about a second.
 * @throws StrutError `bad-input` if no take of the neutral style is left
 */
export function builtInWithout(takes: readonly string[]): Database {
  return Database.of(
    guarded(() => own(glue.Database.builtInWithout([...takes]))),
    "built-in",
  );
}

/** A walk or run of the built-in database as an input; `undefined` if there is none of this name. */
export function inputOfTake(database: Database, name: string): Input | undefined {
  const raw = guarded(() => glue.Input.ofTake(own(database.raw), name));
  return raw && Input.of(own(raw), database, { kind: "built-in", name });
}

/** A rotation of a joint: its index, and an axis times an angle about the axes of its parent, radians. */
export interface Turn {
  joint: number;
  by: readonly [x: number, y: number, z: number];
}

/**
 * An input with joints rotated in every frame, and the whole body rotated about the vertical, radians.
 * @throws StrutError `bad-input`
 */
export function turnedInput(database: Database, input: Input, turns: readonly Turn[], heading: number): Input {
  const raw = guarded(() => own<glue.Input>(input.raw).turned(numbersOf(turns), heading));
  return Input.of(own(raw), database, { kind: "built-in", name: input.info.name });
}

/** Turns as the numbers that the module expects. */
export function numbersOf(turns: readonly Turn[]): Float32Array {
  return Float32Array.from(turns.flatMap(({ joint, by }) => [joint, ...by]));
}
