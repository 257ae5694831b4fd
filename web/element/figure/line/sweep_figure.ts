/** The error of a free-running prediction over the weight of the ridge. */

import { stepped } from "../../../ui/controls/dial";
import { html, setAttributes, setText, svg } from "../../../ui/dom";
import { listenToDrags } from "../../../ui/drag";
import { type Axes, decadesOf, extentOf, ticksOf, valueOfX, xOf, yOf } from "../axes";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words";
import { LAMBDAS, measureLine, sweepOf } from "./line_measure";
import { LINE_FIELDS, LINE_RANGES, type LineState } from "./line_state";

/** Share of the range of an arrow key; with Shift the fine one. */
const STEP = 0.02;
const FINE_STEP = 0.005;
/** Least extent of the errors, degrees. */
const LEAST_EXTENT = 0.1;

export const SWEEP: FigureKind<LineState> = {
  fields: LINE_FIELDS,
  create: (parts) => new SweepFigure(parts),
};

class SweepFigure implements FigureInstance<LineState> {
  readonly #parts: FigureParts<LineState>;
  readonly #frame: PlotFrame;
  readonly #curve = svg("path", { class: "curve chosen" });
  readonly #head = svg("g", { class: "playhead", role: "slider", tabindex: 0, "data-term": "lambda" });
  readonly #point = svg("circle", { class: "query", r: 5 });
  readonly #readout = html("p", { class: "readout" });
  readonly #sweeping = new Latest<LineState>((state) => this.#sweep(state));
  #state: LineState | undefined;
  #swept: { key: string; errors: number[] } | undefined;
  #axes: Axes | undefined;
  #request = 0;
  /** Whether a key has moved the head and is still down. */
  #keyed = false;

  constructor(parts: FigureParts<LineState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.sweep.title, () => this.#draw(), signal);
    this.#head.append(
      svg("path", { class: "target" }),
      svg("path", { class: "line" }),
      svg("path", { class: "flag", d: "M-5 0h10v7l-5 5l-5-5z" }),
    );
    this.#head.setAttribute("aria-label", words.line.knobs.lambda.name);
    this.#frame.picture.append(this.#curve, this.#point, this.#head);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.sweep.title)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
    );
    listenToDrags(this.#frame.picture, (press) => this.#drag(press), signal);
    this.#head.addEventListener("keydown", (event) => this.#key(event), { signal });
    const settle = () => {
      if (this.#keyed) change({}, true);
      this.#keyed = false;
    };
    for (const type of ["keyup", "blur"]) this.#head.addEventListener(type, settle, { signal });
  }

  show(state: LineState): Promise<void> {
    this.#state = state;
    this.#draw();
    return this.#sweeping.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureLine(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    const now = this.#now();
    if (!now) return "";
    const { words } = this.#parts;
    const { lambda, error, least, best } = now;
    const degrees = (value: number) => figure(value, 2, words);
    return words.sweep.said(figure(lambda, 4, words), degrees(error), degrees(least), figure(best, 4, words));
  }

  table(): Table {
    const { words } = this.#parts;
    const rows = (this.#swept?.errors ?? []).map((error, i) => [
      figure(LAMBDAS[i]!, 4, words),
      figure(error, 3, words),
    ]);
    return { head: words.sweep.columns, rows };
  }

  values(): Readonly<Record<string, string>> {
    const { words } = this.#parts;
    return this.#state ? { lambda: figure(this.#state.lambda, 4, words) } : {};
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
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

  async #sweep(state: LineState): Promise<void> {
    // The ridge and the instant do not change the curve.
    const key = JSON.stringify({ ...state, lambda: 0, at: 0 });
    if (this.#swept?.key === key) return;
    const errors = await sweepOf(this.#parts.engine, state);
    if (this.#parts.signal.aborted) return;
    this.#swept = { key, errors };
    this.#draw();
  }

  /** The error at the state's λ is read from the curve. */
  #now() {
    const [state, swept] = [this.#state, this.#swept];
    if (!state || !swept) return undefined;
    const { errors } = swept;
    const share = (Math.log10(state.lambda) + 4) * ((LAMBDAS.length - 1) / 5);
    const i = Math.min(LAMBDAS.length - 2, Math.max(0, Math.floor(share)));
    const error = errors[i]! + (errors[i + 1]! - errors[i]!) * Math.min(1, share - i);
    const least = Math.min(...errors);
    return { lambda: state.lambda, error, least, best: LAMBDAS[errors.indexOf(least)]!, errors };
  }

  #draw(): void {
    this.#parts.changed();
    cancelAnimationFrame(this.#request);
    this.#request = requestAnimationFrame(() => this.#drawNow());
  }

  #drawNow(): void {
    const now = this.#now();
    if (!now || this.#frame.width === 0) return;
    const { words } = this.#parts;
    const { errors, lambda, error, least, best } = now;
    const axes: Axes = {
      width: this.#frame.width,
      height: this.#frame.height,
      x: [LINE_RANGES.lambda.min, LINE_RANGES.lambda.max],
      y: extentOf(errors, LEAST_EXTENT),
      logX: true,
    };
    this.#axes = axes;
    const columns = decadesOf(axes.x).map(
      (value) => [value, value < 1 ? figure(value, -Math.log10(value), words) : `${value}`] as const,
    );
    this.#frame.drawGrid(axes, { x: "λ", y: words.sweep.error, columns, rows: ticksOf(axes.y, 4) }, words);
    const points = errors.map((value, i) => `${xOf(axes, LAMBDAS[i]!).toFixed(1)} ${yOf(axes, value).toFixed(1)}`);
    setAttributes(this.#curve, { d: `M${points.join("L")}` });
    setAttributes(this.#point, { cx: xOf(axes, lambda), cy: yOf(axes, error) });
    const bottom = yOf(axes, axes.y[0]);
    setAttributes(this.#head, {
      transform: `translate(${xOf(axes, lambda)} 0)`,
      "aria-valuemin": LINE_RANGES.lambda.min,
      "aria-valuemax": LINE_RANGES.lambda.max,
      "aria-valuenow": lambda,
      "aria-valuetext": this.sentence(),
    });
    setAttributes(this.#head.children[0]!, { d: `M-22 0h44V${bottom}h-44z` });
    setAttributes(this.#head.children[1]!, { d: `M0 0V${bottom}` });
    setText(this.#readout, words.sweep.read(figure(error, 2, words), figure(least, 2, words), figure(best, 3, words)));
  }

  #drag(press: PointerEvent) {
    const [axes, state] = [this.#axes, this.#state];
    if (!axes || !state) return undefined;
    const before = state.lambda;
    const goTo = (event: PointerEvent) => {
      const box = this.#frame.picture.getBoundingClientRect();
      this.#goTo(valueOfX(axes, event.clientX - box.left));
    };
    press.preventDefault();
    this.#head.focus({ preventScroll: true });
    goTo(press);
    return {
      move: goTo,
      cancel: () => this.#goTo(before),
      end: () => this.#parts.change({}, true),
    };
  }

  #key(event: KeyboardEvent): void {
    if (!this.#state || event.ctrlKey || event.metaKey || event.altKey) return;
    const { lambda } = this.#state;
    const step = event.shiftKey ? FINE_STEP : STEP;
    const [less, more] = [-step, step].map((shares) => stepped(lambda, shares, LINE_RANGES.lambda));
    const to = {
      ArrowLeft: less,
      ArrowDown: less,
      ArrowRight: more,
      ArrowUp: more,
      Home: LINE_RANGES.lambda.min,
      End: LINE_RANGES.lambda.max,
    }[event.key];
    if (to === undefined) return;
    event.preventDefault();
    this.#keyed = true;
    this.#goTo(to);
  }

  #goTo(lambda: number): void {
    const { min, max, digits } = LINE_RANGES.lambda;
    this.#parts.change({ lambda: Number(Math.min(max, Math.max(min, lambda)).toFixed(digits)) }, false);
  }
}
