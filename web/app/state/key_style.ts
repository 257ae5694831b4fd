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
  /** The set of training clips, see `views/key_style/sets.ts`, and the names of its clips if they were selected. */
  keySet: string;
  keyClips: readonly string[];
  /** Style variables; empty for those that fit the motions best. */
  keyAxes: readonly Axis[];
  /** Number of components of the mixture, 0 for the number that training chooses, and the training method. */
  keyComponents: number;
  keyLearning: KeyLearning;
  /** Whether the winning component alone determines the pose. */
  keyHard: boolean;
  /** Values at the handle; empty until a model provides its default. */
  keyHandle: readonly number[];
  /** The last drag. */
  keyTrail: readonly TimedValue[];
  /** Keys over time, the index of the selected key, the length of the animation and the playhead, seconds. */
  keys: readonly TimedValue[];
  keyChosen: number;
  keyLength: number;
  keyTime: number;
  keyCurve: KeyCurve;
  keyMethod: KeyMethod;
  /** Whether the nearest recorded pose is drawn, and the panel below the pad. */
  keyGhost: boolean;
  keyPane: KeyPane;
}

const KEY_LEARNING = ["som", "em"] as const;
export type KeyLearning = (typeof KEY_LEARNING)[number];
const KEY_CURVES = ["spline", "monotone"] as const;
export type KeyCurve = (typeof KEY_CURVES)[number];
const KEY_METHODS = ["style", "hybrid", "frame", "all"] as const;
export type KeyMethod = (typeof KEY_METHODS)[number];
const KEY_PANES = ["keys", "recordings"] as const;
export type KeyPane = (typeof KEY_PANES)[number];

export const KEY_STYLE_RANGES = {
  components: { min: 0, max: 32, digits: 0 },
} as const satisfies Record<string, Range>;

/** Maximum number of training clips that can be selected. */
export const MAX_CLIPS = 1000;
/** Maximum number of style variables of a model. */
export const MAX_AXES = 3;
/** Longest expression of a style variable, characters. */
export const MAX_CHARACTERS = 80;
export const MAX_KEYS = 60;
/** Length of the animation, seconds. */
export const LENGTH_RANGE = { min: 0.5, max: 30, digits: 2 } as const satisfies Range;
/** Points per second of a trail that are kept: links stay short, and hand movements are not faster. */
export const TRAIL_RATE_HZ = 20;
/** Longest trail, seconds; older points are removed. */
export const LONGEST_TRAIL_SECS = 6;
/** Maximum number of points of a trail. */
export const MAX_POINTS = TRAIL_RATE_HZ * LONGEST_TRAIL_SECS + 2;

/** Encodes axes in links, separated by `~`, which no expression contains. */
export function encodeAxes(axes: readonly Axis[]): string {
  return axes.join(SEPARATOR.name);
}

/** Decodes {@link encodeAxes}; `undefined` if there are too many, or duplicates. */
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

/**
 * Decodes {@link encodeTimed}; `undefined` if it is invalid: times must increase and all entries must have the same
 * number of values.
 */
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

/** The handle as one value without a time. */
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
