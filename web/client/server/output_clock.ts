/**
 * The clock of the output. Styled frames last as long as the engine predicts, and the displayed pose lies between two
 * of them.
 */

/** Longest step of the clock: after a sleep, playback continues from its position. */
export const MAX_STEP_SECS = 1;

/** One styled frame on the clock. */
export interface Moment {
  inputFrame: number;
  timeSecs: number;
  pose: Float32Array;
  planted: [boolean, boolean];
}

/** Returns the pose between two poses, `t` from 0 to 1. */
export type Interpolate = (a: Float32Array, b: Float32Array, t: number) => Float32Array;

/** The last two moments, and the clock between them. */
export class OutputClock<M extends Moment = Moment> {
  /** Seconds of output since {@link begin}. */
  secs = 0;
  #moments: [M, M] | undefined;

  constructor(private readonly interpolate: Interpolate) {}

  /** Whether there is a moment to display. */
  get hasBegun(): boolean {
    return this.#moments !== undefined;
  }

  /** Restarts at a moment. */
  begin(moment: M): void {
    this.secs = moment.timeSecs;
    this.#moments = [moment, moment];
  }

  /** Adds the moment after the last one. */
  push(moment: M): void {
    this.#moments = [this.last, moment];
  }

  /** Advances by a duration; a duration that is too long is shortened. */
  advance(dtSecs: number): void {
    this.secs += Math.min(dtSecs, MAX_STEP_SECS);
  }

  /** Whether the moment to display does not exist yet. */
  get isAhead(): boolean {
    return this.secs >= this.last.timeSecs;
  }

  get last(): M {
    return this.#moments![1];
  }

  get #previous(): M {
    return this.#moments![0];
  }

  /** Replaces the poses of both moments by the last ones of some frames. */
  repose(poses: Float32Array, floats: number): void {
    const [previous, last] = this.#moments!;
    if (previous !== last) previous.pose = poses.slice(-2 * floats, -floats);
    last.pose = poses.slice(-floats);
  }

  /** Delays both moments and the clock. */
  delay(secs: number): void {
    this.secs += secs;
    for (const moment of this.#shown) moment.timeSecs += secs;
  }

  /** Moves both moments over the ground. */
  moveBy(x: number, z: number): void {
    for (const moment of this.#shown) {
      moment.pose[0]! += x;
      moment.pose[2]! += z;
    }
  }

  /** Position of the clock between the two moments, 0–1. */
  get share(): number {
    const [a, b] = [this.#previous, this.last];
    const span = b.timeSecs - a.timeSecs;
    return span > 0 ? Math.min(Math.max((this.secs - a.timeSecs) / span, 0), 1) : 1;
  }

  get inputFrame(): number {
    const a = this.#previous.inputFrame;
    return a + (this.last.inputFrame - a) * this.share;
  }

  get pose(): Float32Array {
    return this.between(({ pose }) => pose);
  }

  /** Interpolates a property of the moments. */
  between(of: (moment: M) => Float32Array): Float32Array {
    return this.interpolate(of(this.#previous), of(this.last), this.share);
  }

  /** The nearer moment. */
  get nearest(): M {
    return this.share < 0.5 ? this.#previous : this.last;
  }

  /** Both moments, which may be one object before the first one has a successor. */
  get #shown(): Set<M> {
    return new Set(this.#moments);
  }
}
