/**
 * Edits of styles in the state: of the whole body, a body part or a key of the style track; settings A and B; random
 * styles. Pure functions over {@link AppState}.
 */

import { BODY_PARTS, type BodyPart, type DatabaseInfo } from "../../client/protocol";
import type { Role } from "../../humanoid";
import { MAX_TRACK_KEYS, type TrackKey } from "../../link/play";
import { normalised, type Selection, TRIANGLE } from "../../ui/polygon/selection";
import { type AppState, fromHash, initialState, toHash, UNDOABLE } from "./state";

type Patch = Partial<AppState>;

/** The styles that the polygon shows: those of the selected body part if it has its own, otherwise the whole body's. */
export function shownStyles({ part, parts, styles }: AppState): Selection {
  return (part && parts[part]) || styles;
}

/** A key is under the playhead if it is at most this many frames away: a pixel of the timeline may cover several frames. */
const UNDER_PLAYHEAD = 3;

/** Index of the nearest key under the playhead at a frame; −1 if there is none. */
export function keyUnder({ track }: Pick<AppState, "track">, frame: number): number {
  const away = track.map((key) => Math.abs(key.frame - frame));
  const least = Math.min(...away);
  return least <= UNDER_PLAYHEAD ? away.indexOf(least) : -1;
}

/**
 * Sets the styles that the polygon shows: of the selected body part, or of the whole body. With a track, the edit
 * changes the key under the playhead, or adds a key there if there is none; styles elsewhere do not change. `frame` is
 * the playhead's; `undefined` without a timeline.
 */
export function withStyles(state: AppState, styles: Selection, frame: number | undefined): Patch {
  const { part, parts, track } = state;
  if (part) return { parts: { ...parts, [part]: styles } };
  if (frame === undefined || track.length === 0) return { styles };
  const under = keyUnder(state, frame);
  if (under < 0) return keyMade(state, styles, frame);
  return { styles, key: under, track: track.map((key, i) => (i === under ? { ...key, styles } : key)) };
}

/** Removes the styles of a body part: it follows the whole body again. */
export function withoutPart({ parts }: AppState, part: BodyPart): Patch {
  return { parts: Object.fromEntries(Object.entries(parts).filter(([name]) => name !== part)) };
}

/** Index of the selected key; −1 without a track. */
export function chosenKey({ track, key }: AppState): number {
  return Math.min(key, track.length - 1);
}

/** Selects a key: the polygon shows its styles. */
export function chooseKey({ track }: AppState, key: number): Patch {
  const styles = track[key]?.styles;
  return styles ? { key, styles, part: "" } : {};
}

/** The styles of the track at a frame, interpolated as in the engine; the state's styles without a track. */
export function stylesAt({ track, styles }: AppState, frame: number): Selection {
  const after = track.findIndex((key) => key.frame > frame);
  const to = track[after < 0 ? track.length - 1 : after];
  if (!to) return styles;
  const from = track[after - 1] ?? to;
  const share = to.frame > from.frame ? (frame - from.frame) / (to.frame - from.frame) : 1;
  const weight = (of: Selection, name: string) => of.find((s) => s.name === name)?.weight ?? 0;
  const names = new Set([...from.styles, ...to.styles].map((s) => s.name));
  return [...names].map((name) => ({
    name,
    weight: (1 - share) * weight(from.styles, name) + share * weight(to.styles, name),
  }));
}

/**
 * Adds a key at a frame and selects it: with `styles`, or those that the track has there. An existing key at that frame
 * is selected.
 */
export function addKey(state: AppState, frame: number, styles: Selection = stylesAt(state, frame)): Patch {
  const at = Math.max(0, Math.round(frame));
  const present = state.track.findIndex((key) => key.frame === at);
  return present >= 0 ? chooseKey(state, present) : keyMade(state, styles, at);
}

/** A new key, which is selected. */
function keyMade(state: AppState, styles: Selection, frame: number): Patch {
  if (state.track.length >= MAX_TRACK_KEYS) return {};
  const added: TrackKey = { frame: Math.max(0, Math.round(frame)), styles };
  const track = [...state.track, added].sort((a, b) => a.frame - b.frame);
  return { styles, track, key: track.indexOf(added), part: "" };
}

/** Removes a key and selects the previous one. */
export function removeKey(state: AppState, key: number): Patch {
  const track = state.track.filter((_, i) => i !== key);
  const next = Math.max(0, key - 1);
  return { track, key: next, styles: track[next]?.styles ?? state.styles };
}

/** Moves a key to a frame, but not past its neighbours. */
export function moveKey({ track }: AppState, key: number, frame: number): Patch {
  const min = (track[key - 1]?.frame ?? -1) + 1;
  const max = (track[key + 1]?.frame ?? Number.MAX_SAFE_INTEGER) - 1;
  const at = Math.min(max, Math.max(min, Math.round(frame)));
  return { track: track.map((k, i) => (i === key ? { ...k, frame: at } : k)) };
}

/**
 * The changes for a database that has only the styles `known`: others are dropped, and `first` is selected if none is
 * left. `undefined` if nothing changes.
 */
export function withKnownStyles(state: AppState, known: readonly string[], first: Selection): Patch | undefined {
  const isKnown = (s: { name: string }) => known.includes(s.name);
  const all = [state.styles, ...Object.values(state.parts), ...state.track.map((key) => key.styles)];
  if (all.every((styles) => styles.length > 0 && styles.every(isKnown))) return undefined;
  const keep = (styles: Selection): Selection => {
    if (styles.length > 0 && styles.every(isKnown)) return styles;
    const left = styles.filter(isKnown);
    return left.length > 0 ? normalised(left) : first;
  };
  const parts = Object.entries(state.parts).filter(([, styles]) => styles.some(isKnown));
  return {
    styles: keep(state.styles),
    parts: Object.fromEntries(parts.map(([part, styles]) => [part, keep(styles)])),
    track: state.track.map((key) => ({ ...key, styles: keep(key.styles) })),
    wholePolygon: false,
  };
}

/**
 * The changes for a database that has styles of the previous one under other names; `renamed` maps former names to new
 * ones.
 */
export function withRenamedStyles(state: AppState, renamed: ReadonlyMap<string, string>): Patch {
  if (renamed.size === 0) return {};
  const rename = (styles: Selection): Selection => styles.map((s) => ({ ...s, name: renamed.get(s.name) ?? s.name }));
  return {
    styles: rename(state.styles),
    parts: Object.fromEntries(Object.entries(state.parts).map(([part, styles]) => [part, rename(styles)])),
    track: state.track.map((key) => ({ ...key, styles: rename(key.styles) })),
  };
}

/** The changes for a database without a class of the input's labels; `undefined` if it has one. */
export function withKnownLabels({ action, inputStyle }: AppState, classes: DatabaseInfo["classes"]): Patch | undefined {
  const known = classes.some((c) => (!action || action === c.action) && (!inputStyle || inputStyle === c.style));
  return known ? undefined : { action: "", inputStyle: "" };
}

/** The fields that belong to a setting, A or B. */
const SETTING = UNDOABLE.filter((name) => !["database", "input", "side", "other"].includes(name));

function setting(state: AppState): AppState {
  return { ...initialState(), ...Object.fromEntries(SETTING.map((name) => [name, state[name]])) };
}

/** Switches between settings A and B; B begins as a copy of A. */
export function otherSide(state: AppState): Patch {
  const side = state.side === "a" ? "b" : "a";
  const other = toHash(setting(state));
  if (state.other === "") return { side, other };
  const next = fromHash(state.other);
  return { ...Object.fromEntries(SETTING.map((name) => [name, next[name]])), side, other };
}

/**
 * Three random styles with random weights; `random` returns numbers from 0 to 1. The neutral style is as likely as the
 * others.
 */
export function randomStyles(styles: readonly string[], random: () => number = Math.random): Selection {
  const left = [...styles];
  const chosen: Selection[number][] = [];
  while (chosen.length < TRIANGLE && left.length > 0) {
    const [name] = left.splice(Math.floor(random() * left.length) % left.length, 1);
    // Normalised exponential variates are uniform over the triangle.
    chosen.push({ name: name!, weight: -Math.log(1 - Math.min(random(), 0.999)) });
  }
  return normalised(chosen).map((s) => ({ ...s, weight: Math.round(s.weight * 1000) / 1000 }));
}

/** Range of the intensity in which all weights stay within the data. */
export function plausibleIntensity(styles: Selection): { min: number; max: number } {
  const max = Math.max(...styles.map((s) => s.weight), 0);
  const negative = styles.some((s) => s.weight < 0);
  return { min: 0, max: negative || max <= 0 ? 0 : 1 / max };
}

/** The body part of a joint, as in the engine. */
export function partOf(joint: Role): BodyPart {
  if (joint === "neck" || joint === "head") return "head";
  if (joint === "spine" || joint === "chest") return "torso";
  if (/_(shoulder|upper_arm|lower_arm|hand)$/.test(joint)) return joint.startsWith("left") ? "left_arm" : "right_arm";
  return "legs";
}

/** The body parts that have their own styles. */
export function ownParts({ parts }: AppState): BodyPart[] {
  return BODY_PARTS.filter((part) => parts[part]);
}
