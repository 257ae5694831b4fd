/** The Data view: anyone's clips become a database, here in the page. */
import "../styles/data.css";
import { createBuildClient } from "../../worker/build/client";
import type { BuildClient, DroppedFile } from "../../worker/build/protocol";
import { button } from "../controls/buttons";
import { icon } from "../controls/icons";
import { html, saveFile, setAttributes, setText } from "../dom";
import { filesOfDialog } from "../dropped";
import { ProgressLine } from "../progress";
import { strings } from "../strings/strings";
import type { View, ViewHost } from "../views";
import { capitalised, errorText, isCancellation, numberWord } from "../words";
import { BuildPanel } from "./build_panel";
import type { PublicSet } from "./catalogue";
import { CataloguePanel } from "./catalogue_panel";
import { ClipList } from "./clip_list";
import {
  applyLabels,
  applyNews,
  classTable,
  concerns,
  databaseName,
  type KnownSkeleton,
  type LabelField,
  likelyNeutral,
  obstacle,
  type Row,
  rowOf,
} from "./corpus";
import { Edits } from "./edits";
import { type ClassFilter, Matrix } from "./matrix";
import { ClipPreview } from "./preview";
import { askForRoles } from "./roles_dialog";
import { forget, keep, listShelf, type Shelved } from "./shelf";
import { ShelfPanel } from "./shelf_panel";

const words = strings.data;

export function createView(host: ViewHost): View {
  return new DataOfAnyone(host);
}

/** What the list is narrowed to. */
type Filter = ClassFilter | "left out" | undefined;

class DataOfAnyone implements View {
  readonly element: HTMLElement;
  readonly history: Edits;
  readonly #host: ViewHost;
  readonly #client: BuildClient = createBuildClient();
  readonly #reading = new ProgressLine();
  readonly #heading = html("h1", { class: "page-title" });
  readonly #summary = html("p", { class: "caption data-summary" });
  readonly #pattern = html("input", { type: "text", class: "text", "aria-label": words.names.pattern });
  readonly #patternNote = html("p", { class: "caption", role: "status" });
  readonly #leftOut: HTMLButtonElement;
  readonly #files = html("input", { type: "file", multiple: true, hidden: true, accept: ".bvh,.zip,.csv,.strutdb" });
  readonly #folder = html("input", { type: "file", webkitdirectory: true, hidden: true });
  readonly #matrix: Matrix;
  readonly #list: ClipList;
  readonly #preview: ClipPreview;
  readonly #build: BuildPanel;
  readonly #shelf: ShelfPanel;
  readonly #catalogue = new CataloguePanel((set, files) => this.#takeSet(set, files));
  readonly #unsubscribe: () => void;
  #dropped: DroppedFile[] = [];
  #rows: Row[] = [];
  #skeletons: KnownSkeleton[] = [];
  #table: File | undefined;
  #neutral = "";
  #filter: Filter;
  #selected: number | undefined;
  /** Databases that the browser would not keep: they last as long as the page. */
  readonly #unkept = new Map<string, Shelved>();
  #building = false;

  constructor(host: ViewHost) {
    this.#host = host;
    this.history = new Edits(() => {
      this.#chooseNeutral();
      this.#show();
      host.historyChanged();
    });
    this.#preview = new ClipPreview((container) => host.borrowPicture(container));
    this.#matrix = new Matrix({
      onNeutral: (style) => {
        this.#neutral = style;
        this.#show();
      },
      onFilter: (filter) => this.#narrow(filter),
      onRename: (field, from, to) => this.#rename(field, from, to),
    });
    this.#list = new ClipList({
      onSelect: (row) => void this.#select(row),
      onEdit: (row, field, value) => this.#edit(row, field, value),
    });
    this.#build = new BuildPanel({
      onBuild: (name) => void this.#start(name),
      onRoles: (skeleton) => void this.#chooseRoles(skeleton),
    });
    this.#shelf = new ShelfPanel({
      onOpen: ({ name, file }) => void host.openDatabase(name, file, !this.#unkept.has(name)),
      onBuiltIn: () => void host.openBuiltIn(),
      onExport: ({ name, file }) => saveFile(`${name}.strutdb`, file),
      onDelete: (database) => void this.#delete(database),
    });
    this.#leftOut = button(words.leftOut, () => this.#narrow(this.#filter === "left out" ? undefined : "left out"), {
      label: true,
    });
    this.element = this.#compose();
    this.#files.addEventListener("change", () => this.#takeChosen(this.#files));
    this.#folder.addEventListener("change", () => this.#takeChosen(this.#folder));
    this.#pattern.addEventListener("change", () => void this.#label());
    this.#unsubscribe = host.store.subscribe((_, changed) => {
      if (changed.has("database")) void this.#showShelf();
    });
    this.#show();
  }

  show(): void {
    this.#preview.resume();
    this.#catalogue.show();
    void this.#showShelf();
  }

  hide(): void {
    this.#preview.stop();
  }

  dispose(): void {
    this.#unsubscribe();
    this.#preview.stop();
    this.#client.dispose();
  }

  takeFiles(files: DroppedFile[]): void {
    for (const { path, file } of files.filter(({ path }) => /\.strutdb$/i.test(path)))
      void this.#host.openDatabase(path.replace(/\.strutdb$/i, ""), file, false);
    const tables = files.filter(({ path }) => /\.csv$/i.test(path));
    if (tables.length > 0) this.#table = tables.at(-1)!.file;
    const clips = files.filter(({ path }) => /\.(bvh|zip)$/i.test(path));
    if (clips.length > 0) {
      const others = files.filter(({ path }) => !/\.(strutdb|csv)$/i.test(path));
      const known = new Set(others.map(({ path }) => path));
      void this.#open([...this.#dropped.filter(({ path }) => !known.has(path)), ...others]);
    } else if (tables.length > 0) void this.#label();
    else if (files.length > 0 && !files.some(({ path }) => /\.strutdb$/i.test(path)))
      this.#host.notices.error(words.noneOf(files.length));
  }

  #compose(): HTMLElement {
    const first = [
      button(words.empty.files, () => this.#files.click(), { icon: "drop", label: true, class: "outlined" }),
      button(words.empty.folder, () => this.#folder.click(), { icon: "folder", label: true, class: "outlined" }),
    ];
    const clear = button(words.add.clear, () => void this.#open([]), { label: true });
    const more = [
      button(words.add.files, () => this.#files.click(), { icon: "drop", label: true, class: "outlined" }),
      button(words.add.folder, () => this.#folder.click(), { icon: "folder", label: true, class: "outlined" }),
    ];
    const heading = html(
      "header",
      { class: "data-heading" },
      html("div", {}, this.#heading, this.#summary),
      html("div", { class: "data-actions" }, clear, ...more),
    );
    const names = html(
      "div",
      { class: "data-names" },
      html("label", { class: "row" }, html("span", { class: "label" }, words.names.label), this.#pattern),
      this.#patternNote,
      this.#leftOut,
    );
    const empty = html(
      "div",
      { class: "data-empty" },
      icon("drop", 24),
      html("h1", { class: "page-title" }, words.empty.heading),
      html("p", {}, words.empty.what),
      html("div", { class: "data-actions" }, ...first),
      html("p", { class: "caption" }, words.empty.best),
    );
    const clips = html(
      "div",
      { class: "data-clips" },
      this.#reading.element,
      heading,
      names,
      this.#matrix.element,
      this.#list.element,
    );
    const panels = html(
      "aside",
      { class: "data-panels", "aria-label": words.build.panels },
      this.#preview.element,
      this.#build.element,
      this.#shelf.element,
      this.#catalogue.element,
    );
    return html("main", { class: "view data" }, empty, clips, panels, this.#files, this.#folder);
  }

  // --- clips ---

  #takeChosen(input: HTMLInputElement): void {
    const files = filesOfDialog(input.files ?? []);
    input.value = "";
    this.takeFiles(files);
  }

  /** Takes a public data set in the place of what there was. */
  #takeSet({ name, pattern, labels }: PublicSet, files: DroppedFile[]): void {
    this.#rows = [];
    this.#table = labels === undefined ? undefined : new File([labels], `${name}.csv`);
    void this.#open(files, pattern);
  }

  /** Lists, labels and reads the clips among the files; without a pattern it is found. */
  async #open(files: DroppedFile[], pattern?: string): Promise<void> {
    const edits = new Map(this.#rows.filter((row) => row.edited).map((row) => [row.path, row]));
    const chosenBefore = this.#rows.length > 0;
    this.#dropped = files;
    this.history.forget();
    this.#host.historyChanged();
    this.#skeletons = [];
    this.#selected = undefined;
    this.#filter = undefined;
    this.#preview.clear();
    if (files.length === 0) {
      this.#rows = [];
      this.#table = undefined;
      this.#neutral = "";
      this.#client.dispose();
      this.#show();
      return;
    }
    setAttributes(this.element, { "aria-busy": "true" });
    await this.#attempt(() =>
      this.#reading.run(words.looking, async (options) => {
        const found = await this.#client.open(files, options);
        this.#rows = found.clips.map(rowOf);
        for (const row of this.#rows) {
          const edit = edits.get(row.path);
          if (edit) Object.assign(row, { action: edit.action, style: edit.style, take: edit.take, edited: true });
        }
        for (const note of found.notes) this.#host.notices.error(note);
        if (this.#rows.length === 0 && found.notes.length === 0) this.#host.notices.error(words.noClips);
        if (this.#rows.length === 0) this.#dropped = [];
        if (!chosenBefore) {
          this.#pattern.value = pattern ?? found.pattern ?? "";
          this.#build.name = databaseName(this.#rows.map((row) => row.path));
        }
        await this.#label();
        const [first] = this.#rows;
        const skeletons = this.#skeletons;
        await this.#client.readAll((news) => {
          applyNews(this.#rows, skeletons, news);
          this.#show();
          const shown = first && this.#selected === undefined && this.#rows.find((row) => row.read);
          if (shown) void this.#select(shown);
        }, options);
      }),
    );
    setAttributes(this.element, { "aria-busy": "false" });
    this.#show();
  }

  /** Takes the labels from the table and the pattern. */
  async #label(): Promise<void> {
    const pattern = this.#pattern.value.trim();
    if (this.#rows.length === 0) return;
    try {
      applyLabels(this.#rows, await this.#client.label(pattern || undefined, this.#table));
      const matching = this.#rows.filter((row) => row.unlabelled === "").length;
      const all = this.#rows.length;
      const matches = matching === all ? words.names.all : words.names.some(matching, all);
      setText(this.#patternNote, this.#table ? words.names.tableFirst(matches, this.#table.name) : matches);
    } catch (error) {
      if (isCancellation(error)) return;
      // A table that is wrong is not tried again.
      this.#table = undefined;
      setText(this.#patternNote, errorText(error));
    }
    this.#chooseNeutral();
    this.#show();
  }

  #edit(row: Row, field: LabelField, value: string): void {
    const text = value.trim();
    const take = /^\d{1,9}$/.test(text) ? Number(text) : undefined;
    this.history.edit([row], field === "take" ? { take } : { [field]: text });
  }

  /** Renames an action or a style wherever it is; the name of another makes both one. */
  #rename(field: "action" | "style", from: string, to: string): void {
    if (field === "style" && this.#neutral === from) this.#neutral = to;
    this.history.edit(
      this.#rows.filter((row) => row[field].trim() === from),
      { [field]: to },
    );
  }

  /** Where the neutral style has gone, another takes its place. */
  #chooseNeutral(): void {
    const { styles } = this.#classes();
    if (!styles.includes(this.#neutral)) this.#neutral = likelyNeutral(styles);
  }

  #narrow(filter: Filter): void {
    this.#filter = filter;
    this.#list.element.scrollTop = 0;
    this.#show();
  }

  async #select(row: Row): Promise<void> {
    this.#selected = row.index;
    this.#showList();
    const title =
      row.action && row.style
        ? words.preview.title(row.action, row.style)
        : row.path.slice(row.path.lastIndexOf("/") + 1);
    if (row.fault) {
      this.#preview.fail(title, row.fault);
      return;
    }
    try {
      const roles = row.read && this.#skeletons[row.read.skeleton]?.chosen;
      const clip = await this.#client.preview(row.index, roles);
      if (this.#selected === row.index) this.#preview.show(title, clip);
    } catch (error) {
      if (!isCancellation(error) && this.#selected === row.index) this.#preview.fail(title, errorText(error));
    }
  }

  async #chooseRoles(number: number): Promise<void> {
    const skeleton = this.#skeletons[number];
    const roles = skeleton && (await askForRoles(skeleton));
    if (!roles) return;
    skeleton.chosen = roles;
    const selected = this.#rows.find((row) => row.index === this.#selected);
    const shown =
      selected?.read?.skeleton === number ? selected : this.#rows.find((row) => row.read?.skeleton === number);
    if (shown) await this.#select(shown);
    this.#show();
  }

  // --- database ---

  async #start(name: string): Promise<void> {
    if (this.#building) return;
    this.#building = true;
    this.#build.busy = true;
    this.#preview.playing = false;
    const started = performance.now();
    await this.#attempt(() =>
      this.#build.progress.run(words.build.progress, async (options) => {
        const files = this.#usable().map((row) => ({
          index: row.index,
          path: row.path,
          licence: row.licence,
          action: row.action.trim(),
          style: row.style.trim(),
          take: row.take,
          roles: row.read && this.#skeletons[row.read.skeleton]?.chosen,
        }));
        const { refused, neutral: _, ...built } = await this.#client.build(files, this.#neutral, options);
        const reasons = new Map(refused.map(({ path, reason }) => [path, reason]));
        for (const row of this.#rows) row.fault = reasons.get(row.path) ?? row.fault;
        await this.#keep({ name, ...built });
        const seconds = ((performance.now() - started) / 1000).toFixed(1);
        const ready = words.build.ready(
          capitalised(numberWord(built.styles.length)),
          built.styles.length,
          built.frames,
          seconds,
        );
        const left = refused.length > 0 ? ` ${words.build.refused(refused.length)}` : "";
        this.#host.notices.note(ready + left);
      }),
    );
    this.#building = false;
    this.#build.busy = false;
    this.#preview.playing = true;
    this.#show();
    await this.#showShelf();
  }

  async #keep(database: Shelved): Promise<void> {
    try {
      await keep(database);
      this.#unkept.delete(database.name);
    } catch (error) {
      this.#unkept.set(database.name, database);
      this.#host.notices.error(words.build.unkept(database.name, errorText(error)));
    }
  }

  async #delete({ name }: Shelved): Promise<void> {
    this.#unkept.delete(name);
    await this.#attempt(() => forget(name));
    await this.#showShelf();
  }

  async #showShelf(): Promise<void> {
    const kept = await listShelf().catch(() => []);
    const all = [...kept.filter(({ name }) => !this.#unkept.has(name)), ...this.#unkept.values()];
    this.#shelf.show(all, this.#host.store.state.database);
  }

  // --- picture ---

  #usable(): Row[] {
    return this.#rows.filter((row) => obstacle(row, this.#skeletons) === "");
  }

  #classes() {
    return classTable(this.#usable());
  }

  #show(): void {
    this.element.classList.toggle("filled", this.#rows.length > 0);
    if (this.#rows.length === 0) return;
    const usable = this.#usable();
    const classes = classTable(usable);
    const left = this.#rows.length - usable.length;
    setText(this.#heading, words.heading(usable.length, classes.styles.length));
    const sources = new Set(this.#rows.map(({ path }) => path.slice(0, path.indexOf("/")) || path));
    const [source = ""] = sources;
    setText(
      this.#summary,
      words.summary(classes.actions.length, sources.size === 1 ? source : words.sources(sources.size)),
    );
    this.#leftOut.hidden = left === 0;
    setText(this.#leftOut.firstElementChild!, words.leftOutCount(left));
    this.#leftOut.setAttribute("aria-pressed", String(this.#filter === "left out"));
    this.#matrix.show(classes, this.#neutral, this.#filter === "left out" ? undefined : this.#filter);
    const clipsOf = this.#skeletons.map((_, i) => this.#rows.filter((row) => row.read?.skeleton === i).length);
    this.#build.show({
      usable: this.#building ? 0 : usable.length,
      styles: classes.styles.length,
      skeletons: this.#skeletons,
      clipsOf,
      concerns: concerns(classes),
    });
    this.#showList(classes);
  }

  #showList(names = this.#classes()): void {
    const filter = this.#filter;
    const rows = this.#rows.filter((row) => {
      if (filter === undefined) return true;
      if (filter === "left out") return obstacle(row, this.#skeletons) !== "";
      return row.action === filter.action && row.style === filter.style;
    });
    this.#list.element.classList.toggle("left-out", filter === "left out");
    this.#list.show(rows, this.#skeletons, this.#selected, names);
  }

  async #attempt(task: () => Promise<void>): Promise<void> {
    try {
      await task();
    } catch (error) {
      if (!isCancellation(error)) this.#host.notices.error(errorText(error));
    }
  }
}
