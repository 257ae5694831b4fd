/** Learning of a self-organising mixture network, update by update: components over the training frames. */
import type { SomnSnapshot, StyleSamples } from "../../client/learn/protocol";
import { DEGREES } from "../../humanoid";
import { button } from "../../ui/controls/buttons";
import { keepCount, setAttributes, setText, svg } from "../../ui/dom";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
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
  measure: measureMap,
  sheet,
  create: (parts) => new SomFigure(parts),
};

interface Shown {
  samples: StyleSamples;
  now: SomnSnapshot;
}

class SomFigure extends PlotFigure<MapState, Shown> {
  readonly #plane = new SamplePlane();
  readonly #components = svg("g", { class: "components", "data-term": "a" });
  readonly #neighbourhood = svg("circle", { class: "neighbourhood", "data-term": "sigma" });
  readonly #sample = svg("circle", { class: "query", r: 5, "data-term": "x" });
  readonly #bars = new ShareBars("r");
  readonly #moves = svg("path", { class: "moves", "data-term": "delta" });
  readonly #play: HTMLButtonElement;
  /** The number of updates reached by playback, and the time of its last picture; `undefined` while paused. */
  #run: { at: number; last: number } | undefined;

  constructor(parts: FigureParts<MapState>) {
    const { map, play } = parts.words;
    super(parts, map.som);
    this.#play = button(play, () => (this.#run ? this.#stop() : this.#start()), { label: true });
    // The button's name changes.
    this.#play.removeAttribute("title");
    parts.signal.addEventListener("abort", () => this.#stop(), { once: true });
    const { picture, element } = this.frame;
    picture.append(this.#plane.dots, this.#components, this.#moves, this.#neighbourhood);
    picture.append(this.#sample, this.#bars.element);
    const step = (name: keyof typeof map.steps, by: (now: SomnSnapshot, updates: number) => number) => {
      const go = () => {
        const [state, shown] = [this.state, this.shown];
        if (!state || !shown) return;
        const updates = state.updates + by(shown.now, state.updates);
        this.change({ updates: Math.min(shown.now.total, updates) });
      };
      return button(map.steps[name], go, { label: true });
    };
    this.lay({
      title: map.som,
      picture: element,
      controls: [
        this.#play,
        step("one", () => 1),
        step("ten", () => 10),
        // To the end of this pass, or of the next one.
        step("pass", ({ frames }, updates) => frames - (updates % frames)),
        step("all", ({ total }) => total),
        button(map.steps.restart, () => this.change({ updates: 0 }), { label: true }),
        this.toggle("printed", map.printed, { updates: 0 }),
      ],
      controlsClass: "knobs steps",
    });
  }

  override show(state: MapState): Promise<void> {
    // The learner has moved elsewhere meanwhile.
    if (this.#run && state.updates !== Math.floor(this.#run.at)) this.#run.at = state.updates;
    return super.show(state);
  }

  protected async load({ updates, printed }: MapState): Promise<Shown> {
    const { engine } = this.parts;
    const [samples, now] = await Promise.all([samplesOf(engine), engine.somn(updates, printed)]);
    return { samples, now };
  }

  protected describe({ now }: Shown): string {
    return this.words.map.stepped(String(now.updates), String(now.weights.length), this.#error(now));
  }

  protected get columns() {
    return this.words.map.components;
  }

  protected rows({ now: { weights, r, centres } }: Shown): string[][] {
    return Array.from(weights, (share, i) => [
      String(i + 1),
      this.number(share, 2),
      this.number(r[i]!, 2),
      `${this.number(centres[2 * i]!, 1)}, ${this.number(centres[2 * i + 1]!, 1)}`,
    ]);
  }

  protected override quantities({ now, samples }: Shown) {
    const most = (values: Float32Array) => values.reduce((a, b) => Math.max(a, b), 0);
    const [x, y] = samples.values.subarray(2 * now.sample, 2 * now.sample + 2);
    return {
      r: this.number(most(now.r), 2),
      delta: this.number(now.delta, 2),
      sigma: `${this.number(now.sigma * DEGREES, 1)}°`,
      a: this.number(most(now.weights), 2),
      x: now.sample < 0 ? "–" : `${this.number(x!, 0)}, ${this.number(y!, 0)} cm`,
    };
  }

  /** The running error as text; once learning has diverged it is not a number. */
  #error({ error }: SomnSnapshot): string {
    if (!Number.isFinite(error)) return "∞";
    const degrees = error * DEGREES;
    return degrees < HUGE ? this.number(degrees, 1) : powerOfTen(degrees);
  }

  #start(): void {
    const [state, now] = [this.state, this.shown?.now];
    if (!state || !now) return;
    // At the end playback restarts.
    this.#run = { at: state.updates >= now.total ? 0 : state.updates, last: performance.now() };
    setText(this.#play.querySelector("span")!, this.words.pause);
    requestAnimationFrame((time) => this.#goOn(time));
  }

  #stop(): void {
    if (!this.#run) return;
    this.#run = undefined;
    setText(this.#play.querySelector("span")!, this.words.play);
    if (!this.parts.signal.aborted) this.change({}, true);
  }

  /** The next picture during playback; with reduced motion, one pass per second. */
  #goOn(time: number): void {
    const [run, now] = [this.#run, this.shown?.now];
    if (!run || !now) return;
    // It is not visible.
    if (this.frame.picture.getClientRects().length === 0) {
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
      if (updates !== this.state!.updates) this.change({ updates }, false);
    }
    if (run.at >= now.total) this.#stop();
    else requestAnimationFrame((next) => this.#goOn(next));
  }

  protected draw({ samples, now }: Shown): void {
    const axes = this.#plane.draw(this.frame, samples.values, this.words);
    const count = now.weights.length;
    const heaviest = now.weights.reduce((a, b) => Math.max(a, b), 0);
    const perUnit = { x: axes.x(1) - axes.x(0), y: axes.y(0) - axes.y(1) };
    keepCount(this.#components, count, () => svg("ellipse"));
    for (let i = 0; i < count; i++) {
      setAttributes(this.#components.children[i]!, {
        cx: axes.x(now.centres[2 * i]!).toFixed(1),
        cy: axes.y(now.centres[2 * i + 1]!).toFixed(1),
        rx: (perUnit.x * now.spreads[2 * i]!).toFixed(1),
        ry: (perUnit.y * now.spreads[2 * i + 1]!).toFixed(1),
        "fill-opacity": (0.28 * (now.weights[i]! / heaviest)).toFixed(3),
        class: now.r[i]! > 0.1 ? "taking" : "",
      });
    }
    const known = now.sample >= 0;
    const [sx, sy] = known ? [samples.values[2 * now.sample]!, samples.values[2 * now.sample + 1]!] : [0, 0];
    const visibility = known ? "visible" : "hidden";
    setAttributes(this.#sample, { cx: axes.x(sx), cy: axes.y(sy), visibility });
    // The neighbourhood is one of poses; the ring shows only its width relative to the initial width.
    setAttributes(this.#neighbourhood, { cx: axes.x(sx), cy: axes.y(sy), r: 60 * now.sigma, visibility });
    this.#bars.draw(axes, now.r);
    setAttributes(this.#moves, { d: known ? movesOf(now, [sx, sy], (x, y) => [axes.x(x), axes.y(y)]) : "" });
    const pass = String(Math.min(now.total / now.frames, passOf(now.updates, now.frames) + 1));
    setText(this.readout, this.words.map.at(String(now.updates), pass, this.#error(now)));
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
