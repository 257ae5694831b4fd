/** Keyboard shortcuts of the Play view. */

import { GHOST_MODES, TRACE_MODES } from "../../../link/play";
import type { Session } from "../../../player/session";
import type { Playhead } from "../../state/playhead";
import type { Store } from "../../state/store";
import { addKey, otherSide } from "../../state/style_settings";
import type { KeyTable } from "../../view";
import type { StylePanel } from "./style_panel";
import { type Edge, trimOf, withEdge } from "./timeline/trim";

/** The next mode, cyclically. */
const after = <T>(mode: T, modes: readonly T[]): T => modes[(modes.indexOf(mode) + 1) % modes.length]!;

/** Digits that select one style, clockwise from the top. */
const DIGITS = [1, 2, 3, 4, 5, 6, 7, 8, 9];

/** Keys that are not used without a timeline. */
const OF_TIME = [" ", "ArrowLeft", "ArrowRight", "Home", "End", "l", "k", "i", "o", "u"];

/** The keys of Play while driving, or during a live performance. */
export function keysWithoutTime(keys: KeyTable): KeyTable {
  return Object.fromEntries(Object.entries(keys).filter(([key]) => !OF_TIME.includes(key)));
}

export function keysOf(store: Store, session: Session, playhead: Playhead, style: StylePanel) {
  /** Moves an end of the trim to the playhead; beyond the other end it does nothing. */
  const cutRange = (edge: Edge): void => {
    const frames = session.input?.frames ?? 2;
    const { first, last } = trimOf(store.state.range, frames);
    const at = Math.round(playhead.at);
    if (edge === "first" ? at < last : at > first)
      store.edit({ range: withEdge(store.state.range, edge, playhead.at, frames) });
  };
  const ofStyle = (number: number) => () => style.polygon.takeAllOf(style.vertices[number - 1] ?? "");
  return {
    " ": () => playhead.togglePlay(),
    ArrowLeft: () => playhead.step(-1),
    ArrowRight: () => playhead.step(1),
    Home: () => playhead.goTo(0),
    End: () => playhead.goTo(Number.MAX_SAFE_INTEGER),
    l: () => store.edit({ loop: !store.state.loop }),
    g: () => store.edit({ ghost: after(store.state.ghost, GHOST_MODES) }),
    t: () => store.edit({ trace: after(store.state.trace, TRACE_MODES) }),
    f: () => store.edit({ follow: !store.state.follow }),
    a: () => store.edit({ atlas: store.state.atlas === "" ? "whole" : "" }),
    h: () => store.edit({ panels: !store.state.panels }),
    x: () => store.edit(otherSide(store.state)),
    r: () => style.mixByChance(),
    k: () => store.edit(addKey(store.state, playhead.at)),
    i: () => cutRange("first"),
    o: () => cutRange("last"),
    u: () => store.edit({ range: undefined }),
    ...Object.fromEntries(DIGITS.map((number) => [String(number), ofStyle(number)])),
  } satisfies KeyTable;
}
