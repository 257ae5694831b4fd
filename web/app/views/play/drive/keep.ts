/** What was driven becomes an input of Play, with a track of the styles that it was shown in. */
import type { StyleKey } from "../../../../client/protocol";
import type { TrackKey } from "../../../../link/play";
import { DRIVE } from "../../../../player/input_library";
import { formatNumber } from "../../../../ui/dom";
import type { Selection } from "../../../../ui/polygon/selection";
import type { ViewHost } from "../../../view";
import { driveWords } from "./strings.en";

/** Keeps it and plays it; whether there was anything to keep. */
export async function keep(host: ViewHost): Promise<boolean> {
  const { session, store, toasts } = host;
  const { database } = session;
  const driven = await session.driven();
  if (!driven || !database) return false;
  if (driven.bvh === "") {
    toasts.note(driveWords.nothing);
    return false;
  }
  const name = freeName((taken) => session.library.has(taken));
  const track = trackOf(driven.track, database.neutral);
  const { proportions, rateHz } = database;
  const exact = { poses: driven.poses, proportions, rateHz };
  await host.playMotion(`${name}.bvh`, new TextEncoder().encode(driven.bvh).buffer, exact);
  if (store.state.input !== name) return false;
  const styles = track.at(-1)?.styles ?? store.state.styles;
  store.edit({ track: track.length > 1 ? track : [], key: Math.max(0, track.length - 1), styles, intensity: 1 });
  const secs = formatNumber(driven.frames / database.rateHz, 1);
  toasts.offer(driveWords.kept(name, secs), driveWords.driveOn, () => void host.chooseInput(DRIVE));
  return true;
}

/** The first name of its kind that no input has. */
function freeName(isTaken: (name: string) => boolean): string {
  let number = 1;
  while (isTaken(driveWords.name(number))) number += 1;
  return driveWords.name(number);
}

/** Weights of the engine as selections of the page: what they lack to 1 is of the neutral style. */
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
