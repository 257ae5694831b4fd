/** A model at work: a hand that drags the variables, keys that are performed, and what the pad and the rows must know of them. */
import type { Between, Curve, KeyStyleModel, Puppet, PuppetFrame, Styling } from "../../worker/key_style/key_style";
import type { Grid } from "./contours";
import { keysOfRecording, keysOfTurn, turnOf } from "./first_keys";
import type { TimedValue } from "./keys";
import { rangeOf } from "./scale";
import type { RowName } from "./timeline";

/** Room beside the training data, share of its range. */
const MARGIN = 0.14;
/** Places of the map of what is known. */
const SUPPORT = { columns: 90, rows: 64 };
/** Moments of the way between keys that are drawn, and most of them. */
const MOMENTS_PER_SEC = 60;
const MOST_MOMENTS = 600;

/** Settings of the performance. */
export interface KeyedMotion {
  keys: readonly TimedValue[];
  length: number;
  curve: Curve;
  loop: boolean;
  hard: boolean;
}

export class Performance {
  readonly model: KeyStyleModel;
  readonly rows: RowName[];
  readonly ranges: { least: number; most: number }[];
  readonly #puppet: Puppet;
  readonly #styling: Styling;
  #way: Float32Array = new Float32Array();

  constructor(model: KeyStyleModel, titleOf: (axis: string) => string) {
    this.model = model;
    this.#puppet = model.puppet();
    this.#styling = model.styling();
    const axes = model.axes.length;
    this.ranges = model.axes.map((_, axis) => rangeOf(valuesOf(model.values, axis, axes), MARGIN));
    this.rows = model.axes.map((axis, i) => {
      const { least, most } = this.ranges[i]!;
      const unit = model.units[i]!;
      // Three figures of the range where no unit says what can be seen.
      const digits = unit === "" ? Math.min(3, Math.max(0, 2 - Math.floor(Math.log10(most - least)))) : 1;
      return { title: titleOf(axis), unit, digits };
    });
  }

  /** The variables that a model begins with: the mean pose. */
  get middle(): number[] {
    return Array.from(this.model.mean);
  }

  /** Keys that show what the model can do: a turn of the motion where it has one. */
  readonly firstKeys = (): TimedValue[] => {
    const { axes, deviation, clips, values, rateHz } = this.model;
    const longest = clips.reduce((a, b) => (b.frames > a.frames ? b : a));
    const of = values.subarray(longest.first * axes.length, (longest.first + longest.frames) * axes.length);
    const turn = turnOf(of, deviation);
    return turn ? keysOfTurn(of, axes.length, turn, rateHz) : keysOfRecording(of, axes.length, rateHz);
  };

  /** How well each place of the pad is known, where the other variables are these. */
  support(values: readonly number[]): Grid {
    const [x, y] = this.ranges;
    const { columns, rows } = SUPPORT;
    if (y)
      return { columns, rows, values: this.model.support({ ...x!, count: columns }, { ...y, count: rows }, values) };
    // A single variable is as well known all the way up.
    const known = this.model.support({ ...x!, count: columns }, undefined, values);
    return { columns, rows: 2, values: Float32Array.from({ length: 2 * columns }, (_, i) => known[i % columns]!) };
  }

  /** The training data on the pad: two variables, or one and the recordings' time. */
  get points(): Float32Array {
    const { values, axes } = this.model;
    const frames = values.length / axes.length;
    const points = new Float32Array(2 * frames);
    for (let frame = 0; frame < frames; frame++) {
      points[2 * frame] = values[frame * axes.length]!;
      points[2 * frame + 1] = axes.length > 1 ? values[frame * axes.length + 1]! : frame / frames;
    }
    return points;
  }

  /** The components' homes on the pad. */
  get centres(): Float32Array {
    const { centres, axes } = this.model;
    if (axes.length < 2) return new Float32Array();
    return Float32Array.from({ length: (2 * centres.length) / axes.length }, (_, i) => {
      return centres[Math.floor(i / 2) * axes.length + (i % 2)]!;
    });
  }

  set hard(hard: boolean) {
    this.#puppet.hard = hard;
    this.#styling.hard = hard;
  }

  /** Takes keys. What begins again where it ends goes through its seam as through any other key. */
  set({ keys, length, curve, loop, hard }: KeyedMotion): void {
    this.hard = hard;
    if (keys.length === 0) {
      this.#way = new Float32Array();
      return;
    }
    this.#styling.set(loop ? seamless(keys, length) : keys, curve);
    this.#way = this.#styling.way(length, Math.min(MOST_MOMENTS, Math.ceil(length * MOMENTS_PER_SEC) + 1));
  }

  /** The variables over the whole length, all of a moment behind each other. */
  get way(): Float32Array {
    return this.#way;
  }

  /** The pose of the keys at a time. */
  at(secs: number, between: Between): PuppetFrame {
    return this.#styling.at(secs, between);
  }

  /** Puts the body of the keys' motion back where it began. */
  goBack(): void {
    this.#styling.goBack();
  }

  /** The pose of a hand, at once or after so many seconds of following. */
  follow(values: readonly number[], secs: number | undefined): PuppetFrame {
    return secs === undefined ? this.#puppet.jump(values) : this.#puppet.advance(secs, values);
  }

  /** Whether the model had to take another place than it was asked for. */
  isBeyond(values: readonly number[], reached: ArrayLike<number>): boolean {
    return values.some((value, axis) => {
      const { least, most } = this.ranges[axis]!;
      return Math.abs(value - reached[axis]!) > 0.004 * (most - least);
    });
  }

  perform(length: number, between: Between): Float32Array {
    return this.#styling.perform(length, between);
  }

  toBvh(length: number, between: Between): string {
    return this.#styling.toBvh(length, between);
  }

  dispose(): void {
    this.#puppet.dispose();
    this.#styling.dispose();
    this.model.dispose();
  }
}

function* valuesOf(values: Float32Array, axis: number, axes: number): Generator<number> {
  for (let i = axis; i < values.length; i += axes) yield values[i]!;
}

/** Keys that end as they begin, with a key before and one after, so that the curve has no corner there; others as they are. */
export function seamless(keys: readonly TimedValue[], length: number): readonly TimedValue[] {
  const [first, last] = [keys[0], keys.at(-1)];
  if (!first || !last || keys.length < 3) return keys;
  const closed = first.secs === 0 && Math.abs(last.secs - length) < 0.01;
  const same = first.values.every((value, axis) => Math.abs(value - last.values[axis]!) < 0.02);
  if (!closed || !same) return keys;
  const [before, after] = [keys.at(-2)!, keys[1]!];
  return [{ ...before, secs: before.secs - last.secs }, ...keys, { ...after, secs: after.secs + last.secs }];
}
