/** The input with its arms raised, and the engine's output, side by side. */
import { POSE_FLOATS } from "../../humanoid";
import { html } from "../../ui/dom";
import type { Viewer } from "../../viewer";
import { RATE_HZ } from "../built_in";
import type { FigureKind, FigureParts } from "../kind";
import { memoized } from "../memoized";
import { SceneFigure } from "../scene_figure";
import { elevation, measureBias } from "./bias_measure";
import { BIAS_FIELDS, type BiasState, lookOf, raisedInput } from "./bias_state";

export const RAISED: FigureKind<BiasState> = {
  fields: BIAS_FIELDS,
  measure: measureBias,
  create: (parts) => new RaisedFigure(parts),
};

/** A raised input, computed once. */
const raisedMotion = memoized((engine, motion: BiasState["motion"], raise: number) =>
  engine.motion(raisedInput({ motion, raise })),
);

interface Shown {
  state: BiasState;
  /** The displayed frame: an input may be shorter than the frame in a link. */
  at: number;
  proportions: Float32Array;
  /** The poses of the input and of the output. */
  given: Float32Array;
  styled: Float32Array;
}

class RaisedFigure extends SceneFigure<BiasState, Shown> {
  constructor(parts: FigureParts<BiasState>) {
    const { stage } = parts.words.bias;
    super(parts, { labels: { styled: "", input: "" }, description: stage });
    this.lay({
      title: stage,
      picture: this.stage.element,
      foot: [],
      controls: [html("div", { class: "others" }, this.instant("at", 2))],
    });
  }

  override light(term: string | undefined): void {
    const { viewer } = this.stage;
    if (!viewer) return;
    const { input, styled } = this.#labels;
    viewer.labels = { input: term === "y" ? "" : input, styled: term === "x" ? "" : styled };
    this.stage.invalidate();
  }

  protected async load(state: BiasState): Promise<Shown> {
    const { engine } = this.parts;
    const [{ poses, proportions }, { pose: styled }] = await Promise.all([
      raisedMotion(engine, state.motion, state.raise),
      engine.styled(lookOf(state)),
    ]);
    const at = Math.min(state.at, poses.length / POSE_FLOATS - 1);
    return { state, at, proportions, given: poses.subarray(at * POSE_FLOATS, (at + 1) * POSE_FLOATS), styled };
  }

  protected pose(viewer: Viewer, { proportions, given, styled }: Shown, _: BiasState, before?: Shown): void {
    if (!before) viewer.setProportions(proportions);
    viewer.setStyled(styled);
    viewer.setInput(given);
    viewer.labels = this.#labels;
    viewer.resetTrail();
  }

  protected describe({ state, at }: Shown): string {
    const { bias, styles } = this.words;
    return bias.posed(styles[state.style], this.number(at / RATE_HZ, 2), String(state.raise));
  }

  protected get columns() {
    return this.words.bias.elevations;
  }

  protected rows({ given, styled, proportions }: Shown): string[][] {
    const labels = this.#labels;
    const row = (label: string, pose: Float32Array) => [label, this.number(elevation(pose, proportions), 1)];
    return [row(labels.input, given), row(labels.styled, styled)];
  }

  get #labels() {
    return { input: this.words.bias.input, styled: this.state ? this.words.styles[this.state.style] : "" };
  }
}
