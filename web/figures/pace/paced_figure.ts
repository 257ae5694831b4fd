/** An input and a blend of styles, at the same second of their clocks. */
import { framesOf, poseAt } from "../../player/measured";
import { html } from "../../ui/dom";
import type { Viewer } from "../../viewer";
import { RATE_HZ } from "../built_in";
import type { FigureKind, FigureParts } from "../kind";
import { Playing } from "../playing";
import { SceneFigure } from "../scene_figure";
import { frameAtSecond, measurePace, type Paced, pacedOf } from "./pace_measure";
import { PACE_FIELDS, type PaceState } from "./pace_state";

export const PACED: FigureKind<PaceState> = {
  fields: PACE_FIELDS,
  measure: measurePace,
  create: (parts) => new PacedFigure(parts),
};

class PacedFigure extends SceneFigure<PaceState, Paced> {
  readonly #playing: Playing;
  protected override readonly drawsAhead = true;

  constructor(parts: FigureParts<PaceState>) {
    const { pace, styles } = parts.words;
    super(parts, { labels: { styled: pace.blendName, input: styles.neutral }, description: pace.paced });
    this.#playing = new Playing(parts.words, () => this.settle(), parts.signal);
    this.lay({
      title: pace.paced,
      picture: this.stage.element,
      foot: [this.#playing.element, this.readout],
      controls: [html("div", { class: "others" }, this.instant("at", 2))],
    });
  }

  override show(state: PaceState): Promise<void> {
    this.#playing.frame = state.at;
    return super.show(state);
  }

  protected override advance(dtSecs: number): void {
    if (!this.shown) return;
    const { input } = this.shown;
    const at = this.#playing.advance(dtSecs, input.rateHz, framesOf(input) - 1);
    if (at !== undefined && at !== this.state?.at) this.change({ at: Math.max(2, at) }, false);
  }

  protected load(state: PaceState): Promise<Paced> {
    return pacedOf(this.parts.engine, state);
  }

  protected pose(viewer: Viewer, paced: Paced, state: PaceState, before?: Paced): void {
    const { input, styled } = paced;
    const { at, styledAt } = instantOf(paced, state);
    if (!before) viewer.setProportions(input.proportions);
    viewer.setStyled(poseAt(styled, Number.isNaN(styledAt) ? framesOf(styled) - 1 : styledAt));
    viewer.setInput(poseAt(input, at));
    if (before !== paced) viewer.resetTrail();
  }

  protected describe(paced: Paced, state: PaceState): string {
    const { at, styledAt } = instantOf(paced, state);
    const { pace } = this.words;
    return Number.isNaN(styledAt) ? pace.ended(this.#secs(at)) : pace.walking(this.#secs(at), this.#secs(styledAt));
  }

  protected get columns() {
    return this.words.pace.times;
  }

  protected rows(paced: Paced, state: PaceState): string[][] {
    const { at, styledAt } = instantOf(paced, state);
    return [[this.#secs(styledAt), this.#secs(at)]];
  }

  #secs(frames: number): string {
    return this.number(frames / RATE_HZ, 2);
  }
}

/** The displayed frame, and the frame that the blend has reached at the same second; NaN after its end. */
function instantOf(paced: Paced, state: PaceState): { at: number; styledAt: number } {
  const at = Math.min(state.at, framesOf(paced.input) - 1);
  return { at, styledAt: frameAtSecond(paced, at / paced.input.rateHz) };
}
