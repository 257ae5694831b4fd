/** The prelude shown until the engine has the first input: that input unchanged, on a clock of its own. */

import type { FirstSteps } from "../client/first_steps";
import type { ShownFrame } from "../client/protocol";
import type { Weights } from "./smoothing";

export class Prelude {
  #secs = 0;

  /** @param styles styles in which the clip is performed */
  constructor(
    private readonly clip: Pick<FirstSteps, "frames" | "rateHz" | "poseAt">,
    readonly styles: Weights,
  ) {}

  advance(dtSecs: number): void {
    this.#secs += dtSecs;
  }

  /** The current frame; the clip loops. */
  get shown(): ShownFrame {
    const { frames, rateHz } = this.clip;
    const inputFrame = (this.#secs * rateHz) % frames;
    return { inputFrame, timeOut: this.#secs, pose: this.clip.poseAt(inputFrame) };
  }
}
