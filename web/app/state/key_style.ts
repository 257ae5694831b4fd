/** State of the Key-style view: the training motions, the style variables, and their keys over time. */

import { choice, encodeNames, type Fields, flag, listed, number, SEPARATOR, text } from "../../link/fields";
import type { Range } from "../../ui/controls/range";

/** A style variable: the name of a measure, or an expression. */
export type Axis = string;

/** Values of the style variables, in their own units, at a time. */
export interface TimedValue {
  secs: number;
  values: readonly number[];
}

export interface KeyStyleState {
  /** The set of training clips, see `views/key_style/sets.ts`, and the names of its clips where they were chosen. */
  keySet: string;
  keyClips: readonly string[];
  /** Style variables; none for those that fit the motions. */
  keyAxes: readonly Axis[];
  /** Number of components of the mixture, 0 for that of the training rule, and how it is trained. */
  keyComponents: number;
  keyLearning: KeyLearning;
  /** Whether the winning component alone is the pose. */
  keyHard: boolean;
  /** Values at the handle; empty until a model gives its default. */
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
}

export const KEY_LEARNING = ["som", "em"] as const;
export type KeyLearning = (typeof KEY_LEARNING)[number];
export const KEY_CURVES = ["spline", "monotone"] as const;
export type KeyCurve = (typeof KEY_CURVES)[number];
export const KEY_METHODS = ["style", "hybrid", "frame", "all"] as const;
export type KeyMethod = (typeof KEY_METHODS)[number];
export const KEY_PANES = ["keys", "recordings"] as const;
export type KeyPane = (typeof KEY_PANES)[number];

export const KEY_STYLE_RANGES = {
  components: { min: 0, max: 32, digits: 0 },
} as const satisfies Record<string, Range>;

/** Maximum number of training clips by choice. */
export const MAX_CLIPS = 1000;
/** Style variables of one model. */
export const MAX_AXES = 3;
/** Longest expression of a style variable. */
export const MAX_CHARACTERS = 80;
export const MAX_KEYS = 60;
/** Length of the animation, seconds. */
export const LENGTH_RANGE = { min: 0.5, max: 30, digits: 2 } as const satisfies Range;
/** Points a second of a trail that are kept: links stay short, and a hand is not faster. */
export const TRAIL_RATE_HZ = 20;
/** Longest trail, seconds; what is older is forgotten. */
export const LONGEST_TRAIL_SECS = 6;
/** Maximum number of points of a trail. */
export const MAX_POINTS = TRAIL_RATE_HZ * LONGEST_TRAIL_SECS + 2;

/** Axes in links stand behind each other with `~`, which no expression has. */
export function encodeAxes(axes: readonly Axis[]): string {
  return axes.join(SEPARATOR.name);
}

/** What {@link encodeAxes} wrote; `undefined` where there are too many, or the same twice. */
export function decodeAxes(text: string): Axis[] | undefined {
  const axes = text === "" ? [] : text.split(SEPARATOR.name);
  const valid = axes.every((axis) => axis !== "" && axis.length <= MAX_CHARACTERS);
  return valid && axes.length <= MAX_AXES && new Set(axes).size === axes.length ? axes : undefined;
}

/** Decimals of seconds and of values in links. */
const DIGITS = { secs: 2, value: 2 };

/** `0.55_24.5_86.4;…`: seconds, then the values. */
export function encodeTimed(timed: readonly TimedValue[]): string {
  const plain = (value: number, digits: number) => String(Number(value.toFixed(digits)));
  return timed
    .map(({ secs, values }) => [plain(secs, DIGITS.secs), ...values.map((v) => plain(v, DIGITS.value))].join("_"))
    .join(SEPARATOR.entry);
}

/** What {@link encodeTimed} wrote; `undefined` where it is none: times must grow and all have as many values. */
export function decodeTimed(text: string, max: number): TimedValue[] | undefined {
  if (text === "") return [];
  const entries = text.split(SEPARATOR.entry, max + 1);
  const timed = entries.map((entry): TimedValue => {
    const [secs, ...values] = entry.split("_").map((part) => (part === "" ? Number.NaN : Number(part)));
    return { secs: secs!, values };
  });
  const valid = timed.every(
    ({ secs, values }, i) =>
      secs >= 0 &&
      secs <= LENGTH_RANGE.max &&
      (i === 0 || secs > timed[i - 1]!.secs) &&
      values.length > 0 &&
      values.length === timed[0]!.values.length &&
      values.every(Number.isFinite),
  );
  return valid && timed.length <= max ? timed : undefined;
}

/** The handle as one value of no time. */
function encodeHandle(values: readonly number[]): string {
  return values.length === 0 ? "" : encodeTimed([{ secs: 0, values }]).slice("0_".length);
}

function decodeHandle(text: string): readonly number[] | undefined {
  return text === "" ? [] : decodeTimed(`0_${text}`, 1)?.[0]?.values;
}

function decodeClips(text: string): string[] | undefined {
  const names = text === "" ? [] : text.split(SEPARATOR.entry, MAX_CLIPS + 1);
  return names.length <= MAX_CLIPS ? names : undefined;
}

export const KEY_STYLE_FIELDS: Fields<KeyStyleState> = {
  keySet: text("set", "walk", true),
  keyClips: listed("clips", [], encodeNames, decodeClips),
  keyAxes: listed("axes", [], encodeAxes, decodeAxes),
  keyComponents: number("components", 0, KEY_STYLE_RANGES.components, true),
  keyLearning: choice("learning", "som", KEY_LEARNING, true),
  keyHard: flag("hard", false, true),
  keyHandle: { ...listed("at", [], encodeHandle, decodeHandle), undoable: false },
  keyTrail: { ...listed("drag", [], encodeTimed, (text) => decodeTimed(text, MAX_POINTS)), undoable: false },
  keys: listed("keys", [], encodeTimed, (text) => decodeTimed(text, MAX_KEYS)),
  keyChosen: number("keyno", -1, { min: -1, max: MAX_KEYS - 1, digits: 0 }, false),
  keyLength: number("length", 0, { ...LENGTH_RANGE, min: 0 }, true),
  keyTime: number("secs", 0, { min: 0, max: LENGTH_RANGE.max, digits: 2 }, false),
  keyCurve: choice("spline", "spline", KEY_CURVES, true),
  keyMethod: choice("between", "style", KEY_METHODS),
  keyGhost: flag("nearest", true, false),
  keyPane: choice("pane", "keys", KEY_PANES),
};
