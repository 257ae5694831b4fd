/**
 * The state of the app: a table of fields for the page and for each view, composed into one. Each field has its key in
 * the URL, its default, an encoder and a decoder. Everything that changes the picture is state; the URL's hash encodes it.
 */

import { COMPARE_FIELDS, type CompareState } from "./compare";
import type { Fields } from "./fields";
import { KEY_STYLE_FIELDS, type KeyStyleState } from "./key_style";
import { PAGE_FIELDS, type PageState } from "./page";
import { PLAY_FIELDS, type PlayState } from "./play";
import { WALK_FIELDS, type WalkState } from "./walk";

/** Everything that a link restores. */
export interface AppState extends PageState, PlayState, CompareState, WalkState, KeyStyleState {}

/** The composed table. */
export const FIELDS: Fields<AppState> = {
  ...PLAY_FIELDS,
  ...PAGE_FIELDS,
  ...COMPARE_FIELDS,
  ...WALK_FIELDS,
  ...KEY_STYLE_FIELDS,
};

const KEYS = Object.keys(FIELDS) as (keyof AppState)[];

/** Names of the fields that undo takes back. */
export const UNDOABLE = KEYS.filter((name) => FIELDS[name].undoable);

/** All fields at their defaults. */
export function initialState(): AppState {
  return Object.fromEntries(KEYS.map((name) => [name, FIELDS[name].initial])) as unknown as AppState;
}

/** Writes the fields that differ from their defaults as `key=value&…`, readable and without the leading `#`. */
export function toHash(state: AppState): string {
  const encode = <K extends keyof AppState>(name: K): string => FIELDS[name].encode(state[name]);
  const written = KEYS.filter((name) => encode(name) !== FIELDS[name].encode(FIELDS[name].initial as never));
  const readable = (value: string) => encodeURIComponent(value).replace(/%2C/g, ",").replace(/%3A/g, ":");
  return written.map((name) => `${FIELDS[name].key}=${readable(encode(name))}`).join("&");
}

/** Reads what {@link toHash} wrote. Unknown keys and invalid values are ignored, so that links of other versions open. */
export function fromHash(hash: string): AppState {
  const state = initialState();
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const read = <K extends keyof AppState>(name: K): void => {
    const value = given.get(FIELDS[name].key);
    const decoded = value === null ? undefined : FIELDS[name].decode(value);
    if (decoded !== undefined) state[name] = decoded;
  };
  KEYS.forEach(read);
  return state;
}
