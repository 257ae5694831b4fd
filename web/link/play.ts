/** State of the Play view: styles, model and picture. */
import { BODY_PARTS, type BodyPart, type FileReading, METHODS, type Method } from "../client/protocol";
import type { Range } from "../ui/controls/range";
import type { Selection } from "../ui/polygon/selection";
import {
  choice,
  decodeEntries,
  encodeEntries,
  type Fields,
  flag,
  listed,
  number,
  optional,
  selection,
  text,
} from "./fields";
import { decodeReading, encodeReading } from "./reading";

/** Styles of the parts of the body that have their own. */
export type Parts = Readonly<Partial<Record<BodyPart, Selection>>>;

/** A key of the style track: the styles at an input frame. */
export interface TrackKey {
  frame: number;
  styles: Selection;
}

export interface PlayState {
  /** Selected styles and weights; empty until a database is open. */
  styles: Selection;
  /** Whether the whole polygon is mixed instead of a triangle of it. */
  wholePolygon: boolean;
  parts: Parts;
  /** The part of the body whose styles the polygon shows; empty for the whole body. */
  part: BodyPart | "";
  /** Styles over time, ordered by frame; if there are keys, {@link styles} are those of the selected one. */
  track: readonly TrackKey[];
  /** Index of the selected key. */
  key: number;
  /** Factor of the styles' weights: 0 is neutral, above 1 exaggerates, below 0 is the opposite. */
  intensity: number;
  /** K: neighbours of the pose in each class. */
  k: number;
  /** λ: weight of the ridge regression, in units of K. */
  lambda: number;
  /** ρ: share of the residual (what the data does not explain) that is added back. */
  rho: number;
  /** κ: standard deviations from the data that still count as explained. */
  kappa: number;
  /** δ: width of the mixture weights. */
  delta: number;
  /** η: how much of the tempo is the style's. */
  tempo: number;
  /** Whether the style changes the timing. */
  timing: boolean;
  /** Whether planted feet are held in place. */
  footplant: boolean;
  /** Whether the output is smoothed where the database does not cover the input. */
  coherence: boolean;
  method: Method;
  /** The user's reading of the input's file; empty for a built-in input. */
  reading: FileReading;
  /** The action and the style that the user set for the input; empty if the engine is to recognise them. */
  action: string;
  inputStyle: string;
  /** Which of the settings A and B is displayed, and the other one, encoded as in the URL; empty while there is only one. */
  side: Side;
  other: string;
  camera: CameraPreset;
  follow: boolean;
  ghost: GhostMode;
  /** Motion trail: none, lines, or onion skin. */
  trace: TraceMode;
  /** Name of the curve in the timeline: a joint or degree of freedom. */
  curve: string;
  /** The part of the body that the atlas compares; empty while it is closed. */
  atlas: AtlasPart | "";
  /** The windows of the database that the atlas shows; `undefined` for all. */
  atlasWindows: AtlasWindows | undefined;
  /** Whether panels and transport are shown. */
  panels: boolean;
  /** The current panel on a narrow screen. */
  tab: Tab;
}

export const ATLAS_PARTS = ["whole", "legs", "arms", "torso", "head"] as const;
export type AtlasPart = (typeof ATLAS_PARTS)[number];
/** Indices of windows: the first, and the one after the last. */
interface AtlasWindows {
  first: number;
  last: number;
}
export const CAMERA_PRESETS = ["orbit", "front", "side", "top"] as const;
export type CameraPreset = (typeof CAMERA_PRESETS)[number];
export const GHOST_MODES = ["beside", "overlay", "off"] as const;
export type GhostMode = (typeof GHOST_MODES)[number];
export const TRACE_MODES = ["off", "lines", "onion"] as const;
type TraceMode = (typeof TRACE_MODES)[number];
export const SIDES = ["a", "b"] as const;
export type Side = (typeof SIDES)[number];
export const TABS = ["style", "input", "model", "curves"] as const;
export type Tab = (typeof TABS)[number];

/** Maximum number of keys of a style track. */
export const MAX_TRACK_KEYS = 1000;

/** Ranges of the knobs and the slider; the model's defaults are the specification's (§1, §7, §8). */
export const PLAY_RANGES = {
  intensity: { min: -1, max: 2, digits: 2 },
  k: { min: 5, max: 160, digits: 0 },
  lambda: { min: 0.01, max: 1, digits: 2 },
  rho: { min: 0, max: 1, digits: 2 },
  kappa: { min: 0.5, max: 6, digits: 1 },
  delta: { min: 0.1, max: 3, digits: 2 },
  tempo: { min: 0, max: 1, digits: 2 },
} as const satisfies Record<string, Range>;

function encodeParts(parts: Parts): string {
  return encodeEntries(Object.entries(parts));
}

function decodeParts(text: string): Parts | undefined {
  const entries = decodeEntries(text, BODY_PARTS.length);
  const known = entries?.every(([name]) => BODY_PARTS.some((part) => part === name));
  return known ? Object.fromEntries(entries!) : undefined;
}

function encodeTrack(track: readonly TrackKey[]): string {
  return encodeEntries(track.map(({ frame, styles }) => [String(frame), styles]));
}

function decodeTrack(text: string): TrackKey[] | undefined {
  const keys = decodeEntries(text, MAX_TRACK_KEYS)?.map(([name, styles]) => ({
    frame: name === "" ? Number.NaN : Number(name),
    styles,
  }));
  const inOrder = keys?.every(
    ({ frame }, i) => Number.isInteger(frame) && frame >= 0 && (i === 0 || frame > keys[i - 1]!.frame),
  );
  return inOrder ? keys : undefined;
}

/** Decodes `first_last` to windows; `undefined` if they are invalid. */
function decodeWindows(text: string): AtlasWindows | undefined {
  const [first, last] = /^(\d{1,9})_(\d{1,9})$/.exec(text)?.slice(1).map(Number) ?? [];
  return first !== undefined && last !== undefined && first < last ? { first, last } : undefined;
}

export const PLAY_FIELDS: Fields<PlayState> = {
  styles: selection("styles"),
  parts: listed("parts", {}, encodeParts, decodeParts),
  part: choice("part", "", ["", ...BODY_PARTS]),
  track: listed("track", [], encodeTrack, decodeTrack),
  key: number("key", 0, { min: 0, max: MAX_TRACK_KEYS - 1, digits: 0 }, false),
  wholePolygon: flag("all", false, true),
  intensity: number("intensity", 1, PLAY_RANGES.intensity, true),
  k: number("k", 40, PLAY_RANGES.k, true),
  lambda: number("lambda", 0.1, PLAY_RANGES.lambda, true),
  rho: number("rho", 0.7, PLAY_RANGES.rho, true),
  kappa: number("kappa", 3, PLAY_RANGES.kappa, true),
  delta: number("delta", 0.35, PLAY_RANGES.delta, true),
  tempo: number("tempo", 0.5, PLAY_RANGES.tempo, true),
  timing: flag("timing", true, true),
  footplant: flag("footplant", true, true),
  coherence: flag("coherence", true, true),
  method: choice("method", "mar", METHODS, true),
  reading: listed("read", {}, encodeReading, decodeReading),
  action: text("action", "", true),
  inputStyle: text("from", "", true),
  side: choice("side", "a", SIDES, true),
  other: text("other", "", true),
  camera: choice("camera", "orbit", CAMERA_PRESETS),
  follow: flag("follow", true, false),
  ghost: choice("ghost", "beside", GHOST_MODES),
  trace: choice("trail", "off", TRACE_MODES),
  curve: text("curve", "knee L", false),
  atlas: choice("atlas", "", ["", ...ATLAS_PARTS]),
  atlasWindows: optional("windows", ({ first, last }) => `${first}_${last}`, decodeWindows),
  panels: flag("panels", true, false),
  tab: choice("tab", "style", TABS),
};

/** Names of the fields on which the engine's output depends. */
export const ENGINE_FIELDS = [
  "styles",
  "parts",
  "track",
  "intensity",
  "k",
  "lambda",
  "rho",
  "kappa",
  "delta",
  "tempo",
  "coherence",
  "timing",
  "footplant",
  "method",
  "action",
  "inputStyle",
] as const satisfies readonly (keyof PlayState)[];
