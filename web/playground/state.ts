/**
 * The playground's state: one table of fields, each with its key in the URL, its default and its two translations.
 * Everything that changes the picture is here and nowhere else; the URL's hash is this table written out.
 */
import type { StylizeOptions } from "../worker/protocol";
import { engineWeights, type Selection } from "./polygon/selection";

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
  camera: CameraPreset;
  follow: boolean;
  ghost: GhostMode;
  theme: Theme;
  loop: boolean;
  speed: number;
  playing: boolean;
  /** Input frame at which a paused motion stands. */
  frame: number;
  /** Joint whose curve the timeline shows. */
  curve: string;
  /** Whether panels and transport are shown. */
  panels: boolean;
  /** The panel that is open on a narrow screen. */
  tab: Tab;
}

export const VIEW_NAMES = ["play", "data"] as const;
export type ViewName = (typeof VIEW_NAMES)[number];
export const CAMERA_PRESETS = ["orbit", "front", "side", "top"] as const;
export type CameraPreset = (typeof CAMERA_PRESETS)[number];
export const GHOST_MODES = ["beside", "overlay", "off"] as const;
export type GhostMode = (typeof GHOST_MODES)[number];
export const THEMES = ["auto", "dark", "light"] as const;
export type Theme = (typeof THEMES)[number];
export const TABS = ["style", "input", "model", "curves"] as const;
export type Tab = (typeof TABS)[number];
/** Playback speeds on offer. */
export const SPEEDS = [0.1, 0.25, 0.5, 1, 1.5, 2] as const;

/** Range of a number that a person can turn, and how it is written. */
export interface Range {
  min: number;
  max: number;
  /** Decimals. */
  digits: number;
}

/** Ranges of everything with a knob or a slider; the model's defaults are the specification's (§1, §7, §8). */
export const RANGES = {
  intensity: { min: -1, max: 2, digits: 2 },
  k: { min: 5, max: 160, digits: 0 },
  lambda: { min: 0.01, max: 1, digits: 2 },
  rho: { min: 0, max: 1, digits: 2 },
  kappa: { min: 0.5, max: 6, digits: 1 },
  delta: { min: 0.1, max: 3, digits: 2 },
} as const satisfies Record<string, Range>;

interface Field<T> {
  /** Key in the URL. */
  key: string;
  initial: T;
  /** Whether undo takes it back. */
  undoable: boolean;
  encode(value: T): string;
  /** The value, or `undefined` where the text is not one. */
  decode(text: string): T | undefined;
}

function number(key: string, initial: number, { min, max, digits }: Range, undoable: boolean): Field<number> {
  return {
    key,
    initial,
    undoable,
    encode: (value) => String(Number(value.toFixed(digits))),
    decode: (text) => {
      const value = Number(text);
      return text.trim() !== "" && Number.isFinite(value) ? Math.min(max, Math.max(min, value)) : undefined;
    },
  };
}

function flag(key: string, initial: boolean, undoable: boolean): Field<boolean> {
  return {
    key,
    initial,
    undoable,
    encode: (value) => (value ? "1" : "0"),
    decode: (text) => (text === "1" ? true : text === "0" ? false : undefined),
  };
}

function choice<T extends string>(key: string, initial: T, options: readonly T[]): Field<T> {
  return {
    key,
    initial,
    undoable: false,
    encode: (value) => value,
    decode: (text) => options.find((option) => option === text),
  };
}

function text(key: string, initial: string, undoable: boolean): Field<string> {
  return { key, initial, undoable, encode: (value) => value, decode: (value) => value };
}

function selection(key: string): Field<Selection> {
  return {
    key,
    initial: [],
    undoable: true,
    encode: (value) => value.map((s) => `${s.name.replace(/[:,]/g, " ")}:${Number(s.weight.toFixed(3))}`).join(","),
    decode: (value) => {
      const parts = value.split(",").map((part) => {
        const colon = part.lastIndexOf(":");
        return { name: part.slice(0, colon), weight: Number(part.slice(colon + 1)) };
      });
      const names = new Set(parts.map((s) => s.name));
      const valid = parts.every((s) => s.name !== "" && Number.isFinite(s.weight) && Math.abs(s.weight) <= 4);
      return valid && names.size === parts.length ? parts : undefined;
    },
  };
}

/** The table. */
export const FIELDS: { readonly [K in keyof PlayState]: Field<PlayState[K]> } = {
  view: choice("view", "play", VIEW_NAMES),
  database: text("db", "", false),
  styles: selection("styles"),
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
  camera: choice("camera", "orbit", CAMERA_PRESETS),
  follow: flag("follow", true, false),
  ghost: choice("ghost", "beside", GHOST_MODES),
  theme: choice("theme", "auto", THEMES),
  loop: flag("loop", true, false),
  speed: number("speed", 1, { min: 0.1, max: 2, digits: 2 }, false),
  playing: flag("play", true, false),
  frame: number("frame", 0, { min: 0, max: 1e7, digits: 0 }, false),
  curve: text("curve", "knee L", false),
  panels: flag("panels", true, false),
  tab: choice("tab", "style", TABS),
};

const KEYS = Object.keys(FIELDS) as (keyof PlayState)[];

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

/** What the engine is asked for in this state. */
export function engineOptions(state: PlayState, neutral: string): StylizeOptions {
  const { k, lambda, rho, kappa, delta, timing, footplant } = state;
  return {
    styles: engineWeights(state.styles, state.intensity, neutral),
    k,
    lambda,
    rho,
    kappa,
    delta,
    timing,
    footplant,
  };
}
