/** The walk as a strip: a figure for every step, side by side; the present one moves, the others are about to strike. */
import { POSE_FLOATS } from "../../viewer";
import { RowViewer } from "../../viewer/row_viewer";
import { html, setText } from "../dom";
import type { Theme } from "../state";
import { strings } from "../strings/strings";
import { isDark } from "../theme";
import { coloursOf, mixed } from "./colours";
import { sharesAt, type WalkBlock } from "./plan";
import type { Walked } from "./walking";

/** A figure needs so much room, pixels. */
const FIGURE_PX = 148;
const MOST_FIGURES = 9;

export class Strip {
  readonly element = html("div", { class: "walk-strip", hidden: true });
  readonly #picture = html("div", { class: "walk-strip-picture" });
  readonly #captions = html("div", { class: "walk-strip-captions" });
  #viewer: RowViewer | undefined;
  #theme: "dark" | "light" = "dark";
  #proportions: ArrayLike<number> | undefined;
  #walked: Walked | undefined;
  #colours: string[] = [];
  #names: string[] = [];
  /** What was to be shown last. */
  #shown: { step: number; pose: Float32Array } | undefined;
  /** The first step that is shown, −1 where all is to be shown anew, and the present one. */
  #first = -1;
  #present = -1;

  constructor() {
    this.element.append(this.#picture, this.#captions);
    new ResizeObserver(() => {
      this.#first = -1;
    }).observe(this.element);
  }

  setProportions(proportions: ArrayLike<number>): void {
    this.#proportions = proportions;
    this.#viewer?.setProportions(proportions);
  }

  setVisible(visible: boolean, theme: Theme): void {
    if (this.element.hidden === visible) this.#first = -1;
    this.element.hidden = !visible;
    const wanted = isDark(theme) ? "dark" : "light";
    if (wanted !== this.#theme) this.#first = -1;
    this.#theme = wanted;
    if (this.#viewer) this.#viewer.theme = wanted;
  }

  /** Takes another time through the plan. */
  set(
    walked: Walked,
    blocks: readonly WalkBlock[],
    neutral: string | undefined,
    nameOf: (block: WalkBlock) => string,
  ): void {
    this.#walked = walked;
    this.#colours = coloursOf(blocks, neutral);
    this.#names = blocks.map(nameOf);
    this.#first = -1;
  }

  /** Shows the present step with the pose that is walked. */
  show(step: number, pose: Float32Array): void {
    this.#shown = { step, pose };
    if (this.element.hidden || !this.#walked) return;
    const steps = this.#walked.begins.length - 1;
    const count = Math.max(1, Math.min(MOST_FIGURES, steps, Math.floor(this.element.clientWidth / FIGURE_PX)));
    const first = Math.max(0, Math.min(Math.floor(step / count) * count, steps - count));
    if (first !== this.#first || step !== this.#present) this.#caption(first, count, step);
    [this.#first, this.#present] = [first, step];
    this.#viewer ??= this.#makeViewer();
    this.#viewer.setFigures(
      Array.from({ length: count }, (_, i) => {
        const at = first + i;
        if (at === step) return { pose, reference: null };
        return { pose: this.#strikeOf(at), reference: null, tint: this.#tint(at) };
      }),
    );
  }

  draw(now: number): void {
    if (this.#first < 0 && this.#shown) this.show(this.#shown.step, this.#shown.pose);
    if (this.#viewer && !this.element.hidden && !this.#viewer.still) this.#viewer.render(now / 1000);
  }

  dispose(): void {
    this.#viewer?.dispose();
  }

  #makeViewer(): RowViewer {
    const viewer = new RowViewer(this.#picture, this.#theme, strings.walk.stripPicture);
    if (this.#proportions) viewer.setProportions(this.#proportions);
    viewer.camera("side");
    viewer.settle();
    return viewer;
  }

  #strikeOf(step: number): Float32Array {
    const { begins, poses } = this.#walked!;
    const frame = begins[step + 1]! - 1;
    return poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
  }

  #colourOf(step: number): string {
    const [one, other] = sharesAt(this.#walked!.segments, step);
    const from = this.#colours[one!.block]!;
    return other ? mixed(from, this.#colours[other.block]!, other.share) : from;
  }

  #tint(step: number): string {
    return rgbOf(this.#colourOf(step), this.element);
  }

  #caption(first: number, count: number, present: number): void {
    const { segments } = this.#walked!;
    const captions = Array.from({ length: count }, (_, i) => {
      const step = first + i;
      const [one, other] = sharesAt(segments, step);
      const style = other ? strings.walk.onTheWay(this.#names[other.block]!) : this.#names[one!.block]!;
      const name = html("span", { class: "walk-strip-style" });
      setText(name, style);
      return html(
        "p",
        { class: step === present ? "present" : "", style: `--colour: ${this.#colourOf(step)}` },
        html("span", {}, strings.walk.stepCaption(step + 1)),
        name,
      );
    });
    this.#captions.style.setProperty("--figures", String(count));
    this.#captions.replaceChildren(...captions);
  }
}

const canvas = document.createElement("canvas");
canvas.width = 1;
canvas.height = 1;
const known = new Map<string, string>();

/** What a colour of the page's style sheets is in red, green and blue. */
function rgbOf(colour: string, element: HTMLElement): string {
  const probe = html("i", { style: `color: ${colour}`, hidden: true });
  element.append(probe);
  const computed = getComputedStyle(probe).color;
  probe.remove();
  const before = known.get(computed);
  if (before) return before;
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  context.fillStyle = computed;
  context.fillRect(0, 0, 1, 1);
  const [r, g, b] = context.getImageData(0, 0, 1, 1).data;
  const rgb = `rgb(${r}, ${g}, ${b})`;
  known.set(computed, rgb);
  return rgb;
}
