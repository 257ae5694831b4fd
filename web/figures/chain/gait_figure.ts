/** A walk synthesised by the model: interpolated between neutral and a style, or extrapolated. */
import type { Walked } from "../../client/learn/protocol";
import { type Measured, measure as measured, poseAt } from "../../player/measured";
import type { Viewer } from "../../viewer";
import { STYLES, type Style } from "../built_in";
import type { FigureKind, FigureParts } from "../kind";
import { memoized } from "../memoized";
import { Playing } from "../playing";
import { SceneFigure } from "../scene_figure";
import { measureChain } from "./chain_measure";
import { CHAIN_FIELDS, CHAIN_RANGES, type ChainState, stylesOf } from "./chain_state";

/** Number of synthesised frames: eight seconds. */
const FRAMES = 240;
/** The frame that is displayed while paused: in the middle of a step. */
const STILL = 40;

export const GAIT: FigureKind<ChainState> = {
  fields: CHAIN_FIELDS,
  measure: measureChain,
  create: (parts) => new GaitFigure(parts),
};

const walkedOf = memoized(async (engine, style: Style, share: number) => {
  const walked = await engine.walk(stylesOf({ style, share }), FRAMES);
  return measured(walked, walked.proportions);
});

class GaitFigure extends SceneFigure<ChainState, Measured<Walked>> {
  readonly #playing: Playing;
  #at = STILL;

  constructor(parts: FigureParts<ChainState>) {
    const { words } = parts;
    const { chain, styles } = words;
    super(parts, { labels: { styled: chain.walker, input: "" }, description: chain.gait });
    this.#playing = new Playing(words, () => this.settle(), parts.signal);
    this.#playing.frame = STILL;
    this.lay({
      title: chain.gait,
      picture: this.stage.element,
      head: [this.choice("style", words.style, STYLES.slice(1), (style) => styles[style])],
      foot: [this.#playing.element, this.readout],
      controls: this.knobs(["share"], chain.knobs, CHAIN_RANGES, { share: "k" }),
    });
  }

  protected override advance(dtSecs: number): void {
    const { shown } = this;
    const { viewer } = this.stage;
    if (!shown) return;
    const at = this.#playing.advance(dtSecs, shown.rateHz, shown.frames - 1);
    if (at === undefined || at === this.#at) return;
    const jumps = at < this.#at;
    this.#at = at;
    viewer?.setStyled(poseAt(shown, at));
    if (jumps) viewer?.resetTrail();
    this.stage.invalidate();
  }

  protected load({ style, share }: ChainState): Promise<Measured<Walked>> {
    return walkedOf(this.parts.engine, style, share);
  }

  protected pose(viewer: Viewer, walked: Measured<Walked>, _: ChainState, before?: Measured<Walked>): void {
    if (!before) viewer.setProportions(walked.proportions);
    if (before === walked) return;
    viewer.setStyled(poseAt(walked, this.#at));
    viewer.resetTrail();
  }

  protected describe(_: Measured<Walked>, { style, share }: ChainState): string {
    return this.words.chain.walks(this.words.styles[style], this.number(share, 2));
  }

  protected get columns() {
    return this.words.chain.shares;
  }

  protected rows(_: Measured<Walked>, { style, share }: ChainState): string[][] {
    return [[this.words.styles[style], this.number(share, 2)]];
  }

  protected override quantities(_: Measured<Walked>, { share }: ChainState) {
    return { k: this.number(share, 2) };
  }
}
