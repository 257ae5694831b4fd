/** The difference of two performances over the time of the input, by both pairings, with a playhead. */
import { JOINT, ROLES } from "../../humanoid";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent, ticks } from "../../ui/scale";
import type { Axes, Margin } from "../axes";
import type { FigureKind, FigureParts } from "../kind";
import { measurePair } from "../pair_measure";
import { PAIR_FIELDS, type PairState } from "../pair_state";
import { jointCurve, meanOf, PAIRINGS, type Pair, type Pairing } from "../pairing";
import { PlotFigure } from "../plot_figure";
import { sharedPair } from "../shared";

/** Step of an arrow key, frames; with Shift one frame. */
const STEP = 10;
/** Below the axis the thread leads to the paired instant. */
const MARGIN: Margin = { left: 32, right: 20, top: 20, bottom: 56 };
/** Minimum range of the distances, cm. */
const LEAST_EXTENT = 1;
/** Frames between two rows of the table. */
const TABLE_STEP = 60;

export const CURVE: FigureKind<PairState> = {
  fields: PAIR_FIELDS,
  measure: measurePair,
  create: (parts) => new CurveFigure(parts),
};

interface Shown {
  state: PairState;
  pair: Pair;
  /** The two displayed curves, cm. */
  curves: Record<Pairing, Float64Array>;
}

class CurveFigure extends PlotFigure<PairState, Shown> {
  readonly #grid = svg("g", { class: "grid", "aria-hidden": "true" });
  readonly #curves = both((pairing) => svg("path", { class: `curve ${pairing}`, "data-term": "e" }));
  readonly #legend = both((pairing) => html("span", { class: `legend ${pairing}`, "data-term": "e" }));
  readonly #points = both((pairing) => svg("circle", { class: `point ${pairing}`, r: 4, "data-term": "e" }));
  readonly #thread = svg("path", { class: "thread", "data-term": "tau" });
  readonly #handle = this.playhead("at", {
    step: STEP,
    rate: () => this.shown!.pair.rateHz,
    ends: () => [0, (this.shown?.pair.input.frames ?? 1) - 1],
  });
  readonly #styled = svg(
    "g",
    { class: "styled", "data-term": "tau", "aria-hidden": "true" },
    svg("circle", { r: 3 }),
    svg("text", { x: 8, y: 4 }),
  );
  /** Key of the drawn curves and their size: moving the playhead does not draw them again. */
  #drawn = "";
  /** The curves of the last joint. */
  #joint: { key: string; curves: Record<Pairing, Float64Array> } | undefined;

  constructor(parts: FigureParts<PairState>) {
    const { words } = parts;
    super(parts, words.difference);
    const { picture, element } = this.frame;
    picture.append(this.#grid, this.#curves.second, this.#curves.content, this.#thread);
    picture.append(this.#styled, ...Object.values(this.#points), this.#handle.element);
    const { content, second } = this.#legend;
    const nameOf = (joint: PairState["joint"]) => (joint === "" ? words.allJoints : words.joints[joint]);
    this.lay({
      title: words.difference,
      picture: element,
      head: [this.choice("joint", words.joint, ["", ...ROLES], nameOf)],
      foot: [html("p", { class: "readout legends" }, content, second)],
    });
  }

  protected async load(state: PairState): Promise<Shown | undefined> {
    const pair = await sharedPair(this.parts.engine, state.motion, state.style);
    return pair && { state, pair, curves: this.#curvesOf(pair, state) };
  }

  #curvesOf(pair: Pair, { motion, style, joint }: PairState): Record<Pairing, Float64Array> {
    if (joint === "") return pair.difference;
    const key = `${motion}/${style}/${joint}`;
    if (this.#joint?.key !== key)
      this.#joint = { key, curves: both((pairing) => jointCurve(pair, pairing, JOINT[joint])) };
    return this.#joint.curves;
  }

  protected describe(shown: Shown): string {
    const { secs, content, second } = instantOf(shown);
    const { curves, state } = shown;
    return this.words.curved(
      this.words.styles[state.style],
      this.number(secs, 2),
      this.number(content, 1),
      this.number(second, 1),
      this.number(meanOf(curves.content), 1),
      this.number(meanOf(curves.second), 1),
    );
  }

  protected get columns() {
    const { time, content, second } = this.words;
    return [time, `${content}, cm`, `${second}, cm`];
  }

  protected rows({ pair, curves: { content, second } }: Shown): string[][] {
    return Array.from({ length: Math.ceil(content.length / TABLE_STEP) }, (_, i) => {
      const frame = i * TABLE_STEP;
      return [this.number(frame / pair.rateHz, 1), this.number(content[frame]!, 1), this.number(second[frame]!, 1)];
    });
  }

  protected override quantities(shown: Shown) {
    const { at, secs, styledSecs } = instantOf(shown);
    const { pair, state } = shown;
    return {
      e: `${this.number(pair.difference[state.pairing][at]!, 1)} cm`,
      i: `${this.number(secs, 2)} s`,
      tau: `${this.number(styledSecs, 2)} s`,
    };
  }

  protected draw(shown: Shown): void {
    const { state, pair, curves } = shown;
    const now = instantOf(shown);
    const { width, height } = this.frame;
    const secs = (pair.input.frames - 1) / pair.rateHz;
    const drawn = [state.motion, state.style, state.joint, width, height].join("/");
    if (!this.axes || drawn !== this.#drawn) {
      this.#drawn = drawn;
      const up = roundedExtent([0, ...curves.content, ...curves.second], LEAST_EXTENT);
      this.axes = this.frame.axes({ min: 0, max: secs }, up, { margin: MARGIN });
      this.#drawGrid(this.axes);
      for (const pairing of PAIRINGS)
        setAttributes(this.#curves[pairing], { d: this.axes.curve(curves[pairing], pair.rateHz) });
    }
    const { axes } = this;
    for (const pairing of PAIRINGS) {
      for (const mark of [this.#curves[pairing], this.#legend[pairing], this.#points[pairing]])
        mark.classList.toggle("chosen", pairing === state.pairing);
      const value = now[pairing];
      setAttributes(this.#points[pairing], {
        cx: axes.x(now.secs),
        cy: axes.y(Number.isNaN(value) ? 0 : value),
        visibility: Number.isNaN(value) ? "hidden" : "visible",
      });
      const read = [value, meanOf(curves[pairing])].map((cm) => this.number(cm, 2)) as [string, string];
      setText(this.#legend[pairing], this.words.legend(this.words[pairing], ...read));
    }
    const x = axes.x(now.secs);
    const bottom = axes.y(0);
    this.#handle.place({ x, bottom, value: now.at, text: this.sentence() });
    const other = axes.x(Math.min(now.styledSecs, secs));
    setAttributes(this.#thread, {
      d: `M${x} ${bottom}C${x} ${bottom + 14} ${other} ${bottom + 2} ${other} ${bottom + 14}`,
    });
    setAttributes(this.#styled, { transform: `translate(${other} ${bottom + 14})` });
    const label = this.#styled.lastElementChild!;
    const inwards = other > 0.7 * width;
    setAttributes(label, { x: inwards ? -8 : 8, "text-anchor": inwards ? "end" : "start" });
    setText(label, `${this.words.styles[state.style]} ${this.number(now.styledSecs, 2)} s`);
    const { joint } = state;
    const { difference, distance, joints } = this.words;
    setText(this.heading, joint === "" ? difference : distance(joints[joint]));
  }

  /** The labels of the horizontal axis are below the thread. */
  #drawGrid(axes: Axes): void {
    const { left, right } = axes;
    const bottom = axes.y(0);
    const text = (x: number, y: number, anchor: string, label: string) =>
      svg("text", { x, y, "text-anchor": anchor }, label);
    const rows = ticks(axes.up, 4).values.flatMap((cm) => [
      svg("path", { d: `M${left} ${axes.y(cm)}H${right}` }),
      text(left - 6, axes.y(cm) + 4, "end", `${cm}`),
    ]);
    const columns = ticks(axes.across, 8).values.map((secs) => text(axes.x(secs), bottom + 32, "middle", `${secs}`));
    this.#grid.replaceChildren(
      ...rows,
      ...columns,
      text(left, 12, "start", "cm"),
      text(right, bottom + 50, "end", this.words.time),
    );
  }
}

function both<T>(make: (pairing: Pairing) => T): Record<Pairing, T> {
  return Object.fromEntries(PAIRINGS.map((pairing) => [pairing, make(pairing)])) as Record<Pairing, T>;
}

/** The displayed frame, its times, and the values of both curves. */
function instantOf({ pair, state, curves }: Shown) {
  const at = Math.min(state.at, pair.input.frames - 1);
  const secs = at / pair.rateHz;
  return {
    at,
    secs,
    styledSecs: state.pairing === "content" ? pair.styled.timeOut[at]! : secs,
    content: curves.content[at]!,
    second: curves.second[at]!,
  };
}
