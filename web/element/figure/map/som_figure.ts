/** Learning of a self-organising mixture network, update by update: components over the training frames. */
import type { SomnSnapshot, StyleSamples } from "../../../client/learn/protocol";
import { button, Toggle } from "../../../ui/controls/buttons";
import { html, setAttributes, setText, svg } from "../../../ui/dom";
import { xOf, yOf } from "../axes";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { PlotFrame } from "../plot_frame";
import { figure } from "../words/words";
import sheet from "./map.css?inline";
import { measureMap, passOf, samplesOf } from "./map_measure";
import { MAP_FIELDS, type MapState } from "./map_state";
import { createDots, dotsOf, planeOf } from "./plane";

/** Height of the bar of r 1, pixels, and width of all bars. */
const BAR = { height: 34, width: 7, gap: 3 };

export const SOM: FigureKind<MapState> = {
  fields: MAP_FIELDS,
  sheet,
  create: (parts) => new SomFigure(parts),
};

class SomFigure implements FigureInstance<MapState> {
  readonly #parts: FigureParts<MapState>;
  readonly #frame: PlotFrame;
  readonly #printed: Toggle;
  readonly #dots = createDots();
  readonly #components = svg("g", { class: "components", "data-term": "a" });
  readonly #neighbourhood = svg("circle", { class: "neighbourhood", "data-term": "sigma" });
  readonly #sample = svg("circle", { class: "query", r: 5, "data-term": "x" });
  readonly #bars = svg("g", { class: "bars", "data-term": "r" });
  readonly #readout = html("p", { class: "readout" });
  readonly #stepping = new Latest<MapState>((state) => this.#step(state));
  #state: MapState | undefined;
  #shown: { samples: StyleSamples; now: SomnSnapshot } | undefined;

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
    const steps = [
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
    this.#frame.picture.append(this.#dots, this.#components, this.#neighbourhood, this.#sample, this.#bars);
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
      sigma: `${figure(now.sigma, 2, words)} rad`,
      a: figure(
        now.weights.reduce((a, b) => Math.max(a, b), 0),
        2,
        words,
      ),
      ...(sample && { x: `${figure(sample[0]!, 0, words)}, ${figure(sample[1]!, 0, words)} cm` }),
    };
  }

  light(term: string | undefined): void {
    this.#frame.light(term);
  }

  /** The running error; once learning has diverged it is no number any more. */
  #error({ error }: SomnSnapshot): string {
    if (!Number.isFinite(error)) return "∞";
    return error < 100 ? figure(error, 3, this.#parts.words) : error.toExponential(0);
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
    const axes = planeOf(this.#frame, samples.values, words);
    setAttributes(this.#dots, { d: dotsOf(axes, samples.values) });
    const count = now.weights.length;
    const heaviest = now.weights.reduce((a, b) => Math.max(a, b), 0);
    const perUnit = { x: xOf(axes, 1) - xOf(axes, 0), y: yOf(axes, 0) - yOf(axes, 1) };
    this.#components.replaceChildren(
      ...Array.from({ length: count }, (_, i) => {
        const [x, y] = [xOf(axes, now.centres[2 * i]!), yOf(axes, now.centres[2 * i + 1]!)];
        return svg("ellipse", {
          cx: x.toFixed(1),
          cy: y.toFixed(1),
          rx: (perUnit.x * now.spreads[2 * i]!).toFixed(1),
          ry: (perUnit.y * now.spreads[2 * i + 1]!).toFixed(1),
          "fill-opacity": (0.28 * (now.weights[i]! / heaviest)).toFixed(3),
          class: now.r[i]! > 0.1 ? "taking" : "",
        });
      }),
    );
    const known = now.sample >= 0;
    const [sx, sy] = known ? [samples.values[2 * now.sample]!, samples.values[2 * now.sample + 1]!] : [0, 0];
    const visibility = known ? "visible" : "hidden";
    setAttributes(this.#sample, { cx: xOf(axes, sx), cy: yOf(axes, sy), visibility });
    // The neighbourhood is one of poses; the ring says only how wide it is against its first width.
    setAttributes(this.#neighbourhood, { cx: xOf(axes, sx), cy: yOf(axes, sy), r: 60 * now.sigma, visibility });
    const left = xOf(axes, axes.x[1]) - count * (BAR.width + BAR.gap);
    const bottom = yOf(axes, axes.y[1]) + BAR.height + 6;
    this.#bars.replaceChildren(
      ...Array.from({ length: count }, (_, i) => {
        const height = Math.max(1, BAR.height * now.r[i]!);
        return svg("rect", { x: left + i * (BAR.width + BAR.gap), y: bottom - height, width: BAR.width, height });
      }),
    );
    const pass = String(Math.min(now.total / now.frames, passOf(now.updates, now.frames) + 1));
    setText(this.#readout, words.map.at(String(now.updates), pass, this.#error(now)));
  }
}
