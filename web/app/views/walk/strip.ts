/** The walk as a strip: one figure per step, side by side. The current step moves, the others show their last pose. */

import "./strip.css";
import { POSE_FLOATS } from "../../../humanoid";
import { html, setText } from "../../../ui/dom";
import { isDark, type Theme } from "../../../ui/theme";
import { SideBySideViewer } from "../../../viewer/side_by_side_viewer";
import type { WalkBlock } from "../../state/walk";
import { strings } from "../../strings/strings";
import { onResize } from "../../ui/resize";
import { coloursOf, mixed } from "./colours";
import { sharesAt } from "./plan";
import type { PlannedWalk } from "./plan_walker";

/** Minimum width of a figure, pixels. */
const FIGURE_PX = 148;
const MAX_FIGURES = 9;

export class Strip {
  readonly element = html("div", { class: "walk-strip", hidden: true });
  readonly #picture = html("div", { class: "walk-strip-picture" });
  readonly #captions = html("div", { class: "walk-strip-captions" });
  #viewer: SideBySideViewer | undefined;
  #theme: "dark" | "light" = "dark";
  #proportions: ArrayLike<number> | undefined;
  #walk: PlannedWalk | undefined;
  #colours: string[] = [];
  #names: string[] = [];
  /** The current step and its pose. */
  #shown: { step: number; pose: Float32Array } | undefined;
  /** First displayed step, −1 if everything must be redrawn, and the current step. */
  #first = -1;
  #present = -1;

  constructor() {
    this.element.append(this.#picture, this.#captions);
  }

  /** Follows the size of the page until `signal` aborts; then the graphics context is released. */
  attach(signal: AbortSignal): void {
    onResize(this.element, () => this.#drawAnew(), signal);
    signal.addEventListener("abort", () => this.#release(), { once: true });
  }

  setProportions(proportions: ArrayLike<number>): void {
    this.#proportions = proportions;
    this.#viewer?.setProportions(proportions);
  }

  setVisible(visible: boolean, theme: Theme): void {
    if (this.element.hidden === visible) this.#drawAnew();
    this.element.hidden = !visible;
    const wanted = isDark(theme) ? "dark" : "light";
    if (wanted !== this.#theme) this.#drawAnew();
    this.#theme = wanted;
    if (this.#viewer) this.#viewer.theme = wanted;
  }

  /** Sets one pass through another plan. */
  set(
    walk: PlannedWalk,
    blocks: readonly WalkBlock[],
    neutral: string | undefined,
    nameOf: (block: WalkBlock) => string,
  ): void {
    this.#walk = walk;
    this.#colours = coloursOf(blocks, neutral);
    this.#names = blocks.map(nameOf);
    this.#drawAnew();
  }

  /** Shows the pose of the current step. */
  show(step: number, pose: Float32Array): void {
    this.#shown = { step, pose };
    if (this.element.hidden || !this.#walk) return;
    const steps = this.#walk.stepStarts.length - 1;
    const count = Math.max(1, Math.min(MAX_FIGURES, steps, Math.floor(this.element.clientWidth / FIGURE_PX)));
    const first = Math.max(0, Math.min(Math.floor(step / count) * count, steps - count));
    if (first !== this.#first || step !== this.#present) this.#caption(first, count, step);
    [this.#first, this.#present] = [first, step];
    this.#viewer ??= this.#makeViewer();
    this.#viewer.setFigures(
      Array.from({ length: count }, (_, i) => {
        const at = first + i;
        if (at === step) return { pose, reference: null };
        return { pose: this.#lastPoseOf(at), reference: null, tint: this.#tint(at) };
      }),
    );
  }

  draw(now: number): void {
    if (this.#first < 0 && this.#shown) this.show(this.#shown.step, this.#shown.pose);
    if (this.#viewer && !this.element.hidden && !this.#viewer.still) this.#viewer.render(now / 1000);
  }

  #drawAnew(): void {
    this.#first = -1;
  }

  #release(): void {
    this.#viewer?.dispose();
    this.#viewer = undefined;
    this.#drawAnew();
  }

  #makeViewer(): SideBySideViewer {
    const viewer = new SideBySideViewer(this.#picture, this.#theme, strings.walk.stripPicture);
    if (this.#proportions) viewer.setProportions(this.#proportions);
    viewer.camera("side");
    viewer.settle();
    return viewer;
  }

  #lastPoseOf(step: number): Float32Array {
    const { stepStarts, poses } = this.#walk!;
    const frame = stepStarts[step + 1]! - 1;
    return poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
  }

  #colourOf(step: number): string {
    const [one, other] = sharesAt(this.#walk!.segments, step);
    const from = this.#colours[one!.block]!;
    return other ? mixed(from, this.#colours[other.block]!, other.share) : from;
  }

  #tint(step: number): string {
    return rgbOf(this.#colourOf(step), this.element);
  }

  #caption(first: number, count: number, present: number): void {
    const { segments } = this.#walk!;
    const captions = Array.from({ length: count }, (_, i) => {
      const step = first + i;
      const [one, other] = sharesAt(segments, step);
      const style = other ? strings.walk.onTheWay(this.#names[other.block]!) : this.#names[one!.block]!;
      const name = html("span", { class: "walk-strip-style" });
      setText(name, style);
      const caption = html(
        "p",
        { class: step === present ? "present" : "" },
        html("span", {}, strings.walk.stepCaption(step + 1)),
        name,
      );
      caption.style.setProperty("--colour", this.#colourOf(step));
      return caption;
    });
    this.#captions.style.setProperty("--figures", String(count));
    this.#captions.replaceChildren(...captions);
  }
}

/** Resolved colours of the style sheets as `rgb(…)`. */
const known = new Map<string, string>();
let canvas: CanvasRenderingContext2D | undefined;

/** Red, green and blue of a colour that may use variables of the style sheets. */
function rgbOf(colour: string, element: HTMLElement): string {
  const probe = html("i", { hidden: true });
  probe.style.setProperty("color", colour);
  element.append(probe);
  const computed = getComputedStyle(probe).color;
  probe.remove();
  const rgb = known.get(computed) ?? pixelOf(computed);
  known.set(computed, rgb);
  return rgb;
}

/** three.js parses few CSS colours; a canvas parses all of them. */
function pixelOf(colour: string): string {
  canvas ??= html("canvas", { width: 1, height: 1 }).getContext("2d", { willReadFrequently: true })!;
  canvas.fillStyle = colour;
  canvas.fillRect(0, 0, 1, 1);
  const [r, g, b] = canvas.getImageData(0, 0, 1, 1).data;
  return `rgb(${r}, ${g}, ${b})`;
}
