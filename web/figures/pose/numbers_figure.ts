/** All numbers of a pose; those that differ from the input's are marked. */
import { DEGREES, JOINTS, ROLES } from "../../humanoid";
import { html, setText } from "../../ui/dom";
import type { FigureKind, FigureParts } from "../kind";
import { LiveFigure } from "../live_figure";
import sheet from "./pose.css?inline";
import { DOFS, framesOf, measurePose, motionOf, numbersAt, same } from "./pose_measure";
import { POSE_FIELDS, type PoseState } from "./pose_state";

/** Terms of the numbers after those of the joints. */
const REST = ["h", "v", "v", "psi"] as const;
/** Decimals of metres and of metres per second. */
const DIGITS = 2;

export const NUMBERS: FigureKind<PoseState> = {
  fields: POSE_FIELDS,
  measure: measurePose,
  sheet,
  create: (parts) => new NumbersFigure(parts),
};

interface Shown {
  state: PoseState;
  /** As text: angles in degrees, the rest in metres. */
  numbers: string[];
  /** Whether each differs from the input's. */
  changed: boolean[];
  count: string;
}

class NumbersFigure extends LiveFigure<PoseState, Shown> {
  readonly #cells = Array.from({ length: DOFS }, (_, i) => html("span", { class: "cell", "data-term": termOf(i) }));

  constructor(parts: FigureParts<PoseState>) {
    super(parts);
    const { pose, joints } = parts.words;
    const row = (name: string, first: number, count: number) => {
      const cells = this.#cells.slice(first, first + count);
      return html("div", { class: "numbers-row" }, html("span", { class: "name" }, name), ...cells);
    };
    const list = html(
      "div",
      { class: "numbers" },
      ...ROLES.map((role, joint) => row(pose.angles(joints[role]), 3 * joint, 3)),
      ...[pose.height, pose.sideways, pose.forwards, pose.turning].map((name, i) => row(name, 3 * JOINTS + i, 1)),
    );
    this.lay({ title: pose.numbers, picture: html("div", { class: "picture listed" }, list) });
  }

  override light(term: string | undefined): void {
    const joint = this.state && ROLES.indexOf(this.state.joint);
    // w belongs to the joint that is read.
    this.#cells.forEach((cell, i) => {
      cell.classList.toggle("lit", cell.dataset.term === term && (term !== "w" || Math.floor(i / 3) === joint));
    });
  }

  protected async load(state: PoseState): Promise<Shown> {
    const { engine } = this.parts;
    const [plain, motion] = await Promise.all([
      motionOf(engine, state.motion, [], 0),
      motionOf(engine, state.motion, state.turned, state.heading),
    ]);
    const frame = Math.min(state.at, framesOf(motion) - 1);
    const [before, numbers] = [numbersAt(plain, frame), numbersAt(motion, frame)];
    const changed = Array.from(numbers, (value, i) => !same(value, before[i]!));
    const text = (value: number, i: number) =>
      i < 3 * JOINTS || i === DOFS - 1 ? this.number(value * DEGREES, 0) : this.number(value, DIGITS);
    return { state, numbers: Array.from(numbers, text), changed, count: String(changed.filter(Boolean).length) };
  }

  protected redraw(): void {
    const { numbers, changed, count } = this.shown!;
    this.#cells.forEach((cell, i) => {
      setText(cell, numbers[i]!);
      cell.classList.toggle("changed", changed[i]!);
    });
    setText(this.readout, this.words.pose.counted(count, String(DOFS)));
    this.parts.changed();
  }

  protected describe({ count, state: { heading, turned } }: Shown): string {
    return this.words.pose.listed(count, String(DOFS), String(heading), String(turned.length));
  }

  protected get columns() {
    return this.words.pose.components;
  }

  protected rows({ numbers }: Shown): string[][] {
    return ROLES.map((role, joint) => [this.words.joints[role], ...numbers.slice(3 * joint, 3 * joint + 3)]);
  }

  protected override quantities({ numbers }: Shown) {
    const [h, v0, v1, psi] = numbers.slice(3 * JOINTS);
    return { h: `${h} m`, v: `${v0}, ${v1} m/s`, psi: `${psi} °/s` };
  }
}

function termOf(i: number): string {
  return REST[i - 3 * JOINTS] ?? "w";
}
