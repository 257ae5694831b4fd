/** An open model: poses the character by the handle or by keys, and provides the data of the pad and the timelines. */
import type {
  Between,
  Curve,
  KeyStyleFrame,
  KeyStyleModel,
  Poser,
  Span,
  Styling,
} from "../../../client/models/key_style";
import { type Extent, paddedExtent } from "../../../ui/scale";
import type { TimedValue } from "../../state/key_style";
import type { Grid } from "./contours";
import { cycleOf, keysOfCycle, keysOfRecording } from "./first_keys";
import type { RowName } from "./timeline_rows";

/** Share of the range of the training data by which the axes extend beyond it. */
const MARGIN = 0.14;
/** Grid size of the training data's support on the pad. */
const SUPPORT = { columns: 90, rows: 64 };
/** Points per second of the drawn curve through the keys, and their maximum number. */
const POINTS_PER_SEC = 60;
const MAX_POINTS = 600;

/** Keys, and the interpolation of their motion. */
interface KeyedMotion {
  keys: readonly TimedValue[];
  length: number;
  curve: Curve;
  loop: boolean;
  hard: boolean;
}

export class KeyMotion {
  readonly model: KeyStyleModel;
  readonly rows: RowName[];
  readonly ranges: Extent[];
  readonly #poser: Poser;
  readonly #styling: Styling;
  #curve: Float32Array = new Float32Array();

  constructor(model: KeyStyleModel, titleOf: (axis: string) => string) {
    this.model = model;
    this.#poser = model.poser();
    this.#styling = model.styling();
    const axes = model.axes.length;
    this.ranges = model.axes.map((_, axis) => paddedExtent(valuesOf(model.values, axis, axes), MARGIN));
    this.rows = model.axes.map((axis, i) => {
      const { min, max } = this.ranges[i]!;
      const unit = model.units[i]!;
      // Without a unit: three significant digits of the range.
      const digits = unit === "" ? Math.min(3, Math.max(0, 2 - Math.floor(Math.log10(max - min)))) : 1;
      return { title: titleOf(axis), unit, digits };
    });
  }

  /** Variables of the mean pose. */
  get middle(): number[] {
    return Array.from(this.model.mean);
  }

  /** Initial keys: one cycle of the training motion, if it has one. */
  readonly firstKeys = (): TimedValue[] => {
    const { axes, deviation, clips, values, rateHz } = this.model;
    const longest = clips.reduce((a, b) => (b.frames > a.frames ? b : a));
    const of = values.subarray(longest.first * axes.length, (longest.first + longest.frames) * axes.length);
    const turn = cycleOf(of, deviation);
    return turn ? keysOfCycle(of, axes.length, turn, rateHz) : keysOfRecording(of, axes.length, rateHz);
  };

  /** Support of the training data on the pad for these values of the other variables. */
  support(values: readonly number[]): Grid {
    const [x, y] = this.ranges;
    const { columns, rows } = SUPPORT;
    if (y) return { columns, rows, values: this.model.support(spanOf(x!, columns), spanOf(y, rows), values) };
    // A single variable has no vertical axis.
    const known = this.model.support(spanOf(x!, columns), undefined, values);
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

  /** Centres of the components on the pad, x and y alternating. */
  get centres(): Float32Array {
    const { centres, axes } = this.model;
    if (axes.length < 2) return new Float32Array();
    return Float32Array.from({ length: (2 * centres.length) / axes.length }, (_, i) => {
      return centres[Math.floor(i / 2) * axes.length + (i % 2)]!;
    });
  }

  set hard(hard: boolean) {
    this.#poser.mode = hard ? "hard" : "smooth";
    this.#styling.mode = hard ? "hard" : "smooth";
  }

  /** Sets keys. A looping motion is smooth where it restarts. */
  set({ keys, length, curve, loop, hard }: KeyedMotion): void {
    this.hard = hard;
    if (keys.length === 0) {
      this.#curve = new Float32Array();
      return;
    }
    this.#styling.set(loop ? seamless(keys, length) : keys, curve);
    this.#curve = this.#styling.way(length, Math.min(MAX_POINTS, Math.ceil(length * POINTS_PER_SEC) + 1));
  }

  /** The variables at equally spaced times over the whole length, time after time. */
  get curve(): Float32Array {
    return this.#curve;
  }

  /** The pose of the keys at a time. */
  at(secs: number, between: Between): KeyStyleFrame {
    return this.#styling.at(secs, between);
  }

  /** Moves the root of the keys' motion back to its start. */
  goBack(): void {
    this.#styling.goBack();
  }

  /** The pose for values of the handle, at once or after following it for `secs` seconds. */
  follow(values: readonly number[], secs: number | undefined): KeyStyleFrame {
    return secs === undefined ? this.#poser.jump(values) : this.#poser.advance(secs, values);
  }

  /** Whether the model clamped the values to its data. */
  isBeyond(values: readonly number[], reached: ArrayLike<number>): boolean {
    return values.some((value, axis) => {
      const { min, max } = this.ranges[axis]!;
      return Math.abs(value - reached[axis]!) > 0.004 * (max - min);
    });
  }

  perform(length: number, between: Between): Float32Array {
    return this.#styling.perform(length, between);
  }

  toBvh(length: number, between: Between): string {
    return this.#styling.toBvh(length, between);
  }

  dispose(): void {
    this.#poser.dispose();
    this.#styling.dispose();
    this.model.dispose();
  }
}

const spanOf = ({ min, max }: Extent, count: number): Span => ({ min, max, count });

function* valuesOf(values: Float32Array, axis: number, axes: number): Generator<number> {
  for (let i = axis; i < values.length; i += axes) yield values[i]!;
}

/** Keys that end as they begin get one key before and one after, so that the curve is smooth there; others are unchanged. */
export function seamless(keys: readonly TimedValue[], length: number): readonly TimedValue[] {
  const [first, last] = [keys[0], keys.at(-1)];
  if (!first || !last || keys.length < 3) return keys;
  const closed = first.secs === 0 && Math.abs(last.secs - length) < 0.01;
  const same = first.values.every((value, axis) => Math.abs(value - last.values[axis]!) < 0.02);
  if (!closed || !same) return keys;
  const [before, after] = [keys.at(-2)!, keys[1]!];
  return [{ ...before, secs: before.secs - last.secs }, ...keys, { ...after, secs: after.secs + last.secs }];
}
