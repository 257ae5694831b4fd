/** Style weights that approach their targets exponentially, so that a change of style fades in. */
import { type WeightKey, weightsAt } from "../../engine/style_track";
import type { Stylizer } from "../../engine/stylizer";
import { BODY_PARTS, STYLE_HALF_LIFE_SECS, type StylizeOptions, WEIGHT_EPSILON } from "../protocol";

/** The part of the engine's stylizer that is needed here. */
export type StyledStream = Pick<Stylizer, "setWeights" | "setPartWeights" | "weightsOf">;

/** The weights of the whole body, or of a part of it; `target` is `undefined` if the part follows the whole. */
interface Weights {
  now: Float32Array;
  target: Float32Array | undefined;
  /** Whether the engine has `now`; for a part that follows the whole, whether the engine still has the part's own weights. */
  sent: boolean;
}

/** Target styles: of the whole body, of {@link BODY_PARTS} that have their own, and over time. */
export interface Targets {
  readonly whole: Float32Array;
  readonly parts: readonly (Float32Array | undefined)[];
  readonly track: WeightKey[];
}

/** Eases the weights without allocations. */
export class EasedStyles {
  /** Whole body, then each of {@link BODY_PARTS}. */
  readonly #weights: Weights[];
  #track: WeightKey[] = [];
  /** Half-life of a change of style; 0 applies it at once. */
  halfLifeSecs = STYLE_HALF_LIFE_SECS;

  constructor(
    private readonly stream: StyledStream,
    options: StylizeOptions,
  ) {
    const whole = stream.weightsOf(options.styles);
    this.#weights = [undefined, ...BODY_PARTS].map(() => ({ now: whole.slice(), target: undefined, sent: false }));
    this.targets = this.targetsOf(options);
    this.arrive(0);
  }

  /** The targets that options ask for. Invalid options are refused, and nothing changes. */
  targetsOf({ styles, parts, track }: StylizeOptions): Targets {
    const { stream } = this;
    return {
      whole: stream.weightsOf(styles),
      parts: BODY_PARTS.map((part) => parts[part] && stream.weightsOf(parts[part])),
      track: track.map((key) => ({ frame: key.frame, weights: stream.weightsOf(key.styles) })),
    };
  }

  /** Sets the targets. */
  set targets({ whole, parts, track }: Targets) {
    this.#track = track;
    this.#weights[0]!.target = whole;
    for (const [i, weights] of parts.entries()) {
      const part = this.#weights[1 + i]!;
      // A part with new weights of its own starts from the weights of the whole body.
      if (weights && !part.target) part.now.set(this.#weights[0]!.now);
      part.target = weights;
    }
  }

  /** The current weights of the whole body; callers must not keep the array. */
  get whole(): Float32Array {
    return this.#weights[0]!.now;
  }

  /** Jumps to the styles of an input frame. */
  arrive(frame: number): void {
    this.#move(frame, 1);
  }

  /** Advances by one input frame, which lasts `frameSecs`, to `frame`. */
  ease(frame: number, frameSecs: number): void {
    this.#move(frame, this.halfLifeSecs > 0 ? 1 - 0.5 ** (frameSecs / this.halfLifeSecs) : 1);
  }

  /** Whether the engine has the target weights and the frame does not matter, so that {@link ease} would change nothing. */
  get settled(): boolean {
    return !this.changesOverTime && this.#weights.every(isSettled);
  }

  /** Whether the styles depend on the frame. */
  get changesOverTime(): boolean {
    return this.#track.length > 0;
  }

  #move(frame: number, share: number): void {
    const whole = this.#weights[0]!;
    if (this.changesOverTime) {
      weightsAt(this.#track, frame, whole.now);
      whole.sent = false;
    } else if (approach(whole.now, whole.target!, share)) whole.sent = false;
    if (!whole.sent) this.stream.setWeights(whole.now);
    whole.sent = true;
    for (const [i, name] of BODY_PARTS.entries()) {
      const part = this.#weights[1 + i]!;
      if (part.target) {
        if (approach(part.now, part.target, share)) part.sent = false;
        if (!part.sent) this.stream.setPartWeights(name, part.now);
        part.sent = true;
      } else if (part.sent) {
        this.stream.setPartWeights(name, undefined);
        part.sent = false;
      }
    }
  }
}

function isSettled({ now, target, sent }: Weights): boolean {
  return target ? sent && now.every((weight, i) => weight === target[i]) : !sent;
}

/** Moves weights towards their targets by a share of the distance. Returns whether any had not reached its target. */
function approach(now: Float32Array, target: Float32Array, share: number): boolean {
  let moved = false;
  for (let i = 0; i < now.length; i++) {
    const left = target[i]! - now[i]!;
    if (left === 0) continue;
    moved = true;
    now[i] = Math.abs(left) < WEIGHT_EPSILON ? target[i]! : now[i]! + left * share;
  }
  return moved;
}
