/**
 * Poses of style variables, on the present thread: a pose takes microseconds, and where a hand drags the variables is to be
 * seen in the same frame of the screen. A {@link KeyStyleModel} says what it has learned, a {@link Puppet} follows a hand, a
 * {@link Styling} performs keys.
 */
import { Handle } from "../handle";
import { sentence } from "../side_package";
import { POSE_FLOATS } from "../types";
import { type KeyStyleGlue, keyStylePackage } from "./wasm";

/** A clip among the training motions: its first frame among all, and how many there are. */
export interface TrainingClip {
  name: string;
  first: number;
  frames: number;
}

/** What a style variable is: its unit, or what is wrong with its expression and at which character, from 0. */
export type CheckedAxis = { unit: string } | { message: string; column: number };

/** Where a key is, and what the variables are there. */
export interface StyleKey {
  secs: number;
  values: readonly number[];
}

/** What is between keys: style variables alone, those through recorded poses at the keys, or recorded poses blended. */
export type Between = "style" | "hybrid" | "frame";
const BETWEEN: Readonly<Record<Between, number>> = { style: 0, hybrid: 1, frame: 2 };

/** The curve of the variables between keys: a Catmull-Rom spline, or one that never leaves what keys ask for. */
export type Curve = "spline" | "monotone";

/** A range of a style variable, with the number of places in it. */
export interface Span {
  least: number;
  most: number;
  count: number;
}

/** Reads a style variable by its name or as an expression. */
export async function checkAxis(text: string): Promise<CheckedAxis> {
  const glue = await keyStylePackage.load();
  const checked = keyStylePackage.guarded(() => glue.checkMeasure(text));
  try {
    const column = checked.column();
    return column < 0 ? { unit: checked.unit() } : { message: sentence(checked.message()), column };
  } finally {
    checked.free();
  }
}

/** A model of poses. */
export class KeyStyleModel extends Handle<InstanceType<KeyStyleGlue["KeyStyleModel"]>> {
  readonly axes: readonly string[];
  readonly units: readonly string[];
  readonly rateHz: number;
  readonly components: number;
  /** Bone offsets, 21 × xyz, metres. */
  readonly proportions: Float32Array;
  readonly clips: readonly TrainingClip[];
  /** The variables of every training frame, all of a frame behind each other. */
  readonly values: Float32Array;
  /** Where each component is at home, all variables of one behind each other. */
  readonly centres: Float32Array;
  /** Mean and standard deviation of each variable. */
  readonly mean: Float32Array;
  readonly deviation: Float32Array;

  private constructor(
    private readonly glue: KeyStyleGlue,
    file: Uint8Array,
  ) {
    super(
      keyStylePackage.guarded(() => new glue.KeyStyleModel(file)),
      "key-style model",
    );
    const { raw } = this;
    this.axes = raw.axes();
    this.units = raw.units();
    this.rateHz = raw.rateHz();
    this.components = raw.components();
    this.proportions = raw.proportions();
    const [names, frames] = [raw.clipNames(), raw.clipFrames()];
    let first = 0;
    this.clips = names.map((name, i) => {
      const clip = { name, first, frames: frames[i]! };
      first += clip.frames;
      return clip;
    });
    this.values = raw.values();
    this.centres = raw.centres();
    this.mean = raw.mean();
    this.deviation = raw.deviation();
  }

  /**
   * The model in a `.strutkeys` file.
   * @throws StrutError if the module cannot be had, or with what is wrong with the file
   */
  static async open(file: Uint8Array): Promise<KeyStyleModel> {
    return new KeyStyleModel(await keyStylePackage.load(), file);
  }

  puppet(): Puppet {
    return new Puppet(this, this.glue);
  }

  styling(): Styling {
    return new Styling(this, this.glue);
  }

  /** Number of the training frame whose variables are nearest. */
  nearest(values: readonly number[]): number {
    return this.raw.nearest(Float64Array.from(values));
  }

  /** The pose of a training frame. */
  recorded(frame: number): Float32Array | undefined {
    return this.raw.recorded(frame);
  }

  /**
   * How well each place is known, row after row from the greatest value of the second variable: below 0 a pose is a guess.
   * Without a second variable a row is enough. Further variables are as in `values`.
   */
  support(x: Span, y: Span | undefined, values: readonly number[]): Float32Array {
    const { least, most, count } = y ?? { least: 0, most: 0, count: 1 };
    return keyStylePackage.guarded(() =>
      this.raw.support(Float64Array.from(values), x.least, x.most, x.count, least, most, count),
    );
  }
}

/** What a puppet shows. */
export interface PuppetFrame {
  /** `POSE_FLOATS` numbers. */
  readonly pose: Float32Array;
  /** How much each component is of the pose. */
  readonly weights: Float32Array;
  /** The variables as measured on the pose, and those that the model was asked for: within what it has learned. */
  readonly measured: Float32Array;
  readonly reached: Float32Array;
}

/** Somebody whose pose follows a hand that drags the style variables. */
export class Puppet extends Handle<InstanceType<KeyStyleGlue["Puppet"]>> {
  /** The present frame; every call writes it anew. */
  readonly frame: PuppetFrame;
  private readonly asked: Float64Array;
  private readonly address: number;
  private readonly floats: number;

  constructor(model: KeyStyleModel, glue: KeyStyleGlue) {
    super(
      keyStylePackage.guarded(() => new glue.Puppet(model.raw)),
      "puppet",
    );
    this.frame = emptyFrame(model);
    this.asked = new Float64Array(model.axes.length);
    this.address = this.raw.frameAddress();
    this.floats = lengthOf(this.frame);
    this.read();
  }

  /** Whether the winning component alone is the pose. */
  set hard(hard: boolean) {
    this.raw.setHard(hard);
  }

  /** Takes a pose at once. */
  jump(values: ArrayLike<number>): PuppetFrame {
    this.asked.set(values);
    this.raw.jump(this.asked);
    return this.read();
  }

  /** Follows the hand by so many seconds. */
  advance(secs: number, values: ArrayLike<number>): PuppetFrame {
    this.asked.set(values);
    this.raw.advance(secs, this.asked);
    return this.read();
  }

  private read(): PuppetFrame {
    return readFrame(this.frame, this.address, this.floats);
  }
}

/** Keys that are performed. */
export class Styling extends Handle<InstanceType<KeyStyleGlue["Styling"]>> {
  /** The present frame; every call writes it anew. */
  readonly frame: PuppetFrame;
  private readonly address: number;
  private readonly floats: number;

  constructor(model: KeyStyleModel, glue: KeyStyleGlue) {
    super(
      keyStylePackage.guarded(() => new glue.Styling(model.raw)),
      "key-styling",
    );
    this.frame = emptyFrame(model);
    this.address = this.raw.frameAddress();
    this.floats = lengthOf(this.frame);
  }

  /** Whether the winning component alone is the pose. */
  set hard(hard: boolean) {
    this.raw.setHard(hard);
  }

  /**
   * Takes keys in the order of their times.
   * @throws StrutError with what is wrong with them
   */
  set(keys: readonly StyleKey[], curve: Curve): void {
    const secs = Float64Array.from(keys, (key) => key.secs);
    const values = Float64Array.from(keys.flatMap((key) => [...key.values]));
    keyStylePackage.guarded(() => this.raw.setKeys(secs, values, curve === "monotone"));
  }

  /** The pose at a time. `reached` of the frame are the variables that the keys ask for there. */
  at(secs: number, between: Between): PuppetFrame {
    this.raw.at(secs, BETWEEN[between]);
    return readFrame(this.frame, this.address, this.floats);
  }

  /** The variables at so many moments from the beginning to `length`, all of a moment behind each other. */
  way(length: number, moments: number): Float32Array {
    return keyStylePackage.guarded(() => this.raw.way(length, moments));
  }

  /** Puts the body back above the origin, where it began. */
  goBack(): void {
    this.raw.goBack();
  }

  /** Poses of the whole animation at the model's rate. */
  perform(length: number, between: Between): Float32Array {
    return keyStylePackage.guarded(() => this.raw.perform(length, BETWEEN[between]));
  }

  /** The text of a BVH file of the same. */
  toBvh(length: number, between: Between): string {
    return keyStylePackage.guarded(() => this.raw.toBvh(length, BETWEEN[between]));
  }
}

/** Room for a frame of a model. */
function emptyFrame({ components, axes }: KeyStyleModel): PuppetFrame {
  return {
    pose: new Float32Array(POSE_FLOATS),
    weights: new Float32Array(components),
    measured: new Float32Array(axes.length),
    reached: new Float32Array(axes.length),
  };
}

/** The parts of a frame in the order in which they lie in memory. */
function partsOf({ pose, weights, measured, reached }: PuppetFrame): Float32Array[] {
  return [pose, weights, measured, reached];
}

function lengthOf(frame: PuppetFrame): number {
  return partsOf(frame).reduce((sum, part) => sum + part.length, 0);
}

/** Copies a frame out of the package's memory: no view of it outlives the call. */
function readFrame(frame: PuppetFrame, address: number, length: number): PuppetFrame {
  const floats = new Float32Array(keyStylePackage.bytes, address, length);
  let at = 0;
  for (const part of partsOf(frame)) for (let i = 0; i < part.length; i++) part[i] = floats[at++]!;
  return frame;
}
