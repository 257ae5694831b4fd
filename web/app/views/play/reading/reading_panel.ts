/** The panel with the reading of a file: properties that were found, guessed or specified, each of which can be corrected. */
import "./reading_panel.css";
import { type FileRead, type FileReading, type InputInfo, type Note, UP_AXES } from "../../../../client/protocol";
import { ROLES } from "../../../../humanoid";
import { button } from "../../../../ui/controls/buttons";
import { icon } from "../../../../ui/controls/icons";
import { formatNumber, html, saveFile, setText } from "../../../../ui/dom";
import { grouped } from "../../../strings/numerals";
import { announce } from "../../../ui/announce";
import { askForRoles, jointNames } from "../../../ui/roles_dialog";
import { spoken } from "../../../ui/words";
import type { Likeness } from "../likeness";
import { jointFile, readJointFile } from "./joint_file";
import { otherNotes } from "./other_notes";
import {
  likenessText,
  ROW_NAMES,
  type RowName,
  type RowText,
  rowTexts,
  saysOfSkeleton,
  saysRow,
  UNITS,
  withoutRow,
} from "./rows";
import { pullToClose } from "./sheet";
import { readingWords as words } from "./strings.en";

interface ReadingListeners {
  /** Called when the file is to be read in another way. */
  onRead: (reading: FileReading) => Promise<boolean>;
  /** Called when the user sets the input's action; empty for any action. */
  onAction: (action: string) => void;
  /** Called when the user's labels of the input are removed. */
  onAnything: () => void;
  onClose: () => void;
  /** Called with a sentence if a file of joints is invalid. */
  onRefused: (sentence: string) => void;
}

/** Contents of the similarity row. */
interface ShownLikeness {
  /** The recognised class; `undefined` while it is not known. */
  likeness: Likeness | undefined;
  /** Actions of the database. */
  actions: readonly string[];
  /** The action that the user set for the input; empty if none. */
  action: string;
  /** Whether the user set labels of the input. */
  said: boolean;
}

/** A row: its control and its texts. */
interface Row {
  element: HTMLElement;
  source: HTMLElement;
  why: HTMLElement;
  reset: HTMLButtonElement;
}

export class ReadingPanel {
  readonly element: HTMLElement;
  readonly #listeners: ReadingListeners;
  readonly #head: HTMLElement;
  readonly #facts = html("p", { class: "caption" });
  readonly #up = select(UP_AXES.map((axis) => [axis, words.axes[axis]]));
  readonly #sides = select([
    ["0", words.sides.named],
    ["1", words.sides.exchanged],
  ]);
  readonly #floor = html("input", { type: "number", class: "text number", step: "any", inputmode: "decimal" });
  readonly #unit = html("select");
  readonly #count = html("span", { class: "joint-count" });
  readonly #rows: Record<RowName, Row>;
  readonly #action = html("select");
  readonly #likeness: Row;
  readonly #notes = html("ul", { class: "reading-notes", "aria-label": words.notes });
  readonly #memory = html("p", { class: "caption" });
  readonly #resetAll: HTMLButtonElement;
  #input: InputInfo | undefined;
  #ofStyled: readonly Note[] = [];

  constructor(listeners: ReadingListeners) {
    this.#listeners = listeners;
    this.#up.addEventListener("change", () => {
      const up = UP_AXES.find((axis) => axis === this.#up.value);
      if (up) this.#say("up", { up });
    });
    this.#sides.addEventListener("change", () => this.#say("sides", { mirrored: this.#sides.value === "1" }));
    this.#floor.addEventListener("change", () => this.#sayFloor());
    this.#unit.addEventListener("change", () => this.#say("unit", { unit: Number(this.#unit.value) }));
    const floor = html(
      "span",
      { class: "floor-field" },
      this.#floor,
      html("span", { class: "caption" }, words.floor.unit),
    );
    this.#rows = {
      up: this.#row("up", selectBox(this.#up), this.#up),
      sides: this.#row("sides", selectBox(this.#sides), this.#sides),
      floor: this.#row("floor", floor, this.#floor),
      unit: this.#row("unit", selectBox(this.#unit), this.#unit),
      joints: this.#jointsRow(),
    };
    this.#action.addEventListener("change", () => listeners.onAction(this.#action.value));
    this.#likeness = this.#rowOf("likeness", selectBox(this.#action), listeners.onAnything, this.#action);
    this.#likeness.element.classList.add("likeness");
    this.#floor.setAttribute("aria-label", words.floor.name);
    this.#resetAll = button(words.resetAll, () => void this.#read({}), { label: true });
    const close = button(words.close, listeners.onClose, { icon: "close" });
    this.#head = html("div", { class: "reading-head" }, html("h2", { id: "reading-heading" }, words.heading), close);
    this.element = html(
      "section",
      { class: "reading-panel", role: "dialog", "aria-labelledby": "reading-heading", tabindex: -1, hidden: true },
      this.#head,
      this.#facts,
      ...ROW_NAMES.map((name) => this.#rows[name].element),
      this.#likeness.element,
      this.#notes,
      html("div", { class: "reading-foot" }, this.#memory, this.#resetAll),
    );
    pullToClose(this.element, this.#head, listeners.onClose);
  }

  /** Adds the progress line of reading a file. */
  takeProgress(line: HTMLElement): void {
    this.#head.append(line);
  }

  /** The input whose file is displayed. */
  set input(input: InputInfo) {
    this.#input = input;
    const { reading: read, notes } = input;
    if (!read) return;
    setText(this.#facts, words.facts(grouped(read.frames), String(Math.round(100 * read.rateHz) / 100)));
    this.#up.value = read.up;
    this.#sides.value = read.mirrored ? "1" : "0";
    this.#floor.value = String(Math.round(1000 * read.floorMetres) / 10);
    this.#showUnit(read);
    const found = ROLES.filter((role) => read.joints[role] !== null).length;
    setText(this.#count, words.joints.count(found, ROLES.length));
    const texts = rowTexts(read, notes);
    for (const name of ROW_NAMES) {
      showText(this.#rows[name], texts[name]);
      this.#rows[name].reset.disabled = !saysRow(read.said, name);
    }
    this.#showNotes();
    const { remembered, willRemember, asBefore } = words;
    setText(this.#memory, read.remembered ? asBefore : saysOfSkeleton(read.said) ? remembered : willRemember);
    this.#resetAll.disabled = !ROW_NAMES.some((name) => saysRow(read.said, name));
  }

  /** Notes on the styled motion, once it exists. */
  set styledNotes(notes: readonly Note[]) {
    this.#ofStyled = notes;
    this.#showNotes();
  }

  #showNotes(): void {
    const others = otherNotes([...(this.#input?.notes ?? []), ...this.#ofStyled]);
    this.#notes.replaceChildren(...others.map(({ text }) => html("li", {}, text)));
    this.#notes.hidden = others.length === 0;
  }

  /** The recognised class of the input, and the labels set by the user. */
  set likeness({ likeness, actions, action, said }: ShownLikeness) {
    const names = ["", ...actions];
    if (names.join() !== [...this.#action.options].map(({ value }) => value).join())
      this.#action.replaceChildren(
        ...names.map((name) => html("option", { value: name }, name ? spoken(name) : words.likeness.any)),
      );
    this.#action.value = action;
    showText(this.#likeness, likenessText(likeness, said));
    this.#likeness.reset.disabled = !said;
  }

  #row(name: RowName, control: HTMLElement, labelled?: HTMLElement): Row {
    return this.#rowOf(name, control, () => void this.#read(withoutRow(this.#said, name)), labelled);
  }

  #rowOf(
    name: keyof typeof words.rows,
    control: HTMLElement,
    onReset: () => void,
    labelled: HTMLElement | undefined,
  ): Row {
    const id = `reading-${name}`;
    const source = html("span", { class: "row-source", id: `${id}-source` });
    const why = html("span", { class: "row-why", id: `${id}-why` });
    const reset = button(words.reset(words.rows[name]), onReset, { icon: "reset", class: "row-reset" });
    labelled?.setAttribute("aria-label", words.rows[name]);
    labelled?.setAttribute("aria-describedby", `${source.id} ${why.id}`);
    control.classList.add("row-control");
    const title = html("span", { class: "row-name" }, words.rows[name]);
    const element = html("div", { class: "reading-row" }, title, control, source, why, reset);
    return { element, source, why, reset };
  }

  #jointsRow(): Row {
    const { edit, editWhy, exportWhy, importWhy } = words.joints;
    const editor = button(edit, () => void this.#edit(), { label: true, class: "outlined" });
    editor.title = editWhy;
    editor.setAttribute("aria-describedby", "reading-joints-source reading-joints-why");
    const row = this.#row("joints", html("span", { class: "joint-control" }, this.#count, editor));
    const picker = html("input", { type: "file", accept: ".json,application/json", hidden: true });
    picker.addEventListener("change", () => void this.#import(picker));
    const save = button(words.joints.export, () => this.#export(), { label: true, class: "plain" });
    const load = button(words.joints.import, () => picker.click(), { label: true, class: "plain" });
    [save.title, load.title] = [exportWhy, importWhy];
    row.element.append(html("span", { class: "joint-files" }, save, load, picker));
    return row;
  }

  /** The user's reading of the file. */
  get #said(): FileReading {
    return this.#input?.reading?.said ?? {};
  }

  #say(row: RowName, said: FileReading): void {
    void this.#read({ ...withoutRow(this.#said, row), ...said });
  }

  #sayFloor(): void {
    const centimetres = this.#floor.valueAsNumber;
    if (Number.isFinite(centimetres)) this.#say("floor", { floor: Math.round(1e4 * centimetres) / 1e6 });
    else this.#showAgain();
  }

  /** Reads the file in another way; if that fails, the rows return to the current reading. */
  async #read(reading: FileReading): Promise<void> {
    if (await this.#listeners.onRead(reading)) announce(words.again);
    else this.#showAgain();
  }

  #showAgain(): void {
    if (this.#input) this.input = this.#input;
  }

  async #edit(): Promise<void> {
    const read = this.#input?.reading;
    if (!read) return;
    const { joints } = read.skeleton;
    const roles = ROLES.map((role) => joints.indexOf(read.joints[role] ?? ""));
    const chosen = await askForRoles({ joints, roles, note: words.joints.ask });
    if (chosen) this.#say("joints", { joints: jointNames(chosen, joints) });
  }

  #export(): void {
    const { reading, name = "" } = this.#input ?? {};
    if (!reading) return;
    const file = new Blob([jointFile(reading.joints)], { type: "application/json" });
    saveFile(words.joints.fileName(name), file);
  }

  async #import(picker: HTMLInputElement): Promise<void> {
    const file = picker.files?.[0];
    picker.value = "";
    if (!file) return;
    const read = await file.text().then(
      (text) => readJointFile(file.name, text),
      () => ({ fault: words.joints.noJson(file.name) }),
    );
    if ("fault" in read) this.#listeners.onRefused(read.fault);
    else this.#say("joints", read);
  }

  #showUnit({ metresPerUnit }: FileRead): void {
    const known = UNITS.find(({ metres }) => Math.abs(metres - metresPerUnit) < 1e-6 * metres);
    const other = known
      ? []
      : [{ metres: metresPerUnit, name: words.unit.other(formatNumber(100 * metresPerUnit, 2)) }];
    this.#unit.replaceChildren(
      ...[...UNITS, ...other].map(({ metres, name }) => html("option", { value: String(metres) }, name)),
    );
    this.#unit.value = String(known?.metres ?? metresPerUnit);
  }
}

function showText({ source, why }: Row, text: RowText): void {
  setText(source, text.source);
  source.classList.toggle("guessed", text.guessed);
  setText(why, text.why);
}

function select(options: readonly (readonly [value: string, name: string])[]): HTMLSelectElement {
  return html("select", {}, ...options.map(([value, name]) => html("option", { value }, name)));
}

function selectBox(choice: HTMLSelectElement): HTMLElement {
  return html("span", { class: "select" }, choice, icon("chevron"));
}
