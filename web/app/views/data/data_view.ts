/** The Data view: builds a database from the user's clips in the page. */
import "./data.css";
import { BuildClient } from "../../../client/build/client";
import type { DroppedFile } from "../../../client/build/protocol";
import { type CallOptions, isCancellation } from "../../../client/protocol";
import { button } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { html, saveFile, setAttributes } from "../../../ui/dom";
import type { UndoRedo } from "../../state/history";
import { strings } from "../../strings/strings";
import { filesOfDialog } from "../../ui/dropped_files";
import { askForRoles } from "../../ui/roles_dialog";
import { showScrollCue } from "../../ui/scroll_cue";
import { capitalised, errorText, numberWord } from "../../ui/words";
import type { View, ViewHost } from "../../view";
import { BuildPanel } from "./build_panel";
import type { PublicSet } from "./catalogue";
import { CataloguePanel } from "./catalogue_panel";
import { ClipCollection, type Labelling } from "./clip_collection";
import { ClipsPanel } from "./clips_panel";
import { classTable, concerns, type Row, skeletonKey } from "./corpus";
import { DatabasesPanel } from "./databases_panel";
import { DeviceDatabases, type Placed } from "./device_databases";
import { MannersPanel } from "./manners_panel";
import { ClipPreview } from "./preview";
import { askToReplace } from "./replace_dialog";
import type { SavedDatabase } from "./saved_databases";

const words = strings.data;

export function createView(host: ViewHost): View {
  return new DatabaseView(host);
}

class DatabaseView implements View {
  readonly element: HTMLElement;
  readonly #host: ViewHost;
  readonly #client = new BuildClient();
  readonly #clips: ClipCollection;
  readonly #databases = new DeviceDatabases();
  /** Removes the offer to play with the built database. */
  #takeReady = () => {};
  readonly #files = html("input", { type: "file", multiple: true, hidden: true, accept: ".bvh,.zip,.csv,.strutdb" });
  readonly #folder = html("input", { type: "file", webkitdirectory: true, hidden: true });
  readonly #clipsPanel: ClipsPanel;
  readonly #preview: ClipPreview;
  readonly #build: BuildPanel;
  readonly #manners: MannersPanel;
  readonly #databasesPanel: DatabasesPanel;
  /** Opens the last cleared clips again, until the user adds others. */
  #cleared: ((options: CallOptions) => Promise<void>) | undefined;
  readonly #catalogue = new CataloguePanel((set, files) => this.#takeSet(set, files));
  /** Index of the clip in the preview. */
  #selected: number | undefined;
  #building = false;

  constructor(host: ViewHost) {
    this.#host = host;
    this.#clips = new ClipCollection(this.#client, () => {
      this.#show();
      host.historyChanged();
      host.workChanged();
    });
    this.#preview = new ClipPreview((container) => host.borrowViewer(container));
    this.#clipsPanel = new ClipsPanel(this.#clips, {
      onAddFiles: () => this.#files.click(),
      onAddFolder: () => this.#folder.click(),
      onClear: () => this.#clear(),
      onPattern: (pattern) => void this.#clips.label({ pattern }),
      onSelect: (row) => void this.#select(row),
    });
    this.#build = new BuildPanel({
      onBuild: (name) => void this.#start(name),
      onRoles: (skeleton) => void this.#chooseRoles(skeleton),
    });
    this.#manners = new MannersPanel({
      onShow: ({ action, style }) => this.#clipsPanel.reveal({ action, style }),
      onDivide: (found) => this.#clips.divide(found),
    });
    this.#databasesPanel = new DatabasesPanel({
      onOpen: ({ name, file }) => void host.openDatabase(name, file, this.#databases.isKept(name)),
      onOpenBuiltIn: () => void host.openBuiltIn(),
      onExport: ({ name, file }) => saveFile(`${name}.strutdb`, file),
      onDelete: ({ name }) => void this.#changeDatabases(() => this.#databases.delete(name)),
      onRestore: ({ name }) =>
        void this.#changeDatabases(async () => this.#sayUnkept(await this.#databases.restore(name))),
    });
    this.element = this.#compose();
    this.#files.addEventListener("change", () => this.#takeChosen(this.#files));
    this.#folder.addEventListener("change", () => this.#takeChosen(this.#folder));
    host.store.subscribe((_, changed) => {
      if (changed.has("database")) void this.#changeDatabases(() => this.#databases.load());
    }, host.signal);
    this.#show();
  }

  /** Undo of the edits, and before them of clearing the table. */
  get history(): UndoRedo {
    const { edits } = this.#clips;
    const openAgain = this.#cleared;
    if (!openAgain || edits.canUndo || edits.canRedo) return edits;
    return { canUndo: true, canRedo: false, undo: () => void this.#openAgain(openAgain), redo: () => {} };
  }

  get holdsWork(): boolean {
    return this.#clips.rows.length > 0 || this.#cleared !== undefined || this.#databases.holdsUnkept;
  }

  get holdsUnkept(): boolean {
    return this.#clips.isUnbuilt || this.#databases.hasUnkept;
  }

  show(): void {
    this.#preview.resume();
    this.#catalogue.show();
    void this.#changeDatabases(() => this.#databases.load());
  }

  hide(): void {
    this.#preview.stop();
    this.#takeReady();
  }

  dispose(): void {
    this.#preview.stop();
    this.#build.progress.cancel();
    this.#clipsPanel.dispose();
    this.#catalogue.dispose();
    this.#client.dispose();
  }

  takeFiles(files: DroppedFile[]): void {
    const ending = (pattern: RegExp) => files.filter(({ path }) => pattern.test(path));
    const databases = ending(/\.strutdb$/i);
    const table = ending(/\.csv$/i).at(-1)?.file;
    for (const { path, file } of databases) void this.#host.openDatabase(path.replace(/\.strutdb$/i, ""), file, false);
    if (ending(/\.(bvh|zip)$/i).length > 0) {
      const clips = files.filter(({ path }) => !/\.(strutdb|csv)$/i.test(path));
      this.#cleared = undefined;
      void this.#open(clips, table ? { table } : {});
    } else if (table) void this.#clips.label({ table });
    else if (files.length > 0 && databases.length === 0) this.#host.toasts.error(words.noneOf(files.length));
  }

  #compose(): HTMLElement {
    const empty = html(
      "div",
      { class: "data-empty" },
      icon("drop", 24),
      html("h1", { class: "page-title" }, words.empty.heading),
      html("p", {}, words.empty.what),
      html(
        "div",
        { class: "data-actions" },
        button(words.empty.files, () => this.#files.click(), { icon: "drop", label: true, class: "outlined" }),
        button(words.empty.folder, () => this.#folder.click(), { icon: "folder", label: true, class: "outlined" }),
      ),
      html("p", { class: "caption" }, words.empty.best),
    );
    const panels = html(
      "aside",
      { class: "data-panels", "aria-label": words.build.panels },
      this.#preview.element,
      this.#build.element,
      this.#manners.element,
      this.#databasesPanel.element,
      this.#catalogue.element,
    );
    showScrollCue(panels, this.#host.signal);
    return html("main", { class: "view data" }, empty, this.#clipsPanel.element, panels, this.#files, this.#folder);
  }

  // --- clips ---

  #takeChosen(input: HTMLInputElement): void {
    const files = filesOfDialog(input.files ?? []);
    input.value = "";
    this.takeFiles(files);
  }

  /** Opens a public data set instead of the current clips. */
  #takeSet({ name, pattern, labels }: PublicSet, files: DroppedFile[]): void {
    this.#clear();
    void this.#open(files, {
      ...(pattern !== undefined && { pattern }),
      ...(labels !== undefined && { table: new File([labels], `${name}.csv`) }),
    });
  }

  /** Removes all clips; undo restores them. */
  #clear(): void {
    const hadClips = this.#clips.rows.length > 0;
    this.#clipsPanel.progress.cancel();
    this.#forgetShown();
    const openAgain = this.#clips.clear();
    if (hadClips) this.#cleared = openAgain;
    this.#host.historyChanged();
  }

  #openAgain(open: (options: CallOptions) => Promise<void>): Promise<void> {
    this.#cleared = undefined;
    this.#clipsPanel.progress.cancel();
    return this.#read(async (options) => {
      await open(options);
      return [];
    });
  }

  /** Opens clips and reads them. */
  #open(files: readonly DroppedFile[], labelling: Labelling): Promise<void> {
    return this.#read((options) => this.#clips.open(files, labelling, options));
  }

  /** Reads the clips that `open` opens, and previews the first readable one. */
  async #read(open: (options: CallOptions) => Promise<readonly string[]>): Promise<void> {
    const wereOpen = this.#clips.rows.length > 0;
    this.#forgetShown();
    setAttributes(this.element, { "aria-busy": "true" });
    await this.#attempt(() =>
      this.#clipsPanel.progress.run(words.looking, async (options) => {
        for (const note of await open(options)) this.#host.toasts.error(note);
        if (!wereOpen) await this.#proposeName();
        await this.#clips.read(options);
      }),
    );
    setAttributes(this.element, { "aria-busy": "false" });
    this.#show();
  }

  #forgetShown(): void {
    this.#selected = undefined;
    this.#clipsPanel.reset();
    this.#preview.clear();
  }

  async #proposeName(): Promise<void> {
    await this.#databases.load();
    this.#build.name = this.#databases.freeName(this.#clips.name);
  }

  async #select(row: Row): Promise<void> {
    this.#selected = row.index;
    this.#clipsPanel.selected = row.index;
    const file = row.path.slice(row.path.lastIndexOf("/") + 1);
    const title = row.action && row.style ? words.preview.title(row.action, row.style) : file;
    if (row.fault) {
      this.#preview.fail(title, row.fault);
      return;
    }
    try {
      const clip = await this.#clips.preview(row);
      if (this.#selected === row.index) this.#preview.show(title, clip);
    } catch (error) {
      if (!isCancellation(error) && this.#selected === row.index) this.#preview.fail(title, errorText(error));
    }
  }

  async #chooseRoles(number: number): Promise<void> {
    const { skeletons, rows } = this.#clips;
    const skeleton = skeletons[number];
    const roles =
      skeleton &&
      (await askForRoles({
        joints: skeleton.joints,
        roles: skeleton.chosen ?? skeleton.roles,
        note: skeleton.fault || skeleton.note,
      }));
    if (!roles) return;
    this.#clips.edits.choose(skeletonKey(skeleton), roles);
    const ofSkeleton = rows.filter((row) => row.read?.skeleton === number);
    const shown = ofSkeleton.find((row) => row.index === this.#selected) ?? ofSkeleton[0];
    if (shown) await this.#select(shown);
    this.#show();
  }

  // --- databases ---

  async #start(name: string): Promise<void> {
    if (this.#building) return;
    this.#building = true;
    const place = await this.#placeFor(name);
    if (place) await this.#buildInto(place, name);
    this.#building = false;
    this.#show();
  }

  /** How to save a database: asks if one of that name exists; `undefined` if it is not to be saved. */
  async #placeFor(name: string): Promise<((database: SavedDatabase) => Promise<Placed>) | undefined> {
    await this.#databases.load();
    const present = this.#databases.find(name);
    const answer = present ? await askToReplace(present) : "keep both";
    if (answer === "keep both") return (database) => this.#databases.add(database);
    return answer && ((database) => this.#databases.replace(database));
  }

  async #buildInto(place: (database: SavedDatabase) => Promise<Placed>, name: string): Promise<void> {
    this.#build.busy = true;
    this.#preview.playing = false;
    this.#takeReady();
    const started = performance.now();
    await this.#attempt(() =>
      this.#build.progress.run(words.build.progress, async (options) => {
        const { refused, neutral: _, twoManners: __, doubt: ___, ...built } = await this.#clips.build(options);
        const placed = await place({ name, ...built });
        this.#build.name = placed.name;
        const seconds = ((performance.now() - started) / 1000).toFixed(1);
        const styles = built.styles.length;
        const ready = words.build.ready(capitalised(numberWord(styles)), styles, built.frames, seconds);
        const text = refused.length > 0 ? `${ready} ${words.build.refused(refused.length)}` : ready;
        // Play uses it from now on; the user can continue with the clips here.
        const made = { name: placed.name, file: built.file };
        const opened = await this.#host.openBuilt(made, !placed.unkept, this.#clips.renamed);
        if (opened) {
          const { open, play } = words.build;
          this.#takeReady = this.#host.toasts.offer(`${text} ${open}`, play, () => this.#host.showPlay());
        } else this.#host.toasts.note(text);
        // Opening it removes error messages.
        this.#sayUnkept(placed);
      }),
    );
    this.#build.busy = false;
    this.#preview.playing = true;
    this.#listDatabases();
  }

  #sayUnkept(placed: Placed | undefined): void {
    if (placed?.unkept) this.#host.toasts.error(words.build.unkept(placed.name, placed.unkept));
  }

  async #changeDatabases(change: () => Promise<void>): Promise<void> {
    await this.#attempt(change);
    this.#listDatabases();
  }

  // --- display ---

  #listDatabases(): void {
    const { file } = this.#host.databaseFile();
    this.#databasesPanel.show(this.#databases, { name: this.#host.store.state.database, file });
    this.#host.workChanged();
  }

  #show(): void {
    const { rows, skeletons, usable } = this.#clips;
    this.element.classList.toggle("filled", rows.length > 0);
    this.#manners.show(this.#clips.manners);
    if (rows.length === 0) return;
    const classes = classTable(usable);
    this.#clipsPanel.show(usable, classes);
    this.#build.show({
      usable: this.#building ? 0 : usable.length,
      styles: classes.styles.length,
      skeletons,
      clipsOf: skeletons.map((_, i) => rows.filter((row) => row.read?.skeleton === i).length),
      concerns: concerns(classes),
    });
    const first = this.#selected === undefined && rows.find((row) => row.read);
    if (first) void this.#select(first);
  }

  async #attempt(task: () => Promise<void>): Promise<void> {
    try {
      await task();
    } catch (error) {
      if (!isCancellation(error)) this.#host.toasts.failure(error);
    }
  }
}
