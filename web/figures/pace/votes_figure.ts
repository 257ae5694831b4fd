/** Duration of each neighbour's frame over the neighbour's distance, and the kernel-weighted mean. */
import type { Timing } from "../../client/learn/protocol";
import { keepCount, setAttributes, setText, svg } from "../../ui/dom";
import { roundedExtent } from "../../ui/scale";
import type { Axes } from "../axes";
import { Choice } from "../controls";
import type { FigureKind, FigureParts } from "../kind";
import { PlotFigure } from "../plot_figure";
import sheet from "./pace.css?inline";
import { kernelAt, measurePace } from "./pace_measure";
import { BLENDED, type Blended, lookOf, PACE_FIELDS, type PaceState } from "./pace_state";

/** Radius of a neighbour with g 0 and with g 1, units. */
const RADIUS = { least: 1.5, most: 6 };
/** Number of segments of the kernel's curve. */
const PIECES = 48;
/** Rows of the table. */
const TABLE_ROWS = 12;
const MS = 1000;

export const VOTES: FigureKind<PaceState> = {
  fields: PACE_FIELDS,
  measure: measurePace,
  sheet,
  create: (parts) => new VotesFigure(parts),
};

interface Shown {
  style: Blended;
  timing: Timing;
}

class VotesFigure extends PlotFigure<PaceState, Shown> {
  readonly #kernel = svg("path", { class: "kernel", "data-term": "g" });
  readonly #width = svg("path", { class: "guide", "data-term": "h" });
  readonly #labels = {
    h: svg("text", { class: "label votes", "data-term": "h" }, "h"),
    g: svg("text", { class: "label votes", "data-term": "g" }, "g"),
  };
  readonly #dots = svg("g", { class: "dots", "data-term": "g" });
  readonly #mean = svg("path", { class: "fit", "data-term": "w" });
  /** The style whose neighbours are shown. */
  #chosen: Blended = BLENDED[0];

  constructor(parts: FigureParts<PaceState>) {
    const { pace, style: label, styles } = parts.words;
    super(parts, pace.votes);
    const options = BLENDED.map((style) => [style, styles[style]] as const);
    const choice = new Choice(label, options, (style) => {
      this.#chosen = style;
      if (this.state) void this.show(this.state);
    });
    choice.value = this.#chosen;
    const { h, g } = this.#labels;
    this.frame.picture.append(this.#kernel, this.#width, this.#dots, this.#mean, h, g);
    this.lay({ title: pace.votes, picture: this.frame.element, head: [choice.element] });
  }

  protected async load(state: PaceState): Promise<Shown> {
    const style = this.#chosen;
    const look = lookOf(state);
    // A style without weight has no output: its neighbours are requested with a nonzero weight.
    const styles = { ...look.styles, [style]: state[style] || 1 };
    return { style, timing: await this.parts.engine.timing({ ...look, styles }, style) };
  }

  protected describe({ style, timing }: Shown): string {
    const [ms, bandwidth] = this.#read(timing);
    return this.words.pace.voted(this.words.styles[style], String(timing.durations.length), ms, bandwidth);
  }

  protected get columns() {
    return this.words.pace.voices;
  }

  protected rows({ timing: { durations, distances, bandwidth } }: Shown): string[][] {
    return Array.from({ length: Math.min(TABLE_ROWS, durations.length) }, (_, i) => [
      this.number(distances[i]!, 2),
      this.number(MS * durations[i]!, 1),
      this.number(kernelAt(distances[i]!, bandwidth), 2),
    ]);
  }

  protected override quantities({ timing: { distances, bandwidth } }: Shown) {
    const sum = distances.reduce((total, d) => total + kernelAt(d, bandwidth), 0);
    return { g: `Σ ${this.number(sum, 1)}`, h: `${this.number(bandwidth, 1)} σ` };
  }

  #read({ duration, bandwidth }: Timing): [ms: string, bandwidth: string] {
    return [this.number(MS * (duration ?? Number.NaN), 1), this.number(bandwidth, 2)];
  }

  protected draw({ timing }: Shown): void {
    const { pace } = this.words;
    const durations = Array.from(timing.durations, (secs) => MS * secs);
    const farthest = timing.distances.reduce((a, b) => Math.max(a, b), timing.bandwidth);
    const across = { min: 0, max: roundedExtent([0, farthest], 1).max };
    const labels = { x: pace.distance, y: pace.duration, columns: 6, rows: 4 };
    const axes = this.plot(across, roundedExtent(durations, 2), labels);
    keepCount(this.#dots, durations.length, () => svg("circle", {}));
    durations.forEach((ms, i) => {
      setAttributes(this.#dots.children[i]!, {
        cx: axes.x(timing.distances[i]!).toFixed(1),
        cy: axes.y(ms).toFixed(1),
        r: (RADIUS.least + (RADIUS.most - RADIUS.least) * kernelAt(timing.distances[i]!, timing.bandwidth)).toFixed(1),
      });
    });
    this.#drawKernel(axes, timing);
    const mean = axes.y(MS * (timing.duration ?? Number.NaN));
    setAttributes(this.#mean, { d: Number.isFinite(mean) ? `M${axes.x(0)} ${mean}H${axes.right}` : "" });
    setText(this.readout, this.words.pace.mean(...this.#read(timing)));
  }

  /** g over d, from the lower to the upper edge of the picture. */
  #drawKernel(axes: Axes, { bandwidth }: Timing): void {
    const { min: bottom, max: top } = axes.up;
    const points = Array.from({ length: PIECES + 1 }, (_, i) => {
      const d = (axes.across.max * i) / PIECES;
      return axes.at(d, bottom + kernelAt(d, bandwidth) * (top - bottom));
    });
    setAttributes(this.#kernel, { d: `M${points.join("L")}` });
    const [x, foot] = [axes.x(bandwidth), axes.y(bottom)];
    setAttributes(this.#width, { d: `M${x} ${foot}V${axes.y(top)}` });
    setAttributes(this.#labels.h, { x: x + 5, y: foot - 6 });
    const near = axes.across.max / PIECES;
    const below = axes.y(bottom + kernelAt(near, bandwidth) * (top - bottom)) + 16;
    setAttributes(this.#labels.g, { x: axes.x(near), y: below });
  }
}
