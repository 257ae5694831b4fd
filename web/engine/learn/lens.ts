/** Inspects one frame of an input while it is styled: the numbers that lessons show. */
import type { Database } from "../database";
import { Handle } from "../handle";
import type { Input } from "../input";
import { guarded } from "../wasm";
import * as glue from "./pkg/strut_learn.js";
import { numbersOf, type Turn } from "./wasm";

/** Options that lessons change; see `StylizeOptions`. */
export interface LensOptions {
  k: number;
  lambda: number;
  rho: number;
  kappa: number;
  delta: number;
  coherence: boolean;
}

/** Frames of a window; the engine uses five. */
export type WindowLength = 1 | 5 | 9 | 15;

/** Distances of every class of the database, in its order. */
export interface ClassDistances {
  /** λⱼ of Eq. 4, 0 to 1. */
  weights: Float32Array;
  /** Dⱼ: mean squared distance of the K nearest windows, m²; also for classes whose weight the engine rounds to 0. */
  meanSquares: Float32Array;
}

/** Windows most similar to a query, nearest first. */
export interface NearestWindows {
  /** The last row of each window. */
  rows: Uint32Array;
  /** √D of each window, metres. */
  distances: Float32Array;
  /** Weight of each window in regressions, 0 to 1. */
  weights: Float32Array;
}

/** How a query differs from the input. */
export interface QueryChange {
  turns: readonly Turn[];
  /** Rotation about the vertical through the hips, radians. */
  heading: number;
  /** Translation on the ground, metres. */
  x: number;
  z: number;
  /** Whether time is reversed. */
  reversed: boolean;
}

/** Which examples a line is fitted to, and the parameters of the fit. */
export interface FitSettings {
  /** Index of the degree of freedom: three per joint, then height of the hips, velocity x and z, and rate of turning. */
  dof: number;
  /** K, from 1. */
  k: number;
  /** λ ≥ 0, as a share of K in global standard deviations. */
  lambda: number;
  /** Standard deviation ν of noise on the targets, in the unit of the degree of freedom. */
  noise: number;
  /** Whether the weights of neighbours decrease with distance; otherwise they are 1, as in the paper. */
  taper: boolean;
}

/** A fitted line and its examples (Eq. 2); radians, metres and seconds. */
export interface Fit {
  /** The class of the examples. */
  class: number;
  rows: Uint32Array;
  x: Float32Array;
  xPrevious: Float32Array;
  y: Float32Array;
  yPrevious: Float32Array;
  /** v: weights of the examples. */
  weights: Float32Array;
  /** a, b and c: of xₜ₋₁, yₜ₋₁ and xₜ. */
  beta: [a: number, b: number, c: number];
  /** xₜ₋₁, yₜ₋₁ and xₜ of the query. */
  query: [xPrevious: number, yPrevious: number, x: number];
  /** Weighted means of the examples. */
  means: { xPrevious: number; yPrevious: number; x: number; y: number };
  /** σ of the neighbours' xₜ, with the floors of the bias. */
  deviation: number;
  /** σ of the degree of freedom over all rows. */
  globalDeviation: number;
  /** Δx of Eq. 6. */
  bias: number;
  /** yₜ of Eq. 7. */
  predicted: number;
}

/** The duration of the frame, as predicted by the neighbours of the heaviest class. */
export interface Timing {
  /** d of each neighbour from the input and the output, in standard deviations. */
  distances: Float32Array;
  /** w of each neighbour, seconds. */
  durations: Float32Array;
  /** g of each neighbour, relative to the nearest. */
  kernel: Float32Array;
  /** v of each neighbour. */
  weights: Float32Array;
  /** h: the bandwidth. */
  bandwidth: number;
  /** Their weighted mean, seconds; `undefined` without neighbours. */
  duration: number | undefined;
}

/** Left and right. */
type Feet<T> = [left: T, right: T];

/** Votes for the foot contacts. */
export interface Contacts {
  /** P in this frame, before smoothing. */
  votes: Feet<number>;
  /** P after smoothing over time. */
  smoothed: Feet<number>;
  /** Mean with the contacts of the registered targets, after smoothing; it decides which feet are planted. */
  output: Feet<number>;
  planted: Feet<boolean>;
  /** The rows that vote. */
  rows: Uint32Array;
  /** g of each row, left and right interleaved. */
  voices: Float32Array;
  /** c of each row, left and right interleaved. */
  contacts: Uint8Array;
}

/** Inspects one frame of an input. Methods throw a StrutError, `bad-input`, if the requested item does not exist. */
export class Lens extends Handle<glue.Lens> {
  /**
   * Inspects an input in these styles, one weight per style of the database, with the engine's default options.
   * @throws StrutError `bad-input` if the input has fewer than three frames, or the number of weights is wrong
   */
  constructor(database: Database, input: Input, styles: Float32Array) {
    // Casts objects of this package to the engine's types of the same classes.
    const parts = [database.raw, input.raw] as unknown as [glue.Database, glue.Input];
    super(
      guarded(() => new glue.Lens(...parts, styles)),
      "lens",
    );
  }

  /** Replaces the options. */
  configure({ k, lambda, rho, kappa, delta, coherence }: LensOptions): void {
    guarded(() => this.raw.configure(k, lambda, rho, kappa, delta, coherence));
  }

  /** Sets one weight per style of the database. */
  setStyles(weights: Float32Array): void {
    guarded(() => this.raw.setStyles(weights));
  }

  /** Moves to a frame. Returns the frame that is inspected: the nearest one with two frames before it. */
  at(frame: number): number {
    return guarded(() => this.raw.at(frame));
  }

  /** Changes the query of {@link neighbours} and {@link profile}. Returns the query's pose. */
  query({ turns, heading, x, z, reversed }: QueryChange): Float32Array {
    return guarded(() => this.raw.query(numbersOf(turns), heading, x, z, reversed));
  }

  classes(): ClassDistances {
    const pairs = guarded(() => this.raw.classes());
    const column = (side: number) => pairs.filter((_, i) => i % 2 === side);
    return { weights: column(0), meanSquares: column(1) };
  }

  /** The class with the largest weight; `undefined` if no class has neighbours. */
  heaviestClass(): number | undefined {
    return guarded(() => this.raw.heaviestClass());
  }

  /** The first row of a class; the rows of a class are consecutive. */
  firstRow(classNumber: number): number {
    return guarded(() => this.raw.firstRow(classNumber));
  }

  /** The `k` windows of a class nearest to the query. */
  neighbours(classNumber: number, k: number, length: WindowLength = 5): NearestWindows {
    return guarded(() => {
      const found = this.raw.neighbours(classNumber, k, length);
      const windows = { rows: found.rows(), distances: found.distances(), weights: found.weights() };
      found.free();
      return windows;
    });
  }

  /** √D in metres between the query and the window that ends at each row of a class; NaN where no window ends. */
  profile(classNumber: number, length: WindowLength = 5): Float32Array {
    return guarded(() => this.raw.profile(classNumber, length));
  }

  /** The pose of a row of the database, moved above the origin and turned to face +Z. */
  rowPose(row: number): Float32Array {
    return guarded(() => this.raw.rowPose(row));
  }

  /** The degrees of freedom of every frame of the input: 68 numbers per frame, of which the last is padding. */
  rows(): Float32Array {
    return guarded(() => this.raw.rows());
  }

  /** Mean rotation of each joint, x y z w: the centres of the exponential maps. */
  means(): Float32Array {
    return guarded(() => this.raw.means());
  }

  /** The styled pose of the frame. */
  styled(): Float32Array {
    return guarded(() => this.raw.styled());
  }

  /** Duration of the styled frame, seconds. */
  stepSecs(): number {
    return guarded(() => this.raw.stepSecs());
  }

  /** The fitted line of one degree of freedom in the heaviest class, for the style with the largest weight. */
  fit({ dof, k, lambda, noise, taper }: FitSettings): Fit {
    return guarded(() => {
      const raw = this.raw.fit(dof, k, lambda, noise, taper);
      const rows = raw.rows();
      const columns = raw.columns();
      const column = (i: number) => columns.slice(i * rows.length, (i + 1) * rows.length);
      const [a, b, c, xPrevious, yPrevious, x, ...rest] = raw.numbers() as unknown as Numbers<14>;
      const [meanXPrevious, meanYPrevious, meanX, meanY, deviation, globalDeviation, bias, predicted] = rest;
      const fit: Fit = {
        class: raw.class(),
        rows,
        x: column(0),
        xPrevious: column(1),
        y: column(2),
        yPrevious: column(3),
        weights: column(4),
        beta: [a, b, c],
        query: [xPrevious, yPrevious, x],
        means: { xPrevious: meanXPrevious, yPrevious: meanYPrevious, x: meanX, y: meanY },
        deviation,
        globalDeviation,
        bias,
        predicted,
      };
      raw.free();
      return fit;
    });
  }

  /**
   * For each λ, the root mean square error of one degree of freedom that is predicted over the whole input from its own
   * past, compared with `ideal`, the poses of the input's counterpart in the style with the largest weight.
   */
  sweep(settings: Omit<FitSettings, "lambda">, lambdas: Float32Array, ideal: Float32Array): Float32Array {
    const { dof, k, noise, taper } = settings;
    return guarded(() => this.raw.sweep(dof, k, lambdas, noise, taper, ideal));
  }

  /** Predicted duration of the frame in a style that has a weight, by the style's index. */
  timing(style: number): Timing {
    return guarded(() => {
      const raw = this.raw.timing(style);
      const timing = {
        distances: raw.distances(),
        durations: raw.durations(),
        kernel: raw.kernel(),
        weights: raw.weights(),
        bandwidth: raw.bandwidth(),
        duration: raw.duration(),
      };
      raw.free();
      return timing;
    });
  }

  contacts(): Contacts {
    return guarded(() => {
      const raw = this.raw.contacts();
      const [a, b, c, d, e, f] = raw.likelihoods() as unknown as Numbers<6>;
      const [left, right] = raw.planted();
      const contacts: Contacts = {
        votes: [a, b],
        smoothed: [c, d],
        output: [e, f],
        planted: [left === 1, right === 1],
        rows: raw.rows(),
        voices: raw.voices(),
        contacts: raw.contacts(),
      };
      raw.free();
      return contacts;
    });
  }
}

/** A tuple of `N` numbers. */
type Numbers<N extends number, T extends number[] = []> = T["length"] extends N ? T : Numbers<N, [...T, number]>;
