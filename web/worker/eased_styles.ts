/** The styles that the engine has now, on their way to those that are wanted: a change fades in. */
import { type WeightKey, weightsAt } from "../engine/style_track";
import type { Stylizer } from "../engine/stylizer";
import { BODY_PARTS, type StylizeOptions } from "./protocol";

/** Half-life with which a change of style is taken up. */
export const STYLE_HALF_LIFE_SECS = 0.1;
/** Weights nearer to their target than this are there. */
const WEIGHT_EPSILON = 1e-3;

/** As much of the engine's stylizer as this needs. */
export type StyledStream = Pick<Stylizer, "setWeights" | "setPartWeights" | "weightsOf">;

/** The weights of the whole body, or of a part of it; `wanted` is `undefined` where the part follows the whole. */
interface Weights {
  now: Float32Array;
  wanted: Float32Array | undefined;
  /** Whether the engine has `now`. */
  told: boolean;
}

/** Nothing is allocated while weights are eased. */
export class EasedStyles {
  /** Whole body, then each of {@link BODY_PARTS}. */
  private readonly weights: Weights[];
  private track: WeightKey[] = [];

  constructor(
    private readonly stream: StyledStream,
    options: StylizeOptions,
  ) {
    const whole = stream.weightsOf(options.styles);
    this.weights = [undefined, ...BODY_PARTS].map(() => ({ now: whole.slice(), wanted: undefined, told: false }));
    this.want(options);
    this.arrive(0);
  }

  /** Takes what is wanted from now on. What is refused changes nothing. */
  want({ styles, parts, track }: StylizeOptions): void {
    const { stream } = this;
    const whole = stream.weightsOf(styles);
    const own = BODY_PARTS.map((part) => parts[part] && stream.weightsOf(parts[part]));
    const keys = track.map((key) => ({ frame: key.frame, weights: stream.weightsOf(key.styles) }));
    this.track = keys;
    this.weights[0]!.wanted = whole;
    for (const [i, weights] of own.entries()) {
      const part = this.weights[1 + i]!;
      // A part that begins to have its own starts from what it has in common with the whole.
      if (weights && !part.wanted) part.now.set(this.weights[0]!.now);
      part.wanted = weights;
    }
  }

  /** Is at once where an input frame wants to be. */
  arrive(frame: number): void {
    this.move(frame, 1);
  }

  /** Goes on by one input frame to `frame`. */
  ease(frame: number, frameSecs: number): void {
    this.move(frame, 1 - 0.5 ** (frameSecs / STYLE_HALF_LIFE_SECS));
  }

  /** Whether the styles depend on the frame. */
  get changesOverTime(): boolean {
    return this.track.length > 0;
  }

  private move(frame: number, share: number): void {
    const whole = this.weights[0]!;
    if (this.changesOverTime) {
      weightsAt(this.track, frame, whole.now);
      whole.told = false;
    } else if (approach(whole.now, whole.wanted!, share)) whole.told = false;
    if (!whole.told) this.stream.setWeights(whole.now);
    whole.told = true;
    for (const [i, name] of BODY_PARTS.entries()) {
      const part = this.weights[1 + i]!;
      if (part.wanted) {
        if (approach(part.now, part.wanted, share)) part.told = false;
        if (!part.told) this.stream.setPartWeights(name, part.now);
        part.told = true;
      } else if (part.told) {
        this.stream.setPartWeights(name, undefined);
        part.told = false;
      }
    }
  }
}

/** Moves weights towards the wanted ones by a share of the way; whether any was not there yet. */
function approach(now: Float32Array, wanted: Float32Array, share: number): boolean {
  let moved = false;
  for (let i = 0; i < now.length; i++) {
    const left = wanted[i]! - now[i]!;
    if (left === 0) continue;
    moved = true;
    now[i] = Math.abs(left) < WEIGHT_EPSILON ? wanted[i]! : now[i]! + left * share;
  }
  return moved;
}
