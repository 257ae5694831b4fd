/** Shows one view at a time. Each is made when it is shown, and disposed of after being hidden for a while. */

import type { ViewName } from "../../link/page";
import { otherTasks } from "../ui/tasks";
import type { View, ViewHost } from "../view";
import type { ViewEntry } from "./view_table";

/** A view hidden for this time is disposed of: it may hold a graphics context, a worker and recordings. */
const DISPOSE_MS = 60_000;

/** The views, and how each is loaded. */
type ViewTable = readonly Pick<ViewEntry, "name" | "load">[];

interface ViewsListeners {
  /** Makes the host of a view that lives until `signal` aborts. */
  host: (signal: AbortSignal) => ViewHost;
  /** Called when another view is shown; `first` if there was none before. */
  onShow: (name: ViewName, view: View, first: boolean) => void;
  /** Called when the code of a view could not be loaded, or the view could not be made. */
  onRefused: (name: ViewName, error: unknown) => void;
}

/** A view that exists or is being made. */
interface Made {
  view: Promise<View | undefined>;
  life: AbortController;
  timer?: ReturnType<typeof setTimeout>;
}

export class Views {
  readonly #listeners: ViewsListeners;
  readonly #table: ViewTable;
  /** Adds the element of a view to the page. */
  readonly #place: (element: HTMLElement) => void;
  readonly #made = new Map<ViewName, Made>();
  /** The existing views. */
  readonly #alive = new Set<View>();
  #wanted: ViewName | undefined;
  #shown: { name: ViewName; view: View } | undefined;

  constructor(place: (element: HTMLElement) => void, listeners: ViewsListeners, table: ViewTable) {
    this.#place = place;
    this.#listeners = listeners;
    this.#table = table;
  }

  /** Shows a view; `undefined` if it cannot be loaded. */
  async show(name: ViewName): Promise<View | undefined> {
    this.#wanted = name;
    const view = await this.#make(name);
    if (this.#wanted !== name || !view || this.#shown?.view === view) return view;
    const before = this.#shown;
    if (before) {
      before.view.hide();
      before.view.element.remove();
      this.#disposeLater(before.name);
    }
    this.#shown = { name, view };
    clearTimeout(this.#made.get(name)?.timer);
    this.#place(view.element);
    view.show();
    this.#listeners.onShow(name, view, before === undefined);
    return view;
  }

  /** The current view; `undefined` until the first one is made. */
  get shown(): View | undefined {
    return this.#shown?.view;
  }

  /** Whether leaving the page would lose the user's work in any view. */
  get holdUnkept(): boolean {
    return [...this.#alive].some((view) => view.holdsUnkept);
  }

  dispose(): void {
    this.#wanted = undefined;
    this.#shown = undefined;
    for (const name of [...this.#made.keys()]) void this.#dispose(name);
  }

  #make(name: ViewName): Promise<View | undefined> {
    const made = this.#made.get(name);
    if (made) return made.view;
    const life = new AbortController();
    const view = this.#load(name, life);
    this.#made.set(name, { view, life });
    return view;
  }

  async #load(name: ViewName, life: AbortController): Promise<View | undefined> {
    try {
      const entry = this.#table.find((view) => view.name === name)!;
      const view = (await entry.load()).createView(this.#listeners.host(life.signal));
      this.#alive.add(view);
      // Making a view and adding it to the page each take long enough for a task of their own.
      await otherTasks();
      return view;
    } catch (error) {
      // Cancels everything that the view started before it failed.
      life.abort();
      this.#made.delete(name);
      this.#listeners.onRefused(name, error);
      return undefined;
    }
  }

  #disposeLater(name: ViewName): void {
    const made = this.#made.get(name);
    if (!made) return;
    clearTimeout(made.timer);
    made.timer = setTimeout(async () => {
      const view = await made.view;
      if (this.#shown?.view === view) return;
      if (view?.holdsWork) this.#disposeLater(name);
      else await this.#dispose(name);
    }, DISPOSE_MS);
  }

  async #dispose(name: ViewName): Promise<void> {
    const made = this.#made.get(name);
    if (!made) return;
    this.#made.delete(name);
    clearTimeout(made.timer);
    const view = await made.view;
    made.life.abort();
    if (!view) return;
    this.#alive.delete(view);
    view.dispose();
    view.element.remove();
  }
}
