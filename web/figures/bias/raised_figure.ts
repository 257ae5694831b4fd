/** The input with its arms raised, and the engine's output, side by side. */
import { POSE_FLOATS } from "../../humanoid";
import type { Slider } from "../../ui/controls/slider";
import { html } from "../../ui/dom";
import { RATE_HZ } from "../built_in";
import { createInstant } from "../controls";
import { FigureStage } from "../figure_stage";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { remembered } from "../remembered";
import { figure } from "../words/words";
import { elevation, measureBias } from "./bias_measure";
import { BIAS_FIELDS, type BiasState, lookOf, raisedInput } from "./bias_state";

export const RAISED: FigureKind<BiasState> = {
  fields: BIAS_FIELDS,
  create: (parts) => new RaisedFigure(parts),
};

/** A raised input, computed once. */
const raisedMotion = remembered((engine, motion: BiasState["motion"], raise: number) =>
  engine.motion(raisedInput({ motion, raise })),
);

class RaisedFigure implements FigureInstance<BiasState> {
  readonly #parts: FigureParts<BiasState>;
  readonly stage: FigureStage;
  readonly #instant: Slider;
  readonly #posing = new Latest<BiasState>((state) => this.#pose(state));
  #state: BiasState | undefined;
  #shown: BiasState | undefined;
  /** The displayed frame: an input may be shorter than the frame in a link. */
  #at = 0;
  /** Elevations of the arms of the input and of the output, degrees. */
  #elevations: readonly number[] = [];

  constructor(parts: FigureParts<BiasState>) {
    this.#parts = parts;
    const { words, container, change } = parts;
    this.stage = new FigureStage(words, { labels: { styled: "", input: "" }, description: words.bias.stage });
    this.#instant = createInstant(words, 2, change);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.bias.stage)),
      this.stage.element,
      html("div", { class: "knobs" }, html("div", { class: "others" }, this.#instant.element)),
    );
  }

  show(state: BiasState): Promise<void> {
    this.#state = state;
    this.#instant.value = state.at;
    return this.#posing.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureBias(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const state = this.#shown;
    if (!state) return "";
    const { words } = this.#parts;
    return words.bias.posed(words.styles[state.style], figure(this.#at / RATE_HZ, 2, words), String(state.raise));
  }

  table(): Table {
    const { words } = this.#parts;
    const { input, styled } = this.#labels;
    const rows = this.#elevations.map((degrees, i) => [[input, styled][i]!, figure(degrees, 1, words)]);
    return { head: words.bias.elevations, rows };
  }

  values(): Readonly<Record<string, string>> {
    return {};
  }

  light(term: string | undefined): void {
    const { viewer } = this.stage;
    if (!viewer) return;
    const { input, styled } = this.#labels;
    viewer.labels = { input: term === "y" ? "" : input, styled: term === "x" ? "" : styled };
    this.stage.invalidate();
  }

  get #labels() {
    const { words } = this.#parts;
    return { input: words.bias.input, styled: this.#state ? words.styles[this.#state.style] : "" };
  }

  async #pose(state: BiasState): Promise<void> {
    const { engine, signal } = this.#parts;
    const [{ poses, proportions }, { pose }] = await Promise.all([
      raisedMotion(engine, state.motion, state.raise),
      engine.styled(lookOf(state)),
    ]);
    if (signal.aborted) return;
    const isFirst = !this.#shown;
    this.#shown = state;
    const at = Math.min(state.at, poses.length / POSE_FLOATS - 1);
    this.#at = at;
    const given = poses.subarray(at * POSE_FLOATS, (at + 1) * POSE_FLOATS);
    this.#elevations = [given, pose].map((one) => elevation(one, proportions));
    const { viewer } = this.stage;
    if (viewer) {
      if (isFirst) viewer.setProportions(proportions);
      viewer.setStyled(pose);
      viewer.setInput(given);
      viewer.labels = this.#labels;
      viewer.description = this.sentence();
      viewer.resetTrail();
    }
    this.stage.invalidate();
    this.#parts.changed();
  }
}
