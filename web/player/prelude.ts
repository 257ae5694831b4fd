/** What is shown until the engine has the first input: that input as it is, on a clock of its own. */

import type { FirstSteps } from "../client/first_steps";
import type { ShownFrame } from "../client/protocol";
import type { Weights } from "./smoothing";

export class Prelude {
  #secs = 0;

  /** @param styles what the clip is performed in */
  constructor(
    private readonly clip: Pick<FirstSteps, "frames" | "rateHz" | "poseAt">,
    readonly styles: Weights,
  ) {}

  advance(dtSecs: number): void {
    this.#secs += dtSecs;
  }

  /** The present frame; the clip is repeated. */
  get shown(): ShownFrame {
    const { frames, rateHz } = this.clip;
    const inputFrame = (this.#secs * rateHz) % frames;
    return { inputFrame, timeOut: this.#secs, pose: this.clip.poseAt(inputFrame) };
  }
}
