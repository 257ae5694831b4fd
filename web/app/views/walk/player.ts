/** Plays the plan of the state: live from its current position, or sought to a time of the plan. */
import type { WalkFrame } from "../../../client/models/walk";
import { stepSecs } from "../../../player/clock";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";
import { WALK_RANGES } from "../../state/walk";
import type { PlannedWalk, PlanWalker, WalkSettings } from "./plan_walker";
import { TapTempo } from "./tap_tempo";

/** Seed of sampled durations: a link shows everyone the same walk. */
const SEED = 1;

export interface PlayerListeners {
  /** Called with one pass through a new plan. */
  onPlan: (walk: PlannedWalk) => void;
  /** Called with the live walk's frame, and its time and step in the plan. */
  onFrame: (frame: WalkFrame, secs: number, step: number) => void;
  /** Called when the walk was moved, with its new frame. */
  onJump: (frame: WalkFrame) => void;
}

export class Player {
  readonly #store: Store;
  readonly #listeners: PlayerListeners;
  readonly #taps = new TapTempo();
  #walker: PlanWalker | undefined;
  #walk: PlannedWalk | undefined;
  /** Whether the plan of the state differs from {@link #walk}. */
  #planChanged = true;
  /** Whether a paused walk must be redrawn. */
  #moved = true;
  /**
   * The time to which the walk was sought, seconds, until it continues: the phase of its step gives the time less
   * precisely.
   */
  #sought: number | undefined;
  #last = 0;
  /** Whether a {@link pass} controls the plan, which excludes everything else. */
  #passing = false;

  constructor(store: Store, listeners: PlayerListeners) {
    this.#store = store;
    this.#listeners = listeners;
  }

  /** Sets the walker of another model, which restarts the plan; without one nothing is played. */
  set walker(walker: PlanWalker | undefined) {
    if (walker === this.#walker) return;
    this.#walker = walker;
    this.#walk = undefined;
    this.#planChanged = true;
    this.seek(0);
  }

  /** One pass through the plan of the state; `undefined` without a walker or a plan. */
  get walk(): PlannedWalk | undefined {
    return this.#ready() && this.#walk;
  }

  /** Starts the clock. */
  start(now: number): void {
    this.#last = now;
    this.changePlan();
  }

  /** To be called when the plan of the state has changed. */
  changePlan(): void {
    this.#planChanged = true;
    this.#moved = true;
  }

  /** To be called when the plan must be drawn anew. */
  redraw(): void {
    this.#moved = true;
    if (this.#walk && !this.#planChanged) this.#listeners.onPlan(this.#walk);
  }

  /** Advances to a display frame; times in milliseconds. */
  tick(now: number): void {
    const secs = stepSecs(this.#last, now);
    this.#last = now;
    const walker = this.#ready();
    if (!walker || this.#passing) return;
    const { state } = this.#store;
    if (state.playing) {
      walker.advance(secs * state.speed);
      this.#sought = undefined;
      this.#moved = true;
      if (!state.loop && walker.place.rounds > 0) {
        this.#put(walker, this.#walk!.frames - 1);
        this.#store.edit({ playing: false });
      }
    }
    if (this.#moved) this.#show(walker);
  }

  /** Duration of one pass at the chosen speed, seconds; 0 without a walk. */
  get passSecs(): number {
    return this.#walk ? this.#walk.frames / this.#walk.rateHz / this.#store.state.speed : 0;
  }

  /**
   * One pass through the plan at the speed of the state, frame by frame: shows each, and yields the progress.
   * Afterwards the walk returns to its previous position.
   */
  *pass(rateHz: number): Generator<number> {
    const walker = this.#ready();
    if (!walker) return;
    const { playing, speed } = this.#store.state;
    const secs = this.#secsOf(walker);
    this.#store.edit({ playing: false });
    this.seek(0);
    this.#passing = true;
    const frames = Math.round(this.passSecs * rateHz);
    try {
      for (let frame = 0; frame < frames; frame++) {
        if (frame > 0) {
          walker.advance(speed / rateHz);
          this.#sought = undefined;
        }
        this.#show(walker);
        yield frame / frames;
      }
    } finally {
      this.#passing = false;
      this.seek(secs);
      this.#store.edit({ playing });
    }
  }

  /** Moves the walk to the frame nearest to a time of the plan, seconds. */
  seek(secs: number): void {
    const walker = this.#ready();
    if (!walker || this.#passing) return;
    const { rateHz, frames } = this.#walk!;
    this.#put(walker, Math.min(Math.max(0, Math.round(secs * rateHz)), frames - 1));
    this.#listeners.onJump(walker.frame);
  }

  /** Pauses in the middle of the step that is `steps` away. */
  stepBy(steps: number): void {
    const walker = this.#ready();
    if (!walker) return;
    this.#store.edit({ playing: false });
    const step = (walker.place.step + steps + walker.steps) % walker.steps;
    this.seek(this.#secsAt(step, 0.5));
  }

  togglePlay(): void {
    const walker = this.#ready();
    if (!walker) return;
    const { playing, loop } = this.#store.state;
    if (!playing && !loop && walker.place.step === walker.steps - 1) this.seek(0);
    this.#store.edit({ playing: !playing });
  }

  /** Handles a tapped beat: the cadence becomes that of the last beats, and a step ends at the beat. */
  tapBeat(): void {
    if (!this.#walker || this.#store.state.walkTempo !== "fixed") return;
    const cadence = this.#taps.tap(performance.now());
    if (cadence === undefined) return;
    const { min, max } = WALK_RANGES.cadence;
    this.#store.edit({ walkCadence: Math.round(Math.min(max, Math.max(min, cadence))) }, "walk cadence");
    this.#ready()?.beatNow();
  }

  /** The walker with the plan of the state; `undefined` without a walker or a plan. */
  #ready(): PlanWalker | undefined {
    const { state } = this.#store;
    if (!this.#walker || state.walk.length === 0) return undefined;
    if (this.#planChanged || !this.#walk) {
      this.#planChanged = false;
      this.#moved = true;
      this.#sought = undefined;
      this.#walk = this.#walker.set(settingsOf(state));
      this.#listeners.onPlan(this.#walk);
    }
    return this.#walker;
  }

  #show(walker: PlanWalker): void {
    this.#moved = false;
    this.#listeners.onFrame(walker.frame, this.#secsOf(walker), walker.place.step);
  }

  #put(walker: PlanWalker, frame: number): void {
    walker.seek(frame);
    this.#sought = frame / this.#walk!.rateHz;
    this.#moved = true;
  }

  /** Position of a walker in the plan, seconds. */
  #secsOf({ frame, place }: PlanWalker): number {
    return this.#sought ?? this.#secsAt(place.step, frame.done);
  }

  #secsAt(step: number, done: number): number {
    const { stepStarts, rateHz } = this.#walk!;
    const [from, to] = [stepStarts[step] ?? 0, stepStarts[step + 1] ?? stepStarts.at(-1)!];
    return (from + (to - from) * done) / rateHz;
  }
}

function settingsOf(state: Readonly<AppState>): WalkSettings {
  const { walk, loop, walkTempo, walkCadence, walkStride, walkTurn } = state;
  const tempo: WalkSettings["tempo"] =
    walkTempo === "fixed"
      ? { kind: "fixed", cadence: walkCadence }
      : walkTempo === "sampled"
        ? { kind: "sampled", seed: SEED }
        : { kind: "model" };
  return { blocks: walk, loop, tempo, stride: walkStride / 100, turn: (walkTurn * Math.PI) / 180 };
}
