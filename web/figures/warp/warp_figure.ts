/** The costs of pairing instants of two steps, and the paths of corresponding instants; one of them can be bent by hand. */
import { Segment } from "../../ui/controls/buttons";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { type Axes, type Margin, ticksOf, valueOfX, xOf, yOf } from "../axes";
import type { Style } from "../built_in";
import { Choice } from "../controls";
import { Handle } from "../handle";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { type Place, PlaneHandles } from "../plane_handles";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
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
  sheet,
  create: (parts) => new WarpFigure(parts),
};

class WarpFigure implements FigureInstance<WarpState> {
  readonly #parts: FigureParts<WarpState>;
  readonly #frame: PlotFrame;
  readonly #heat = new Heat();
  readonly #lines: Readonly<Record<PathName, SVGPathElement>>;
  readonly #feet = svg("g", { class: "feet", "aria-hidden": "true" });
  readonly #wedge = svg("path", { class: "wedge", "data-term": "s" });
  readonly #guide = svg("path", { class: "guide" });
  readonly #point = svg("circle", { class: "query", r: 5, "data-term": "tau" });
  readonly #handle: Handle;
  readonly #anchors: PlaneHandles;
  readonly #style: Choice<Style>;
  readonly #path: Segment<PathName>;
  readonly #legends: Readonly<Record<PathName, HTMLElement>>;
  readonly #registering = new Latest<WarpState>((state) => this.#register(state));
  #state: WarpState | undefined;
  #shown: { style: Style; warping: Warping } | undefined;
  #axes: Axes | undefined;

  constructor(parts: FigureParts<WarpState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.warp.title, () => this.#drawNow(), signal);
    const { picture } = this.#frame;
    const settle = () => change({}, true);
    this.#style = new Choice(
      words.style,
      WARPED.map((style) => [style, words.styles[style]] as const),
      (style) => change({ style }, true),
    );
    this.#path = new Segment(
      words.warp.path,
      PATHS.map((value) => ({ value, label: words.warp.paths[value] })),
      (path) => change({ path }, true),
    );
    this.#handle = new Handle(
      words.playhead,
      "tau",
      picture,
      {
        value: () => this.#axes && this.#state?.at,
        valueOf: (x) => this.#frames(valueOfX(this.#axes!, x)),
        stepped: (at, direction, fine) => at + direction * (fine ? 1 : STEP),
        ends: () => [0, (this.#shown?.warping.neutral.frames ?? 1) - 1],
        onInput: (at) => change({ at: Math.round(at) }, false),
        onSettle: settle,
      },
      signal,
    );
    this.#anchors = new PlaneHandles(
      picture,
      WARP_FIELDS.anchors.initial.map((_, i) => words.warp.anchor(i + 1)),
      (fine) => this.#ms(fine ? ANCHOR_STEP.fine : ANCHOR_STEP.coarse),
      { axes: () => this.#axes, onInput: (which, place) => this.#bend(which, place), onSettle: settle },
      signal,
    );
    const line = (path: PathName) => svg("path", { class: `path ${path}` });
    this.#lines = Object.fromEntries(PATHS.map((path) => [path, line(path)])) as Record<PathName, SVGPathElement>;
    const { imw, ...others } = this.#lines;
    // Iterative motion warping has two symbols and one path.
    imw.setAttribute("data-term", "beta");
    const lines = [svg("g", { "data-term": "alpha" }, imw), ...Object.values(others)];
    picture.append(...lines, this.#feet, this.#wedge, this.#guide, this.#handle.element, this.#point);
    picture.append(...this.#anchors.elements);
    this.#frame.element.prepend(this.#heat.element);
    this.#frame.listenToMarks(parts.point);
    this.#legends = Object.fromEntries(
      PATHS.map((path) => {
        const [name, cost, off] = [words.warp.paths[path], "", ""].map((text) => html("span", {}, text));
        off!.className = "off";
        return [path, html("span", { class: `legend ${path}` }, name!, " ", cost!, " ", off!)];
      }),
    ) as Record<PathName, HTMLElement>;
    const [cost, off] = words.warp.lead;
    const lead = html("span", {}, cost, html("span", { class: "off" }, ` ${off}`), ":");
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.warp.title), this.#style.element),
      this.#frame.element,
      html("footer", { class: "foot" }, html("p", { class: "readout legends" }, lead, ...Object.values(this.#legends))),
      html("div", { class: "knobs" }, this.#path.element),
    );
  }

  show(state: WarpState): Promise<void> {
    this.#state = state;
    this.#style.value = state.style;
    this.#path.value = state.path;
    this.#draw();
    return this.#registering.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureWarp(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const now = this.#now();
    if (!now) return "";
    const { words } = this.#parts;
    const { cost, said } = readAt(now.warping, now.state, words);
    const path = words.warp.paths[now.state.path];
    const { time, tau, neutral, style, styled } = said;
    return words.warp.said(path, time, tau, figure(cost, 1, words), neutral, style, styled);
  }

  table(): Table {
    const { words } = this.#parts;
    const now = this.#now();
    const head = [words.warp.neutral, ...PATHS.map((path) => words.warp.paths[path])];
    if (!now) return { head, rows: [] };
    const { warping, state } = now;
    const paths = PATHS.map((path) => pathOf(warping, { ...state, path }));
    const count = Math.ceil(warping.neutral.frames / TABLE_STEP);
    const rows = Array.from({ length: count }, (_, k) => {
      const frame = k * TABLE_STEP;
      return [frame, ...paths.map((path) => path[frame]!)].map((frames) => wholeMs(frames, warping, words));
    });
    return { head, rows };
  }

  values(): Readonly<Record<string, string>> {
    const now = this.#now();
    if (!now) return {};
    const { words } = this.#parts;
    const { warping, state } = now;
    const { frame, cost, said } = readAt(warping, state, words);
    const path = pathOf(warping, state);
    const from = Math.max(1, frame);
    return {
      c: figure(cost, 1, words),
      s: figure(path[from]! - path[from - 1]!, 2, words),
      tau: `${said.tau} ms`,
      alpha: figure(warping.scale[frame]!, 2, words),
      beta: figure(warping.offset[frame]!, 2, words),
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
    this.#heat.element.classList.toggle("lit", term === "c");
  }

  repaint(): void {
    this.#frame.request();
  }

  #now() {
    const [state, shown] = [this.#state, this.#shown];
    return state && shown?.style === state.style ? { state, warping: shown.warping } : undefined;
  }

  async #register(state: WarpState): Promise<void> {
    if (this.#shown?.style === state.style) return;
    const warping = await warpingOf(this.#parts.engine, state.style);
    if (this.#parts.signal.aborted) return;
    this.#shown = { style: state.style, warping };
    this.#draw();
  }

  #ms(frames: number): number {
    return (1000 * frames) / (this.#shown?.warping.rateHz ?? 1);
  }

  #frames(ms: number): number {
    return (ms * (this.#shown?.warping.rateHz ?? 1)) / 1000;
  }

  /** Bending the own path also selects it for reading. */
  #bend(which: number, [x, y]: Place): void {
    const now = this.#now();
    if (!now) return;
    const { neutral, styled } = now.warping;
    const to = { x: this.#frames(x) / (neutral.frames - 1), y: this.#frames(y) / (styled.frames - 1) };
    this.#parts.change({ anchors: moved(now.warping, now.state.anchors, which, to), path: "own" }, false);
  }

  #draw(): void {
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    const now = this.#now();
    if (!now) return;
    const { words } = this.#parts;
    const { state, warping } = now;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [0, this.#ms(warping.neutral.frames - 1)],
      y: [0, this.#ms(warping.styled.frames - 1)],
      margin: ROOM,
    };
    this.#axes = axes;
    const columns = ticksOf(axes.x, 5).map((value) => [value, figure(value, 0, words)] as const);
    const names = { x: words.warp.neutral, y: words.warp.styled(words.styles[state.style]) };
    this.#frame.drawGrid(axes, { ...names, columns, rows: ticksOf(axes.y, 5) }, words);
    this.#heat.place(axes, warping);
    this.#drawPaths(axes, warping, state);
    this.#drawFeet(axes, warping);
    this.#drawCursor(axes, warping, state);
    const places = cornersOf(warping, state.anchors).slice(1, -1);
    const inMs = places.map(([x, y]): Place => [this.#ms(x), this.#ms(y)]);
    this.#frame.picture.classList.add("drawn");
    this.#anchors.place(axes, inMs, ([x, y]) => words.warp.place(figure(x, 0, words), figure(y, 0, words)));
  }

  #drawPaths(axes: Axes, warping: Warping, state: WarpState): void {
    const { words } = this.#parts;
    for (const path of PATHS) {
      const warp = pathOf(warping, { ...state, path });
      const points = Array.from(warp, (y, x) => `${this.#x(axes, x).toFixed(1)} ${this.#y(axes, y).toFixed(1)}`);
      setAttributes(this.#lines[path], { d: `M${points.join("L")}` });
      this.#lines[path].classList.toggle("chosen", path === state.path);
      const [, cost, off] = this.#legends[path].children;
      setText(cost!, words.warp.cost(figure(costRatio(warping, warp), 2, words)));
      setText(off!, path === "exact" ? "" : words.warp.off(figure(msOff(warping, warp), 0, words)));
      this.#legends[path].classList.toggle("chosen", path === state.path);
    }
  }

  /** A bar for every contact range: left and right foot, above for the neutral step and at the right for the other. */
  #drawFeet(axes: Axes, { neutral, styled }: Warping): void {
    const [top, right] = [yOf(axes, axes.y[1]), xOf(axes, axes.x[1])];
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
      const name = this.#parts.words.warp.sides[foot]!;
      const middle = away + BAR.width / 2;
      const names = [
        svg("text", { x: xOf(axes, axes.x[0]) - 6, y: top - middle + 4, "text-anchor": "end" }, name),
        svg("text", { x: right + middle, y: yOf(axes, axes.y[0]) + 12, "text-anchor": "middle" }, name),
      ];
      return [...above, ...beside, ...names];
    });
    this.#feet.replaceChildren(...bars);
  }

  #drawCursor(axes: Axes, warping: Warping, state: WarpState): void {
    const { frame, other } = readAt(warping, state, this.#parts.words);
    const [x, y] = [this.#x(axes, frame), this.#y(axes, other)];
    setAttributes(this.#point, { cx: x, cy: y });
    setAttributes(this.#guide, { d: `M${x} ${y}H${xOf(axes, axes.x[1]) + ROOM.right}` });
    const line = (dx: number, dy: number) =>
      `M${this.#x(axes, frame - dx)} ${this.#y(axes, other - dy)}L${this.#x(axes, frame + dx)} ${this.#y(axes, other + dy)}`;
    setAttributes(this.#wedge, { d: line(WEDGE, WEDGE / MAX_PACE) + line(WEDGE / MAX_PACE, WEDGE) });
    this.#handle.place({ x, bottom: yOf(axes, 0), value: frame, text: this.sentence() });
  }

  /** X position of a frame of the neutral step; `#y` is the Y position of a frame of the style's. */
  #x(axes: Axes, frames: number): number {
    return xOf(axes, this.#ms(frames));
  }

  #y(axes: Axes, frames: number): number {
    return yOf(axes, this.#ms(frames));
  }
}

/** First and last frames of a step's stances on a foot. */
function stances({ contacts, frames }: Step, foot: number): [from: number, to: number][] {
  const found: [number, number][] = [];
  for (let frame = 0; frame < frames; frame++) {
    if (contacts[2 * frame + foot] !== 1) continue;
    const last = found.at(-1);
    if (last?.[1] === frame - 1) last[1] = frame;
    else found.push([frame, frame]);
  }
  return found;
}
