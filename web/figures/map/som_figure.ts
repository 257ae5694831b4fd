/** Learning of a self-organising mixture network, update by update: components over the training frames. */
import type { SomnSnapshot, StyleSamples } from "../../client/learn/protocol";
import { DEGREES } from "../../humanoid";
import { button, Toggle } from "../../ui/controls/buttons";
import { html, keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { xOf, yOf } from "../axes";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./map.css?inline";
import { measureMap, passOf, samplesOf } from "./map_measure";
import { MAP_FIELDS, type MapState } from "./map_state";
import { SamplePlane, ShareBars } from "./plane";

/** Updates per second during playback: few at first, then a share of those made so far. */
const PLAY = { least: 4, share: 0.4 };
/** If an update moves a centre by less than this, units, no arrow is drawn. */
const LEAST_MOVE = 3;
/** Larger errors, degrees, are displayed as powers of ten. */
const HUGE = 10_000;

export const SOM: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  sheet,
  create: (parts) => new SomFigure(parts),
};

class SomFigure implements FigureInstance<MapState> {
  readonly #parts: FigureParts<MapState>;
  readonly #frame: PlotFrame;
  readonly #printed: Toggle;
  readonly #plane = new SamplePlane();
  readonly #components = svg("g", { class: "components", "data-term": "a" });
  readonly #neighbourhood = svg("circle", { class: "neighbourhood", "data-term": "sigma" });
  readonly #sample = svg("circle", { class: "query", r: 5, "data-term": "x" });
  readonly #bars = new ShareBars("r");
  readonly #moves = svg("path", { class: "moves", "data-term": "delta" });
  readonly #play: HTMLButtonElement;
  readonly #readout = html("p", { class: "readout" });
  readonly #stepping = new Latest<MapState>((state) => this.#step(state));
  #state: MapState | undefined;
  #shown: { samples: StyleSamples; now: SomnSnapshot } | undefined;
  /** The number of updates reached by playback, and the time of its last picture; `undefined` while paused. */
  #run: { at: number; last: number } | undefined;

  constructor(parts: FigureParts<MapState>) {
    this.#parts = parts;
    const { words, container, signal, change } = parts;
    this.#frame = new PlotFrame(words.map.som, () => this.#drawNow(), signal);
    this.#printed = new Toggle(words.map.printed, (printed) => change({ printed, updates: 0 }, true));
    const go = (by: (now: SomnSnapshot) => number) => () => {
      const [state, shown] = [this.#state, this.#shown];
      if (state && shown) change({ updates: Math.min(shown.now.total, state.updates + by(shown.now)) }, true);
    };
    const { one, ten, pass, all, restart } = words.map.steps;
    this.#play = button(words.play, () => (this.#run ? this.#stop() : this.#start()), { label: true });
    // The button's name changes.
    this.#play.removeAttribute("title");
    signal.addEventListener("abort", () => this.#stop(), { once: true });
    const steps = [
      this.#play,
      button(
        one,
        go(() => 1),
        { label: true },
      ),
      button(
        ten,
        go(() => 10),
        { label: true },
      ),
      // To the end of this pass, or of the next one.
      button(
        pass,
        go(({ frames }) => frames - (this.#state!.updates % frames)),
        { label: true },
      ),
      button(
        all,
        go(({ total }) => total),
        { label: true },
      ),
      button(restart, () => change({ updates: 0 }, true), { label: true }),
    ];
    this.#frame.picture.append(this.#plane.dots, this.#components, this.#moves, this.#neighbourhood);
    this.#frame.picture.append(this.#sample, this.#bars.element);
    this.#frame.listenToMarks(parts.point);
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.map.som)),
      this.#frame.element,
      html("footer", { class: "foot" }, this.#readout),
      html("div", { class: "knobs steps" }, ...steps, this.#printed.element),
    );
  }

  show(state: MapState): Promise<void> {
    this.#state = state;
    this.#printed.on = state.printed;
    // The learner has moved elsewhere meanwhile.
    if (this.#run && state.updates !== Math.floor(this.#run.at)) this.#run.at = state.updates;
    return this.#stepping.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measureMap(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#shown) return "";
    const { now } = this.#shown;
    return this.#parts.words.map.stepped(String(now.updates), String(now.weights.length), this.#error(now));
  }

  table(): Table {
    const { words } = this.#parts;
    const now = this.#shown?.now;
    const rows = Array.from(now?.weights ?? [], (share, i) => [
      String(i + 1),
      figure(share, 2, words),
      figure(now!.r[i]!, 2, words),
      `${figure(now!.centres[2 * i]!, 1, words)}, ${figure(now!.centres[2 * i + 1]!, 1, words)}`,
    ]);
    return { head: words.map.components, rows };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#shown) return {};
    const { words } = this.#parts;
    const { now, samples } = this.#shown;
    const most = now.r.reduce((a, b) => Math.max(a, b), 0);
    const sample = now.sample < 0 ? undefined : samples.values.subarray(2 * now.sample, 2 * now.sample + 2);
    return {
      r: figure(most, 2, words),
      delta: figure(now.delta, 2, words),
      sigma: `${figure(now.sigma * DEGREES, 1, words)}°`,
      a: figure(
        now.weights.reduce((a, b) => Math.max(a, b), 0),
        2,
        words,
      ),
      x: sample ? `${figure(sample[0]!, 0, words)}, ${figure(sample[1]!, 0, words)} cm` : "–",
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  /** The running error as text; once learning has diverged it is not a number. */
  #error({ error }: SomnSnapshot): string {
    if (!Number.isFinite(error)) return "∞";
    const degrees = error * DEGREES;
    return degrees < HUGE ? figure(degrees, 1, this.#parts.words) : powerOfTen(degrees);
  }

  #start(): void {
    const { words } = this.#parts;
    const { state, now } = { state: this.#state, now: this.#shown?.now };
    if (!state || !now) return;
    // At the end playback restarts.
    this.#run = { at: state.updates >= now.total ? 0 : state.updates, last: performance.now() };
    setText(this.#play.querySelector("span")!, words.pause);
    requestAnimationFrame((time) => this.#goOn(time));
  }

  #stop(): void {
    if (!this.#run) return;
    this.#run = undefined;
    setText(this.#play.querySelector("span")!, this.#parts.words.play);
    if (!this.#parts.signal.aborted) this.#parts.change({}, true);
  }

  /** The next picture during playback; with reduced motion, one pass per second. */
  #goOn(time: number): void {
    const [run, now] = [this.#run, this.#shown?.now];
    if (!run || !now) return;
    // It is not visible.
    if (this.#frame.picture.getClientRects().length === 0) {
      this.#stop();
      return;
    }
    const secs = Math.max(0, time - run.last) / 1000;
    const isReduced = matchMedia("(prefers-reduced-motion: reduce)").matches;
    if (!isReduced || secs >= 1) {
      run.last = time;
      run.at += isReduced ? now.frames : Math.min(0.1, secs) * Math.max(PLAY.least, PLAY.share * run.at);
      run.at = Math.min(now.total, run.at);
      const updates = Math.floor(run.at);
      if (updates !== this.#state!.updates) this.#parts.change({ updates }, false);
    }
    if (run.at >= now.total) this.#stop();
    else requestAnimationFrame((next) => this.#goOn(next));
  }

  async #step(state: MapState): Promise<void> {
    const { engine, signal } = this.#parts;
    const [samples, now] = await Promise.all([samplesOf(engine), engine.somn(state.updates, state.printed)]);
    if (signal.aborted) return;
    this.#shown = { samples, now };
    this.#parts.changed();
    this.#frame.request();
  }

  #drawNow(): void {
    if (!this.#shown) return;
    const { words } = this.#parts;
    const { samples, now } = this.#shown;
    const axes = this.#plane.draw(this.#frame, samples.values, words);
    const count = now.weights.length;
    const heaviest = now.weights.reduce((a, b) => Math.max(a, b), 0);
    const perUnit = { x: xOf(axes, 1) - xOf(axes, 0), y: yOf(axes, 0) - yOf(axes, 1) };
    keepCount(this.#components, count, () => svg("ellipse"));
    for (let i = 0; i < count; i++) {
      setAttributes(this.#components.children[i]!, {
        cx: xOf(axes, now.centres[2 * i]!).toFixed(1),
        cy: yOf(axes, now.centres[2 * i + 1]!).toFixed(1),
        rx: (perUnit.x * now.spreads[2 * i]!).toFixed(1),
        ry: (perUnit.y * now.spreads[2 * i + 1]!).toFixed(1),
        "fill-opacity": (0.28 * (now.weights[i]! / heaviest)).toFixed(3),
        class: now.r[i]! > 0.1 ? "taking" : "",
      });
    }
    const known = now.sample >= 0;
    const [sx, sy] = known ? [samples.values[2 * now.sample]!, samples.values[2 * now.sample + 1]!] : [0, 0];
    const visibility = known ? "visible" : "hidden";
    setAttributes(this.#sample, { cx: xOf(axes, sx), cy: yOf(axes, sy), visibility });
    // The neighbourhood is one of poses; the ring shows only its width relative to the initial width.
    setAttributes(this.#neighbourhood, { cx: xOf(axes, sx), cy: yOf(axes, sy), r: 60 * now.sigma, visibility });
    this.#bars.draw(axes, now.r);
    setAttributes(this.#moves, { d: known ? movesOf(now, [sx, sy], (x, y) => [xOf(axes, x), yOf(axes, y)]) : "" });
    const pass = String(Math.min(now.total / now.frames, passOf(now.updates, now.frames) + 1));
    setText(this.#readout, words.map.at(String(now.updates), pass, this.#error(now)));
  }
}

/** Movements of the centres in the last update: each by δ r of the distance to the sample. */
function movesOf(
  { centres, r, delta }: SomnSnapshot,
  sample: readonly number[],
  at: (x: number, y: number) => readonly [number, number],
): string {
  let path = "";
  r.forEach((share, i) => {
    const [x, y] = [0, 1].map((axis) => {
      const now = centres[2 * i + axis]!;
      return [(now - delta * share * sample[axis]!) / (1 - delta * share), now] as const;
    }) as [readonly [number, number], readonly [number, number]];
    const [from, to] = [at(x[0], y[0]), at(x[1], y[1])];
    if (Math.hypot(to[0] - from[0], to[1] - from[1]) < LEAST_MOVE) return;
    path += `M${from.map((pixel) => pixel.toFixed(1)).join(" ")}L${to.map((pixel) => pixel.toFixed(1)).join(" ")}`;
  });
  return path;
}

/** A large number as a power of ten. */
function powerOfTen(value: number): string {
  const digits = String(Math.floor(Math.log10(value)));
  return `10${Array.from(digits, (digit) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]).join("")}`;
}
