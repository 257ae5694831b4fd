/** An input and a blend of styles, at the same second of their clocks. */
import { framesOf, poseAt } from "../../player/measured";
import type { Slider } from "../../ui/controls/slider";
import { html, setText } from "../../ui/dom";
import { RATE_HZ } from "../built_in";
import { createInstant } from "../controls";
import { FigureStage } from "../figure_stage";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { Playing } from "../playing";
import { figure } from "../words/words";
import { frameAtSecond, measurePace, type Paced, pacedOf } from "./pace_measure";
import { PACE_FIELDS, type PaceState } from "./pace_state";

export const PACED: FigureKind<PaceState> = {
  fields: PACE_FIELDS,
  create: (parts) => new PacedFigure(parts),
};

class PacedFigure implements FigureInstance<PaceState> {
  readonly #parts: FigureParts<PaceState>;
  readonly stage: FigureStage;
  readonly #playing: Playing;
  readonly #instant: Slider;
  readonly #readout = html("p", { class: "readout" });
  readonly #walking = new Latest<PaceState>((state) => this.#walk(state));
  #state: PaceState | undefined;
  #paced: Paced | undefined;

  constructor(parts: FigureParts<PaceState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    const labels = { styled: words.pace.blendName, input: words.styles.neutral };
    this.stage = new FigureStage(
      words,
      { labels, description: words.pace.paced },
      { advance: (dtSecs) => this.#advance(dtSecs) },
    );
    const settle = () => change({}, true);
    this.#playing = new Playing(words, settle, signal);
    this.#instant = createInstant(words, 2, change);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.pace.paced)),
      this.stage.element,
      html("footer", { class: "foot" }, this.#playing.element, this.#readout),
      html("div", { class: "knobs" }, html("div", { class: "others" }, this.#instant.element)),
    );
  }

  show(state: PaceState): Promise<void> {
    this.#state = state;
    this.#playing.frame = state.at;
    this.#instant.value = state.at;
    this.#pose();
    return this.#walking.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measurePace(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const now = this.#now();
    if (!now) return "";
    const { words } = this.#parts;
    const secs = (frames: number) => figure(frames / RATE_HZ, 2, words);
    return Number.isNaN(now.styledAt)
      ? words.pace.ended(secs(now.at))
      : words.pace.walking(secs(now.at), secs(now.styledAt));
  }

  table(): Table {
    const { words } = this.#parts;
    const now = this.#now();
    const secs = (frames: number) => figure(frames / RATE_HZ, 2, words);
    return { head: words.pace.times, rows: now ? [[secs(now.styledAt), secs(now.at)]] : [] };
  }

  values(): Readonly<Record<string, string>> {
    return {};
  }

  light(): void {}

  /** The displayed second, and the frame that the blend has reached then; NaN after its end. */
  #now() {
    const [state, paced] = [this.#state, this.#paced];
    if (!state || !paced) return undefined;
    const at = Math.min(state.at, framesOf(paced.input) - 1);
    return { at, paced, styledAt: frameAtSecond(paced, at / paced.input.rateHz) };
  }

  #advance(dtSecs: number): void {
    if (!this.#paced) return;
    const { input } = this.#paced;
    const at = this.#playing.advance(dtSecs, input.rateHz, framesOf(input) - 1);
    if (at !== undefined && at !== this.#state?.at) this.#parts.change({ at: Math.max(2, at) }, false);
  }

  async #walk(state: PaceState): Promise<void> {
    const paced = await pacedOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted || this.#paced === paced) return;
    if (!this.#paced) this.stage.viewer?.setProportions(paced.input.proportions);
    this.#paced = paced;
    this.#pose();
    this.stage.viewer?.resetTrail();
  }

  #pose(): void {
    const now = this.#now();
    if (!now) return;
    const { at, styledAt } = now;
    const { input, styled } = now.paced;
    const { viewer } = this.stage;
    if (viewer) {
      viewer.setStyled(poseAt(styled, Number.isNaN(styledAt) ? framesOf(styled) - 1 : styledAt));
      viewer.setInput(poseAt(input, at));
      viewer.description = this.sentence();
    }
    setText(this.#readout, this.sentence());
    this.stage.invalidate();
    this.#parts.changed();
  }
}
