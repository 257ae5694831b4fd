/** What the engine did in every frame, as files for other programs. Pure. */
import type { Analysis, DatabaseInfo, InputInfo } from "../../worker/protocol";

/** What a trace is made of. */
export interface Traced {
  analysis: Analysis;
  input: Pick<InputInfo, "rateHz">;
  classes: DatabaseInfo["classes"];
}

/** Weights below this are left out. */
const LEAST_WEIGHT = 1e-4;

const rounded = (value: number): number => Number(value.toFixed(5));

/** One frame, as `strut stylize --trace` names its fields. */
interface TraceFrame {
  frame: number;
  time_in: number;
  time_out: number;
  dt: number;
  class_weights: Record<string, number>;
  planted: [left: number, right: number];
}

function framesOf({ analysis, input, classes }: Traced): TraceFrame[] {
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
      class_weights: Object.fromEntries(weights.filter(([, weight]) => weight >= LEAST_WEIGHT)),
      planted: [planted[2 * frame]!, planted[2 * frame + 1]!],
    };
  });
}

/** JSON lines, one object a frame. */
export function traceAsJson(traced: Traced): string {
  return framesOf(traced)
    .map((frame) => `${JSON.stringify(frame)}\n`)
    .join("");
}

/** Comma-separated values with a header; one column a class that has any weight. */
export function traceAsCsv(traced: Traced): string {
  const frames = framesOf(traced);
  const names = [...new Set(frames.flatMap((frame) => Object.keys(frame.class_weights)))].sort();
  const quoted = (text: string) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);
  const header = ["frame", "time_in", "time_out", "dt", "planted_left", "planted_right", ...names.map(quoted)];
  const rows = frames.map(({ frame, time_in, time_out, dt, planted, class_weights }) =>
    [frame, time_in, time_out, dt, ...planted, ...names.map((name) => class_weights[name] ?? 0)].join(","),
  );
  return `${[header.join(","), ...rows].join("\n")}\n`;
}
