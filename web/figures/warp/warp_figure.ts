/** The costs of pairing instants of two steps, and the paths of corresponding instants; one of them can be bent by hand. */
import { html, setAttributes, setText, svg } from "../../ui/dom";
import type { Axes, Margin } from "../axes";
import type { Handle } from "../handle";
import type { FigureKind, FigureParts } from "../kind";
import { type Place, PlaneHandles } from "../plane_handles";
import { PlotFigure } from "../plot_figure";
import { runsOf } from "../runs";
import { Heat } from "./heat";
import { readAt, wholeMs } from "./reading";
import sheet from "./warp.css?inline";
import { measureWarp } from "./warp_measure";
import { PATHS, type PathName, WARP_FIELDS, WARPED, type WarpState } from "./warp_state";
import { cornersOf, costRatio, MAX_PACE, moved, msOff, pathOf, type Step, type Warping, warpingOf } from "./warping";

/** Step of an arrow key, frames; with Shift one frame, and for an anchor a part of one. */
const STEP = 5;
const ANCHOR_STEP = { coarse: 1, fine: 0.25 };
/** Frames between two rows of the table. */
const TABLE_STEP = 5;
/** Bars of planted feet are above and at the right. */
const ROOM: Margin = { left: 44, right: 38, top: 40, bottom: 44 };
const BAR = { first: 5, each: 10, width: 6 };
/** Half the length of the lines that show the largest pace, frames of the faster step. */
const WEDGE = 15;

export const WARP: FigureKind<WarpState> = {
  fields: WARP_FIELDS,
  measure: measureWarp,
  sheet,
  create: (parts) => new WarpFigure(parts),
};

interface Shown {
  state: WarpState;
  warping: Warping;
}

class WarpFigure extends PlotFigure<WarpState, Shown> {
  readonly #heat = new Heat();
  readonly #lines = ofPaths((path) => svg("path", { class: `path ${path}` }));
  readonly #feet = svg("g", { class: "feet", "aria-hidden": "true" });
  readonly #wedge = svg("path", { class: "wedge", "data-term": "s" });
  readonly #guide = svg("path", { class: "guide" });
  readonly #point = svg("circle", { class: "query", r: 5, "data-term": "tau" });
  readonly #handle: Handle;
  readonly #anchors: PlaneHandles;
  /** Name, cost, and distance from the exact path. */
  readonly #legends = ofPaths((path) => {
    const [name, cost, off] = [this.words.warp.paths[path], "", ""].map((text) => html("span", {}, text));
    off!.className = "off";
    return html("span", { class: `legend ${path}` }, name!, " ", cost!, " ", off!);
  });

  constructor(parts: FigureParts<WarpState>) {
    const { warp, style, styles } = parts.words;
    super(parts, warp.title);
    const { picture, element } = this.frame;
    this.#handle = this.playhead("at", {
      term: "tau",
      step: STEP,
      rate: () => this.#frames(1),
      ends: () => [0, (this.shown?.warping.neutral.frames ?? 1) - 1],
    });
    this.#anchors = new PlaneHandles(
      picture,
      WARP_FIELDS.anchors.initial.map((_, i) => warp.anchor(i + 1)),
      (fine) => this.#ms(fine ? ANCHOR_STEP.fine : ANCHOR_STEP.coarse),
      {
        axes: () => this.axes,
        onInput: (which, place) => this.#bend(which, place),
        onSettle: () => this.settle(),
      },
      parts.signal,
    );
    const { imw, ...others } = this.#lines;
    // Iterative motion warping has two symbols and one path.
    imw.setAttribute("data-term", "beta");
    const lines = [svg("g", { "data-term": "alpha" }, imw), ...Object.values(others)];
    picture.append(...lines, this.#feet, this.#wedge, this.#guide, this.#handle.element, this.#point);
    picture.append(...this.#anchors.elements);
    element.prepend(this.#heat.element);
    const [cost, off] = warp.lead;
    const lead = html("span", {}, cost, html("span", { class: "off" }, ` ${off}`), ":");
    this.lay({
      title: warp.title,
      picture: element,
      head: [this.choice("style", style, WARPED, (name) => styles[name])],
      foot: [html("p", { class: "readout legends" }, lead, ...Object.values(this.#legends))],
      controls: [this.segment("path", warp.path, PATHS, (path) => warp.paths[path]).element],
    });
  }

  override light(term: string | undefined): void {
    super.light(term);
    this.#heat.element.classList.toggle("lit", term === "c");
  }

  repaint(): void {
    this.frame.request();
  }

  protected async load(state: WarpState): Promise<Shown> {
    return { state, warping: await warpingOf(this.parts.engine, state.style) };
  }

  protected describe({ warping, state }: Shown): string {
    const { warp } = this.words;
    const { cost, said } = readAt(warping, state, this.words);
    const { time, tau, neutral, style, styled } = said;
    return warp.said(warp.paths[state.path], time, tau, this.number(cost, 1), neutral, style, styled);
  }

  protected get columns() {
    const { neutral, paths } = this.words.warp;
    return [neutral, ...PATHS.map((path) => paths[path])];
  }

  protected rows({ warping, state }: Shown): string[][] {
    const paths = PATHS.map((path) => pathOf(warping, { ...state, path }));
    return Array.from({ length: Math.ceil(warping.neutral.frames / TABLE_STEP) }, (_, k) => {
      const frame = k * TABLE_STEP;
      return [frame, ...paths.map((path) => path[frame]!)].map((frames) => wholeMs(frames, warping, this.words));
    });
  }

  protected override quantities({ warping, state }: Shown) {
    const { frame, cost, said } = readAt(warping, state, this.words);
    const path = pathOf(warping, state);
    const from = Math.max(1, frame);
    return {
      c: this.number(cost, 1),
      s: this.number(path[from]! - path[from - 1]!, 2),
      tau: `${said.tau} ms`,
      alpha: this.number(warping.scale[frame]!, 2),
      beta: this.number(warping.offset[frame]!, 2),
    };
  }

  #ms(frames: number): number {
    return (1000 * frames) / (this.shown?.warping.rateHz ?? 1);
  }

  #frames(ms: number): number {
    return (ms * (this.shown?.warping.rateHz ?? 1)) / 1000;
  }

  /** Bending the own path also selects it for reading. */
  #bend(which: number, [x, y]: Place): void {
    if (!this.shown) return;
    const { warping, state } = this.shown;
    const { neutral, styled } = warping;
    const to = { x: this.#frames(x) / (neutral.frames - 1), y: this.#frames(y) / (styled.frames - 1) };
    this.change({ anchors: moved(warping, state.anchors, which, to), path: "own" }, false);
  }

  protected draw({ state, warping }: Shown): void {
    const { warp, styles } = this.words;
    const axes = this.plot(
      { min: 0, max: this.#ms(warping.neutral.frames - 1) },
      { min: 0, max: this.#ms(warping.styled.frames - 1) },
      { x: warp.neutral, y: warp.styled(styles[state.style]), columns: 5, digits: 0, rows: 5 },
      { margin: ROOM },
    );
    this.#heat.place(axes, warping);
    this.#drawPaths(axes, warping, state);
    this.#drawFeet(axes, warping);
    this.#drawCursor(axes, warping, state);
    const places = cornersOf(warping, state.anchors).slice(1, -1);
    const inMs = places.map(([x, y]): Place => [this.#ms(x), this.#ms(y)]);
    this.frame.picture.classList.add("drawn");
    this.#anchors.place(axes, inMs, ([x, y]) => this.words.warp.place(this.number(x, 0), this.number(y, 0)));
  }

  #drawPaths(axes: Axes, warping: Warping, state: WarpState): void {
    for (const path of PATHS) {
      const warp = pathOf(warping, { ...state, path });
      const points = Array.from(warp, (y, x) => `${this.#x(axes, x).toFixed(1)} ${this.#y(axes, y).toFixed(1)}`);
      setAttributes(this.#lines[path], { d: `M${points.join("L")}` });
      this.#lines[path].classList.toggle("chosen", path === state.path);
      const [, cost, off] = this.#legends[path].children;
      setText(cost!, this.words.warp.cost(this.number(costRatio(warping, warp), 2)));
      setText(off!, path === "exact" ? "" : this.words.warp.off(this.number(msOff(warping, warp), 0)));
      this.#legends[path].classList.toggle("chosen", path === state.path);
    }
  }

  /** A bar for every contact range: left and right foot, above for the neutral step and at the right for the other. */
  #drawFeet(axes: Axes, { neutral, styled }: Warping): void {
    const [top, right] = [axes.top, axes.right];
    const bars = [0, 1].flatMap((foot) => {
      const away = BAR.first + BAR.each * (1 - foot);
      const above = stances(neutral, foot).map(([from, to]) => {
        const [x, end] = [this.#x(axes, from), this.#x(axes, to)];
        return svg("rect", { x, y: top - away - BAR.width, width: end - x, height: BAR.width });
      });
      const beside = stances(styled, foot).map(([from, to]) => {
        const [y, end] = [this.#y(axes, to), this.#y(axes, from)];
        return svg("rect", { x: right + away, y, width: BAR.width, height: end - y });
      });
      // The name of the foot is at the first end of the bars.
      const name = this.words.warp.sides[foot]!;
      const middle = away + BAR.width / 2;
      const names = [
        svg("text", { x: axes.left - 6, y: top - middle + 4, "text-anchor": "end" }, name),
        svg("text", { x: right + middle, y: axes.bottom + 12, "text-anchor": "middle" }, name),
      ];
      return [...above, ...beside, ...names];
    });
    this.#feet.replaceChildren(...bars);
  }

  #drawCursor(axes: Axes, warping: Warping, state: WarpState): void {
    const { frame, other } = readAt(warping, state, this.words);
    const [x, y] = [this.#x(axes, frame), this.#y(axes, other)];
    setAttributes(this.#point, { cx: x, cy: y });
    setAttributes(this.#guide, { d: `M${x} ${y}H${axes.right + ROOM.right}` });
    const line = (dx: number, dy: number) =>
      `M${this.#x(axes, frame - dx)} ${this.#y(axes, other - dy)}L${this.#x(axes, frame + dx)} ${this.#y(axes, other + dy)}`;
    setAttributes(this.#wedge, { d: line(WEDGE, WEDGE / MAX_PACE) + line(WEDGE / MAX_PACE, WEDGE) });
    this.#handle.place({ x, bottom: axes.y(0), value: frame, text: this.sentence() });
  }

  /** X position of a frame of the neutral step; `#y` is the Y position of a frame of the style's. */
  #x(axes: Axes, frames: number): number {
    return axes.x(this.#ms(frames));
  }

  #y(axes: Axes, frames: number): number {
    return axes.y(this.#ms(frames));
  }
}

function ofPaths<T>(make: (path: PathName) => T): Readonly<Record<PathName, T>> {
  return Object.fromEntries(PATHS.map((path) => [path, make(path)])) as Record<PathName, T>;
}

/** First and last frames of a step's stances on a foot. */
function stances({ contacts, frames }: Step, foot: number): [first: number, last: number][] {
  return runsOf(0, frames, (frame) => contacts[2 * frame + foot] === 1);
}
