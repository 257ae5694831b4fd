/** A walk synthesised by the model: interpolated between neutral and a style, or extrapolated. */

import type { Walked } from "../../client/learn/protocol";
import { type Measured, measure as measured, poseAt } from "../../player/measured";
import type { Knob } from "../../ui/controls/knob";
import { html, setText } from "../../ui/dom";
import { STYLES, type Style } from "../built_in";
import { Choice, createKnobs } from "../controls";
import { FigureStage } from "../figure_stage";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { Playing } from "../playing";
import { remembered } from "../remembered";
import { figure } from "../words/words";
import { measureChain } from "./chain_measure";
import { CHAIN_FIELDS, CHAIN_RANGES, type ChainState, stylesOf } from "./chain_state";

/** Number of synthesised frames: eight seconds. */
const FRAMES = 240;
/** The frame that is displayed while paused: in the middle of a step. */
const STILL = 40;

export const GAIT: FigureKind<ChainState> = {
  fields: CHAIN_FIELDS,
  create: (parts) => new GaitFigure(parts),
};

const walkedOf = remembered(async (engine, style: Style, share: number) => {
  const walked = await engine.walk(stylesOf({ style, share }), FRAMES);
  return measured(walked, walked.proportions);
});

class GaitFigure implements FigureInstance<ChainState> {
  readonly #parts: FigureParts<ChainState>;
  readonly stage: FigureStage;
  readonly #style: Choice<Style>;
  readonly #share: Knob;
  readonly #playing: Playing;
  readonly #readout = html("p", { class: "readout" });
  readonly #walking = new Latest<ChainState>((state) => this.#walk(state));
  #state: ChainState | undefined;
  #walked: Measured<Walked> | undefined;
  #at = STILL;

  constructor(parts: FigureParts<ChainState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.stage = new FigureStage(
      words,
      { labels: { styled: words.chain.walker, input: "" }, description: words.chain.gait },
      { advance: (dtSecs) => this.#advance(dtSecs) },
    );
    this.#style = new Choice(
      words.style,
      STYLES.slice(1).map((style) => [style, words.styles[style]] as const),
      (style) => change({ style }, true),
    );
    const settle = () => change({}, true);
    this.#share = createKnobs(["share"], words, words.chain.knobs, CHAIN_RANGES, CHAIN_FIELDS, change).share;
    this.#playing = new Playing(words, settle, signal);
    this.#playing.frame = STILL;
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.chain.gait), this.#style.element),
      this.stage.element,
      html("footer", { class: "foot" }, this.#playing.element, this.#readout),
      html("div", { class: "knobs" }, this.#share.element),
    );
  }

  show(state: ChainState): Promise<void> {
    this.#state = state;
    this.#style.value = state.style;
    this.#share.value = state.share;
    return this.#walking.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureChain(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const state = this.#state;
    if (!state || !this.#walked) return "";
    const { words } = this.#parts;
    return words.chain.walks(words.styles[state.style], figure(state.share, 2, words));
  }

  table(): Table {
    const { words } = this.#parts;
    const state = this.#state;
    return {
      head: words.chain.shares,
      rows: state ? [[words.styles[state.style], figure(state.share, 2, words)]] : [],
    };
  }

  values(): Readonly<Record<string, string>> {
    return this.#state ? { k: figure(this.#state.share, 2, this.#parts.words) } : {};
  }

  light(term: string | undefined): void {
    this.#share.element.classList.toggle("lit", term === "k");
  }

  #advance(dtSecs: number): void {
    if (!this.#walked) return;
    const at = this.#playing.advance(dtSecs, this.#walked.rateHz, this.#walked.frames - 1);
    if (at === undefined || at === this.#at) return;
    const jumps = at < this.#at;
    this.#at = at;
    this.#pose(jumps);
  }

  async #walk({ style, share }: ChainState): Promise<void> {
    const walked = await walkedOf(this.#parts.engine, style, share);
    if (this.#parts.signal.aborted || this.#walked === walked) return;
    if (!this.#walked) this.stage.viewer?.setProportions(walked.proportions);
    this.#walked = walked;
    this.#pose(true);
    setText(this.#readout, this.sentence());
    this.#parts.changed();
  }

  /** @param jumps whether the camera moves there at once */
  #pose(jumps: boolean): void {
    const { viewer } = this.stage;
    if (!viewer || !this.#walked) return;
    viewer.setStyled(poseAt(this.#walked, this.#at));
    viewer.description = this.sentence();
    if (jumps) viewer.resetTrail();
    this.stage.invalidate();
  }
}
