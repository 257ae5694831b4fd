/** The two poses that a path pairs at the cursor, side by side. */
import { type Measured, measure as measured, type Posed, poseAt } from "../../player/measured";
import { html, setText } from "../../ui/dom";
import { INPUTS, type Style } from "../built_in";
import { FigureStage } from "../figure_stage";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { remembered } from "../remembered";
import { readAt } from "./reading";
import { measureWarp } from "./warp_measure";
import { WARP_FIELDS, type WarpState } from "./warp_state";
import { type Step, type Warping, warpingOf } from "./warping";

/** Both steps with their poses. */
interface Walked {
  style: Style;
  warping: Warping;
  proportions: Float32Array;
  neutral: Measured<Posed>;
  styled: Measured<Posed>;
}

export const WALKERS: FigureKind<WarpState> = {
  fields: WARP_FIELDS,
  create: (parts) => new WalkersFigure(parts),
};

const walkedOf = remembered(async (engine, style: Style): Promise<Walked> => {
  const [warping, { proportions }] = await Promise.all([warpingOf(engine, style), engine.motion({ name: INPUTS[0] })]);
  const posesOf = async ({ row, frames }: Step) => {
    const poses = await engine.rowPoses(Array.from({ length: frames }, (_, i) => row + i));
    return measured({ poses }, proportions);
  };
  const [neutral, styled] = await Promise.all([posesOf(warping.neutral), posesOf(warping.styled)]);
  return { style, warping, proportions, neutral, styled };
});

class WalkersFigure implements FigureInstance<WarpState> {
  readonly #parts: FigureParts<WarpState>;
  readonly stage: FigureStage;
  readonly #readout = html("p", { class: "readout" });
  readonly #walking = new Latest<WarpState>((state) => this.#walk(state));
  #state: WarpState | undefined;
  #walked: Walked | undefined;

  constructor(parts: FigureParts<WarpState>) {
    this.#parts = parts;
    const { words, container } = parts;
    this.stage = new FigureStage(words, { labels: { styled: "", input: "" }, description: words.warp.walkers });
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.warp.walkers)),
      this.stage.element,
      html("footer", { class: "foot" }, this.#readout),
    );
  }

  show(state: WarpState): Promise<void> {
    this.#state = state;
    this.#pose();
    return this.#walking.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureWarp(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const said = this.#said();
    if (!said) return "";
    return this.#parts.words.warp.paired(said.time, said.neutral, said.tau, said.style, said.styled);
  }

  table(): Table {
    const { words } = this.#parts;
    const said = this.#said();
    const rows = said
      ? [
          [words.styles.neutral, said.time, said.neutral],
          [said.style, said.tau, said.styled],
        ]
      : [];
    return { head: words.warp.columns, rows };
  }

  values(): Readonly<Record<string, string>> {
    const said = this.#said();
    return said ? { tau: `${said.tau} ms` } : {};
  }

  light(term: string | undefined): void {
    if (this.stage.viewer) this.stage.viewer.labels = this.#labels(term === "tau");
    this.stage.invalidate();
  }

  /** Names above the heads; only the paired one while its symbol is highlighted. */
  #labels(paired: boolean) {
    const { styles } = this.#parts.words;
    return { styled: this.#state ? styles[this.#state.style] : "", input: paired ? "" : styles.neutral };
  }

  #now() {
    const [state, walked] = [this.#state, this.#walked];
    return state && walked?.style === state.style ? { state, walked } : undefined;
  }

  #said() {
    const now = this.#now();
    return now && readAt(now.walked.warping, now.state, this.#parts.words).said;
  }

  async #walk(state: WarpState): Promise<void> {
    if (this.#walked?.style === state.style) return;
    const walked = await walkedOf(this.#parts.engine, state.style);
    if (this.#parts.signal.aborted) return;
    this.#walked = walked;
    this.stage.viewer?.setProportions(walked.proportions);
    this.#pose();
  }

  #pose(): void {
    const now = this.#now();
    if (!now) return;
    const { walked, state } = now;
    const { frame, other } = readAt(walked.warping, state, this.#parts.words);
    const { viewer } = this.stage;
    if (viewer) {
      viewer.setStyled(poseAt(walked.styled, Math.min(walked.styled.frames - 1, Math.max(0, other))));
      viewer.setInput(poseAt(walked.neutral, frame));
      viewer.labels = this.#labels(false);
      viewer.description = this.sentence();
    }
    setText(this.#readout, this.sentence());
    this.stage.invalidate();
    this.#parts.changed();
  }
}
