/** An input and its performance in a style, side by side; each joint has a mark for the difference. */
import { JOINT, ROLES, type Role } from "../../humanoid";
import { poseAt } from "../../player/measured";
import { Segment } from "../../ui/controls/buttons";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import type { Viewer } from "../../viewer";
import { STYLES, type Style } from "../built_in";
import { Choice } from "../controls";
import { FigureStage } from "../figure_stage";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { measurePair } from "../pair_measure";
import { PAIR_FIELDS, type PairState } from "../pair_state";
import { jointDifferences, meanOf, PAIRINGS, type Pair } from "../pairing";
import { Playing } from "../playing";
import { sharedPair } from "../shared";
import { figure } from "../words/words";

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
  create: (parts) => new StageFigure(parts),
};

class StageFigure implements FigureInstance<PairState> {
  readonly #parts: FigureParts<PairState>;
  readonly stage: FigureStage;
  readonly #marks = new Map<Role, SVGCircleElement>();
  readonly #leader = svg("path", { class: "leader" });
  readonly #label = svg("text", { class: "label chosen" });
  readonly #style: Choice<Style>;
  readonly #pairing: Segment<PairState["pairing"]>;
  readonly #playing: Playing;
  readonly #readout = html("p", { class: "readout" });
  #state: PairState | undefined;
  #pair: Pair | undefined;
  #differences: number[] = [];
  #shownAt = Number.NaN;

  constructor(parts: FigureParts<PairState>) {
    this.#parts = parts;
    const { words, container, signal } = parts;
    this.stage = new FigureStage(
      words,
      { labels: { styled: "", input: "" }, description: words.two },
      { advance: (dtSecs) => this.#advance(dtSecs), drawn: () => this.#placeMarks() },
    );
    this.#style = new Choice(
      words.style,
      STYLES.map((style) => [style, words.styles[style]] as const),
      (style) => parts.change({ style }, true),
    );
    this.#pairing = new Segment(
      words.pairing,
      PAIRINGS.map((value) => ({ value, label: words[value] })),
      (pairing) => parts.change({ pairing }, true),
    );
    this.#playing = new Playing(words, () => parts.change({}, true), signal);
    for (const role of ROLES) {
      const mark = svg("circle", { class: "joint", "data-term": "e" });
      mark.addEventListener("click", () => parts.change({ joint: this.#state?.joint === role ? "" : role }, true));
      mark.addEventListener("pointerenter", () => parts.point("e"));
      mark.addEventListener("pointerleave", () => parts.point(undefined));
      this.#marks.set(role, mark);
    }
    this.stage.overlay.append(this.#leader, ...this.#marks.values(), this.#label);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.two), this.#style.element),
      this.stage.element,
      html("footer", { class: "foot" }, this.#playing.element, this.#pairing.element, this.#readout),
    );
  }

  async show(state: PairState): Promise<void> {
    const before = this.#state;
    this.#state = state;
    this.#playing.frame = state.at;
    this.#style.value = state.style;
    this.#pairing.value = state.pairing;
    const pair = await sharedPair(this.#parts.engine, state.motion, state.style);
    if (this.#state !== state || this.#parts.signal.aborted) return;
    const jumped =
      this.#pair !== pair || before?.pairing !== state.pairing || Math.abs(state.at - this.#shownAt) > JUMP;
    if (pair && this.#pair !== pair) this.#viewer?.setProportions(pair.proportions);
    this.#pair = pair;
    this.#showNow();
    if (jumped) this.#viewer?.resetTrail();
  }

  async measure(): Promise<Measure> {
    if (!this.#pair || !this.#state) return {};
    return measurePair(this.#parts.engine, this.#state, this.#pair);
  }

  sentence(): string {
    const [pair, state] = [this.#pair, this.#state];
    if (!pair || !state) return "";
    const { words } = this.#parts;
    const most = this.#differences.reduce((found, cm, joint, all) => (cm > all[found]! ? joint : found), 0);
    const cm = (value: number) => figure(value, 1, words);
    return words.pictured(
      words.styles[state.style],
      figure(this.#frame / pair.rateHz, 2, words),
      words[state.pairing],
      cm(meanOf(this.#differences)),
      words.joints[ROLES[most]!],
      cm(this.#differences[most]!),
    );
  }

  table(): Table {
    const { words } = this.#parts;
    const rows = ROLES.map((role, joint) => [
      words.joints[role],
      figure(this.#differences[joint] ?? Number.NaN, 1, words),
    ]);
    return { head: [words.joint, "cm"], rows };
  }

  values(): Readonly<Record<string, string>> {
    const [pair, state] = [this.#pair, this.#state];
    if (!pair || !state) return {};
    const { words } = this.#parts;
    const secs = (value: number) => `${figure(value, 2, words)} s`;
    return {
      p: words.styles.neutral,
      q: words.styles[state.style],
      e: `${figure(meanOf(this.#differences), 1, words)} cm`,
      i: secs(this.#frame / pair.rateHz),
      tau: secs(this.#styledSecs(pair, state)),
      J: String(ROLES.length),
    };
  }

  light(term: string | undefined): void {
    // The difference is the mean of all joints.
    this.stage.overlay.classList.toggle("lit", term === "e" || term === "J");
    const labels = { styled: this.#styleName, input: this.#parts.words.styles.neutral };
    if (!this.#viewer) return;
    // Its name highlights either walker.
    if (term === "p") this.#viewer.labels = { ...labels, styled: "" };
    else if (term === "q") this.#viewer.labels = { ...labels, input: "" };
    else this.#viewer.labels = labels;
    this.stage.invalidate();
  }

  get #viewer(): Viewer | undefined {
    return this.stage.viewer;
  }

  get #frame(): number {
    return Math.min(this.#state?.at ?? 0, (this.#pair?.input.frames ?? 1) - 1);
  }

  /** Time at which the styled walker is compared. */
  #styledSecs({ styled, rateHz }: Pair, { pairing }: PairState): number {
    return pairing === "content" ? styled.timeOut[this.#frame]! : this.#frame / rateHz;
  }

  get #styleName(): string {
    return this.#state ? this.#parts.words.styles[this.#state.style] : "";
  }

  #advance(dtSecs: number): void {
    if (!this.#pair) return;
    const at = this.#playing.advance(dtSecs, this.#pair.rateHz, this.#pair.input.frames - 1);
    if (at !== undefined && at !== this.#state?.at) this.#parts.change({ at }, false);
  }

  /** Poses both walkers and shows their times. */
  #showNow(): void {
    const [pair, state] = [this.#pair, this.#state];
    if (!pair || !state) return;
    const { words } = this.#parts;
    const frame = this.#frame;
    this.#shownAt = frame;
    const paired = pair.frames[state.pairing][frame]!;
    const over = Number.isNaN(paired);
    this.#differences = jointDifferences(pair, state.pairing, frame);
    const viewer = this.#viewer;
    if (viewer) {
      viewer.setStyled(poseAt(pair.styled, over ? pair.styled.frames - 1 : paired));
      viewer.setInput(poseAt(pair.input, frame));
      viewer.labels = { styled: this.#styleName, input: words.styles.neutral };
      viewer.description = this.sentence();
    }
    const secs = frame / pair.rateHz;
    const styledSecs = this.#styledSecs(pair, state);
    const times = words.times(figure(secs, 2, words), this.#styleName, figure(styledSecs, 2, words));
    setText(this.#readout, over ? words.ended : times);
    this.stage.invalidate();
    this.#parts.changed();
  }

  /** Moves the marks to the joints of the drawn picture. */
  #placeMarks(): void {
    const [viewer, state] = [this.#viewer, this.#state];
    if (!viewer || !state) return;
    const { words } = this.#parts;
    for (const [role, mark] of this.#marks) {
      const { x, y } = viewer.jointScreenPosition(role);
      const share = Math.min(1, (this.#differences[JOINT[role]] || 0) / FULL_CM);
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
    setText(this.#label, `${words.joints[joint]} ${figure(this.#differences[JOINT[joint]]!, 1, words)} cm`);
  }
}
