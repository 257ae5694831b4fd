/** All numbers of a pose; those that differ from the input's are marked. */
import { DEGREES, JOINTS, ROLES } from "../../humanoid";
import { html, setText } from "../../ui/dom";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { figure } from "../words/words";
import sheet from "./pose.css?inline";
import { DOFS, framesOf, measurePose, motionOf, numbersAt, same } from "./pose_measure";
import { POSE_FIELDS, type PoseState } from "./pose_state";

/** Terms of the numbers after those of the joints. */
const REST = ["h", "v", "v", "psi"] as const;
/** Decimals of metres and of metres per second. */
const DIGITS = 2;

export const NUMBERS: FigureKind<PoseState> = {
  fields: POSE_FIELDS,
  sheet,
  create: (parts) => new NumbersFigure(parts),
};

class NumbersFigure implements FigureInstance<PoseState> {
  readonly #parts: FigureParts<PoseState>;
  readonly #cells: readonly HTMLElement[];
  readonly #readout = html("p", { class: "readout" });
  readonly #reading = new Latest<PoseState>((state) => this.#read(state));
  #state: PoseState | undefined;
  #shown: { state: PoseState; numbers: Float32Array; changed: boolean[] } | undefined;

  constructor(parts: FigureParts<PoseState>) {
    this.#parts = parts;
    const { words, container } = parts;
    const { height, sideways, forwards, turning } = words.pose;
    this.#cells = Array.from({ length: DOFS }, (_, i) => html("span", { class: "cell", "data-term": termOf(i) }));
    const row = (name: string, first: number, count: number) =>
      html(
        "div",
        { class: "numbers-row" },
        html("span", { class: "name" }, name),
        ...this.#cells.slice(first, first + count),
      );
    const list = html(
      "div",
      { class: "numbers" },
      ...ROLES.map((role, joint) => row(words.pose.angles(words.joints[role]), 3 * joint, 3)),
      ...[height, sideways, forwards, turning].map((name, i) => row(name, 3 * JOINTS + i, 1)),
    );
    for (const cell of this.#cells) {
      cell.addEventListener("pointerenter", () => parts.point(cell.dataset.term));
      cell.addEventListener("pointerleave", () => parts.point(undefined));
    }
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.pose.numbers)),
      html("div", { class: "picture listed" }, list),
      html("footer", { class: "foot" }, this.#readout),
    );
  }

  show(state: PoseState): Promise<void> {
    this.#state = state;
    return this.#reading.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measurePose(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#shown) return "";
    const { heading, turned } = this.#shown.state;
    return this.#parts.words.pose.listed(this.#count(), String(DOFS), String(heading), String(turned.length));
  }

  table(): Table {
    const { words } = this.#parts;
    const rows = this.#shown
      ? ROLES.map((role, joint) => [words.joints[role], ...[0, 1, 2].map((axis) => this.#text(3 * joint + axis))])
      : [];
    return { head: words.pose.components, rows };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#shown) return {};
    const first = 3 * JOINTS;
    return {
      h: `${this.#text(first)} m`,
      v: `${this.#text(first + 1)}, ${this.#text(first + 2)} m/s`,
      psi: `${this.#text(first + 3)} °/s`,
    };
  }

  light(term: string | undefined): void {
    const joint = this.#state && ROLES.indexOf(this.#state.joint);
    // w belongs to the joint that is read.
    this.#cells.forEach((cell, i) => {
      cell.classList.toggle("lit", cell.dataset.term === term && (term !== "w" || Math.floor(i / 3) === joint));
    });
  }

  async #read(state: PoseState): Promise<void> {
    const { engine, signal } = this.#parts;
    const [plain, motion] = await Promise.all([
      motionOf(engine, state.motion, [], 0),
      motionOf(engine, state.motion, state.turned, state.heading),
    ]);
    if (signal.aborted) return;
    const frame = Math.min(state.at, framesOf(motion) - 1);
    const [before, numbers] = [numbersAt(plain, frame), numbersAt(motion, frame)];
    this.#shown = { state, numbers, changed: Array.from(numbers, (value, i) => !same(value, before[i]!)) };
    this.#cells.forEach((cell, i) => {
      setText(cell, this.#text(i));
      cell.classList.toggle("changed", this.#shown!.changed[i]!);
    });
    setText(this.#readout, this.#parts.words.pose.counted(this.#count(), String(DOFS)));
    this.#parts.changed();
  }

  #count(): string {
    return String(this.#shown!.changed.filter(Boolean).length);
  }

  /** Angles in degrees, the rest in metres. */
  #text(i: number): string {
    const value = this.#shown!.numbers[i]!;
    const isAngle = i < 3 * JOINTS || i === DOFS - 1;
    return isAngle ? figure(value * DEGREES, 0, this.#parts.words) : figure(value, DIGITS, this.#parts.words);
  }
}

function termOf(i: number): string {
  return REST[i - 3 * JOINTS] ?? "w";
}
