/** Bimodal styles that a build found among the clips of the Data view: plain data. */
import type { TwoManners } from "../../../client/build/protocol";
import { strings } from "../../strings/strings";
import type { Row } from "./corpus";

const words = strings.data.manners;

/** The clips of each cluster of a style in an action. */
export interface Manners {
  action: string;
  style: string;
  rows: [Row[], Row[]];
}

/** The findings about clips that are still open and still labelled as one style of one action. */
export function mannersAmong(rows: readonly Row[], found: readonly TwoManners[]): Manners[] {
  const rowAt = new Map(rows.map((row) => [row.path, row]));
  const open = (paths: string[]) => paths.flatMap((path) => rowAt.get(path) ?? []);
  return found.flatMap(({ paths: [first, second] }): Manners[] => {
    const both: [Row[], Row[]] = [open(first), open(second)];
    const all = both.flat();
    const [{ action, style } = { action: "", style: "" }] = all;
    const whole = all.length === first.length + second.length;
    return whole && all.every((row) => row.action === action && row.style === style)
      ? [{ action, style, rows: both }]
      : [];
  });
}

/** Clips in words: “takes 1–4, 6”, or their files if the take numbers are ambiguous. */
export function clipsInWords(rows: readonly Row[]): string {
  const takes = rows.flatMap(({ take }) => take ?? []).sort((a, b) => a - b);
  if (new Set(takes).size < rows.length) return rows.map(({ path }) => fileName(path)).join(", ");
  const runs: [number, number][] = [];
  for (const take of takes) {
    const last = runs.at(-1);
    if (last && take === last[1] + 1) last[1] = take;
    else runs.push([take, take]);
  }
  return words.takes(runs.map(([from, to]) => (from === to ? `${from}` : `${from}–${to}`)).join(", "));
}

/** The name of a file without its folders. */
export const fileName = (path: string): string => path.slice(path.lastIndexOf("/") + 1);
