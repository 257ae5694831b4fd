/** The kinds of figures, each loaded with the first figure of it. */
import { type TextKind, textKind } from "./kind";

const KINDS = {
  stage: async () => textKind((await import("./stage/stage_figure")).STAGE),
  curve: async () => textKind((await import("./curve/curve_figure")).CURVE),
  scatter: async () => textKind((await import("./line/scatter_figure")).SCATTER),
  reading: async () => textKind((await import("./mix/reading_figure")).READING),
  bars: async () => textKind((await import("./mix/bars_figure")).BARS),
  sweep: async () => textKind((await import("./line/sweep_figure")).SWEEP),
} as const satisfies Record<string, () => Promise<TextKind>>;

/** Name of a kind. */
export type KindName = keyof typeof KINDS;

/** Loads a kind; `undefined` where there is none of the name. */
export async function loadKind(name: string): Promise<TextKind | undefined> {
  return Object.hasOwn(KINDS, name) ? KINDS[name as KindName]() : undefined;
}
