/** The motion of the keys by three methods side by side: key-style, hybrid and key-framing. */

import type { Between } from "../../../client/models/key_style";
import { POSE_FLOATS } from "../../../humanoid";
import { html } from "../../../ui/dom";
import { isDark, type Theme } from "../../../ui/theme";
import { SideBySideViewer } from "../../../viewer/side_by_side_viewer";
import { strings } from "../../strings/strings";

export const WAYS: readonly Between[] = ["style", "hybrid", "frame"];

export class Comparison {
  readonly element: HTMLElement;
  readonly #picture = html("div", { class: "comparison-picture" });
  readonly #figures = WAYS.map(() => ({ pose: new Float32Array(POSE_FLOATS), reference: null }));
  #viewer: SideBySideViewer | undefined;
  #theme: "dark" | "light" = "dark";
  #proportions: ArrayLike<number> | undefined;

  constructor() {
    const captions = WAYS.map((way) =>
      html(
        "p",
        {},
        html("b", {}, strings.keyStyle.methods[way]),
        html("span", { class: "caption" }, strings.keyStyle.methodCaptions[way]),
      ),
    );
    this.element = html(
      "div",
      { class: "comparison", hidden: true },
      this.#picture,
      html("div", { class: "comparison-captions" }, ...captions),
      html("p", { class: "caption comparison-why" }, strings.keyStyle.compared),
    );
  }

  setProportions(proportions: ArrayLike<number>): void {
    this.#proportions = proportions;
    this.#viewer?.setProportions(proportions);
  }

  setVisible(visible: boolean, theme: Theme): void {
    this.element.hidden = !visible;
    this.#theme = isDark(theme) ? "dark" : "light";
    if (this.#viewer) this.#viewer.theme = this.#theme;
  }

  get visible(): boolean {
    return !this.element.hidden;
  }

  /** Shows the pose of each of {@link WAYS}; they may share one array. */
  show(poseOf: (way: Between) => Float32Array): void {
    this.#viewer ??= this.#makeViewer();
    for (const [i, { pose }] of this.#figures.entries()) pose.set(poseOf(WAYS[i]!));
    this.#viewer.setFigures(this.#figures);
  }

  draw(now: number): void {
    if (this.#viewer && this.visible && !this.#viewer.still) this.#viewer.render(now / 1000);
  }

  /** Releases the graphics context; the next pose creates another one. */
  release(): void {
    this.#viewer?.dispose();
    this.#viewer = undefined;
  }

  #makeViewer(): SideBySideViewer {
    const viewer = new SideBySideViewer(this.#picture, this.#theme, strings.keyStyle.comparePicture);
    if (this.#proportions) viewer.setProportions(this.#proportions);
    viewer.camera("side", true);
    viewer.settle();
    return viewer;
  }
}
