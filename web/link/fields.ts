/** Kinds of state fields: how a value is encoded in the URL and decoded from it. */
import { type Range, rounded } from "../ui/controls/range";
import type { Selection } from "../ui/polygon/selection";

/** One field of the state. */
export interface Field<T> {
  /** Key in the URL. */
  key: string;
  initial: T;
  /** Whether undo restores it. */
  undoable: boolean;
  encode(value: T): string;
  /** The value; `undefined` if the text is invalid. */
  decode(text: string): T | undefined;
}

/** A table of fields: one for each member of a state. */
export type Fields<State> = { readonly [K in keyof State]: Field<State[K]> };

/** A number, clamped to its range, and rounded to its number of decimals. */
export function number(key: string, initial: number, range: Range, undoable: boolean): Field<number> {
  return {
    key,
    initial,
    undoable,
    encode: (value) => String(Number(value.toFixed(range.digits))),
    decode: (text) => {
      const value = Number(text);
      return text.trim() !== "" && Number.isFinite(value) ? rounded(value, range) : undefined;
    },
  };
}

/** A boolean, written as 1 or 0. */
export function flag(key: string, initial: boolean, undoable: boolean): Field<boolean> {
  return {
    key,
    initial,
    undoable,
    encode: (value) => (value ? "1" : "0"),
    decode: (text) => (text === "1" ? true : text === "0" ? false : undefined),
  };
}

/** One of the given words. */
export function choice<T extends string>(key: string, initial: T, options: readonly T[], undoable = false): Field<T> {
  return {
    key,
    initial,
    undoable,
    encode: (value) => value,
    decode: (text) => options.find((option) => option === text),
  };
}

/** A text. */
export function text(key: string, initial: string, undoable: boolean): Field<string> {
  return { key, initial, undoable, encode: (value) => value, decode: (value) => value };
}

/** An optional value. */
export function optional<T>(
  key: string,
  encode: (value: T) => string,
  decode: (text: string) => T | undefined,
  undoable = false,
): Field<T | undefined> {
  return { key, initial: undefined, undoable, encode: (value) => (value ? encode(value) : ""), decode };
}

/** A list. */
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

/** `name:weight,…`; separators in names become blanks. */
export function encodeSelection(value: Selection): string {
  return value.map((s) => `${s.name.replace(/[:,;~]/g, " ")}:${Number(s.weight.toFixed(3))}`).join(",");
}

/** Decodes {@link encodeSelection}; `undefined` if it is invalid, or a weight is beyond ±4. */
export function decodeSelection(value: string): Selection | undefined {
  const parts = value.split(",").map((part) => {
    const colon = part.lastIndexOf(":");
    return { name: part.slice(0, colon), weight: Number(part.slice(colon + 1)) };
  });
  const names = new Set(parts.map((s) => s.name));
  const valid = parts.every((s) => s.name !== "" && Number.isFinite(s.weight) && Math.abs(s.weight) <= 4);
  return valid && names.size === parts.length ? parts : undefined;
}

/** Separators of entries in a list, and of a name and its value in an entry. */
export const SEPARATOR = { entry: ";", name: "~" } as const;

/** `name~selection;…`. */
export function encodeEntries(entries: readonly (readonly [name: string, styles: Selection])[]): string {
  return entries.map(([name, styles]) => `${name}${SEPARATOR.name}${encodeSelection(styles)}`).join(SEPARATOR.entry);
}

/** Decodes {@link encodeEntries}; `undefined` if an entry is invalid, or there are more than `max`. */
export function decodeEntries(text: string, max: number): [name: string, styles: Selection][] | undefined {
  const texts = text.split(SEPARATOR.entry, max + 1);
  if (texts.length > max) return undefined;
  const entries = texts.map((entry): [string, Selection | undefined] => {
    const at = entry.indexOf(SEPARATOR.name);
    return [entry.slice(0, at), decodeSelection(entry.slice(at + 1))];
  });
  return entries.every((entry): entry is [string, Selection] => entry[1] !== undefined) ? entries : undefined;
}

/** `name;…`; separators in names become blanks. */
export function encodeNames(names: readonly string[]): string {
  return names.map((name) => name.replaceAll(SEPARATOR.entry, " ")).join(SEPARATOR.entry);
}
