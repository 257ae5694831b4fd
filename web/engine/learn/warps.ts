/** Compares the clips of an action as registration does. */
import type { Database } from "../database";
import { Handle } from "../handle";
import { guarded } from "../wasm";
import * as glue from "./pkg/strut_learn.js";

/** A range of a clip; clips are numbered as in the database. */
export interface Stretch {
  clip: number;
  /** Its first frame and its last. */
  first: number;
  last: number;
}

/** Dynamic time warping, iterative motion warping (Hsu et al. 2005), or linear time. */
export type WarpMethod = "dtw" | "imw" | "linear";

/** The comparison of two ranges, a and b. */
export interface Compared {
  /** cᵢⱼ of every pair of a frame of a and a frame of b, row after row of a. */
  costs: Float32Array;
  /** τ: for every frame of a, the frame of b, from its first frame; empty if no warp with a pace of at most 3 : 1 exists. */
  warp: Float32Array;
  /**
   * The counterpart in the database of every frame of a, from b's first frame: exact for the built-in database. NaN
   * where it is in another clip.
   */
  recorded: Float32Array;
  /** α and β of the strongest principal feature in every frame of a; only for iterative motion warping, otherwise empty. */
  scale: Float32Array;
  offset: Float32Array;
}

/** Comparisons of the clips of one action. Methods throw a StrutError, `bad-input`, if the requested item does not exist. */
export class Warps extends Handle<glue.Warps> {
  /** Computes the features of all clips of an action, given by its index. Takes about a second. */
  constructor(database: Database, action: number) {
    // Casts an object of this package to the engine's type of the same class.
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

  /** The row of a clip's first frame in the database, and the clip's number of frames. */
  rows(clip: number): { first: number; frames: number } {
    const [first, frames] = guarded(() => this.raw.rows(clip));
    return { first: first!, frames: frames! };
  }

  /** Foot contacts of a clip, left and right interleaved. */
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
