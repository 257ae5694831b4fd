/** An input and its performance in a style, side by side; each joint has a mark for the difference. */
import { JOINT, ROLES, type Role } from "../../humanoid";
import { poseAt } from "../../player/measured";
import { setAttributes, setText, svg } from "../../ui/dom";
import type { Viewer } from "../../viewer";
import { STYLES } from "../built_in";
import type { FigureKind, FigureParts } from "../kind";
import { measurePair } from "../pair_measure";
import { PAIR_FIELDS, type PairState } from "../pair_state";
import { jointDifferences, meanOf, PAIRINGS, type Pair } from "../pairing";
import { Playing } from "../playing";
import { SceneFigure } from "../scene_figure";
import { sharedPair } from "../shared";

/** A difference with the largest mark, cm. */
const FULL_CM = 30;
/** Radius of a mark, pixels: at no difference, and at {@link FULL_CM}. */
const RADIUS = { none: 2.5, full: 8 };
/** Beyond this number of frames the camera jumps instead of following. */
const JUMP = 30;
/** Distance of the joint's label from its mark, pixels. */
const LABEL = 64;

export const STAGE: FigureKind<PairState> = {
  fields: PAIR_FIELDS,
  measure: measurePair,
  create: (parts) => new PairFigure(parts),
};

interface Shown {
  state: PairState;
  pair: Pair;
  /** The displayed frame, and the second at which the styled walker is compared. */
  frame: number;
  styledSecs: number;
  /** Of each joint, cm. */
  differences: number[];
}

class PairFigure extends SceneFigure<PairState, Shown> {
  readonly #marks = new Map<Role, SVGCircleElement>();
  readonly #leader = svg("path", { class: "leader" });
  readonly #label = svg("text", { class: "label chosen" });
  readonly #playing: Playing;

  constructor(parts: FigureParts<PairState>) {
    const { words } = parts;
    super(parts, { labels: { styled: "", input: "" }, description: words.two });
    this.#playing = new Playing(words, () => this.settle(), parts.signal);
    for (const role of ROLES) {
      const mark = svg("circle", { class: "joint", "data-term": "e" });
      mark.addEventListener("click", () => this.change({ joint: this.state?.joint === role ? "" : role }));
      this.#marks.set(role, mark);
    }
    this.stage.overlay.append(this.#leader, ...this.#marks.values(), this.#label);
    const pairing = this.segment("pairing", words.pairing, PAIRINGS, (value) => words[value]);
    this.lay({
      title: words.two,
      picture: this.stage.element,
      head: [this.choice("style", words.style, STYLES, (style) => words.styles[style])],
      foot: [this.#playing.element, pairing.element, this.readout],
    });
  }

  override show(state: PairState): Promise<void> {
    this.#playing.frame = state.at;
    return super.show(state);
  }

  override light(term: string | undefined): void {
    // The difference is the mean of all joints.
    this.stage.overlay.classList.toggle("lit", term === "e" || term === "J");
    const { viewer } = this.stage;
    if (!viewer) return;
    // Its name highlights either walker.
    viewer.labels = this.#labels(term);
    this.stage.invalidate();
  }

  protected override advance(dtSecs: number): void {
    if (!this.shown) return;
    const { rateHz, input } = this.shown.pair;
    const at = this.#playing.advance(dtSecs, rateHz, input.frames - 1);
    if (at !== undefined && at !== this.state?.at) this.change({ at }, false);
  }

  protected async load(state: PairState): Promise<Shown | undefined> {
    const pair = await sharedPair(this.parts.engine, state.motion, state.style);
    if (!pair) return undefined;
    const { pairing } = state;
    const frame = Math.min(state.at, pair.input.frames - 1);
    const styledSecs = pairing === "content" ? pair.styled.timeOut[frame]! : frame / pair.rateHz;
    return { state, pair, frame, styledSecs, differences: jointDifferences(pair, pairing, frame) };
  }

  protected pose(viewer: Viewer, { state, pair, frame }: Shown, _: PairState, before?: Shown): void {
    const paired = pair.frames[state.pairing][frame]!;
    if (before?.pair !== pair) viewer.setProportions(pair.proportions);
    viewer.setStyled(poseAt(pair.styled, Number.isNaN(paired) ? pair.styled.frames - 1 : paired));
    viewer.setInput(poseAt(pair.input, frame));
    viewer.labels = this.#labels();
    const follows =
      before?.pair === pair && before.state.pairing === state.pairing && Math.abs(state.at - before.frame) <= JUMP;
    if (!follows) viewer.resetTrail();
  }

  protected override read({ state, pair, frame, styledSecs }: Shown): string {
    if (Number.isNaN(pair.frames[state.pairing][frame])) return this.words.ended;
    const secs = this.number(frame / pair.rateHz, 2);
    return this.words.times(secs, this.words.styles[state.style], this.number(styledSecs, 2));
  }

  protected describe({ state, pair, frame, differences }: Shown): string {
    const most = differences.reduce((found, cm, joint) => (cm > differences[found]! ? joint : found), 0);
    return this.words.pictured(
      this.words.styles[state.style],
      this.number(frame / pair.rateHz, 2),
      this.words[state.pairing],
      this.number(meanOf(differences), 1),
      this.words.joints[ROLES[most]!],
      this.number(differences[most]!, 1),
    );
  }

  protected get columns() {
    return [this.words.joint, "cm"];
  }

  protected rows({ differences }: Shown): string[][] {
    return ROLES.map((role, joint) => [this.words.joints[role], this.number(differences[joint]!, 1)]);
  }

  protected override quantities({ state, pair, frame, styledSecs, differences }: Shown) {
    const { styles } = this.words;
    return {
      p: styles.neutral,
      q: styles[state.style],
      e: `${this.number(meanOf(differences), 1)} cm`,
      i: `${this.number(frame / pair.rateHz, 2)} s`,
      tau: `${this.number(styledSecs, 2)} s`,
      J: String(ROLES.length),
    };
  }

  #labels(term?: string): { styled: string; input: string } {
    const { styles } = this.words;
    const style = this.state ? styles[this.state.style] : "";
    return { styled: term === "p" ? "" : style, input: term === "q" ? "" : styles.neutral };
  }

  protected override placeMarks(): void {
    const [{ viewer }, state] = [this.stage, this.state];
    if (!viewer || !state) return;
    const differences = this.shown?.differences ?? [];
    for (const [role, mark] of this.#marks) {
      const { x, y } = viewer.jointScreenPosition(role);
      const share = Math.min(1, (differences[JOINT[role]] || 0) / FULL_CM);
      const r = RADIUS.none + share * (RADIUS.full - RADIUS.none);
      setAttributes(mark, {
        cx: x.toFixed(1),
        cy: y.toFixed(1),
        r: r.toFixed(1),
        "fill-opacity": (0.12 + 0.78 * share).toFixed(2),
      });
      mark.classList.toggle("chosen", role === state.joint);
    }
    const { joint } = state;
    setAttributes(this.#leader, { visibility: joint === "" ? "hidden" : "visible" });
    setText(this.#label, "");
    if (joint === "") return;
    const { x, y } = viewer.jointScreenPosition(joint);
    const side = x > this.stage.element.clientWidth / 2 ? 1 : -1;
    setAttributes(this.#leader, { d: `M${x} ${y}h${LABEL * side}` });
    setAttributes(this.#label, { x: x + (LABEL + 6) * side, y: y + 4, "text-anchor": side > 0 ? "start" : "end" });
    setText(this.#label, `${this.words.joints[joint]} ${this.number(differences[JOINT[joint]]!, 1)} cm`);
  }
}
