/** The driven character's state in numbers. */
import type { DriveFrame, DriveInfo } from "../../../../client/drive/protocol";
import { Toggle } from "../../../../ui/controls/buttons";
import { formatNumber, html, setAttributes, setText } from "../../../../ui/dom";
import { spoken } from "../../../ui/words";
import { driveWords } from "./strings.en";

const words = driveWords.panel;
/** Minimum time between updates, so that they are readable. */
const READ_OUT_MS = 250;

export class DrivePanel {
  readonly element: HTMLElement;
  readonly #speed = html("b");
  readonly #clip = html("b");
  readonly #transitions = html("b");
  readonly #offCourse = html("b");
  readonly #unit = html("span");
  readonly #neutral: string;
  #shownAt = 0;

  /** @param neutral name of the neutral style */
  constructor({ speeds, clips, frames, note }: DriveInfo, neutral: string, onKeepGoing: (on: boolean) => void) {
    this.#neutral = neutral;
    const keepGoing = new Toggle(words.keepGoing, (on) => {
      keepGoing.on = on;
      onKeepGoing(on);
    });
    keepGoing.on = false;
    const row = (name: string, ...values: Node[]) =>
      html("div", { class: "drive-row" }, html("dt", {}, name), html("dd", {}, ...values.flatMap((v) => [v, " "])));
    const of = html("span", {}, words.of(formatNumber(speeds[0], 2)));
    this.element = html(
      "section",
      { class: "section drive-panel", "aria-labelledby": "drive-heading" },
      html(
        "div",
        { class: "section-heading" },
        html("h2", { id: "drive-heading" }, words.heading),
        html("span", { class: "caption" }, words.from(clips, frames)),
      ),
      ...(note ? [html("p", { class: "caption drive-note" }, words.note(note))] : []),
      html(
        "dl",
        {},
        row(words.speed, this.#speed, of),
        row(words.clip, this.#clip),
        row(words.transitions, this.#transitions, html("span", {}, words.perSecond)),
        row(words.offCourse, this.#offCourse, this.#unit),
      ),
      html(
        "p",
        { class: "caption drive-legend" },
        `${words.legend}:`,
        html("span", { class: "asked" }, words.asked),
        html("span", { class: "of-clip" }, words.ofClip),
      ),
      keepGoing.element,
    );
  }

  /**
   * Shows a frame, at most every {@link READ_OUT_MS}; `offCourse` returns the distance from the path in metres, if
   * there is one.
   */
  show({ speed, clip, row, transitions }: DriveFrame, offCourse: () => number | undefined): void {
    const now = performance.now();
    if (now - this.#shownAt < READ_OUT_MS) return;
    this.#shownAt = now;
    setText(this.#speed, formatNumber(speed, 2));
    setText(this.#clip, clipWords(clip, this.#neutral));
    setAttributes(this.#clip, { title: words.clipWhy(clip, String(row)) });
    setText(this.#transitions, String(transitions));
    const off = offCourse();
    setText(this.#offCourse, off === undefined ? "" : formatNumber(100 * off, 1));
    setText(this.#unit, off === undefined ? words.noPath : words.centimetres);
  }
}

/** The content of a clip in words: its name without style, take and duplicates. */
export function clipWords(name: string, neutral: string): string {
  const [file, isMirrored] = [name.replace(/, mirrored$/, ""), name.endsWith(", mirrored")];
  const parts = file.split("_").filter((part) => part !== neutral && !/^\d+$/.test(part));
  const said = spoken(parts.join(" ")).replace(/^(\S+) \1\b/, "$1");
  return isMirrored ? words.mirrored(said) : said;
}
