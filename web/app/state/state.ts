/**
 * The state of the app: a table of fields for the page and for each view, composed into one. Each field has its key in
 * the URL, its default, an encoder and a decoder. Everything that changes the picture is state; the URL's hash encodes it.
 */

import type { Fields } from "../../link/fields";
import { initialOf, namesOf, readHash, writeHash } from "../../link/hash";
import { PAGE_FIELDS, type PageState } from "../../link/page";
import { PLAY_FIELDS, type PlayState } from "../../link/play";
import { COMPARE_FIELDS, type CompareState } from "./compare";
import { CROWD_FIELDS, type CrowdState } from "./crowd";
import { KEY_STYLE_FIELDS, type KeyStyleState } from "./key_style";
import { foreignPairs, LEARN_FIELDS, type LearnState } from "./learn";
import { WALK_FIELDS, type WalkState } from "./walk";

/** Everything that a link restores. */
export interface AppState
  extends PageState,
    PlayState,
    CompareState,
    WalkState,
    KeyStyleState,
    CrowdState,
    LearnState {}

/** The composed table. */
export const FIELDS: Fields<AppState> = {
  ...PLAY_FIELDS,
  ...PAGE_FIELDS,
  ...COMPARE_FIELDS,
  ...WALK_FIELDS,
  ...KEY_STYLE_FIELDS,
  ...CROWD_FIELDS,
  ...LEARN_FIELDS,
};

/** Names of the fields that undo restores. */
export const UNDOABLE = namesOf(FIELDS).filter((name) => FIELDS[name].undoable);

/** Keys of the page's own fields in a link. */
const KEYS: ReadonlySet<string> = new Set(namesOf(FIELDS).map((name) => FIELDS[name].key));

/** All fields at their defaults. */
export function initialState(): AppState {
  return initialOf(FIELDS);
}

/** Writes the fields that differ from their defaults as `key=value&…`, readable and without the leading `#`. */
export function toHash(state: AppState): string {
  const figures = state.view === "learn" ? state.figures : "";
  return [writeHash(FIELDS, { ...state, figures: "" }), figures].filter((part) => part !== "").join("&");
}

/**
 * Decodes {@link toHash}. In Learn, keys that the page does not know are the figures' state. Other unknown keys and invalid
 * values are ignored, so that links of other versions open.
 */
export function fromHash(hash: string): AppState {
  const state = readHash(FIELDS, hash);
  return state.view === "learn" ? { ...state, figures: foreignPairs(hash, KEYS) } : state;
}
