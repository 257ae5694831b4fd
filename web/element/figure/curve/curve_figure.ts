/** The difference of two performances over the time of the input, by both pairings, with a playhead. */
import { JOINT, ROLES, type Role } from "../../../humanoid";
import { html, setAttributes, setText, svg } from "../../../ui/dom";
import { listenToDrags } from "../../../ui/drag";
import { Choice } from "../controls";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { measurePair } from "../pair_measure";
import { PAIR_FIELDS, type PairState } from "../pair_state";
import { jointCurve, meanOf, PAIRINGS, type Pair, type Pairing } from "../pairing";
import { sharedPair } from "../shared";
import { figure } from "../words";
import { curvePath, niceTop, type Plot, ticksTo, xOf, yOf } from "./plot";

/** Frames of an arrow key; with Shift one. */
const STEP = 10;
/** Frames between two rows of the table. */
const TABLE_STEP = 60;

export const CURVE: FigureKind<PairState> = {
  fields: PAIR_FIELDS,
  create: (parts) => new CurveFigure(parts),
};

class CurveFigure implements FigureInstance<PairState> {
  readonly #parts: FigureParts<PairState>;
  readonly #joint: Choice<Role | "">;
  readonly #picture = svg("svg", { class: "plot", role: "group" });
  readonly #grid = svg("g", { class: "grid" });
  readonly #curves: Record<Pairing, SVGPathElement>;
  readonly #legend: Record<Pairing, HTMLElement>;
  readonly #thread = svg("path", { class: "thread", "data-term": "tau" });
  readonly #points: Record<Pairing, SVGCircleElement>;
  readonly #head = svg("g", { class: "playhead", role: "slider", tabindex: 0, "data-term": "i" });
  readonly #title: HTMLElement;
  readonly #styled = svg(
    "g",
    { class: "styled", "data-term": "tau" },
    svg("circle", { r: 3 }),
    svg("text", { x: 8, y: 4 }),
  );
  #state: PairState | undefined;
  #pair: Pair | undefined;
  /** The two curves that are drawn, and of what. */
  #drawn: { key: string; values: Record<Pairing, Float64Array> } | undefined;
  #plot: Plot = { width: 0, height: 0, secs: 1, top: 1 };
  #request = 0;
  /** What the curves are of, and their size: a playhead that moves does not draw them again. */
  #curvesOf = "";
  /** Whether a key has moved the playhead and is still down. */
  #keyed = false;

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
    this.#head.append(
      svg("path", { class: "target" }),
      svg("path", { class: "line" }),
      svg("path", { class: "flag", d: "M-5 0h10v7l-5 5l-5-5z" }),
    );
    this.#head.setAttribute("aria-label", words.playhead);
    this.#picture.append(this.#grid, this.#curves.second, this.#curves.content, this.#thread);
    this.#picture.append(this.#styled, ...Object.values(this.#points), this.#head);
    this.#picture.setAttribute("aria-label", words.difference);
    this.#title = html("h3", {}, words.difference);
    container.append(
      html("header", { class: "head" }, this.#title, this.#joint.element),
      html("div", { class: "picture" }, this.#picture),
      html(
        "footer",
        { class: "foot" },
        html("p", { class: "readout legends" }, this.#legend.content, this.#legend.second),
      ),
    );
    const observer = new ResizeObserver(() => this.#resize());
    observer.observe(this.#picture.parentElement!);
    signal.addEventListener("abort", () => observer.disconnect(), { once: true });
    listenToDrags(this.#picture, (press) => this.#drag(press), signal);
    this.#head.addEventListener("keydown", (event) => this.#key(event), { signal });
    const settle = () => {
      if (this.#keyed) parts.change({}, true);
      this.#keyed = false;
    };
    for (const type of ["keyup", "blur"]) this.#head.addEventListener(type, settle, { signal });
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

  run(): void {
    // It draws when something changes, and only then.
  }

  setTheme(): void {
    // Its colours are those of the style sheet.
  }

  dispose(): void {
    cancelAnimationFrame(this.#request);
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

  #resize(): void {
    const { clientWidth: width, clientHeight: height } = this.#picture.parentElement!;
    if (width === this.#plot.width && height === this.#plot.height) return;
    this.#plot = { ...this.#plot, width, height };
    this.#draw();
  }

  /** Draws with the next picture: a drag may bring several states for one. */
  #draw(): void {
    this.#parts.changed();
    cancelAnimationFrame(this.#request);
    this.#request = requestAnimationFrame(() => this.#drawNow());
  }

  #drawNow(): void {
    const [pair, state, values, now] = [this.#pair, this.#state, this.#values(), this.#now()];
    if (!pair || !state || !values || !now || this.#plot.width === 0) return;
    const { words } = this.#parts;
    const secs = (pair.input.frames - 1) / pair.rateHz;
    const curves = [state.motion, state.style, state.joint, this.#plot.width, this.#plot.height].join("/");
    if (curves !== this.#curvesOf) {
      this.#curvesOf = curves;
      this.#plot = { ...this.#plot, secs, top: niceTop([...values.content, ...values.second]) };
      this.#drawCurves(values, pair.rateHz);
    }
    const plot = this.#plot;
    for (const pairing of PAIRINGS) {
      const chosen = pairing === state.pairing;
      for (const mark of [this.#curves[pairing], this.#legend[pairing], this.#points[pairing]])
        mark.classList.toggle("chosen", chosen);
      const value = now[pairing];
      setAttributes(this.#points[pairing], {
        cx: xOf(plot, now.secs),
        cy: yOf(plot, Number.isNaN(value) ? 0 : value),
        visibility: Number.isNaN(value) ? "hidden" : "visible",
      });
    }
    this.#showLegend(now);
    const x = xOf(plot, now.secs);
    const bottom = yOf(plot, 0);
    setAttributes(this.#head, {
      transform: `translate(${x} 0)`,
      "aria-valuemin": 0,
      "aria-valuemax": Number(secs.toFixed(2)),
      "aria-valuenow": Number(now.secs.toFixed(2)),
      "aria-valuetext": this.sentence(),
    });
    setAttributes(this.#head.children[0]!, { d: `M-22 0h44V${bottom}h-44z` });
    setAttributes(this.#head.children[1]!, { d: `M0 0V${bottom}` });
    const other = xOf(plot, Math.min(now.styledSecs, secs));
    setAttributes(this.#thread, {
      d: `M${x} ${bottom}C${x} ${bottom + 14} ${other} ${bottom + 2} ${other} ${bottom + 14}`,
    });
    const styled = `${words.styles[state.style]} ${figure(now.styledSecs, 2, words)} s`;
    setAttributes(this.#styled, { transform: `translate(${other} ${bottom + 14})` });
    const label = this.#styled.lastElementChild!;
    const inwards = other > 0.7 * plot.width;
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

  #drawCurves(values: Record<Pairing, Float64Array>, rateHz: number): void {
    const plot = this.#plot;
    setAttributes(this.#picture, { viewBox: `0 0 ${plot.width} ${plot.height}` });
    this.#drawGrid();
    for (const pairing of PAIRINGS)
      setAttributes(this.#curves[pairing], { d: curvePath(plot, values[pairing], rateHz) });
  }

  #drawGrid(): void {
    const plot = this.#plot;
    const { words } = this.#parts;
    const bottom = yOf(plot, 0);
    const text = (x: number, y: number, anchor: string, label: string) =>
      svg("text", { x, y, "text-anchor": anchor }, label);
    const rows = ticksTo(plot.top, 4).flatMap((cm) => [
      svg("path", { d: `M${xOf(plot, 0)} ${yOf(plot, cm)}H${xOf(plot, plot.secs)}` }),
      text(xOf(plot, 0) - 6, yOf(plot, cm) + 4, "end", `${cm}`),
    ]);
    const columns = ticksTo(plot.secs, 8).map((secs) => text(xOf(plot, secs), bottom + 32, "middle", `${secs}`));
    this.#grid.replaceChildren(
      ...rows,
      ...columns,
      text(xOf(plot, 0), 12, "start", "cm"),
      text(xOf(plot, plot.secs), bottom + 50, "end", words.time),
    );
  }

  #drag(press: PointerEvent) {
    const [pair, state] = [this.#pair, this.#state];
    if (!pair || !state) return undefined;
    const before = state.at;
    const goTo = (event: PointerEvent, settled: boolean) => {
      const box = this.#picture.getBoundingClientRect();
      const span = xOf(this.#plot, this.#plot.secs) - xOf(this.#plot, 0);
      const share = (event.clientX - box.left - xOf(this.#plot, 0)) / span;
      this.#goTo(share * (pair.input.frames - 1), settled);
    };
    press.preventDefault();
    this.#head.focus({ preventScroll: true });
    goTo(press, false);
    return {
      move: (event: PointerEvent) => goTo(event, false),
      cancel: () => this.#goTo(before, false),
      end: () => this.#parts.change({}, true),
    };
  }

  #key(event: KeyboardEvent): void {
    const [pair, state] = [this.#pair, this.#state];
    if (!pair || !state || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = event.shiftKey ? 1 : STEP;
    const last = pair.input.frames - 1;
    const at = Math.min(state.at, last);
    const to = {
      ArrowLeft: at - step,
      ArrowDown: at - step,
      ArrowRight: at + step,
      ArrowUp: at + step,
      Home: 0,
      End: last,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    this.#keyed = true;
    this.#goTo(to, false);
  }

  #goTo(frame: number, settled: boolean): void {
    const last = this.#pair!.input.frames - 1;
    this.#parts.change({ at: Math.round(Math.min(last, Math.max(0, frame))) }, settled);
  }
}
