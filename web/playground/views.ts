/**
 * The views of the page beside Play: each is a module of its own that is loaded when it is first shown, so that nobody
 * waits for what they do not use. A new view is a name in `state.ts` and a row in the table here.
 */
import type { Viewer } from "../viewer";
import type { DroppedFile } from "../worker/build/protocol";
import type { Notices } from "./notices";
import type { Session } from "./session";
import type { ViewName } from "./state";
import type { History, Store } from "./store";
import { strings } from "./strings/strings";
import { errorText } from "./words";

/** What a view may ask of the page. */
export interface ViewHost {
  readonly store: Store;
  readonly notices: Notices;
  /** Makes a database the playground's and shows it, by its name in the URL if it is kept here; whether that worked. */
  openDatabase(name: string, file: Blob, kept: boolean): Promise<boolean>;
  /** Moves the 3-D picture into a container of the view's until it is hidden; see `Stage.lend`. */
  borrowPicture(container: HTMLElement): Picture;
  /** Says that {@link View.history} has other things to undo or redo. */
  historyChanged(): void;
  /** What is open in the engine; `undefined` until it is loaded. */
  session(): Session | undefined;
  /** Opens an input by its name in the library. */
  chooseInput(name: string): void;
  /** Fractional input frame at which the motion stands. */
  playhead(): number;
  /** Puts the motion at an input frame. */
  goTo(frame: number): void;
  /** The database that is open: its name for people, and its file unless it is the built-in one. */
  databaseFile(): { name: string; file: Blob | undefined };
  /** Makes a motion the input of Play, and goes there. */
  playMotion(name: string, bytes: ArrayBuffer): Promise<void>;
  /** Goes back to the built-in database. */
  openBuiltIn(): Promise<boolean>;
}

/** The 3-D picture in the hands of a view: after every change it asks for drawing. */
export interface Picture {
  readonly viewer: Viewer;
  invalidate(): void;
  /** Leaves the picture as it is, while something else needs the processor. */
  freeze(frozen: boolean): void;
}

/** A view of the page. */
export interface View {
  /** Fills the page below the top bar. */
  readonly element: HTMLElement;
  /** What undo and redo act upon while the view is shown. */
  readonly history: History;
  show(): void;
  /** Another database or input is open. */
  refresh?(): void;
  /** Afterwards the page takes its picture back. */
  hide(): void;
  /** Takes files that were dropped while the view is shown, or that are its business. */
  takeFiles(files: DroppedFile[]): void;
  dispose(): void;
}

interface ViewModule {
  createView(host: ViewHost): View;
}

/** Every view in the order of the tabs; Play is the page itself. */
export const VIEWS: readonly { name: ViewName; title: string; load?: () => Promise<ViewModule> }[] = [
  { name: "play", title: strings.page.views.play },
  { name: "compare", title: strings.page.views.compare, load: () => import("./compare/compare_view") },
  { name: "walk", title: strings.page.views.walk, load: () => import("./walk/walk_view") },
  {
    name: "key-style",
    title: strings.page.views["key-style"],
    load: () => import("./key_style/key_style_view"),
  },
  { name: "data", title: strings.page.views.data, load: () => import("./data/data_view") },
];

/** Shows one view at a time. */
export class Views {
  readonly #root: HTMLElement;
  readonly #host: ViewHost;
  readonly #made = new Map<ViewName, Promise<View | undefined>>();
  #wanted: ViewName = "play";
  #shown: View | undefined;

  constructor(root: HTMLElement, host: ViewHost) {
    this.#root = root;
    this.#host = host;
  }

  /** Goes to a view; `undefined` for Play, and where the view cannot be loaded. */
  async show(name: ViewName): Promise<View | undefined> {
    this.#wanted = name;
    const view = await this.#make(name);
    if (this.#wanted !== name || this.#shown === view) return view;
    this.#shown?.hide();
    this.#shown?.element.remove();
    this.#shown = view;
    if (view) {
      this.#root.append(view.element);
      view.show();
    }
    return view;
  }

  /** The view that is shown; `undefined` for Play. */
  get shown(): View | undefined {
    return this.#shown;
  }

  dispose(): void {
    for (const view of this.#made.values()) void view.then((made) => made?.dispose());
  }

  #make(name: ViewName): Promise<View | undefined> {
    const made = this.#made.get(name) ?? this.#load(name);
    this.#made.set(name, made);
    return made;
  }

  async #load(name: ViewName): Promise<View | undefined> {
    const load = VIEWS.find((view) => view.name === name)?.load;
    if (!load) return undefined;
    try {
      return (await load()).createView(this.#host);
    } catch (error) {
      this.#made.delete(name);
      this.#host.notices.error(strings.page.viewNotLoaded(errorText(error)));
      this.#host.store.edit({ view: "play" });
      return undefined;
    }
  }
}
