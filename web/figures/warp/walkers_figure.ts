/** The two poses that a path pairs at the cursor, side by side. */
import { type Measured, measure as measured, type Posed, poseAt } from "../../player/measured";
import type { Viewer } from "../../viewer";
import { INPUTS, type Style } from "../built_in";
import type { FigureKind, FigureParts } from "../kind";
import { memoized } from "../memoized";
import { SceneFigure } from "../scene_figure";
import { type Reading, readAt } from "./reading";
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
  measure: measureWarp,
  create: (parts) => new WalkersFigure(parts),
};

const walkedOf = memoized(async (engine, style: Style): Promise<Walked> => {
  const [warping, { proportions }] = await Promise.all([warpingOf(engine, style), engine.motion({ name: INPUTS[0] })]);
  const posesOf = async ({ row, frames }: Step) => {
    const poses = await engine.rowPoses(Array.from({ length: frames }, (_, i) => row + i));
    return measured({ poses }, proportions);
  };
  const [neutral, styled] = await Promise.all([posesOf(warping.neutral), posesOf(warping.styled)]);
  return { style, warping, proportions, neutral, styled };
});

interface Shown {
  state: WarpState;
  walked: Walked;
  reading: Reading;
}

class WalkersFigure extends SceneFigure<WarpState, Shown> {
  constructor(parts: FigureParts<WarpState>) {
    const { walkers } = parts.words.warp;
    super(parts, { labels: { styled: "", input: "" }, description: walkers });
    this.lay({ title: walkers, picture: this.stage.element });
  }

  override light(term: string | undefined): void {
    if (this.stage.viewer) this.stage.viewer.labels = this.#labels(term === "tau");
    this.stage.invalidate();
  }

  protected async load(state: WarpState): Promise<Shown> {
    const walked = await walkedOf(this.parts.engine, state.style);
    return { state, walked, reading: readAt(walked.warping, state, this.words) };
  }

  protected pose(viewer: Viewer, { walked, reading }: Shown, _: WarpState, before?: Shown): void {
    const { proportions, styled, neutral } = walked;
    if (before?.walked !== walked) viewer.setProportions(proportions);
    viewer.setStyled(poseAt(styled, Math.min(styled.frames - 1, Math.max(0, reading.other))));
    viewer.setInput(poseAt(neutral, reading.frame));
    viewer.labels = this.#labels(false);
  }

  protected describe({ reading: { said } }: Shown): string {
    return this.words.warp.paired(said.time, said.neutral, said.tau, said.style, said.styled);
  }

  protected get columns() {
    return this.words.warp.columns;
  }

  protected rows({ reading: { said } }: Shown): string[][] {
    return [
      [this.words.styles.neutral, said.time, said.neutral],
      [said.style, said.tau, said.styled],
    ];
  }

  protected override quantities({ reading: { said } }: Shown) {
    return { tau: `${said.tau} ms` };
  }

  /** Names above the heads; only the paired one while its symbol is highlighted. */
  #labels(paired: boolean) {
    const { styles } = this.words;
    return { styled: this.state ? styles[this.state.style] : "", input: paired ? "" : styles.neutral };
  }
}
