/** Kinds of fields of the state: how a value is written into the URL and read from it. */
import type { Selection } from "./polygon/selection";

/** One field of the state. */
export interface Field<T> {
  /** Key in the URL. */
  key: string;
  initial: T;
  /** Whether undo takes it back. */
  undoable: boolean;
  encode(value: T): string;
  /** The value, or `undefined` where the text is not one. */
  decode(text: string): T | undefined;
}

/** Range of a number that a person can turn, and how it is written. */
export interface Range {
  min: number;
  max: number;
  /** Decimals. */
  digits: number;
}

/** A number, written with as few decimals as it needs and kept in its range. */
export function number(key: string, initial: number, { min, max, digits }: Range, undoable: boolean): Field<number> {
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

/** On or off. */
export function flag(key: string, initial: boolean, undoable: boolean): Field<boolean> {
  return {
    key,
    initial,
    undoable,
    encode: (value) => (value ? "1" : "0"),
    decode: (text) => (text === "1" ? true : text === "0" ? false : undefined),
  };
}

/** One of a few words. */
export function choice<T extends string>(key: string, initial: T, options: readonly T[], undoable = false): Field<T> {
  return {
    key,
    initial,
    undoable,
    encode: (value) => value,
    decode: (text) => options.find((option) => option === text),
  };
}

/** Any text. */
export function text(key: string, initial: string, undoable: boolean): Field<string> {
  return { key, initial, undoable, encode: (value) => value, decode: (value) => value };
}

/** Something that need not be there. */
export function optional<T>(
  key: string,
  encode: (value: T) => string,
  decode: (text: string) => T | undefined,
): Field<T | undefined> {
  return { key, initial: undefined, undoable: false, encode: (value) => (value ? encode(value) : ""), decode };
}

/** Several things, none at first. */
export function listed<T>(
  key: string,
  initial: T,
  encode: (value: T) => string,
  decode: (text: string) => T | undefined,
): Field<T> {
  return { key, initial, undoable: true, encode, decode };
}

/** Styles and their weights. */
export function selection(key: string): Field<Selection> {
  return { key, initial: [], undoable: true, encode: encodeSelection, decode: decodeSelection };
}

/** `name:weight,…`; the characters that separate are blanks in names. */
export function encodeSelection(value: Selection): string {
  return value.map((s) => `${s.name.replace(/[:,;~]/g, " ")}:${Number(s.weight.toFixed(3))}`).join(",");
}

/** What {@link encodeSelection} wrote; `undefined` where it is none, or a weight is out of all reason. */
export function decodeSelection(value: string): Selection | undefined {
  const parts = value.split(",").map((part) => {
    const colon = part.lastIndexOf(":");
    return { name: part.slice(0, colon), weight: Number(part.slice(colon + 1)) };
  });
  const names = new Set(parts.map((s) => s.name));
  const valid = parts.every((s) => s.name !== "" && Number.isFinite(s.weight) && Math.abs(s.weight) <= 4);
  return valid && names.size === parts.length ? parts : undefined;
}
