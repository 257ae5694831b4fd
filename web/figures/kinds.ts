/** The kinds of figures, each loaded with the first figure of it. */
import { type TextKind, textKind } from "./kind";

const KINDS = {
  stage: async () => textKind((await import("./stage/stage_figure")).STAGE),
  curve: async () => textKind((await import("./curve/curve_figure")).CURVE),
  scatter: async () => textKind((await import("./line/scatter_figure")).SCATTER),
  reading: async () => textKind((await import("./mix/reading_figure")).READING),
  bars: async () => textKind((await import("./mix/bars_figure")).BARS),
  terms: async () => textKind((await import("./line/terms_figure")).TERMS),
  sweep: async () => textKind((await import("./line/sweep_figure")).SWEEP),
  joint: async () => textKind((await import("./pose/joint_figure")).JOINT_KIND),
  numbers: async () => textKind((await import("./pose/numbers_figure")).NUMBERS),
  logs: async () => textKind((await import("./pose/logs_figure")).LOGS),
  query: async () => textKind((await import("./near/query_figure")).QUERY),
  profile: async () => textKind((await import("./near/profile_figure")).PROFILE),
  band: async () => textKind((await import("./bias/band_figure")).BAND),
  raised: async () => textKind((await import("./bias/raised_figure")).RAISED),
  clock: async () => textKind((await import("./pace/clock_figure")).CLOCK),
  polygon: async () => textKind((await import("./pace/blend_figure")).POLYGON),
  paced: async () => textKind((await import("./pace/paced_figure")).PACED),
  votes: async () => textKind((await import("./pace/votes_figure")).VOTES),
  feet: async () => textKind((await import("./feet/feet_figure")).FEET),
  soles: async () => textKind((await import("./feet/soles_figure")).SOLES),
  leg: async () => textKind((await import("./feet/leg_figure")).LEG),
  methods: async () => textKind((await import("./judge/methods_figure")).METHODS_KIND),
  duel: async () => textKind((await import("./judge/duel_figure")).DUEL),
  histogram: async () => textKind((await import("./judge/histogram_figure")).HISTOGRAM),
  warp: async () => textKind((await import("./warp/warp_figure")).WARP),
  walkers: async () => textKind((await import("./warp/walkers_figure")).WALKERS),
  chain: async () => textKind((await import("./chain/chain_figure")).CHAIN),
  path: async () => textKind((await import("./chain/path_figure")).PATH),
  gait: async () => textKind((await import("./chain/gait_figure")).GAIT),
  som: async () => textKind((await import("./map/som_figure")).SOM),
  update: async () => textKind((await import("./map/update_figure")).UPDATE),
  learning: async () => textKind((await import("./map/learning_figure")).LEARNING),
  pad: async () => textKind((await import("./map/pad_figure")).PAD),
  posed: async () => textKind((await import("./map/posed_figure")).POSED),
  keys: async () => textKind((await import("./map/keys_figure")).KEYS),
} as const satisfies Record<string, () => Promise<TextKind>>;

/** Name of a kind. */
export type KindName = keyof typeof KINDS;
export const KIND_NAMES = Object.keys(KINDS) as readonly KindName[];

/** Loads a kind; `undefined` if there is none of the name. */
export async function loadKind(name: string): Promise<TextKind | undefined> {
  return Object.hasOwn(KINDS, name) ? KINDS[name as KindName]() : undefined;
}
