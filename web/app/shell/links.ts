/** The state in the address bar and in links; a link may carry a small input file. */

import { linkFile } from "../../link/linked_file";
import type { InputLibrary } from "../../player/input_library";
import { prefersReducedMotion } from "../../ui/media";
import { type AppState, fromHash, toHash } from "../state/state";
import type { Store } from "../state/store";

/** Shortest time between two changes of the URL: browsers limit how often a page may change it. */
const WRITE_MS = 200;

/** The state in a link. Playback does not start by itself if the user prefers reduced motion. */
export function stateOfLink(hash: string, reducedMotion = prefersReducedMotion()): AppState {
  const state = fromHash(hash);
  return reducedMotion ? { ...state, playing: false } : state;
}

/** The part of the browser's history that is needed. */
type BrowserHistory = Pick<History, "state" | "pushState" | "replaceState">;

/**
 * State of an entry in the browser's history. Entries with the same `link` come from one opened link: they differ by
 * view or by lesson.
 */
interface Entry {
  link: number;
}

/** The fields that have a history entry of their own: view and lesson. */
type Place = Pick<AppState, "view" | "lesson">;

const isSamePlace = (a: Place, b: Place): boolean => a.view === b.view && (a.view !== "learn" || a.lesson === b.lesson);

/**
 * Synchronises the address bar with the state. A change of view or lesson adds a history entry, so that Back returns to
 * the previous one.
 */
export class AddressBar {
  readonly #store: Store;
  readonly #history: BrowserHistory;
  /** Runs for {@link WRITE_MS} after a change of the URL. */
  #timer: ReturnType<typeof setTimeout> | undefined;
  /** Whether the state changed while the timer ran. */
  #late = false;
  /** The state of the current history entry. */
  #state: Readonly<AppState>;
  #link: number;

  constructor(store: Store, browserHistory: BrowserHistory = history) {
    this.#store = store;
    this.#history = browserHistory;
    this.#state = store.state;
    this.#link = entryOf(browserHistory.state)?.link ?? Date.now();
    this.#claim();
  }

  /**
   * Changes the state without a new history entry, if the view or lesson of the current entry cannot be shown.
   * Otherwise Back would return to it, and leave it again, forever.
   */
  redirect(change: Partial<AppState>): void {
    this.#state = { ...this.#state, ...change };
    this.#store.edit(change);
    this.#replace();
  }

  /**
   * Writes the state, at once unless it was written recently: a reload must restore the last change. A change of view
   * or lesson adds a history entry.
   */
  write(): void {
    const { state } = this.#store;
    if (!isSamePlace(state, this.#state)) {
      this.#stopTimer();
      this.#replace();
      this.#state = state;
      this.#history.pushState(this.#entry, "", addressOf(state));
      return;
    }
    this.#state = state;
    if (this.#timer !== undefined) {
      this.#late = true;
      return;
    }
    this.#replace();
    this.#startTimer();
  }

  /** Writes pending changes, as the page may be closed. */
  flush(): void {
    if (!this.#late) return;
    this.#stopTimer();
    this.#replace();
  }

  /**
   * Handles a `popstate`: another entry is the current one, and its `hashchange` will follow. Until then no state
   * belongs to it.
   */
  leave(): void {
    this.#stopTimer();
  }

  /**
   * Handles a `hashchange`: Back, Forward, or a link entered in the address bar.
   * @returns the fields to change: within the entries of one link only the view, and the lesson if it differs;
   * otherwise all fields
   */
  arrive(hash: string): Partial<AppState> {
    this.#stopTimer();
    const entry = entryOf(this.#history.state);
    const linked = stateOfLink(hash);
    const within = entry?.link === this.#link;
    this.#link = entry?.link ?? Date.now();
    this.#claim();
    const arrived = within ? this.#placeOf(linked) : linked;
    // This entry already exists: the following edit must not add another one.
    this.#state = { ...this.#store.state, ...arrived };
    this.#late = true;
    this.#startTimer();
    return arrived;
  }

  dispose(): void {
    this.#stopTimer();
  }

  #startTimer(): void {
    this.#timer = setTimeout(() => {
      const late = this.#late;
      this.#stopTimer();
      if (!late) return;
      this.#replace();
      this.#startTimer();
    }, WRITE_MS);
  }

  #stopTimer(): void {
    clearTimeout(this.#timer);
    this.#timer = undefined;
    this.#late = false;
  }

  #placeOf({ view, lesson, beat }: AppState): Partial<AppState> {
    if (view !== "learn" || lesson === this.#store.state.lesson) return { view };
    return { view, lesson, beat, task: "", figures: "" };
  }

  get #entry(): Entry {
    return { link: this.#link };
  }

  /** Marks the current entry as the page's own. */
  #claim(): void {
    this.#history.replaceState(this.#entry, "");
  }

  #replace(): void {
    // A link was followed, and its `hashchange` will follow: its address must not be overwritten.
    if (!entryOf(this.#history.state)) return;
    this.#history.replaceState(this.#entry, "", addressOf(this.#state));
  }
}

function entryOf(state: unknown): Entry | undefined {
  const { link } = (state ?? {}) as Partial<Entry>;
  return typeof link === "number" ? { link } : undefined;
}

/** The relative URL of a state. */
function addressOf(state: AppState): string {
  const hash = toHash(state);
  return hash ? `#${hash}` : location.pathname + location.search;
}

/** A link to the displayed state, and whether it contains the dropped motion; `undefined` if there is no motion to include. */
export async function linkTo(
  state: AppState,
  library: InputLibrary,
  page: string,
): Promise<{ href: string; carried: boolean | undefined }> {
  const url = new URL(page);
  url.hash = toHash(state);
  const dropped = library.file(state.input);
  if (!dropped) return { href: url.href, carried: undefined };
  const file = await linkFile({ name: state.input, bytes: await dropped.file.arrayBuffer() });
  if (file) url.hash += `&${file}`;
  return { href: url.href, carried: file !== undefined };
}
