/**
 * Walk synthesis, on the present thread: a frame takes microseconds, and what is controlled acts on the next one. A
 * {@link WalkModel} says what its styles are like, a {@link Walker} walks.
 */
import { Handle } from "../handle";
import { POSE_FLOATS } from "../types";
import { type WalkGlue, walkPackage } from "./wasm";

/** States of a step. */
export const STATES = 5;
/** Numbers of a frame, as `rust/strut-wasm-walk` says. */
const FRAME_FLOATS = POSE_FLOATS + 5 + STATES;
/** Greatest turn of a step, radians. */
export const MOST_TURN = 0.18;

/** For the steps of the left foot and of the right one weight a style; what they lack to a sum of 1 is the average's. */
export type Weights = readonly [left: Float32Array, right: Float32Array];

/** A foot that swings: left or right. */
export type Side = 0 | 1;

/** Where a walk stands. */
export interface WalkFrame {
  /** `POSE_FLOATS` numbers. */
  readonly pose: Float32Array;
  /** Number of the step, how much of it is done (0–1), and its state (0–4). */
  step: number;
  done: number;
  state: number;
  /** Feet that stand, left and right. */
  readonly planted: [boolean, boolean];
  /** Frames that each state of the step lasts. */
  readonly durations: Float32Array;
}

/** A joint's angle through a left step and a right one, a number for each frame; angles in radians. */
export interface JointCurve {
  /** Axis of the joint's own frame that it turns about most. */
  axis: number;
  angle: Float32Array;
  mean: Float32Array;
  deviation: Float32Array;
  side: Uint8Array;
}

/** A change of style that is spread over steps. */
export interface WalkTransition {
  /** The first step in between. */
  step: number;
  /** Steps in between. */
  between: number;
  weights: Weights;
}

/** How long steps last: as in the model, drawn about that by a seed, or all the same (steps a minute). */
export type Tempo = { kind: "model" } | { kind: "sampled"; seed: number } | { kind: "fixed"; cadence: number };

/** A model of walk styles. */
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
   * The model in a `.strutwalk` file.
   * @throws StrutError if the module cannot be had, or with what is wrong with the file
   */
  static async open(file: Uint8Array): Promise<WalkModel> {
    return new WalkModel(await walkPackage.load(), file);
  }

  /** Somebody who walks as the average of all styles. */
  walker(): Walker {
    return new Walker(this, this.glue);
  }

  /** Seconds that the states of a step last: means and standard deviations. */
  durations(weights: Weights, side: Side): { means: number[]; deviations: number[] } {
    const numbers = walkPackage.guarded(() => this.raw.durations(weights[side], side));
    return {
      means: Array.from(numbers.subarray(0, STATES), (frames) => frames / this.rateHz),
      deviations: Array.from(numbers.subarray(STATES), (variance) => Math.sqrt(variance) / this.rateHz),
    };
  }

  /** @throws StrutError if weights are none */
  curve(weights: Weights, joint: number): JointCurve {
    const numbers = walkPackage.guarded(() => this.raw.curve(...weights, joint));
    const frames = (numbers.length - 1) / 5;
    const column = (k: number) => Float32Array.from({ length: frames }, (_, f) => numbers[1 + 5 * f + k]!);
    return {
      axis: numbers[0]!,
      angle: column(0),
      mean: column(1),
      deviation: column(2),
      side: Uint8Array.from(column(3)),
    };
  }

  /** The text of a BVH file of poses, one a frame. */
  toBvh(poses: Float32Array): string {
    return walkPackage.guarded(() => this.raw.toBvh(poses));
  }
}

/** Somebody who walks, and never stops. */
export class Walker extends Handle<InstanceType<WalkGlue["Walk"]>> {
  /** The present frame; every call writes it anew. */
  readonly frame: WalkFrame = {
    pose: new Float32Array(POSE_FLOATS),
    step: 0,
    done: 0,
    state: 0,
    planted: [false, false],
    durations: new Float32Array(STATES),
  };
  private readonly address: number;

  constructor(model: WalkModel, glue: WalkGlue) {
    super(
      walkPackage.guarded(() => new glue.Walk(model.raw)),
      "walker",
    );
    this.address = this.raw.frameAddress();
    this.read();
  }

  /** Number of the first step whose style can still be changed. */
  get nextStep(): number {
    return this.raw.nextStep();
  }

  /** Begins anew at the origin; styles and controls stay. */
  reset(): void {
    this.raw.reset();
    this.read();
  }

  /**
   * Walks in a style from the next frame on, and changes it as planned.
   * @throws StrutError if weights are none
   */
  plan(weights: Weights, transitions: readonly WalkTransition[]): void {
    walkPackage.guarded(() => {
      this.raw.setStyles(...weights);
      for (const { step, between, weights } of transitions) this.raw.planTransition(step, between, ...weights);
    });
  }

  /** Another change of style. */
  add({ step, between, weights }: WalkTransition): void {
    walkPackage.guarded(() => this.raw.planTransition(step, between, ...weights));
  }

  set tempo(tempo: Tempo) {
    this.raw.setCadence(tempo.kind === "fixed" ? tempo.cadence : undefined);
    this.raw.setVariation(tempo.kind === "sampled" ? tempo.seed : undefined);
  }

  /** Steps that come to end on a beat: so many a minute, and one of them now. */
  beatNow(cadence: number): void {
    this.raw.setBeat(cadence, 0);
  }

  /** Radians to the left that a step turns. */
  set turn(turn: number) {
    this.raw.setTurn(turn);
  }

  /** Length of steps as a share of the style's; the engine takes the nearest that it can. */
  set stride(share: number) {
    this.raw.setStride(share);
  }

  /** Whether to walk or to stand, from the next frame on; either takes two steps. */
  set walks(walks: boolean) {
    this.raw.setWalking(walks);
  }

  /** Goes on by so many seconds. */
  advance(secs: number): WalkFrame {
    this.raw.advance(secs);
    return this.read();
  }

  /** Goes on by one frame of the model's rate. */
  next(): WalkFrame {
    this.raw.nextFrame();
    return this.read();
  }

  private read(): WalkFrame {
    const { frame } = this;
    const floats = new Float32Array(walkPackage.bytes, this.address, FRAME_FLOATS);
    for (let i = 0; i < POSE_FLOATS; i++) frame.pose[i] = floats[i]!;
    frame.step = floats[POSE_FLOATS]!;
    frame.done = floats[POSE_FLOATS + 1]!;
    frame.state = floats[POSE_FLOATS + 2]!;
    frame.planted[0] = floats[POSE_FLOATS + 3] === 1;
    frame.planted[1] = floats[POSE_FLOATS + 4] === 1;
    for (let i = 0; i < STATES; i++) frame.durations[i] = floats[POSE_FLOATS + 5 + i]!;
    return frame;
  }
}
