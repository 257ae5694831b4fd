/** The clips of an action, compared as registration compares them. */
import type { Database } from "../database";
import { Handle } from "../handle";
import { guarded } from "../wasm";
import * as glue from "./pkg/strut_learn.js";

/** A stretch of a clip; clips are numbered as in the database. */
export interface Stretch {
  clip: number;
  /** Its first frame and its last. */
  first: number;
  last: number;
}

/** Dynamic time warping, iterative motion warping (Hsu et al. 2005), or linear time. */
export type WarpMethod = "dtw" | "imw" | "linear";

/** Two stretches, a and b, compared. */
export interface Compared {
  /** cᵢⱼ of every frame of a and every frame of b, row after row of a. */
  costs: Float32Array;
  /** τ: for every frame of a the frame of b, from its first; empty if none of a pace up to 3 : 1 exists. */
  warp: Float32Array;
  /** The counterpart in the database of every frame of a, from b's first: exact for the built-in one. NaN where it is in another clip. */
  recorded: Float32Array;
  /** α and β of the strongest principal feature in every frame of a; empty but for iterative motion warping. */
  scale: Float32Array;
  offset: Float32Array;
}

/** Of one action. Methods that ask for what is not there throw a StrutError, `bad-input`. */
export class Warps extends Handle<glue.Warps> {
  /** Computes the features of all clips of an action, by its number: about a second. */
  constructor(database: Database, action: number) {
    // Objects of this package are held under the names of the engine's own.
    const raw = database.raw as unknown as glue.Database;
    super(
      guarded(() => new glue.Warps(raw, action)),
      "clips of an action",
    );
  }

  /** Names of all clips of the database, in the order of their numbers. */
  clipNames(): string[] {
    return guarded(() => this.raw.clipNames());
  }

  /** The gait cycles of a clip: from one left heel strike to the next. */
  cycles(clip: number): Stretch[] {
    const numbers = guarded(() => this.raw.cycles(clip));
    return Array.from({ length: numbers.length / 2 }, (_, i) => {
      const [first, frames] = [numbers[2 * i]!, numbers[2 * i + 1]!];
      return { clip, first, last: first + frames };
    });
  }

  /** The row of a clip's first frame in the database, and how many it has. */
  rows(clip: number): { first: number; frames: number } {
    const [first, frames] = guarded(() => this.raw.rows(clip));
    return { first: first!, frames: frames! };
  }

  /** Planted feet of a clip, left and right interleaved. */
  contacts(clip: number): Uint8Array {
    return guarded(() => this.raw.contacts(clip));
  }

  compare(a: Stretch, b: Stretch, by: WarpMethod): Compared {
    return guarded(() => {
      const raw = this.raw.compare(a.clip, a.first, a.last, b.clip, b.first, b.last, by);
      const affine = raw.affine();
      const compared = {
        costs: raw.costs(),
        warp: raw.warp(),
        recorded: raw.recorded(),
        scale: affine.slice(0, affine.length / 2),
        offset: affine.slice(affine.length / 2),
      };
      raw.free();
      return compared;
    });
  }
}
