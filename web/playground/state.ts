/**
 * The playground's state: one table of fields, each with its key in the URL, its default and its two translations.
 * Everything that changes the picture is here and nowhere else; the URL's hash is this table written out.
 */
import type { TraceMode } from "../viewer";
import { BODY_PARTS, type BodyPart, type FrameRange, METHODS, type Method } from "../worker/protocol";
import {
  choice,
  decodeSelection,
  encodeSelection,
  type Field,
  flag,
  listed,
  number,
  optional,
  type Range,
  selection,
  text,
} from "./fields";
import { type Axis, decodeAxes, encodeAxes } from "./key_style/axes";
import { decodeTimed, encodeTimed, LENGTH_RANGE, MOST_KEYS, type TimedValue } from "./key_style/keys";
import { MOST_POINTS } from "./key_style/trail";
import type { Selection } from "./polygon/selection";
import { INTENSITY_RANGE, MOST_BLOCKS, STEP_RANGE, TRANSITION_RANGE, type WalkBlock } from "./walk/plan";

/** Styles of the parts of the body that have their own. */
export type Parts = Readonly<Partial<Record<BodyPart, Selection>>>;
/** A key of the style track: the styles at an input frame. */
export interface TrackKey {
  frame: number;
  styles: Selection;
}

/** Everything that a link brings back. */
export interface PlayState {
  /** The view that is shown. */
  view: ViewName;
  /** Name of the database on this device that is open; empty for the built-in one. */
  database: string;
  /** Selected styles and weights; empty until a database says which styles there are. */
  styles: Selection;
  /** Whether the whole polygon is mixed instead of a triangle of it. */
  wholePolygon: boolean;
  parts: Parts;
  /** The part of the body whose styles the polygon shows; empty for the whole body. */
  part: BodyPart | "";
  /** Styles over time, in the order of frames; while there are keys {@link styles} are those of the chosen one. */
  track: readonly TrackKey[];
  /** Number of the chosen key. */
  key: number;
  /** What the styles' weights are multiplied by: 0 is neutral, above 1 exaggerates, below 0 is the opposite. */
  intensity: number;
  /** Name of the input; empty for the first built-in one. */
  input: string;
  k: number;
  lambda: number;
  rho: number;
  kappa: number;
  delta: number;
  timing: boolean;
  footplant: boolean;
  coherence: boolean;
  method: Method;
  /** The action and the style that the input is said to be; empty where the engine reads them from it. */
  action: string;
  inputStyle: string;
  /** Which of two settings is shown, and the other one as the URL has it; empty while there is only one. */
  side: Side;
  other: string;
  camera: CameraPreset;
  follow: boolean;
  ghost: GhostMode;
  /** What is drawn of the moments before and after. */
  trace: TraceMode;
  theme: Theme;
  loop: boolean;
  /** The part of the input that is played. */
  range: FrameRange | undefined;
  speed: number;
  playing: boolean;
  /** Input frame at which a paused motion stands, or a place between two. */
  frame: number;
  /** Joint whose curve the timeline shows. */
  curve: string;
  /** Columns of the Compare view, and which of them is drawn behind the others. */
  columns: readonly string[];
  behind: string;
  /** Blocks of the Walk view; empty until a model says which styles there are. */
  walk: readonly WalkBlock[];
  /** Number of the chosen block, and whether its whole polygon is mixed. */
  walkBlock: number;
  walkWhole: boolean;
  /** How long steps last: as in the model, drawn about that, or all the same, and then how many a minute. */
  walkTempo: WalkTempo;
  walkCadence: number;
  /** Length of steps, % of the style's. */
  walkStride: number;
  /** Degrees to the left that a step turns. */
  walkTurn: number;
  /** Whether the walk is shown as a strip of its steps. */
  walkStrip: boolean;
  /** What is plotted of the chosen block. */
  walkPlot: string;
  /** What the Key-style view learns from, see `key_style/sets.ts`, and the names of its clips where they were chosen. */
  keySet: string;
  keyClips: readonly string[];
  /** Its style variables; none for those that fit the motions. */
  keyAxes: readonly Axis[];
  /** Components of the mixture, 0 to have them counted, and how it is learned. */
  keyComponents: number;
  keyLearning: KeyLearning;
  /** Whether the winning component alone is the pose. */
  keyHard: boolean;
  /** Where the handle is; nowhere before a model says what is usual. */
  keyHandle: readonly number[];
  /** The last drag. */
  keyTrail: readonly TimedValue[];
  /** Keys over time, the chosen one's number, the length of the animation and the playhead, seconds. */
  keys: readonly TimedValue[];
  keyChosen: number;
  keyLength: number;
  keyTime: number;
  keyCurve: KeyCurve;
  keyMethod: KeyMethod;
  /** Whether the nearest recorded pose is drawn, and what is below the pad. */
  keyGhost: boolean;
  keyPane: KeyPane;
  /** Whether panels and transport are shown. */
  panels: boolean;
  /** The panel that is open on a narrow screen. */
  tab: Tab;
}

export const VIEW_NAMES = ["play", "compare", "walk", "key-style", "data"] as const;
export type ViewName = (typeof VIEW_NAMES)[number];
export const CAMERA_PRESETS = ["orbit", "front", "side", "top"] as const;
export type CameraPreset = (typeof CAMERA_PRESETS)[number];
export const GHOST_MODES = ["beside", "overlay", "off"] as const;
export type GhostMode = (typeof GHOST_MODES)[number];
export const TRACE_MODES = ["off", "lines", "onion"] as const satisfies readonly TraceMode[];
export const THEMES = ["auto", "dark", "light"] as const;
export type Theme = (typeof THEMES)[number];
export const SIDES = ["a", "b"] as const;
export type Side = (typeof SIDES)[number];
export const WALK_TEMPOS = ["model", "sampled", "fixed"] as const;
export type WalkTempo = (typeof WALK_TEMPOS)[number];
export const KEY_LEARNING = ["som", "em"] as const;
export type KeyLearning = (typeof KEY_LEARNING)[number];
export const KEY_CURVES = ["spline", "monotone"] as const;
export type KeyCurve = (typeof KEY_CURVES)[number];
export const KEY_METHODS = ["style", "hybrid", "frame", "all"] as const;
export type KeyMethod = (typeof KEY_METHODS)[number];
export const KEY_PANES = ["keys", "recordings"] as const;
export type KeyPane = (typeof KEY_PANES)[number];
export const TABS = ["style", "input", "model", "curves"] as const;
export type Tab = (typeof TABS)[number];
/** Playback speeds on offer. */
export const SPEEDS = [0.1, 0.25, 0.5, 1, 1.5, 2, 3, 4] as const;

/** Ranges of everything with a knob or a slider; the model's defaults are the specification's (§1, §7, §8). */
export const RANGES = {
  intensity: { min: -1, max: 2, digits: 2 },
  k: { min: 5, max: 160, digits: 0 },
  lambda: { min: 0.01, max: 1, digits: 2 },
  rho: { min: 0, max: 1, digits: 2 },
  kappa: { min: 0.5, max: 6, digits: 1 },
  delta: { min: 0.1, max: 3, digits: 2 },
  cadence: { min: 50, max: 180, digits: 0 },
  stride: { min: 60, max: 130, digits: 0 },
  turn: { min: -10, max: 10, digits: 0 },
  components: { min: 0, max: 32, digits: 0 },
} as const satisfies Record<string, Range>;

/** Entries of a list stand behind each other with `;`, and a name before what it names with `~`. */
const SEPARATOR = { entry: ";", name: "~" };

function encodeEntries(entries: readonly (readonly [name: string, styles: Selection])[]): string {
  return entries.map(([name, styles]) => `${name}${SEPARATOR.name}${encodeSelection(styles)}`).join(SEPARATOR.entry);
}

/** The entries of {@link encodeEntries}; `undefined` where one of them is none. */
function decodeEntries(text: string): [name: string, styles: Selection][] | undefined {
  const entries = text.split(SEPARATOR.entry).map((entry): [string, Selection | undefined] => {
    const at = entry.indexOf(SEPARATOR.name);
    return [entry.slice(0, at), decodeSelection(entry.slice(at + 1))];
  });
  return entries.every((entry): entry is [string, Selection] => entry[1] !== undefined) ? entries : undefined;
}

function encodeParts(parts: Parts): string {
  return encodeEntries(Object.entries(parts));
}

function decodeParts(text: string): Parts | undefined {
  const entries = decodeEntries(text);
  const known = entries?.every(([name]) => BODY_PARTS.some((part) => part === name));
  return known ? Object.fromEntries(entries!) : undefined;
}

function encodeTrack(track: readonly TrackKey[]): string {
  return encodeEntries(track.map(({ frame, styles }) => [String(frame), styles]));
}

function decodeTrack(text: string): TrackKey[] | undefined {
  const keys = decodeEntries(text)?.map(([name, styles]) => ({
    frame: name === "" ? Number.NaN : Number(name),
    styles,
  }));
  const inOrder = keys?.every(
    ({ frame }, i) => Number.isInteger(frame) && frame >= 0 && (i === 0 || frame > keys[i - 1]!.frame),
  );
  return inOrder ? keys : undefined;
}

/** What stands before the styles of a block's right foot. */
const RIGHT = "r";

/**
 * Intensity, steps and steps in between stand before a block's styles; those of the right foot follow where they differ:
 * `1_4_2~proud:1`.
 */
function encodeWalk(blocks: readonly WalkBlock[]): string {
  const numbers = ({ intensity, steps, transition }: WalkBlock) =>
    [Number(intensity.toFixed(INTENSITY_RANGE.digits)), steps, transition].join("_");
  return encodeEntries(
    blocks.flatMap((block) => [
      [numbers(block), block.styles] as const,
      ...(block.right ? [[RIGHT, block.right] as const] : []),
    ]),
  );
}

function decodeWalk(text: string): WalkBlock[] | undefined {
  const blocks = decodeEntries(text)?.flatMap(([name, styles], i, entries): WalkBlock[] => {
    if (name === RIGHT && i > 0) return [];
    const [intensity, steps, transition] = name
      .split("_")
      .map((number) => (number === "" ? Number.NaN : Number(number)));
    const [after, right] = entries[i + 1] ?? [];
    const block = {
      styles,
      intensity: intensity ?? Number.NaN,
      steps: steps ?? Number.NaN,
      transition: transition ?? Number.NaN,
    };
    return [after === RIGHT ? { ...block, right: right! } : block];
  });
  const within = (value: number, { min, max, digits }: Range) =>
    value >= min && value <= max && (digits > 0 || Number.isInteger(value));
  const valid = blocks?.every(
    ({ intensity, steps, transition }) =>
      within(intensity, INTENSITY_RANGE) && within(steps, STEP_RANGE) && within(transition, TRANSITION_RANGE),
  );
  return valid && blocks!.length <= MOST_BLOCKS ? blocks : undefined;
}

/** The handle as one value of no time. */
function encodeHandle(values: readonly number[]): string {
  return values.length === 0 ? "" : encodeTimed([{ secs: 0, values }]).slice("0_".length);
}

function decodeHandle(text: string): readonly number[] | undefined {
  return text === "" ? [] : decodeTimed(`0_${text}`, 1)?.[0]?.values;
}

/** Names in a list stand behind each other with `;`. */
function encodeNames(names: readonly string[]): string {
  return names.map((name) => name.replaceAll(SEPARATOR.entry, " ")).join(SEPARATOR.entry);
}

function encodeRange({ first, last }: FrameRange): string {
  return `${first}-${last}`;
}

function decodeRange(text: string): FrameRange | undefined {
  const [, first, last] = /^(\d{1,7})-(\d{1,7})$/.exec(text) ?? [];
  return first !== undefined && Number(first) < Number(last) ? { first: Number(first), last: Number(last) } : undefined;
}

/** The table. */
export const FIELDS: { readonly [K in keyof PlayState]: Field<PlayState[K]> } = {
  view: choice("view", "play", VIEW_NAMES),
  database: text("db", "", true),
  styles: selection("styles"),
  parts: listed("parts", {}, encodeParts, decodeParts),
  part: choice("part", "", ["", ...BODY_PARTS]),
  track: listed("track", [], encodeTrack, decodeTrack),
  key: number("key", 0, { min: 0, max: 999, digits: 0 }, false),
  wholePolygon: flag("all", false, true),
  intensity: number("intensity", 1, RANGES.intensity, true),
  input: text("input", "", true),
  k: number("k", 40, RANGES.k, true),
  lambda: number("lambda", 0.1, RANGES.lambda, true),
  rho: number("rho", 0.7, RANGES.rho, true),
  kappa: number("kappa", 3, RANGES.kappa, true),
  delta: number("delta", 0.7, RANGES.delta, true),
  timing: flag("timing", true, true),
  footplant: flag("footplant", true, true),
  coherence: flag("coherence", true, true),
  method: choice("method", "mar", METHODS, true),
  action: text("action", "", true),
  inputStyle: text("from", "", true),
  side: choice("side", "a", SIDES, true),
  other: text("other", "", true),
  camera: choice("camera", "orbit", CAMERA_PRESETS),
  follow: flag("follow", true, false),
  ghost: choice("ghost", "beside", GHOST_MODES),
  trace: choice("trail", "off", TRACE_MODES),
  theme: choice("theme", "auto", THEMES),
  loop: flag("loop", true, false),
  range: optional("range", encodeRange, decodeRange),
  speed: number("speed", 1, { min: 0.1, max: 4, digits: 2 }, false),
  playing: flag("play", true, false),
  frame: number("frame", 0, { min: 0, max: 1e7, digits: 2 }, false),
  curve: text("curve", "knee L", false),
  columns: listed(
    "columns",
    ["input", "nn", "lar", "mar"],
    (names) => names.join(","),
    (text) => text.split(",").slice(0, 5),
  ),
  behind: text("behind", "real", true),
  walk: listed("walk", [], encodeWalk, decodeWalk),
  walkBlock: number("block", 0, { min: 0, max: MOST_BLOCKS - 1, digits: 0 }, false),
  walkWhole: flag("walkall", false, true),
  walkTempo: choice("tempo", "model", WALK_TEMPOS, true),
  walkCadence: number("cadence", 110, RANGES.cadence, true),
  walkStride: number("stride", 100, RANGES.stride, true),
  walkTurn: number("turn", 0, RANGES.turn, true),
  walkStrip: flag("strip", false, false),
  walkPlot: text("plot", "states", false),
  keySet: text("set", "walk", true),
  keyClips: listed("clips", [], encodeNames, (names) => (names === "" ? [] : names.split(SEPARATOR.entry))),
  keyAxes: listed("axes", [], encodeAxes, decodeAxes),
  keyComponents: number("components", 0, RANGES.components, true),
  keyLearning: choice("learning", "som", KEY_LEARNING, true),
  keyHard: flag("hard", false, true),
  keyHandle: { ...listed("at", [], encodeHandle, decodeHandle), undoable: false },
  keyTrail: { ...listed("drag", [], encodeTimed, (text) => decodeTimed(text, MOST_POINTS)), undoable: false },
  keys: listed("keys", [], encodeTimed, (text) => decodeTimed(text, MOST_KEYS)),
  keyChosen: number("keyno", -1, { min: -1, max: MOST_KEYS - 1, digits: 0 }, false),
  keyLength: number("length", 0, { ...LENGTH_RANGE, min: 0 }, true),
  keyTime: number("secs", 0, { min: 0, max: LENGTH_RANGE.max, digits: 2 }, false),
  keyCurve: choice("spline", "spline", KEY_CURVES, true),
  keyMethod: choice("between", "style", KEY_METHODS),
  keyGhost: flag("nearest", true, false),
  keyPane: choice("pane", "keys", KEY_PANES),
  panels: flag("panels", true, false),
  tab: choice("tab", "style", TABS),
};

const KEYS = Object.keys(FIELDS) as (keyof PlayState)[];

/** Names of the fields that the engine's output depends on. */
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
  "coherence",
  "timing",
  "footplant",
  "method",
  "action",
  "inputStyle",
] as const satisfies readonly (keyof PlayState)[];

/** Names of the fields that undo takes back. */
export const UNDOABLE = KEYS.filter((name) => FIELDS[name].undoable);

/** The state before anybody has touched anything. */
export function initialState(): PlayState {
  return Object.fromEntries(KEYS.map((name) => [name, FIELDS[name].initial])) as unknown as PlayState;
}

/** Writes the fields that differ from their defaults as `key=value&…`, readable and without the leading `#`. */
export function toHash(state: PlayState): string {
  const encode = <K extends keyof PlayState>(name: K): string => FIELDS[name].encode(state[name]);
  const written = KEYS.filter((name) => encode(name) !== FIELDS[name].encode(FIELDS[name].initial as never));
  const readable = (value: string) => encodeURIComponent(value).replace(/%2C/g, ",").replace(/%3A/g, ":");
  return written.map((name) => `${FIELDS[name].key}=${readable(encode(name))}`).join("&");
}

/** Reads what {@link toHash} wrote. Unknown keys and values that are none are passed over: links outlive versions. */
export function fromHash(hash: string): PlayState {
  const state = initialState();
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const read = <K extends keyof PlayState>(name: K): void => {
    const value = given.get(FIELDS[name].key);
    const decoded = value === null ? undefined : FIELDS[name].decode(value);
    if (decoded !== undefined) state[name] = decoded;
  };
  KEYS.forEach(read);
  return state;
}
