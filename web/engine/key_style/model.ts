/**
 * Poses from style variables on the calling thread. A pose takes microseconds and follows the pointer within the same
 * display frame. A {@link KeyStyleModel} is the trained model, a {@link Poser} is posed interactively, a {@link
 * Styling} interpolates keys.
 */
import { POSE_FLOATS } from "../../humanoid";
import { Handle } from "../handle";
import { Somn, type SomnOptions } from "./somn";
import { type KeyStyleGlue, keyStylePackage } from "./wasm";

/** A clip of the training motions: index of its first frame among the frames of all clips, and its length in frames. */
export interface TrainingClip {
  name: string;
  first: number;
  frames: number;
}

/** A parsed style variable: its unit, or the error in its expression and its column, from 0. */
export type CheckedAxis = { unit: string } | { message: string; column: number };

/** A key: its time and the values of the style variables. */
export interface StyleKey {
  secs: number;
  values: readonly number[];
}

/**
 * Interpolation between keys: of the style variables, of the style variables with recorded poses at the keys, or of
 * recorded poses.
 */
export type Between = "style" | "hybrid" | "frame";
const BETWEEN: Readonly<Record<Between, number>> = { style: 0, hybrid: 1, frame: 2 };

/** Interpolation curve of the variables between keys: a Catmull-Rom spline, or a monotone one, which does not overshoot. */
export type Curve = "spline" | "monotone";

/**
 * How mixture components are blended into a pose. `hard` uses the likeliest component alone. `smooth` uses the best
 * settings for the caller's purpose. Otherwise each component counts by its likelihood to the power of 1 /
 * `temperature` (0.1 to 100), with regions blurred by `blur` standard deviations of the variables (0 to 10).
 */
export type PoseMode = "hard" | "smooth" | { readonly temperature: number; readonly blur: number };

/** A range of a style variable and the number of samples in it. */
export interface Span {
  min: number;
  max: number;
  count: number;
}

/** Parses a style variable: the name of a measure, or an expression. */
export async function checkAxis(text: string): Promise<CheckedAxis> {
  const glue = await keyStylePackage.load();
  const checked = keyStylePackage.guarded(() => glue.checkMeasure(text));
  try {
    const column = checked.column();
    return column < 0 ? { unit: checked.unit() } : { message: checked.message(), column };
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
  /** The variables of every training frame, frame after frame. */
  readonly values: Float32Array;
  /** The mean of each mixture component in the style variables, component after component. */
  readonly centres: Float32Array;
  /** Mean and standard deviation of each variable. */
  readonly mean: Float32Array;
  readonly deviation: Float32Array;

  private constructor(
    private readonly glue: KeyStyleGlue,
    make: () => InstanceType<KeyStyleGlue["KeyStyleModel"]>,
  ) {
    super(keyStylePackage.guarded(make), "key-style model");
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
   * Opens the model in a `.strutkeys` file.
   * @throws StrutError if the module cannot be loaded, or if the file is invalid
   */
  static async open(file: Uint8Array): Promise<KeyStyleModel> {
    const glue = await keyStylePackage.load();
    return new KeyStyleModel(glue, () => new glue.KeyStyleModel(file));
  }

  /**
   * Starts learning from the same recordings from scratch, update by update.
   * @throws StrutError if there are too many components
   */
  learn(options?: SomnOptions): Somn<KeyStyleModel> {
    return new Somn(this, this.glue, (make) => new KeyStyleModel(this.glue, make), options);
  }

  poser(): Poser {
    return new Poser(this, this.glue);
  }

  styling(): Styling {
    return new Styling(this, this.glue);
  }

  /** Index of the training frame whose variables are nearest. */
  nearest(values: readonly number[]): number {
    return this.raw.nearest(Float64Array.from(values));
  }

  /** The pose of a training frame. */
  recorded(frame: number): Float32Array | undefined {
    return this.raw.recorded(frame);
  }

  /**
   * Mean angle between the joints of the training poses and the poses that the model predicts from their variables,
   * degrees. Takes a millisecond per thousand frames.
   * @throws StrutError if a number of the mode is out of range
   */
  error(mode: Exclude<PoseMode, "smooth">): number {
    const [temperature, blur] = numbersOf(mode);
    return keyStylePackage.guarded(() => this.raw.error(temperature, blur ?? 0));
  }

  /**
   * Support of the training data at each point of a grid, row after row from the largest value of the second variable.
   * Below 0 a pose is extrapolated. Without a second variable there is one row. Further variables are taken from
   * `values`.
   */
  support(x: Span, y: Span | undefined, values: readonly number[]): Float32Array {
    const { min, max, count } = y ?? { min: 0, max: 0, count: 1 };
    return keyStylePackage.guarded(() =>
      this.raw.support(Float64Array.from(values), x.min, x.max, x.count, min, max, count),
    );
  }
}

/** A pose and the values behind it. */
export interface KeyStyleFrame {
  /** `POSE_FLOATS` numbers. */
  readonly pose: Float32Array;
  /** Weight of each mixture component in the pose. */
  readonly weights: Float32Array;
  /** The variables measured on the pose, and the requested ones, clamped to the range of the training data. */
  readonly measured: Float32Array;
  readonly reached: Float32Array;
}

/** An object of the package that fills an array with its current frame. */
interface RawFrames {
  free(): void;
  setMode(temperature: number | undefined, blur: number): void;
  read(floats: Float32Array): void;
}

/** Base of objects that pose a character. Every call overwrites the single frame. */
abstract class FrameSource<Raw extends RawFrames> extends Handle<Raw> {
  /** The current frame; every call overwrites it. */
  readonly frame: KeyStyleFrame;
  private readonly floats: Float32Array;

  /**
   * @param smooth temperature and blur of the mode `smooth`
   * @param noun noun for messages
   */
  protected constructor(
    model: KeyStyleModel,
    make: () => Raw,
    private readonly smooth: Float64Array,
    noun: string,
  ) {
    super(keyStylePackage.guarded(make), noun);
    this.floats = new Float32Array(POSE_FLOATS + model.components + 2 * model.axes.length);
    this.frame = frameOf(this.floats, model);
  }

  /**
   * Sets how components are blended, from the next pose on; in a {@link Styling}, from the next keys on.
   * @throws StrutError if a number is out of range; nothing changes then
   */
  set mode(mode: PoseMode) {
    const [temperature, blur] = mode === "smooth" ? this.smooth : numbersOf(mode);
    keyStylePackage.guarded(() => this.raw.setMode(temperature, blur ?? 0));
  }

  protected read(): KeyStyleFrame {
    this.raw.read(this.floats);
    return this.frame;
  }
}

/** A character whose pose follows the style variables while they are dragged. */
export class Poser extends FrameSource<InstanceType<KeyStyleGlue["DragCharacter"]>> {
  private readonly asked: Float64Array;

  constructor(model: KeyStyleModel, glue: KeyStyleGlue) {
    super(model, () => new glue.DragCharacter(model.raw), glue.DragCharacter.smoothMode(), "poser");
    this.asked = new Float64Array(model.axes.length);
    this.read();
  }

  /** Jumps to the pose of these variables. */
  jump(values: ArrayLike<number>): KeyStyleFrame {
    this.asked.set(values);
    this.raw.jump(this.asked);
    return this.read();
  }

  /** Moves towards the pose of these variables, by `secs` seconds. */
  advance(secs: number, values: ArrayLike<number>): KeyStyleFrame {
    this.asked.set(values);
    this.raw.advance(secs, this.asked);
    return this.read();
  }
}

/** An animation interpolated between keys. */
export class Styling extends FrameSource<InstanceType<KeyStyleGlue["Styling"]>> {
  constructor(model: KeyStyleModel, glue: KeyStyleGlue) {
    super(model, () => new glue.Styling(model.raw), glue.Styling.smoothMode(), "key-styling");
  }

  /**
   * Replaces the keys, which are ordered by time.
   * @throws StrutError if they are invalid; the message says why
   */
  set(keys: readonly StyleKey[], curve: Curve): void {
    const secs = Float64Array.from(keys, (key) => key.secs);
    const values = Float64Array.from(keys.flatMap((key) => [...key.values]));
    keyStylePackage.guarded(() => this.raw.setKeys(secs, values, curve === "monotone"));
  }

  /** The pose at a time. The frame's `reached` are the variables that the keys ask for at that time. */
  at(secs: number, between: Between): KeyStyleFrame {
    this.raw.at(secs, BETWEEN[between]);
    return this.read();
  }

  /** The variables at `moments` equally spaced times from 0 to `length` seconds, time after time. */
  way(length: number, moments: number): Float32Array {
    return keyStylePackage.guarded(() => this.raw.way(length, moments));
  }

  /** Moves the body back to the origin. */
  goBack(): void {
    this.raw.goBack();
  }

  /** Poses of the whole animation, `length` seconds at the model's rate. */
  perform(length: number, between: Between): Float32Array {
    return keyStylePackage.guarded(() => this.raw.perform(length, BETWEEN[between]));
  }

  /** The whole animation as the text of a BVH file. */
  toBvh(length: number, between: Between): string {
    return keyStylePackage.guarded(() => this.raw.toBvh(length, BETWEEN[between]));
  }
}

/** Temperature and blur; empty if a single component gives the pose. */
function numbersOf(mode: Exclude<PoseMode, "smooth">): readonly [temperature?: number, blur?: number] {
  return mode === "hard" ? [] : [mode.temperature, mode.blur];
}

/** A frame whose arrays are consecutive views of one array, which the package fills. */
function frameOf(floats: Float32Array, { components, axes }: KeyStyleModel): KeyStyleFrame {
  const measured = POSE_FLOATS + components;
  const reached = measured + axes.length;
  return {
    pose: floats.subarray(0, POSE_FLOATS),
    weights: floats.subarray(POSE_FLOATS, measured),
    measured: floats.subarray(measured, reached),
    reached: floats.subarray(reached),
  };
}
