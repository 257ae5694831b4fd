/** The engine's data for every frame, as files for other programs. Pure functions. */

/** A styled motion that corresponds to its input frame by frame. */
export interface Traced {
  analysis: {
    /** Output time of each frame, seconds. */
    timeOut: Float32Array;
    /** Foot contacts, frames × (left, right), 0 or 1. */
    planted: Uint8Array;
    /** Weight of each class in each frame, frames × classes. */
    classWeights: Float32Array;
  };
  input: { rateHz: number };
  classes: readonly { action: string; style: string }[];
}

/** Weights below this are left out. */
const MIN_WEIGHT = 1e-4;

const rounded = (value: number): number => Number(value.toFixed(5));

/** One frame, with the field names of `strut stylize --trace`. */
export interface TraceFrame {
  /** Index of the input frame, from 0. */
  frame: number;
  /** Its time in the input, seconds. */
  time_in: number;
  /** Its time in the output, seconds. */
  time_out: number;
  /** Seconds since the previous frame, in the output. */
  dt: number;
  /** Weight of each class, by `action/style`; small ones are left out. */
  class_weights: Record<string, number>;
  /** Whether the feet are held in place, 1 or 0. */
  planted: [left: number, right: number];
}

/** The trace of a styled motion. */
export function traceOf({ analysis, input, classes }: Traced): TraceFrame[] {
  const { timeOut, planted, classWeights } = analysis;
  return Array.from(timeOut, (time, frame) => {
    const weights = classes.map(({ action, style }, c): [string, number] => [
      `${action}/${style}`,
      rounded(classWeights[frame * classes.length + c] ?? 0),
    ]);
    return {
      frame,
      time_in: rounded(frame / input.rateHz),
      time_out: rounded(time),
      dt: rounded(frame > 0 ? time - timeOut[frame - 1]! : 0),
      class_weights: Object.fromEntries(weights.filter(([, weight]) => weight >= MIN_WEIGHT)),
      planted: [planted[2 * frame]!, planted[2 * frame + 1]!],
    };
  });
}

/** JSON lines, one object per frame. */
export function traceAsJson(traced: Traced): string {
  return traceOf(traced)
    .map((frame) => `${JSON.stringify(frame)}\n`)
    .join("");
}

/** Comma-separated values with a header; one column for each class that has any weight. */
export function traceAsCsv(traced: Traced): string {
  const frames = traceOf(traced);
  const names = [...new Set(frames.flatMap((frame) => Object.keys(frame.class_weights)))].sort();
  const header = ["frame", "time_in", "time_out", "dt", "planted_left", "planted_right", ...names.map(cell)];
  const rows = frames.map(({ frame, time_in, time_out, dt, planted, class_weights }) =>
    [frame, time_in, time_out, dt, ...planted, ...names.map((name) => class_weights[name] ?? 0)].join(","),
  );
  return `${[header.join(","), ...rows].join("\n")}\n`;
}

/** Text as one cell: quoted if necessary, and never a formula, which a spreadsheet would run. */
function cell(text: string): string {
  const plain = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(plain) ? `"${plain.replaceAll('"', '""')}"` : plain;
}
