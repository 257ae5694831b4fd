/**
 * Walk synthesis on the calling thread. A frame takes microseconds, and a control acts on the next frame. A {@link
 * WalkModel} holds the learned walk styles, a {@link Walker} is one endless walk.
 */
import { POSE_FLOATS } from "../../humanoid";
import { Handle } from "../handle";
import { loadBuiltInWalkModel } from "./built_in";
import { type WalkGlue, walkPackage } from "./wasm";

/** Number of states of a step. */
export const STATES = 5;
/** Floats of a frame; `rust/strut-wasm/src/walk` defines the layout. */
const FRAME_FLOATS = POSE_FLOATS + 5 + STATES;
/** Largest turn per step, radians. */
export const MAX_TURN = 0.18;

/** A weight for each style, for left and for right steps; the remainder to 1 belongs to the average model. */
export type Weights = readonly [left: Float32Array, right: Float32Array];

/** The swing foot: 0 left, 1 right. */
export type Side = 0 | 1;

/** The current state of a walk. */
export interface WalkFrame {
  /** `POSE_FLOATS` numbers. */
  readonly pose: Float32Array;
  /** Number of the step, its phase (0–1), and its HSMM state (0–4). */
  step: number;
  done: number;
  state: number;
  /** Foot contacts, left and right. */
  readonly planted: [boolean, boolean];
  /** Duration of each state of the step, frames. */
  readonly durations: Float32Array;
}

/** A joint's angle over a left and a right step, a value for each frame; angles in radians. */
export interface JointCurve {
  /** Axis of the joint's own frame about which it turns most: 0 x, 1 y, 2 z. */
  axis: number;
  angle: Float32Array;
  mean: Float32Array;
  deviation: Float32Array;
  side: Uint8Array;
}

/** Adjustable parameters of a {@link JointPath}. */
export interface PathOptions {
  /** Factors of the variances σ², σ′² and σ″² of poses, velocities and accelerations, 0.001 to 1000; 1 if missing. */
  variance?: ArrayLike<number>;
  /** ρ of the durations of left and right steps, d = d̄ + ρν with ν their variance, −10 to 10 per frame; 0 if missing. */
  rho?: ArrayLike<number>;
}

/**
 * The likeliest trajectory of one degree of freedom over a left and a right step, a value for each frame, without joint
 * limits. Angles are in radians from the joint's mean rotation.
 */
export interface JointPath {
  /** c. */
  c: Float32Array;
  /** μ and σ of the frame's state; σ includes its factor. */
  mean: Float32Array;
  deviation: Float32Array;
  /** The frame's state, 0 to 4, and the swing foot. */
  state: Uint8Array;
  side: Uint8Array;
  /** Durations of the states of a left and a right step, 2 × 5, frames, before their sum is rounded. */
  durations: Float32Array;
}

/** A change of style that is interpolated over steps. */
export interface WalkTransition {
  /** The first interpolated step. */
  step: number;
  /** Number of interpolated steps. */
  between: number;
  weights: Weights;
}

/** Step durations: the means of the model, samples from its distributions, or a fixed cadence (steps per minute). */
export type Tempo = { kind: "model" } | { kind: "sampled"; seed: number } | { kind: "fixed"; cadence: number };

/** A model of walk styles (a hidden semi-Markov model for each). */
export class WalkModel extends Handle<InstanceType<WalkGlue["WalkModel"]>> {
  readonly styles: readonly string[];
  readonly rateHz: number;
  /** Bone offsets, 21 × xyz, metres. */
  readonly proportions: Float32Array;

  private constructor(
    private readonly glue: WalkGlue,
    file: Uint8Array,
  ) {
    super(
      walkPackage.guarded(() => new glue.WalkModel(file)),
      "walk model",
    );
    this.styles = this.raw.styles();
    this.rateHz = this.raw.rateHz();
    this.proportions = this.raw.proportions();
  }

  /**
   * Opens the model in a `.strutwalk` file.
   * @throws StrutError if the module cannot be loaded, or if the file is invalid
   */
  static async open(file: Uint8Array): Promise<WalkModel> {
    return new WalkModel(await walkPackage.load(), file);
  }

  /**
   * The model of the built-in walks, which `trainWalk` would make from the built-in database.
   * @throws StrutError if it cannot be loaded
   */
  static async builtIn(): Promise<WalkModel> {
    const [glue, file] = await Promise.all([walkPackage.load(), loadBuiltInWalkModel()]);
    return new WalkModel(glue, file);
  }

  /** A new walk in the average of all styles. */
  walker(): Walker {
    return new Walker(this, this.glue);
  }

  /** Durations of the states of a step, seconds: means and standard deviations. */
  durations(weights: Weights, side: Side): { means: number[]; deviations: number[] } {
    const numbers = walkPackage.guarded(() => this.raw.durations(weights[side], side));
    return {
      means: Array.from(numbers.subarray(0, STATES), (frames) => frames / this.rateHz),
      deviations: Array.from(numbers.subarray(STATES), (variance) => Math.sqrt(variance) / this.rateHz),
    };
  }

  /** @throws StrutError unless there is one finite weight for each style */
  curve(weights: Weights, joint: number): JointCurve {
    const numbers = walkPackage.guarded(() => this.raw.curve(...weights, joint));
    const [angle, mean, deviation, side] = columnsOf(numbers.subarray(1));
    return { axis: numbers[0]!, angle, mean, deviation, side: Uint8Array.from(side) };
  }

  /**
   * The trajectory of a joint's degree of freedom about an axis of its own frame, 0 to 2.
   * @throws StrutError unless there is one finite weight for each style, and if a number is out of range
   */
  path(weights: Weights, joint: number, axis: number, { variance, rho }: PathOptions = {}): JointPath {
    const factors = Float64Array.from(variance ?? [1, 1, 1]);
    const numbers = walkPackage.guarded(() =>
      this.raw.path(...weights, joint, axis, factors, Float32Array.from(rho ?? [0, 0])),
    );
    const [c, mean, deviation, side, state] = columnsOf(numbers.subarray(2 * STATES));
    return {
      c,
      mean,
      deviation,
      state: Uint8Array.from(state),
      side: Uint8Array.from(side),
      durations: numbers.slice(0, 2 * STATES),
    };
  }

  /** The text of a BVH file with one pose per frame. */
  toBvh(poses: Float32Array): string {
    return walkPackage.guarded(() => this.raw.toBvh(poses));
  }
}

type Columns = readonly [Float32Array, Float32Array, Float32Array, Float32Array, Float32Array];

/** Splits five numbers per frame into one array per number. */
function columnsOf(numbers: Float32Array): Columns {
  const column = (k: number) => Float32Array.from({ length: numbers.length / 5 }, (_, f) => numbers[5 * f + k]!);
  return [column(0), column(1), column(2), column(3), column(4)];
}

/** One endless walk, synthesised frame by frame. */
export class Walker extends Handle<InstanceType<WalkGlue["Walk"]>> {
  /** The floats of the current frame, which the package fills. The pose and the durations are views of it. */
  private readonly floats = new Float32Array(FRAME_FLOATS);
  /** The current frame; every call overwrites it. */
  readonly frame: WalkFrame = {
    pose: this.floats.subarray(0, POSE_FLOATS),
    step: 0,
    done: 0,
    state: 0,
    planted: [false, false],
    durations: this.floats.subarray(POSE_FLOATS + 5),
  };

  constructor(model: WalkModel, glue: WalkGlue) {
    super(
      walkPackage.guarded(() => new glue.Walk(model.raw)),
      "walker",
    );
    this.read();
  }

  /** Index of the first step whose style can still be changed. */
  get nextStep(): number {
    return this.raw.nextStep();
  }

  /** Restarts at the origin; styles and controls are kept. */
  reset(): void {
    this.raw.reset();
    this.read();
  }

  /**
   * Sets the style from the next frame on, and the transitions after it.
   * @throws StrutError unless there is one finite weight for each style
   */
  plan(weights: Weights, transitions: readonly WalkTransition[]): void {
    walkPackage.guarded(() => {
      this.raw.setStyles(...weights);
      for (const { step, between, weights } of transitions) this.raw.planTransition(step, between, ...weights);
    });
  }

  /** Adds a transition. */
  add({ step, between, weights }: WalkTransition): void {
    walkPackage.guarded(() => this.raw.planTransition(step, between, ...weights));
  }

  set tempo(tempo: Tempo) {
    this.raw.setCadence(tempo.kind === "fixed" ? tempo.cadence : undefined);
    this.raw.setVariation(tempo.kind === "sampled" ? tempo.seed : undefined);
  }

  /** Synchronises the ends of steps with a beat of `cadence` steps per minute; one beat is now. */
  beatNow(cadence: number): void {
    this.raw.setBeat(cadence, 0);
  }

  /** Turn of a step to the left, radians. */
  set turn(turn: number) {
    this.raw.setTurn(turn);
  }

  /** Step length as a share of the style's; the engine clamps it. */
  set stride(share: number) {
    this.raw.setStride(share);
  }

  /** Sets whether to walk or to stand, from the next frame on; the change takes two steps. */
  set walks(walks: boolean) {
    this.raw.setWalking(walks);
  }

  /** Advances by `secs` seconds. */
  advance(secs: number): WalkFrame {
    this.raw.advance(secs);
    return this.read();
  }

  /** Advances by one frame of the model's rate. */
  next(): WalkFrame {
    this.raw.nextFrame();
    return this.read();
  }

  private read(): WalkFrame {
    const { frame, floats } = this;
    this.raw.read(floats);
    frame.step = floats[POSE_FLOATS]!;
    frame.done = floats[POSE_FLOATS + 1]!;
    frame.state = floats[POSE_FLOATS + 2]!;
    frame.planted[0] = floats[POSE_FLOATS + 3] === 1;
    frame.planted[1] = floats[POSE_FLOATS + 4] === 1;
    return frame;
  }
}
