/**
 * What the styles of the state are asked of: the whole body, one part of it, or a key of the style track; two settings
 * side by side; chance. Pure edits of {@link PlayState}.
 */
import type { Role } from "../viewer";
import { BODY_PARTS, type BodyPart, type DatabaseInfo, type StylizeOptions } from "../worker/protocol";
import { engineWeights, normalised, type Selection, TRIANGLE } from "./polygon/selection";
import { fromHash, initialState, type PlayState, type TrackKey, toHash, UNDOABLE } from "./state";

type Patch = Partial<PlayState>;

/** What the engine is asked for in this state. */
export function engineOptions(state: PlayState, neutral: string): StylizeOptions {
  const { k, lambda, rho, kappa, delta, coherence, timing, footplant, method, action, inputStyle, intensity } = state;
  const weights = (styles: Selection) => engineWeights(styles, intensity, neutral);
  const parts = Object.entries(state.parts).map(([part, styles]) => [part, weights(styles)]);
  return {
    styles: weights(state.styles),
    parts: Object.fromEntries(parts),
    track: state.track.map(({ frame, styles }) => ({ frame, styles: weights(styles) })),
    k,
    lambda,
    rho,
    kappa,
    delta,
    coherence,
    timing,
    footplant,
    method,
    action,
    inputStyle,
  };
}

/** The styles that the polygon shows: those of the chosen part, as far as it has its own. */
export function shownStyles({ part, parts, styles }: PlayState): Selection {
  return (part && parts[part]) || styles;
}

/** Gives what the polygon shows other styles: the chosen part, or the whole body at the chosen key. */
export function withStyles(state: PlayState, styles: Selection): Patch {
  const { part, parts, track } = state;
  if (part) return { parts: { ...parts, [part]: styles } };
  const at = chosenKey(state);
  return { styles, track: track.map((key, i) => (i === at ? { ...key, styles } : key)) };
}

/** Lets a part follow the whole body again. */
export function withoutPart({ parts }: PlayState, part: BodyPart): Patch {
  return { parts: Object.fromEntries(Object.entries(parts).filter(([name]) => name !== part)) };
}

/** Number of the chosen key; −1 without a track. */
export function chosenKey({ track, key }: PlayState): number {
  return Math.min(key, track.length - 1);
}

/** Chooses a key: the polygon shows its styles. */
export function chooseKey({ track }: PlayState, key: number): Patch {
  const styles = track[key]?.styles;
  return styles ? { key, styles, part: "" } : {};
}

/** The styles that the track has reached at a frame, as the engine mixes them; those of the state without a track. */
export function stylesAt({ track, styles }: PlayState, frame: number): Selection {
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

/** Puts a key at a frame, in the present styles, and chooses it; where there is one already that is chosen. */
export function addKey(state: PlayState, frame: number): Patch {
  const at = Math.max(0, Math.round(frame));
  const present = state.track.findIndex((key) => key.frame === at);
  if (present >= 0) return chooseKey(state, present);
  const added: TrackKey = { frame: at, styles: state.styles };
  const track = [...state.track, added].sort((a, b) => a.frame - b.frame);
  return { track, key: track.indexOf(added), part: "" };
}

/** Takes a key away and chooses the one before it. */
export function removeKey(state: PlayState, key: number): Patch {
  const track = state.track.filter((_, i) => i !== key);
  const next = Math.max(0, key - 1);
  return { track, key: next, styles: track[next]?.styles ?? state.styles };
}

/** Moves a key to a frame, not past its neighbours. */
export function moveKey({ track }: PlayState, key: number, frame: number): Patch {
  const least = (track[key - 1]?.frame ?? -1) + 1;
  const most = (track[key + 1]?.frame ?? Number.MAX_SAFE_INTEGER) - 1;
  const at = Math.min(most, Math.max(least, Math.round(frame)));
  return { track: track.map((k, i) => (i === key ? { ...k, frame: at } : k)) };
}

/**
 * What changes where a database has only the styles `known`: others are dropped, and `first` is selected where nothing
 * is left. `undefined` where nothing changes.
 */
export function withKnownStyles(state: PlayState, known: readonly string[], first: Selection): Patch | undefined {
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

/** What changes where a database has no class of the labels that the input was given; `undefined` where it has one. */
export function withKnownLabels(
  { action, inputStyle }: PlayState,
  classes: DatabaseInfo["classes"],
): Patch | undefined {
  const known = classes.some((c) => (!action || action === c.action) && (!inputStyle || inputStyle === c.style));
  return known ? undefined : { action: "", inputStyle: "" };
}

/** The fields of which A and B each have their own. */
const SETTING = UNDOABLE.filter((name) => !["database", "input", "side", "other"].includes(name));

function setting(state: PlayState): PlayState {
  return { ...initialState(), ...Object.fromEntries(SETTING.map((name) => [name, state[name]])) };
}

/** Changes between A and B; B begins as a copy of A. */
export function otherSide(state: PlayState): Patch {
  const side = state.side === "a" ? "b" : "a";
  const other = toHash(setting(state));
  if (state.other === "") return { side, other };
  const next = fromHash(state.other);
  return { ...Object.fromEntries(SETTING.map((name) => [name, next[name]])), side, other };
}

/** Three styles and how much of each by chance; `random` gives numbers from 0 to 1. The neutral one is as likely. */
export function randomStyles(styles: readonly string[], random: () => number = Math.random): Selection {
  const left = [...styles];
  const chosen: Selection[number][] = [];
  while (chosen.length < TRIANGLE && left.length > 0) {
    const [name] = left.splice(Math.floor(random() * left.length) % left.length, 1);
    // Exponential shares are spread evenly over the triangle.
    chosen.push({ name: name!, weight: -Math.log(1 - Math.min(random(), 0.999)) });
  }
  return normalised(chosen).map((s) => ({ ...s, weight: Math.round(s.weight * 1000) / 1000 }));
}

/** The least and the greatest intensity at which all weights stay within what the data holds. */
export function plausibleIntensity(styles: Selection): { least: number; most: number } {
  const most = Math.max(...styles.map((s) => s.weight), 0);
  const negative = styles.some((s) => s.weight < 0);
  return { least: 0, most: negative || most <= 0 ? 0 : 1 / most };
}

/** The part of the body that a joint belongs to, as the engine has it. */
export function partOf(joint: Role): BodyPart {
  if (joint === "neck" || joint === "head") return "head";
  if (joint === "spine" || joint === "chest") return "torso";
  if (/_(shoulder|upper_arm|lower_arm|hand)$/.test(joint)) return joint.startsWith("left") ? "left_arm" : "right_arm";
  return "legs";
}

/** The parts that have styles of their own. */
export function ownParts({ parts }: PlayState): BodyPart[] {
  return BODY_PARTS.filter((part) => parts[part]);
}
