/** What a person may ask of the page by key or by button, beside what a control does by itself. */
import type { KeyActions } from "./keys";
import type { Help } from "./panels/help";
import type { StylePanel } from "./panels/style_panel";
import type { Playhead } from "./playhead";
import { GHOST_MODES, TRACE_MODES } from "./state";
import type { History, Store } from "./store";
import { addKey, otherSide } from "./style_settings";

/** The mode after another one, in turn. */
const after = <T>(mode: T, modes: readonly T[]): T => modes[(modes.indexOf(mode) + 1) % modes.length]!;

/** The commands of a page; `history` gives what undo and redo act upon at the moment. */
export function commandsOf(
  store: Store,
  playhead: Playhead,
  style: StylePanel,
  help: Help,
  history: () => History,
): KeyActions {
  /** Lets the range begin or end at the playhead. */
  const cutRange = (edge: "first" | "last"): void => {
    const frames = playhead.session?.input?.frames ?? 2;
    const range = { first: 0, last: frames - 1, ...store.state.range, [edge]: Math.round(playhead.at) };
    if (range.first < range.last) store.edit({ range });
  };
  return {
    play: () => playhead.togglePlay(),
    frame: (by) => playhead.step(by),
    first: () => playhead.goTo(0),
    last: () => playhead.goTo(Number.MAX_SAFE_INTEGER),
    loop: () => store.edit({ loop: !store.state.loop }),
    ghost: () => store.edit({ ghost: after(store.state.ghost, GHOST_MODES) }),
    trace: () => store.edit({ trace: after(store.state.trace, TRACE_MODES) }),
    follow: () => store.edit({ follow: !store.state.follow }),
    panels: () => store.edit({ panels: !store.state.panels }),
    other: () => store.edit(otherSide(store.state)),
    key: () => store.edit(addKey(store.state, playhead.at)),
    rangeFirst: () => cutRange("first"),
    rangeLast: () => cutRange("last"),
    noRange: () => store.edit({ range: undefined }),
    random: () => style.mixByChance(),
    style: (number) => style.polygon.takeAllOf(style.vertices[number - 1] ?? ""),
    help: () => help.open(),
    undo: () => history().undo(),
    redo: () => history().redo(),
  };
}
