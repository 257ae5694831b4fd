/** Plots of the model of a step: the distributions of the ends of its states, and the angle of a joint with its deviation. */

import type { Side, WalkModel, Weights } from "../../../client/models/walk";
import { JOINT, type Role } from "../../../humanoid";
import { formatNumber, html, setText, svg } from "../../../ui/dom";
import { setSize, sizeOf } from "../../../ui/drawing";
import { pixelOf, type Scale } from "../../../ui/scale";
import { strings } from "../../strings/strings";

/** Height, width while the plot is not displayed, and margins, units. */
const HEIGHT = 104;
const USUAL_WIDTH = 304;
const PAD = { left: 4, right: 4, top: 8, bottom: 20 };
/** Number of points of a drawn density. */
const POINTS = 120;
const DEGREES = 180 / Math.PI;

/** The plotted quantity: the ends of states, or a joint by its role. */
export type PlotSubject = "states" | keyof typeof strings.walk.joints;
export const PLOT_SUBJECTS: readonly PlotSubject[] = [
  "states",
  ...(Object.keys(strings.walk.joints) as (keyof typeof strings.walk.joints)[]),
];

interface PlotModel {
  model: WalkModel;
  subject: PlotSubject;
  weights: Weights;
  side: Side;
}

/** The weights of the average of all styles. */
function averageOf({ styles }: WalkModel): Weights {
  const none = new Float32Array(styles.length);
  return [none, none];
}

export class Plot {
  readonly element: HTMLElement;
  readonly #picture = svg("svg", { class: "walk-plot", role: "img" });
  readonly #legend = html("p", { class: "walk-legend caption", "aria-hidden": "true" });

  constructor() {
    this.element = html("div", { class: "walk-plot-box" }, this.#picture, this.#legend);
  }

  show(what: PlotModel): void {
    const width = sizeOf(this.element).width || USUAL_WIDTH;
    setSize(this.#picture, { width, height: HEIGHT });
    const area: Area = { left: PAD.left, right: width - PAD.right, top: PAD.top, bottom: HEIGHT - PAD.bottom };
    const { subject } = what;
    if (subject === "states") this.#showStates(what, area);
    else this.#showCurve(what, subject, area);
  }

  #showStates({ model, weights, side }: PlotModel, area: Area): void {
    const own = endsOf(model, weights, side);
    const average = endsOf(model, averageOf(model), side);
    const last = Math.max(...[...own, ...average].map(({ mean, deviation }) => mean + 2 * deviation));
    const time: Scale = { min: 0, max: last, from: area.left, to: area.right };
    const x = (secs: number) => pixelOf(time, secs);
    // Heights are the square roots of the densities', so that the wide last states stay visible.
    const tallest = Math.max(...[...own, ...average].map(({ deviation }) => deviation ** -0.5));
    const bell = ({ mean, deviation }: End) => {
      const height = (deviation ** -0.5 / tallest) * (area.bottom - area.top);
      return Array.from({ length: POINTS + 1 }, (_, i) => {
        const secs = Math.min(last, Math.max(0, mean + ((i / POINTS) * 6 - 3) * deviation));
        const y = area.bottom - height * Math.exp(-0.5 * ((secs - mean) / deviation) ** 2);
        return `${x(secs).toFixed(1)} ${y.toFixed(1)}`;
      }).join("L");
    };
    this.#picture.replaceChildren(
      ...secondsAxis(time, area),
      ...average.map((end) => svg("path", { class: "walk-average", d: `M${bell(end)}` })),
      ...own.map((end) =>
        svg("path", { class: "walk-under", d: `M${x(0)} ${area.bottom}L${bell(end)}L${x(last)} ${area.bottom}Z` }),
      ),
      ...own.map((end) => svg("path", { class: "walk-own", d: `M${bell(end)}` })),
    );
    const ends = own.map(({ mean }, i) => `${strings.walk.states[i]} ${formatNumber(mean, 2)} s`).join(", ");
    this.#picture.setAttribute("aria-label", `${strings.walk.stateEnds}: ${ends}`);
    this.#showLegend([
      ["own", strings.walk.thisBlock],
      ["average", strings.walk.average],
    ]);
  }

  #showCurve({ model, weights }: PlotModel, subject: Exclude<PlotSubject, "states">, area: Area): void {
    const curve = model.curve(weights, JOINT[subject as Role]);
    const average = model.curve(averageOf(model), JOINT[subject as Role]);
    const frames = Math.max(curve.angle.length, average.angle.length);
    const time: Scale = { min: 0, max: frames / model.rateHz, from: area.left, to: area.right };
    const x = (frame: number) => pixelOf(time, frame / model.rateHz);
    const [low, high] = [
      curve.mean.map((m, i) => m - curve.deviation[i]!),
      curve.mean.map((m, i) => m + curve.deviation[i]!),
    ];
    const all = [...low, ...high, ...curve.angle, ...average.angle];
    const [min, max] = [Math.min(...all), Math.max(...all)];
    const angles: Scale = { min, max, from: area.bottom, to: area.top };
    const y = (angle: number) => pixelOf(angles, angle);
    const line = (values: Float32Array) =>
      Array.from(values, (value, i) => `${x(i).toFixed(1)} ${y(value).toFixed(1)}`).join("L");
    // Mean and deviation are constant within a state.
    const stairs = (values: Float32Array) =>
      Array.from(
        values,
        (value, i) => `${x(i).toFixed(1)} ${y(value).toFixed(1)}L${x(i + 1).toFixed(1)} ${y(value).toFixed(1)}`,
      );
    const band = [
      ...stairs(high),
      ...stairs(low)
        .map((pair) => pair.split("L").reverse().join("L"))
        .reverse(),
    ].join("L");
    const change = curve.side.findIndex((side, i) => i > 0 && side !== curve.side[i - 1]);
    this.#picture.replaceChildren(
      ...secondsAxis(time, area),
      svg("line", { class: "walk-grid", x1: x(change), x2: x(change), y1: area.top, y2: area.bottom }),
      svg("path", { class: "walk-band", d: `M${band}Z` }),
      svg("path", { class: "walk-average", d: `M${line(average.angle)}` }),
      svg("path", { class: "walk-own", d: `M${line(curve.angle)}` }),
      tick(area.left, area.top + 4, `${formatNumber(max * DEGREES, 0)}°`, "start"),
      tick(area.left, area.bottom - 4, `${formatNumber(min * DEGREES, 0)}°`, "start"),
      tick(x(change) - 6, area.top + 4, strings.walk.leftFoot, "end"),
      tick(x(change) + 6, area.top + 4, strings.walk.rightFoot, "start"),
    );
    const joint = strings.walk.joints[subject];
    const range = `${formatNumber(min * DEGREES, 0)}° – ${formatNumber(max * DEGREES, 0)}°`;
    this.#picture.setAttribute("aria-label", `${strings.walk.curveOf(joint)}: ${range}`);
    this.#showLegend([
      ["own", strings.walk.thisBlock],
      ["average", strings.walk.average],
      ["band", strings.walk.band],
    ]);
  }

  #showLegend(entries: readonly (readonly [kind: string, words: string])[]): void {
    const words = entries.map(([, said]) => said).join();
    if (this.#legend.dataset.words === words) return;
    this.#legend.dataset.words = words;
    this.#legend.replaceChildren(
      ...entries.map(([kind, said]) => {
        const entry = html("span", { class: `walk-key ${kind}` });
        setText(entry, said);
        return entry;
      }),
    );
  }
}

interface Area {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

interface End {
  mean: number;
  deviation: number;
}

/** The end of each state of a step, seconds from its beginning; the durations of states are independent. */
function endsOf(model: WalkModel, weights: Weights, side: Side): End[] {
  const { means, deviations } = model.durations(weights, side);
  let [mean, variance] = [0, 0];
  return means.map((secs, state) => {
    mean += secs;
    variance += deviations[state]! ** 2;
    return { mean, deviation: Math.sqrt(variance) };
  });
}

function secondsAxis(time: Scale, area: Area): SVGElement[] {
  const every = time.max > 1.2 ? 0.4 : 0.2;
  const marks: SVGElement[] = [
    svg("line", { class: "walk-grid", x1: area.left, x2: area.right, y1: area.bottom, y2: area.bottom }),
  ];
  for (let secs = 0; secs < time.max - 0.3 * every; secs += every) {
    const said = secs === 0 ? strings.synthesis.zero : formatNumber(secs, 1);
    marks.push(tick(pixelOf(time, secs), area.bottom + 15, said, secs === 0 ? "start" : "middle"));
  }
  return marks;
}

function tick(x: number, y: number, words: string, anchor: string): SVGTextElement {
  return svg("text", { x, y, "text-anchor": anchor }, words);
}
