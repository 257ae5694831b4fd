/** The WASM package of the lessons: all that the Compare view's does, and looks into a frame of the transfer. */
import { assetOf } from "../assets";
import { Database } from "../database";
import { Input } from "../input";
import { performedBy } from "../performed";
import type { Performed } from "../types";
import { type Glue, guarded, servePackage } from "../wasm";
import * as glue from "./pkg/strut_learn.js";

/** Uses this package as the engine's on this thread; call it before anything is loaded. */
export function serveLearnPackage(): void {
  // The same classes with some more: those of two packages are only different by name.
  servePackage(glue as unknown as Glue, () =>
    assetOf("strut_learn_bg.wasm", () => new URL("./pkg/strut_learn_bg.wasm", import.meta.url)),
  );
}

/** An object of this package that the engine holds under the name of its own. */
const own = <T>(raw: unknown): T => raw as T;

/** A built-in input, or a take of the built-in database, as a style performs it; `undefined` where there is none. */
export function performedIn(name: string, style: string): Performed | undefined {
  return performedBy(glue, name, style);
}

/**
 * The built-in database without some takes in any style, such as "walk-pace". It is performed anew, which takes about a
 * second.
 * @throws StrutError `bad-input` if no take of the neutral style is left
 */
export function builtInWithout(takes: readonly string[]): Database {
  return Database.of(
    guarded(() => own(glue.Database.builtInWithout([...takes]))),
    "built-in",
  );
}

/** A walk or run of the built-in database as an input; `undefined` where there is none of this name. */
export function inputOfTake(database: Database, name: string): Input | undefined {
  const raw = guarded(() => glue.Input.ofTake(own(database.raw), name));
  return raw && Input.of(own(raw), database, { kind: "built-in", name });
}

/** A joint that is turned: its number, and an axis times an angle about the axes of its parent, radians. */
export interface Turn {
  joint: number;
  by: readonly [x: number, y: number, z: number];
}

/**
 * An input with joints turned in every frame, and the whole turned about the vertical, radians.
 * @throws StrutError `bad-input`
 */
export function turnedInput(database: Database, input: Input, turns: readonly Turn[], heading: number): Input {
  const raw = guarded(() => own<glue.Input>(input.raw).turned(numbersOf(turns), heading));
  return Input.of(own(raw), database, { kind: "built-in", name: input.info.name });
}

/** Turns as the module takes them. */
export function numbersOf(turns: readonly Turn[]): Float32Array {
  return Float32Array.from(turns.flatMap(({ joint, by }) => [joint, ...by]));
}
