/** The Input panel: the input motion, and the class that the engine recognises in it. */
import type { InputInfo, Note, Reading } from "../../../client/protocol";
import { clipIn, clipValue, DRIVE, type InputLibrary, isLive, LIVE, MOST_CLIPS } from "../../../player/input_library";
import { button } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { formatNumber, html, setAttributes, setText } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import { inputTitle, spoken } from "../../ui/words";
import { isFaint, isUnlike, type Likeness } from "./likeness";
import { otherNotes } from "./reading/other_notes";

/** Minimum time between updates of the recognised class, so that it can be read. */
const READING_MS = 250;

interface InputListeners {
  onChoose: (name: string) => void;
  /** Called when a clip of the open database is selected, by its index. */
  onClip: (clip: number) => void;
  onFile: () => void;
  /** Called when the public data sets are to be shown. */
  onRecorded: () => void;
}

export class InputPanel {
  readonly element: HTMLElement;
  readonly #select = html("select", { "aria-label": strings.play.input.motion });
  readonly #reading = html("span", { class: "reading" });
  readonly #bar = html("div", { class: "weight-bar-filled" });
  readonly #barBox = html("div", { class: "weight-bar" }, this.#bar);
  // Not a live region: while a motion plays it changes all the time.
  readonly #weight = html("span", { class: "value" });
  readonly #note = html("p", { class: "caption input-note" });
  #notes: readonly Note[] = [];
  /** Notes on the styled motion. */
  #ofStyled: readonly Note[] = [];
  /** The recognised class of the whole input, once it is known. */
  #likeness: Likeness | undefined;
  #readAt = 0;
  /** The displayed reading. */
  #shown: Reading | undefined;
  /** The reading of the next update; `undefined` if none is scheduled. */
  #newest: Reading | undefined;

  constructor(listeners: InputListeners, top: readonly HTMLElement[]) {
    this.#select.addEventListener("change", () => {
      const { value } = this.#select;
      const clip = clipIn(value);
      if (clip === undefined) listeners.onChoose(value);
      else listeners.onClip(clip);
    });
    const { open, openWhy, recorded, recordedWhy } = strings.play.input;
    const file = button(open, listeners.onFile, { icon: "folder", label: true, class: "outlined" });
    file.title = openWhy;
    const sets = button(recorded, listeners.onRecorded, { label: true, class: "plain" });
    sets.title = recordedWhy;
    this.element = html(
      "section",
      { class: "section input", "aria-labelledby": "input-heading" },
      ...top,
      html("div", { class: "section-heading" }, html("h2", { id: "input-heading" }, strings.play.input.heading), sets),
      html(
        "div",
        { class: "input-row" },
        html("div", { class: "select outlined" }, this.#select, icon("chevron")),
        file,
      ),
      html(
        "div",
        { class: "row", title: strings.play.input.readsAsWhy },
        html("span", { class: "label" }, strings.play.input.readsAs),
        this.#reading,
        this.#barBox,
        this.#weight,
      ),
      this.#note,
    );
  }

  /** Lists the available inputs and marks the open one. */
  list(library: InputLibrary, chosen: string, databaseName: string): void {
    const option = (name: string) => html("option", { value: name }, inputTitle(library, name));
    const group = (label: string, names: readonly string[]) =>
      names.length > 0 ? [html("optgroup", { label }, ...names.map(option))] : [];
    this.#select.replaceChildren(
      html("option", { value: DRIVE }, strings.play.input.drive),
      html("option", { value: isLive(chosen) ? chosen : LIVE }, strings.play.input.live),
      ...this.#clips(library, databaseName),
      ...group(strings.play.input.builtIn, library.builtIn),
      ...group(strings.play.input.dropped, library.dropped),
    );
    this.#select.value = chosen;
  }

  #clips({ clips }: InputLibrary, databaseName: string): HTMLElement[] {
    const options = clips
      .slice(0, MOST_CLIPS)
      .map(({ clip, name }) => html("option", { value: clipValue(clip) }, spoken(name)));
    const label = strings.play.input.clipsOf(databaseName);
    return options.length > 0 ? [html("optgroup", { label }, ...options)] : [];
  }

  set input(input: InputInfo) {
    this.#notes = input.notes;
    this.#ofStyled = [];
    this.#likeness = undefined;
    this.#showNotes();
    this.#readAt = 0;
  }

  /** Notes on the styled motion, once it exists. */
  set styledNotes(notes: readonly Note[]) {
    this.#ofStyled = notes;
    this.#showNotes();
  }

  /** The recognised class of the whole input; `undefined` while it is not known. */
  set likeness(likeness: Likeness | undefined) {
    this.#likeness = likeness;
    if (this.#shown) this.#showRead(this.#shown);
    this.#showNotes();
  }

  #showNotes(): void {
    // The panel behind the button shows the other notes.
    const notes = otherNotes([...this.#notes, ...this.#ofStyled]);
    const guess = this.#likeness && isUnlike(this.#likeness) ? [guessText(this.#likeness)] : [];
    const text = [...guess, ...notes.map((note) => note.text)].join(" ");
    setText(this.#note, text);
    this.#note.title = text;
  }

  /** Shows the class with the largest weight in the newest frame, at most every {@link READING_MS}. */
  read([heaviest]: readonly Reading[]): void {
    if (!heaviest) return;
    const waiting = this.#newest !== undefined;
    this.#newest = heaviest;
    if (waiting) return;
    const left = this.#readAt + READING_MS - performance.now();
    if (left <= 0) this.#showNewest();
    else setTimeout(() => this.#showNewest(), left);
  }

  #showNewest(): void {
    const newest = this.#newest;
    if (!newest) return;
    this.#newest = undefined;
    this.#readAt = performance.now();
    this.#showRead(newest);
  }

  #showRead(newest: Reading): void {
    this.#shown = newest;
    const { text, weight } = readText(newest, this.#likeness);
    setText(this.#reading, text);
    setAttributes(this.#reading, { title: text });
    setText(this.#weight, weight === undefined ? "" : formatNumber(weight, 2));
    this.#bar.style.transform = `scaleX(${Math.min(1, Math.max(0, weight ?? 0))})`;
    this.#barBox.hidden = weight === undefined;
  }
}

/** The text about an input that is not similar to any class. */
function guessText({ centimetres }: Likeness): string {
  const { guess, guessFar } = strings.play.input;
  return centimetres === undefined ? guess : guessFar(centimetres);
}

/** The text about a frame's heaviest class, and about the whole input; the weight only if it is meaningful. */
export function readText(frame: Reading, whole: Likeness | undefined): { text: string; weight: number | undefined } {
  const { unlike, anyStyle, readsAsClass } = strings.play.input;
  // Weights compare classes with each other. They are meaningless for an input that is far from all classes, or that
  // only resembles the beginning of one.
  if (whole?.kind === "far" || whole?.kind === "still") return { text: unlike, weight: undefined };
  if (whole && isUnlike(whole)) return { text: unlike, weight: whole.read.weight };
  if (!isFaint(frame)) return { text: readsAsClass(spoken(frame.action), spoken(frame.style)), weight: frame.weight };
  if (whole?.kind === "action") return { text: anyStyle(spoken(whole.read.action)), weight: whole.read.weight };
  return { text: unlike, weight: frame.weight };
}
