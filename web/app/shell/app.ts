/** The app: builds the page around the views, and synchronises it with the state. */

import type { DroppedFile } from "../../client/build/protocol";
import type { StrutClient } from "../../client/client";
import type { FirstSteps } from "../../client/first_steps";
import type { DatabaseSource } from "../../client/protocol";
import type { ViewName } from "../../link/page";
import { applyTheme, isDark, onSystemTheme, opposite } from "../../ui/theme";
import { graphics } from "../../viewer";
import type { Motions } from "../batch/take_motions";
import { Characters } from "../character/characters";
import { embed } from "../embed/embed";
import { ExportLock } from "../outputs/export_lock";
import type { OutputFormat, VideoSize } from "../outputs/formats";
import { launchOutput } from "../outputs/launch";
import type { Projects } from "../project/projects";
import type { UndoRedo } from "../state/history";
import type { AppState } from "../state/state";
import { Store } from "../state/store";
import { strings } from "../strings/strings";
import { announce } from "../ui/announce";
import { focusView } from "../ui/focus_view";
import { LeaveGuard } from "../ui/leave_guard";
import { otherTasks } from "../ui/tasks";
import { RELOAD, Toasts } from "../ui/toasts";
import { errorText, isMissingModule } from "../ui/words";
import type { View, ViewHost } from "../view";
import { DropZone } from "./drop";
import { Help } from "./help";
import type { StrutHook } from "./hook";
import { listenToKeys } from "./keys";
import { AddressBar, stateOfLink } from "./links";
import { SessionFiles } from "./session_files";
import { SessionProgressLines } from "./session_progress";
import { shareLink } from "./share";
import { SharedViewer } from "./shared_viewer";
import { SingleKeys } from "./single_keys";
import { TopBar } from "./top_bar";
import { VIEWS, viewEntry } from "./view_table";
import { Views } from "./views";
import { Workspace } from "./workspace";

export class App {
  /** The link that the page was opened with. */
  readonly #hash = location.hash;
  readonly #store = new Store(stateOfLink(this.#hash));
  readonly #toasts = new Toasts(() => this.#views.shown?.element);
  readonly #progress = new SessionProgressLines();
  readonly #singleKeys = new SingleKeys();
  readonly #help = new Help(this.#singleKeys);
  readonly #address = new AddressBar(this.#store);
  readonly #listening = new AbortController();
  readonly #guard = new LeaveGuard();
  readonly #root: HTMLElement;
  readonly #workspace: Workspace;
  readonly #viewer: SharedViewer;
  readonly #topBar: TopBar;
  readonly #exports: ExportLock;
  readonly #drop: DropZone;
  readonly #characters: Characters;
  readonly #views: Views;
  /** The dropped files, kept for a reload. */
  readonly #files: SessionFiles;
  /** Opens and saves projects; loaded on first use. */
  #projects: Promise<Projects> | undefined;
  /** Handles several motions at once; loaded on first use. */
  #motions: Promise<Motions> | undefined;

  readonly #firstSteps: Promise<FirstSteps> | undefined;
  /** Settles the promise for which dropped files wait. */
  #started = () => {};
  /** Removes the message shown while the WebGL context is lost. */
  #pictureBack = () => {};

  /** @param firstSteps the clip that is shown until the engine is loaded, if the page starts with it */
  constructor(root: HTMLElement, client: StrutClient, firstSteps: Promise<FirstSteps> | undefined) {
    this.#firstSteps = firstSteps;
    const store = this.#store;
    const { signal } = this.#listening;
    applyTheme(store.state.theme);
    this.#root = root;
    this.#workspace = new Workspace(client, store, this.#toasts, this.#progress);
    this.#viewer = new SharedViewer(isDark(store.state.theme) ? "dark" : "light", (lost) => this.#onPicture(lost));
    this.#characters = new Characters(this.#toasts, this.#progress.character, () => {
      this.#views.shown?.refresh?.();
      this.#files.changed();
    });
    const { session, databases } = this.#workspace;
    this.#files = new SessionFiles({ library: session.library, databases, characters: this.#characters }, this.#toasts);
    session.library.onChange = () => this.#files.changed();
    this.#topBar = new TopBar({
      onView: (view) => store.edit({ view }),
      onReach: (view) => void this.#prepare(view),
      onUndo: () => this.#undo(),
      onRedo: () => this.#history.redo(),
      onOpen: () => this.#drop.choose(),
      onSave: () => void this.#project((projects) => projects.save()),
      onForget: () => void this.#project((projects) => projects.forget()),
      onShare: () =>
        void shareLink(store.state, session.library, this.#toasts, () => void this.#project((all) => all.save())),
      onEmbed: () => void this.#embed(),
      onExport: (format, size) => void this.#export(format, size),
      onTheme: () => store.edit({ theme: opposite(store.state.theme) }),
      onHelp: () => this.#help.open(),
    });
    this.#exports = new ExportLock((can) => {
      this.#topBar.canExport = can;
    });
    this.#files.onChange = () => {
      this.#topBar.kept = this.#files.size;
      this.#guardWork();
    };
    this.#drop = new DropZone(
      {
        takes: () => viewEntry(store.state.view).takes,
        onMotion: (file) => void this.#workspace.takeFile(file),
        onModel: (file, beside) => void this.#takeModel(file, beside),
        onDatabase: (name, file) => void this.#openDatabase({ kind: "strutdb", name, file }, ""),
        onProject: (file) => void this.#project((projects) => projects.open(file)),
        onStyle: (file) => void this.#workspace.databases.addStyle(file, this.#progress.database),
        styleTarget: () => this.#views.shown?.styleTarget,
        onClips: (files) => void this.#takeClips(files),
        onRefused: (sentence) => this.#toasts.error(sentence),
      },
      new Promise((resolve) => {
        this.#started = resolve;
      }),
      signal,
    );
    // The placeholders of index.html stay until there is a view.
    const shell = root.querySelectorAll(".shell");
    root.replaceChildren(this.#topBar.element, ...shell, this.#toasts.element, this.#drop.element, this.#help.element);
    this.#views = new Views(
      (element) => {
        for (const box of shell) box.remove();
        this.#topBar.element.after(element);
      },
      {
        host: (life) => this.#hostOf(life),
        onShow: (name, view, first) => this.#onView(name, view, first),
        onRefused: (name, error) => this.#onRefused(name, error),
      },
      VIEWS,
    );
    session.listen({
      onDatabase: () => this.#files.changed(),
      onTick: (now) => {
        // If nothing can be drawn, nothing must wait for drawing.
        if (this.#viewer.draw(now) || graphics() === "none") session.drawn();
      },
      onInput: () => {
        this.#exports.inputOpened();
        this.#toasts.clearErrors();
        this.#views.shown?.refresh?.();
      },
    });
    store.subscribe((_, changed) => this.#onChange(changed), signal);
    onSystemTheme(() => this.#applyTheme(), signal);
    addEventListener("popstate", () => this.#address.leave(), { signal });
    addEventListener("pagehide", () => this.#address.flush(), { signal });
    addEventListener("hashchange", ({ newURL }) => this.#followLink(new URL(newURL).hash), { signal });
    listenToKeys(
      {
        undo: () => this.#undo(),
        redo: () => this.#history.redo(),
        help: () => this.#help.open(),
        open: () => this.#drop.choose(),
        save: () => void this.#project((projects) => projects.save()),
        view: () => this.#views.shown?.keys,
        singleKeys: () => this.#singleKeys.on,
      },
      signal,
    );
    this.#showTopBar();
  }

  /** Shows the view of the link, opens what the link names, and starts playback. */
  async start(): Promise<void> {
    try {
      await Promise.all([this.#startWork(), this.#showFirstView()]);
    } finally {
      this.#started();
    }
  }

  async #startWork(): Promise<void> {
    const restored = await this.#files.restore();
    await this.#workspace.start(this.#hash, this.#firstSteps);
    await restored.character();
  }

  /** Opens files from outside the page as if they had been dropped. */
  open(files: Iterable<File>): void {
    this.#drop.take(files);
  }

  /** Offers a newer version of the page; `update` switches to it. */
  offerUpdate(update: () => void): void {
    const { ready, action } = strings.page.update;
    this.#toasts.offer(ready, action, update);
  }

  /** Asks whether files that were sent to the page are opened. */
  offerFiles(files: readonly File[]): void {
    if (files.length === 0) return;
    const { sent, open } = strings.page.sentFiles;
    this.#toasts.offer(sent(files.map(({ name }) => name)), open, () => this.open(files));
  }

  /** Loads and shows tooltips for keyboard and touch. */
  async showTips(): Promise<void> {
    const { showTips } = await import("../ui/tips");
    if (!this.#listening.signal.aborted) showTips(this.#listening.signal);
  }

  /** Shows why the engine could not be loaded; the page stays unchanged. */
  fail(error: unknown): void {
    this.#toasts.failure(error);
  }

  /** The displayed state, for scripts. */
  get hook(): StrutHook {
    const workspace = this.#workspace;
    const { session } = workspace;
    const store = this.#store;
    const viewer = this.#viewer;
    return {
      get frame() {
        return session.frame;
      },
      get state() {
        return store.state;
      },
      get upToDate() {
        return workspace.upToDate;
      },
      get analysed() {
        return workspace.opened && session.analysed;
      },
      jointScreenPosition: (role) => viewer.jointPosition(role),
      groundScreenPosition: (x, z) => viewer.groundPosition(x, z),
    };
  }

  dispose(): void {
    this.#listening.abort();
    this.#guard.needed = false;
    this.#files.dispose();
    void this.#motions?.then((motions) => motions.dispose());
    this.#address.dispose();
    this.#views.dispose();
    this.#workspace.dispose();
    this.#viewer.dispose();
    this.#characters.dispose();
    this.#root.replaceChildren();
  }

  #hostOf(signal: AbortSignal): ViewHost {
    const { session, playhead, databases } = this.#workspace;
    return {
      store: this.#store,
      toasts: this.#toasts,
      session,
      playhead,
      progress: this.#progress,
      signal,
      openDatabase: (name, file, kept) => this.#openDatabase({ kind: "strutdb", name, file }, kept ? name : ""),
      openBuiltIn: () => this.#openDatabase({ kind: "demo" }, ""),
      databaseFile: () => databases.file,
      performing: () => this.#characters.performing,
      leaveCharacter: () => this.#characters.leave(),
      checkJoints: () => void this.#characters.checkJoints(),
      borrowViewer: (container) => this.#viewer.borrow(container),
      singleKeys: () => this.#singleKeys.on,
      historyChanged: () => this.#showTopBar(),
      workChanged: () => this.#guardWork(),
      chooseInput: (name) => this.#workspace.chooseInput(name),
      removeInput: () => this.#attempt(() => this.#workspace.removeInput()),
      chooseClip: (clip) => this.#workspace.chooseClip(clip),
      openBuilt: (database, kept, renamed) => databases.openBuilt(database, kept, renamed),
      showPlay: () => this.#store.edit({ view: "play" }),
      readAs: (reading) => this.#workspace.readAs(reading),
      chooseFile: () => this.#drop.choose(),
      chooseStyle: () => this.#drop.chooseStyle(),
      tryRecorded: () => this.#attempt(() => this.#tryRecorded()),
      playMotion: async (name, bytes, exact) => {
        this.#store.edit({ view: "play" });
        await this.#workspace.takeMotion(name, bytes, exact);
      },
    };
  }

  // --- from the state ---

  #onChange(changed: ReadonlySet<keyof AppState>): void {
    if (changed.has("theme")) this.#applyTheme();
    if (changed.has("view")) this.#showView();
    else this.#showTopBar();
    this.#address.write();
  }

  /** Creates the picture and the view in separate tasks: together they would block the page. */
  async #showFirstView(): Promise<void> {
    await otherTasks();
    if (this.#store.state.view === "play" && graphics() !== "none") {
      this.#viewer.make();
      await otherTasks();
    }
    this.#showView();
  }

  #showView(): void {
    const { view } = this.#store.state;
    if (graphics() === "none" && !viewEntry(view).flat) {
      this.#toasts.error(strings.page.noWebGl, { lasts: true });
      this.#address.redirect({ view: "learn" });
      return;
    }
    this.#showTopBar();
    void this.#views.show(view);
  }

  /** Starts to load a view that is likely to be shown next. Errors are reported when it is shown. */
  async #prepare(name: ViewName): Promise<void> {
    try {
      (await viewEntry(name).load()).prepare?.(this.#store.state);
    } catch {}
  }

  #onView(name: ViewName, view: View, first: boolean): void {
    const { title } = viewEntry(name);
    this.#root.dataset.view = name;
    document.title = strings.page.title(title);
    this.#showTopBar();
    if (first) return;
    announce(strings.page.viewShown(title));
    focusView(view.element);
  }

  #onRefused(name: ViewName, error: unknown): void {
    const again = { label: strings.page.tryAgain, act: () => this.#store.edit({ view: name }) };
    const text = navigator.onLine
      ? strings.page.viewNotLoaded(isMissingModule(error) ? "" : errorText(error))
      : strings.page.viewOffline;
    this.#toasts.error(text, { action: navigator.onLine ? RELOAD : again });
    if (name !== "play") this.#address.redirect({ view: "play" });
  }

  /** The WebGL context was lost, or restored. */
  #onPicture(lost: boolean): void {
    this.#pictureBack();
    if (lost) this.#pictureBack = this.#toasts.error(strings.page.pictureLost, { lasts: true, action: RELOAD });
  }

  #showTopBar(): void {
    const { view, theme } = this.#store.state;
    const { canUndo, canRedo } = this.#history;
    this.#topBar.show({ view, canUndo, canRedo, dark: isDark(theme) });
  }

  #applyTheme(): void {
    const { theme } = this.#store.state;
    applyTheme(theme);
    this.#viewer.theme = isDark(theme) ? "dark" : "light";
    this.#showTopBar();
  }

  /** Makes the browser ask before the page is left, if that would lose work. */
  #guardWork(): void {
    this.#guard.needed = this.#views.holdUnkept || this.#files.unkept;
  }

  /** Undoes the last edit, or the choice of an input that is still being opened. */
  #undo(): void {
    if (!this.#workspace.cancelChoice()) this.#history.undo();
  }

  get #history(): UndoRedo {
    return this.#views.shown?.history ?? this.#store;
  }

  // --- from the user ---

  #followLink(hash: string): void {
    void this.#workspace.arrive(this.#address.arrive(hash), hash);
  }

  async #openDatabase(source: DatabaseSource, kept: string): Promise<boolean> {
    return this.#workspace.databases.open(source, kept);
  }

  /** Passes clips to the view if it accepts them; otherwise asks the user what they are for. */
  async #takeClips(files: DroppedFile[]): Promise<void> {
    await this.#attempt(async () => {
      const [only, ...others] = files;
      if (only && others.length === 0 && /\.zip$/i.test(only.path)) {
        const { modelIn } = await import("../character/models_of_archive");
        const found = await modelIn(only.file);
        if (found) return this.#takeModel(found.model, found.beside);
      }
      // A table of labels or a database among the files answers the question.
      const isSaid = files.some(({ path }) => /\.(csv|strutdb)$/i.test(path));
      if (viewEntry(this.#store.state.view).takes || isSaid) await this.#showClips(files);
      else (await this.#loadMotions()).take(files);
    });
  }

  /** Offers clips of public data sets as inputs. */
  async #tryRecorded(): Promise<void> {
    const { askForRecorded } = await import("../views/data/recorded/recorded_dialog");
    const chosen = await askForRecorded();
    if (chosen === "data") this.#store.edit({ view: "data" });
    else if (chosen) {
      const { file, citation } = chosen;
      await this.#workspace.takeFile(file);
      this.#toasts.note(strings.data.sets.cite(citation));
    }
  }

  #loadMotions(): Promise<Motions> {
    const { session } = this.#workspace;
    this.#motions ??= import("../batch/take_motions").then(
      ({ Motions }) =>
        new Motions({
          store: this.#store,
          session,
          toasts: this.#toasts,
          input: this.#progress.input,
          root: this.#root,
          asInputs: async (motions) => {
            this.#store.edit({ view: "play" });
            await this.#workspace.takeMotions(motions);
          },
          asDatabase: (files) => this.#showClips(files),
        }),
    );
    return this.#motions.catch((error: unknown) => {
      this.#motions = undefined;
      throw error;
    });
  }

  async #showClips(files: DroppedFile[]): Promise<void> {
    const { view: shown } = this.#store.state;
    const view = viewEntry(shown).takes ? shown : "data";
    this.#store.edit({ view });
    (await this.#views.show(view))?.takeFiles?.(files);
  }

  /** Opens a character in Play, or the motions of its file. */
  async #takeModel(file: File, beside: readonly DroppedFile[]): Promise<void> {
    this.#store.edit({ view: "play" });
    const motions = await this.#characters.open(file, beside);
    await this.#workspace.takeMotions(motions);
    const others = motions.length - 1;
    if (others > 0) this.#toasts.note(strings.page.characters.otherMotions(others));
  }

  /** Runs an action on projects; its code is loaded on first use. */
  async #project(act: (projects: Projects) => Promise<void>): Promise<void> {
    const workspace = this.#workspace;
    const { session, databases } = workspace;
    this.#projects ??= import("../project/projects").then(
      ({ Projects }) =>
        new Projects(
          {
            store: this.#store,
            session,
            databases,
            characters: this.#characters,
            toasts: this.#toasts,
            arrive: (state) => workspace.arrive(state, ""),
          },
          this.#root,
        ),
    );
    const loaded = this.#projects.catch((error: unknown) => {
      // The next attempt may succeed.
      this.#projects = undefined;
      throw error;
    });
    await this.#attempt(async () => act(await loaded));
    this.#views.shown?.refresh?.();
  }

  /** Runs an action whose code may not be loaded yet, and reports an error if it cannot be loaded. */
  async #attempt(task: () => Promise<void>): Promise<void> {
    try {
      await task();
    } catch (error) {
      this.#toasts.failure(error);
    }
  }

  async #embed(): Promise<void> {
    const { session } = this.#workspace;
    const { state } = this.#store;
    // Without a GPU two figures would wait for each other.
    this.#viewer.rests = true;
    await embed({
      state,
      library: session.library,
      neutral: session.database?.neutral ?? "",
      hasCharacter: this.#characters.performing !== undefined,
      hasOwnDatabase: session.databaseSource?.kind === "strutdb",
      onPoster: () => void this.#export("png", "as on screen"),
      onClose: () => {
        this.#viewer.rests = false;
      },
    }).catch((error: unknown) => {
      this.#viewer.rests = false;
      this.#toasts.failure(error);
    });
  }

  async #export(format: OutputFormat, size: VideoSize): Promise<void> {
    const { session, playhead } = this.#workspace;
    const keep = this.#views.shown?.keep?.bind(this.#views.shown);
    if (format !== "png" && keep && !(await keep())) return;
    await this.#exports.run(() =>
      launchOutput(format, size, {
        session,
        playhead,
        store: this.#store,
        pictures: this.#viewer,
        characterGlb: (motion) => this.#characters.glb(motion),
        toasts: this.#toasts,
        progress: this.#progress.database,
      }),
    );
  }
}
