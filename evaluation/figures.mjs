// The figures of docs/evaluation.md, drawn with Vega-Lite.

import * as vega from "vega";
import { compile } from "vega-lite";

const METHODS = ["input", "truth", "nn", "knn", "lar", "mar", "gar", "lti", "lti-dof", "gp"];
// Okabe and Ito's palette, which is safe for colour-blind readers.
const COLOURS = [
  "#999999",
  "#000000",
  "#E69F00",
  "#56B4E9",
  "#009E73",
  "#D55E00",
  "#CC79A7",
  "#0072B2",
  "#8FB8DE",
  "#B8A600",
];
const colour = {
  field: "method",
  type: "nominal",
  scale: { domain: METHODS, range: COLOURS },
  legend: { title: null },
};
const config = { font: "Inter, system-ui, sans-serif", background: "white", axis: { grid: true, gridColor: "#eee" } };

/** Draws a Vega-Lite specification as SVG text. */
async function draw(spec) {
  const view = new vega.View(vega.parse(compile({ config, ...spec }).spec), { renderer: "none" });
  const svg = await view.toSVG();
  view.finalize();
  return `${svg}\n`;
}

/** Figure 6 of the paper: errors of every method by data set. Bars are one standard deviation over the folds. */
export function errorBars(sets) {
  const values = sets.flatMap(({ set, results }) =>
    METHODS.flatMap((method) => {
      const rows = results.filter((row) => row.method === method);
      const mean = (name) => rows.reduce((sum, row) => sum + row[name], 0) / rows.length;
      const bar = (measure, value, sd) => ({
        set,
        method,
        measure,
        value,
        low: Math.max(value - sd, 0),
        high: value + sd,
      });
      if (rows.length === 0) return [];
      return [
        bar("pose error, cm", mean("pose_error_cm"), mean("pose_error_cm_sd")),
        bar("timing error, ms", mean("timing_error_ms"), mean("timing_error_ms_sd")),
      ];
    }),
  );
  const x = { field: "method", type: "nominal", sort: METHODS, axis: { title: null, labelAngle: 0 } };
  return draw({
    data: { values },
    facet: {
      row: { field: "measure", type: "nominal", header: { title: null, labelOrient: "left" } },
      column: { field: "set", type: "nominal", header: { title: null }, sort: sets.map((s) => s.set) },
    },
    spec: {
      width: 220,
      height: 150,
      layer: [
        {
          mark: { type: "bar", width: 18 },
          encoding: { x, y: { field: "value", type: "quantitative", title: null }, color: { ...colour, legend: null } },
        },
        {
          mark: { type: "rule", strokeWidth: 1.5 },
          encoding: { x, y: { field: "low", type: "quantitative", title: null }, y2: { field: "high" } },
        },
      ],
    },
    resolve: { scale: { y: "independent" } },
  });
}

/** Displayed frames of a trial: the longest run of segments, a few cycles. */
const shown = (trial) => ({ first: trial.segments[0][0], end: trial.segments.slice(0, 3).at(-1)[1] });

/** Figure 3: a degree of freedom over time, for every method and the truth. */
export function jointCurve(trial) {
  const { first, end } = shown(trial);
  const values = trial.curves.flatMap(({ name, left_knee_degrees: knee }) =>
    knee.slice(first, end).map((degrees, i) => ({ method: name, frame: first + i, degrees })),
  );
  return draw({
    data: { values },
    width: 760,
    height: 260,
    mark: { type: "line", strokeWidth: 1.5, clip: true },
    encoding: {
      x: { field: "frame", type: "quantitative", title: "input frame", scale: { domain: [first, end], nice: false } },
      y: { field: "degrees", type: "quantitative", title: "left knee, degrees", scale: { domain: [-10, 120] } },
      color: colour,
    },
  });
}

/** Figure 4: time-warp curves, the output's time against the input's within each segment. */
export function timeWarp(trial) {
  const values = trial.curves.flatMap(({ name, time_secs: time }) =>
    trial.segments.slice(0, 3).flatMap(([first, end], segment) =>
      time.slice(first, end).map((secs, i) => ({
        method: name,
        segment,
        input: (first + i) / 60,
        ahead: 1000 * (secs - time[first] - i / 60),
      })),
    ),
  );
  return draw({
    data: { values },
    width: 760,
    height: 220,
    mark: { type: "line", strokeWidth: 1.5 },
    encoding: {
      x: { field: "input", type: "quantitative", title: "input time, s", scale: { zero: false } },
      y: { field: "ahead", type: "quantitative", title: "output later than input, ms" },
      color: colour,
      detail: { field: "segment" },
    },
  });
}
