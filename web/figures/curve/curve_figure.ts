/** The difference of two performances over the time of the input, by both pairings, with a playhead. */
import { JOINT, ROLES, type Role } from "../../humanoid";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, curvePath, extentOf, type Margin, ticksOf, valueOfX, xOf, yOf } from "../axes";
import { Choice } from "../controls";
import { Handle } from "../handle";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { measurePair } from "../pair_measure";
import { PAIR_FIELDS, type PairState } from "../pair_state";
import { jointCurve, meanOf, PAIRINGS, type Pair, type Pairing } from "../pairing";
import { PlotFrame } from "../plot_frame";
import { sharedPair } from "../shared";
import { figure } from "../words/words";

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
  create: (parts) => new CurveFigure(parts),
};

class CurveFigure implements FigureInstance<PairState> {
  readonly #parts: FigureParts<PairState>;
  readonly #joint: Choice<Role | "">;
  readonly #frame: PlotFrame;
  readonly #grid = svg("g", { class: "grid", "aria-hidden": "true" });
  readonly #curves: Record<Pairing, SVGPathElement>;
  readonly #legend: Record<Pairing, HTMLElement>;
  readonly #thread = svg("path", { class: "thread", "data-term": "tau" });
  readonly #points: Record<Pairing, SVGCircleElement>;
  readonly #handle: Handle;
  readonly #title: HTMLElement;
  readonly #styled = svg(
    "g",
    { class: "styled", "data-term": "tau", "aria-hidden": "true" },
    svg("circle", { r: 3 }),
    svg("text", { x: 8, y: 4 }),
  );
  #state: PairState | undefined;
  #pair: Pair | undefined;
  /** The two displayed curves, and their key. */
  #drawn: { key: string; values: Record<Pairing, Float64Array> } | undefined;
  #axes: Axes | undefined;
  /** Key of the curves and their size: moving the playhead does not draw them again. */
  #curvesOf = "";

  constructor(parts: FigureParts<PairState>) {
    this.#parts = parts;
    const { words, container, signal } = parts;
    this.#joint = new Choice(
      words.joint,
      [["", words.allJoints], ...ROLES.map((role) => [role, words.joints[role]] as const)],
      (joint) => parts.change({ joint }, true),
    );
    const both = <T>(make: (pairing: Pairing) => T) =>
      Object.fromEntries(PAIRINGS.map((pairing) => [pairing, make(pairing)])) as Record<Pairing, T>;
    this.#curves = both((pairing) => svg("path", { class: `curve ${pairing}`, "data-term": "e" }));
    this.#legend = both((pairing) => html("span", { class: `legend ${pairing}`, "data-term": "e" }));
    this.#points = both((pairing) => svg("circle", { class: `point ${pairing}`, r: 4, "data-term": "e" }));
    this.#frame = new PlotFrame(words.difference, () => this.#drawNow(), signal);
    const { picture } = this.#frame;
    this.#handle = new Handle(
      words.playhead,
      "i",
      picture,
      {
        value: () => this.#now()?.at,
        valueOf: (x) => (this.#axes ? valueOfX(this.#axes, x) * this.#pair!.rateHz : 0),
        stepped: (at, direction, fine) => at + direction * (fine ? 1 : STEP),
        ends: () => [0, (this.#pair?.input.frames ?? 1) - 1],
        onInput: (at) => parts.change({ at: Math.round(at) }, false),
        onSettle: () => parts.change({}, true),
      },
      signal,
    );
    picture.append(this.#grid, this.#curves.second, this.#curves.content, this.#thread);
    picture.append(this.#styled, ...Object.values(this.#points), this.#handle.element);
    this.#title = html("h3", {}, words.difference);
    container.append(
      html("header", { class: "head" }, this.#title, this.#joint.element),
      this.#frame.element,
      html(
        "footer",
        { class: "foot" },
        html("p", { class: "readout legends" }, this.#legend.content, this.#legend.second),
      ),
    );
    for (const mark of container.querySelectorAll("[data-term]")) {
      mark.addEventListener("pointerenter", () => parts.point(mark.getAttribute("data-term")!));
      mark.addEventListener("pointerleave", () => parts.point(undefined));
    }
  }

  async show(state: PairState): Promise<void> {
    this.#state = state;
    this.#joint.value = state.joint;
    const pair = await sharedPair(this.#parts.engine, state.motion, state.style);
    // Another state may have been set meanwhile.
    if (this.#state !== state || this.#parts.signal.aborted) return;
    this.#pair = pair;
    this.#draw();
  }

  async measure(): Promise<Measure> {
    if (!this.#pair || !this.#state) return {};
    return measurePair(this.#parts.engine, this.#state, this.#pair);
  }

  sentence(): string {
    const now = this.#now();
    if (!now) return "";
    const { words } = this.#parts;
    const cm = (value: number) => figure(value, 1, words);
    const { style, secs, content, second, meanContent, meanSecond } = now;
    return words.curved(
      words.styles[style],
      figure(secs, 2, words),
      cm(content),
      cm(second),
      cm(meanContent),
      cm(meanSecond),
    );
  }

  table(): Table {
    const { words } = this.#parts;
    const { rateHz } = this.#pair ?? { rateHz: 60 };
    const values = this.#values();
    const rows: string[][] = [];
    for (let f = 0; values && f < values.content.length; f += TABLE_STEP)
      rows.push([
        figure(f / rateHz, 1, words),
        figure(values.content[f]!, 1, words),
        figure(values.second[f]!, 1, words),
      ]);
    return { head: [words.time, `${words.content}, cm`, `${words.second}, cm`], rows };
  }

  values(): Readonly<Record<string, string>> {
    const now = this.#now();
    if (!now) return {};
    const { words } = this.#parts;
    const secs = (value: number) => `${figure(value, 2, words)} s`;
    return {
      e: `${figure(this.#pair!.difference[this.#state!.pairing][now.at]!, 1, words)} cm`,
      i: secs(now.secs),
      tau: secs(now.styledSecs),
    };
  }

  light(term: string | undefined): void {
    for (const mark of this.#parts.container.querySelectorAll("[data-term]"))
      mark.classList.toggle("lit", mark.getAttribute("data-term") === term);
  }

  #values(): Record<Pairing, Float64Array> | undefined {
    const [pair, state] = [this.#pair, this.#state];
    if (!pair || !state) return undefined;
    const { joint } = state;
    if (joint === "") return pair.difference;
    const key = `${state.motion}/${state.style}/${joint}`;
    if (this.#drawn?.key !== key) {
      const values = {
        content: jointCurve(pair, "content", JOINT[joint]),
        second: jointCurve(pair, "second", JOINT[joint]),
      };
      this.#drawn = { key, values };
    }
    return this.#drawn.values;
  }

  #now() {
    const [pair, state, values] = [this.#pair, this.#state, this.#values()];
    if (!pair || !state || !values) return undefined;
    const at = Math.min(state.at, pair.input.frames - 1);
    const secs = at / pair.rateHz;
    return {
      style: state.style,
      at,
      secs,
      styledSecs: state.pairing === "content" ? pair.styled.timeOut[at]! : secs,
      content: values.content[at]!,
      second: values.second[at]!,
      meanContent: meanOf(values.content),
      meanSecond: meanOf(values.second),
    };
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const [pair, state, values, now] = [this.#pair, this.#state, this.#values(), this.#now()];
    if (!pair || !state || !values || !now) return;
    const { words } = this.#parts;
    const { width, height } = this.#frame;
    const secs = (pair.input.frames - 1) / pair.rateHz;
    const curves = [state.motion, state.style, state.joint, width, height].join("/");
    if (!this.#axes || curves !== this.#curvesOf) {
      this.#curvesOf = curves;
      const y = extentOf([0, ...values.content, ...values.second], LEAST_EXTENT);
      this.#axes = { width, height, x: [0, secs], y, margin: MARGIN };
      this.#drawCurves(this.#axes, values, pair.rateHz);
    }
    const axes = this.#axes;
    for (const pairing of PAIRINGS) {
      const chosen = pairing === state.pairing;
      for (const mark of [this.#curves[pairing], this.#legend[pairing], this.#points[pairing]])
        mark.classList.toggle("chosen", chosen);
      const value = now[pairing];
      setAttributes(this.#points[pairing], {
        cx: xOf(axes, now.secs),
        cy: yOf(axes, Number.isNaN(value) ? 0 : value),
        visibility: Number.isNaN(value) ? "hidden" : "visible",
      });
    }
    this.#showLegend(now);
    const x = xOf(axes, now.secs);
    const bottom = yOf(axes, 0);
    this.#handle.place({ x, bottom, value: now.at, text: this.sentence() });
    const other = xOf(axes, Math.min(now.styledSecs, secs));
    setAttributes(this.#thread, {
      d: `M${x} ${bottom}C${x} ${bottom + 14} ${other} ${bottom + 2} ${other} ${bottom + 14}`,
    });
    const styled = `${words.styles[state.style]} ${figure(now.styledSecs, 2, words)} s`;
    setAttributes(this.#styled, { transform: `translate(${other} ${bottom + 14})` });
    const label = this.#styled.lastElementChild!;
    const inwards = other > 0.7 * width;
    setAttributes(label, { x: inwards ? -8 : 8, "text-anchor": inwards ? "end" : "start" });
    setText(label, styled);
    const { joint } = state;
    setText(this.#title, joint === "" ? words.difference : words.distance(words.joints[joint]));
  }

  #showLegend(now: Record<Pairing, number> & { meanContent: number; meanSecond: number }): void {
    const { words } = this.#parts;
    const cm = (value: number) => figure(value, 2, words);
    setText(this.#legend.content, words.legend(words.content, cm(now.content), cm(now.meanContent)));
    setText(this.#legend.second, words.legend(words.second, cm(now.second), cm(now.meanSecond)));
  }

  #drawCurves(axes: Axes, values: Record<Pairing, Float64Array>, rateHz: number): void {
    this.#drawGrid(axes);
    for (const pairing of PAIRINGS)
      setAttributes(this.#curves[pairing], { d: curvePath(axes, values[pairing], rateHz) });
  }

  #drawGrid(axes: Axes): void {
    const { words } = this.#parts;
    const [left, right] = axes.x.map((secs) => xOf(axes, secs));
    const bottom = yOf(axes, 0);
    const text = (x: number, y: number, anchor: string, label: string) =>
      svg("text", { x, y, "text-anchor": anchor }, label);
    const rows = ticksOf(axes.y, 4).flatMap((cm) => [
      svg("path", { d: `M${left} ${yOf(axes, cm)}H${right}` }),
      text(left! - 6, yOf(axes, cm) + 4, "end", `${cm}`),
    ]);
    const columns = ticksOf(axes.x, 8).map((secs) => text(xOf(axes, secs), bottom + 32, "middle", `${secs}`));
    this.#grid.replaceChildren(
      ...rows,
      ...columns,
      text(left!, 12, "start", "cm"),
      text(right!, bottom + 50, "end", words.time),
    );
  }
}
