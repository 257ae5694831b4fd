/**
 * Walks a plan with two walkers: one synthesises the whole plan in advance, so that the planner can draw it; the other
 * walks live, so that a change acts on the next frame.
 */

import {
  STATES,
  type Tempo,
  type Walker,
  type WalkFrame,
  type WalkModel,
  type Weights,
} from "../../../client/models/walk";
import { POSE_FLOATS } from "../../../humanoid";
import type { Selection } from "../../../ui/polygon/selection";
import type { WalkBlock } from "../../state/walk";
import { blockBefore, changesOf, type Segment, segmentsOf, stepsOf } from "./plan";

/** A plan and its walking parameters. */
export interface WalkSettings {
  blocks: readonly WalkBlock[];
  loop: boolean;
  tempo: Tempo;
  /** Step length as a share of the style's. */
  stride: number;
  /** Turn of a step to the left, radians. */
  turn: number;
}

/** The motion of one pass through a plan. */
export interface PlannedWalk {
  segments: Segment[];
  rateHz: number;
  /** `POSE_FLOATS` numbers per frame. */
  poses: Float32Array;
  frames: number;
  /** First frame of each step, and the end of the last step. */
  stepStarts: number[];
  /** Duration of each state of each step, seconds. */
  stateSecs: number[][];
}

/** Number of steps in which a walker stops. */
const STOPPING_STEPS = 2;

/** The weights of a block: for each foot one weight per style of the model. */
export function weightsOf({ styles, right, intensity }: WalkBlock, model: WalkModel): Weights {
  const of = (selection: Selection) => {
    const weights = new Float32Array(model.styles.length);
    for (const { name, weight } of selection) {
      const style = model.styles.indexOf(name);
      if (style >= 0) weights[style] = Math.min(5, Math.max(-5, weight * intensity));
    }
    return weights;
  };
  return [of(styles), of(right ?? styles)];
}

export class PlanWalker {
  readonly model: WalkModel;
  readonly #ahead: Walker;
  readonly #live: Walker;
  #settings: WalkSettings | undefined;
  #segments: Segment[] = [];
  #steps = 1;
  /** Offset from the live walker's step indices to steps of the plan, counted over all passes. */
  #offset = 0;
  /** Transitions are planned up to this step. */
  #plannedUntil = 0;
  #poses = new Float32Array(512 * POSE_FLOATS);

  constructor(model: WalkModel) {
    this.model = model;
    this.#ahead = model.walker();
    this.#live = model.walker();
  }

  /** Number of steps of one pass. */
  get steps(): number {
    return this.#steps;
  }

  /** The live walk's current frame. */
  get frame(): WalkFrame {
    return this.#live.frame;
  }

  /** Sets a plan, which the live walk follows from its next frame on, and returns one pass through it. */
  set(settings: WalkSettings): PlannedWalk {
    const { step } = this.place;
    this.#settings = settings;
    this.#segments = segmentsOf(settings.blocks, settings.loop);
    const steps = stepsOf(this.#segments);
    // If the number of steps changes, the live walk continues from the nearest step of the new plan.
    if (steps !== this.#steps) this.#offset = Math.min(step, steps - 1) - this.frame.step;
    this.#steps = steps;
    this.#direct(this.#live, this.frame.step);
    return this.#walkThrough();
  }

  /** The live walk's step of the plan, and the number of completed passes. */
  get place(): { step: number; rounds: number } {
    const at = this.frame.step + this.#offset;
    return { step: ((at % this.#steps) + this.#steps) % this.#steps, rounds: Math.floor(at / this.#steps) };
  }

  /** Advances by `secs` seconds. */
  advance(secs: number): WalkFrame {
    this.#live.walks = this.#walksOn(this.place.step);
    const frame = this.#live.advance(secs);
    if (this.#settings && frame.step + this.#steps > this.#plannedUntil) this.#planRound(this.#live);
    return frame;
  }

  /** Aligns the ends of the live walk's steps with a beat that is now, at the cadence of the plan. */
  beatNow(): void {
    const tempo = this.#settings?.tempo;
    if (tempo?.kind === "fixed") this.#live.beatNow(tempo.cadence);
  }

  /** Moves the live walk to a frame of the pass that {@link set} returned, as if walked from its beginning. */
  seek(frame: number): void {
    this.#offset = 0;
    this.#begin(this.#live);
    for (let walked = 0; walked < frame; walked += 1) {
      this.#live.walks = this.#walksOn(this.#live.frame.step);
      this.#live.next();
    }
  }

  dispose(): void {
    this.#ahead.dispose();
    this.#live.dispose();
    this.model.dispose();
  }

  /** Whether walking continues after a step: a plan that does not loop begins and ends with standing. */
  #walksOn(step: number): boolean {
    return this.#settings!.loop || step < this.#steps - STOPPING_STEPS;
  }

  /** Makes a walker begin the plan as if it had never walked. */
  #begin(walker: Walker): void {
    walker.walks = this.#settings!.loop;
    walker.reset();
    this.#direct(walker, 0);
    // The first reset began with the style of the former plan.
    walker.reset();
  }

  /** Sets the plan on a walker, from one of the walker's own steps on. */
  #direct(walker: Walker, step: number): void {
    const { blocks, tempo, stride, turn } = this.#settings!;
    const round = Math.floor((step + this.#offset) / this.#steps) * this.#steps - this.#offset;
    const base = blocks[blockBefore(this.#segments, step - round)]!;
    const changes = changesOf(this.#segments, round).filter((change) => change.step + change.between >= step);
    this.#plannedUntil = round + this.#steps;
    walker.tempo = tempo;
    walker.stride = stride;
    walker.turn = turn;
    walker.plan(
      weightsOf(base, this.model),
      changes.map(({ step, between, block }) => ({ step: Math.max(0, step), between, weights: this.#weights(block) })),
    );
    this.#planRound(walker);
  }

  /** Plans another pass, if the plan loops. */
  #planRound(walker: Walker): void {
    if (!this.#settings!.loop) {
      this.#plannedUntil = Number.POSITIVE_INFINITY;
      return;
    }
    for (const { step, between, block } of changesOf(this.#segments, this.#plannedUntil))
      walker.add({ step: Math.max(0, step), between, weights: this.#weights(block) });
    this.#plannedUntil += this.#steps;
  }

  #weights(block: number): Weights {
    return weightsOf(this.#settings!.blocks[block]!, this.model);
  }

  #walkThrough(): PlannedWalk {
    const walker = this.#ahead;
    const [offset, planned] = [this.#offset, this.#plannedUntil];
    this.#offset = 0;
    this.#begin(walker);
    [this.#offset, this.#plannedUntil] = [offset, planned];
    const { frame } = walker;
    const { rateHz } = this.model;
    const stepStarts: number[] = [];
    const stateSecs: number[][] = [];
    let frames = 0;
    while (frame.step < this.#steps) {
      if (frame.step === stepStarts.length) {
        stepStarts.push(frames);
        stateSecs.push(Array.from({ length: STATES }, (_, state) => frame.durations[state]! / rateHz));
      }
      if ((frames + 1) * POSE_FLOATS > this.#poses.length) {
        const longer = new Float32Array(2 * this.#poses.length);
        longer.set(this.#poses);
        this.#poses = longer;
      }
      this.#poses.set(frame.pose, frames * POSE_FLOATS);
      frames += 1;
      walker.walks = this.#walksOn(frame.step);
      walker.next();
    }
    stepStarts.push(frames);
    const poses = this.#poses.slice(0, frames * POSE_FLOATS);
    return { segments: this.#segments, rateHz, poses, frames, stepStarts, stateSecs };
  }
}
