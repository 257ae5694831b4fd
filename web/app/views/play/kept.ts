/** Makes a recording without a timeline an input of Play, with a track of the styles in which it was displayed. */
import type { Driven } from "../../../client/drive/protocol";
import type { StyleKey } from "../../../client/protocol";
import type { TrackKey } from "../../../link/play";
import { formatNumber } from "../../../ui/dom";
import type { Selection } from "../../../ui/polygon/selection";
import type { ViewHost } from "../../view";

/** Texts about the recording. */
interface KeptWords {
  /** The name of the first, the second … */
  name(number: number): string;
  /** Shown if there is nothing to keep. */
  readonly nothing: string;
  kept(name: string, secs: string): string;
  /** Label of the button that continues. */
  readonly goOn: string;
}

/** Keeps and plays it. Returns whether there was anything to keep. */
export async function keepMotion(
  { session, store, toasts, playMotion }: ViewHost,
  made: Driven,
  words: KeptWords,
  goOn: () => void,
): Promise<boolean> {
  const { database } = session;
  if (!database) return false;
  if (made.bvh === "") {
    toasts.note(words.nothing);
    return false;
  }
  const name = freeName(words, (taken) => session.library.has(taken));
  const track = trackOf(made.track, database.neutral);
  const exact = { poses: made.poses, proportions: database.proportions, rateHz: database.rateHz };
  await playMotion(`${name}.bvh`, new TextEncoder().encode(made.bvh).buffer, exact);
  if (store.state.input !== name) return false;
  const styles = track.at(-1)?.styles ?? store.state.styles;
  store.edit({ track: track.length > 1 ? track : [], key: Math.max(0, track.length - 1), styles, intensity: 1 });
  toasts.offer(words.kept(name, formatNumber(made.frames / database.rateHz, 1)), words.goOn, goOn);
  return true;
}

/** The first name of its kind that no input has. */
function freeName(words: KeptWords, isTaken: (name: string) => boolean): string {
  let number = 1;
  while (isTaken(words.name(number))) number += 1;
  return words.name(number);
}

/** The engine's weights as selections of the page: the remainder to 1 is the neutral style's. */
export function trackOf(keys: readonly StyleKey[], neutral: string): TrackKey[] {
  return keys.map(({ frame, styles }) => ({ frame, styles: selectionOf(styles, neutral) }));
}

function selectionOf(weights: Readonly<Record<string, number>>, neutral: string): Selection {
  const others = Object.entries(weights).filter(([name]) => name !== neutral);
  const rest = 1 - others.reduce((sum, [, weight]) => sum + weight, 0);
  const all = [...others, [neutral, Math.round(rest * 1000) / 1000] as const];
  const weighing = all.filter(([, weight]) => weight !== 0);
  return weighing.map(([name, weight]) => ({ name, weight }));
}
