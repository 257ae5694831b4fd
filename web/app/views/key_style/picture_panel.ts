/** The picture: the body with dimension lines and the nearest recorded pose, or three methods side by side. */

import "./picture_panel.css";
import type { KeyStyleFrame } from "../../../client/models/key_style";
import { POSE_FLOATS } from "../../../humanoid";
import { button, Segment } from "../../../ui/controls/buttons";
import { formatNumber, html, setText } from "../../../ui/dom";
import type { KeyMethod } from "../../state/key_style";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { capitalised, numberWord, spoken } from "../../ui/words";
import type { ViewerLease } from "../../view";
import { shortTitleOf } from "./axes";
import { Comparison } from "./comparison";
import { DimensionLines, type Measured } from "./dimension_lines";
import type { KeyMotion } from "./key_motion";
import { ModelMenu } from "./model_menu";
import type { ModelTrainer, OpenModel } from "./model_trainer";
import type { Player } from "./player";
import { parseSet } from "./sets";

const words = strings.keyStyle;

export class PicturePanel {
  readonly element: HTMLElement;
  readonly #stage = html("div", { class: "editor-stage" });
  readonly #title = html("h1", { class: "stage-title" });
  readonly #caption = html("p", { class: "caption" });
  readonly #dimensions = new DimensionLines();
  readonly #comparison = new Comparison();
  readonly #method: Segment<KeyMethod>;
  readonly #ghost: HTMLButtonElement;
  readonly #menu: ModelMenu;
  #picture: ViewerLease | undefined;
  #ghosted = true;
  /** Whether the camera was aimed at the body's heading. */
  #aimed = false;
  #measured: Measured[] = [];
  readonly #pose = new Float32Array(POSE_FLOATS);

  constructor(trainer: ModelTrainer, store: Store) {
    this.#menu = new ModelMenu(store);
    this.#method = new Segment<KeyMethod>(
      words.method,
      (["style", "hybrid", "frame", "all"] as const).map((value) => ({ value, label: words.methods[value] })),
      (keyMethod) => store.edit({ keyMethod }),
    );
    this.#ghost = button(words.ghost, () => store.edit({ keyGhost: !store.state.keyGhost }), {
      icon: "ghost",
      label: true,
      class: "chip",
      keys: "G",
    });
    this.element = html(
      "div",
      { class: "editor-picture" },
      this.#stage,
      this.#dimensions.element,
      this.#comparison.element,
      html("div", { class: "stage-heading" }, this.#title, this.#caption),
      html("div", { class: "key-style-method" }, this.#method.element),
      html("div", { class: "key-style-chips" }, this.#ghost),
      this.#menu.element,
      trainer.progress.element,
      trainer.empty.element,
    );
  }

  /** Borrows the page's picture until {@link give}. */
  take(borrow: (container: HTMLElement) => ViewerLease): void {
    this.#picture = borrow(this.#stage);
    const { viewer } = this.#picture;
    viewer.description = words.picture;
    viewer.ghost = "overlay";
    this.#aimed = false;
  }

  give(): void {
    this.#picture = undefined;
    this.#comparison.release();
  }

  /** Shows another model's body and components. */
  present({ motion: { model, rows } }: OpenModel): void {
    this.#picture?.viewer.setProportions(model.proportions);
    this.#comparison.setProportions(model.proportions);
    this.#menu.map.show(model.centres, rows);
    this.jump();
  }

  /** The body is moved on the ground. */
  jump(): void {
    this.#picture?.viewer.resetTrail();
  }

  /** Shows the fields of the state that concern the picture. */
  show(state: Readonly<AppState>, open: OpenModel | undefined, refused: boolean): void {
    this.#method.value = state.keyMethod;
    this.#comparison.setVisible(state.keyMethod === "all" && open !== undefined, state.theme);
    this.element.classList.toggle("comparing", this.#comparison.visible);
    this.#ghosted = state.keyGhost;
    this.#ghost.setAttribute("aria-pressed", String(state.keyGhost));
    this.#menu.show(state);
    if (!open) {
      setText(this.#title, refused ? words.nothing : words.training);
      setText(this.#caption, "");
      return;
    }
    const { motion, trained } = open;
    const n = motion.rows.length;
    this.#menu.say(words.model(motion.model.components, formatNumber(trained.secs, 2)));
    setText(this.#title, titleOf(state, trained.trainedOn));
    const note = trained.unexplainedShare > 0 ? words.unexplained(formatNumber(100 * trained.unexplainedShare, 0)) : "";
    setText(this.#caption, note || words.caption(words.numbers(n, numberWord(n))));
  }

  /** Shows a pose, its variables, and the training frame nearest to them. */
  showFrame(
    frame: KeyStyleFrame,
    values: readonly number[],
    nearest: number,
    { model, rows }: KeyMotion,
    player: Player,
  ): void {
    this.#measured = rows.map(({ title, unit, digits }, axis) => {
      const name = model.axes[axis]!;
      const measured = frame.measured[axis]!;
      // Speed is not a measure of a pose.
      const value = Number.isFinite(measured) ? measured : values[axis]!;
      return { axis: name, words: words.valueOf(shortTitleOf(name) || title, formatNumber(value, digits), unit) };
    });
    this.#menu.map.weights = frame.weights;
    if (!this.#picture) return;
    const { viewer } = this.#picture;
    viewer.setStyled(frame.pose);
    if (!this.#aimed) {
      this.#aimed = true;
      viewer.camera("side", true);
      viewer.resetTrail();
    }
    viewer.setInput(this.#ghosted ? (model.recorded(nearest) ?? null) : null);
    // No redraw while the body is at rest.
    if (frame.pose.some((value, i) => value !== this.#pose[i])) this.#picture.invalidate();
    this.#pose.set(frame.pose);
    if (this.#comparison.visible) this.#comparison.show((way) => player.poseOf(way) ?? this.#pose);
  }

  /** Draws the parts that follow the camera. */
  draw(now: number): void {
    this.#comparison.draw(now);
    if (!this.#picture) return;
    if (this.#comparison.visible) {
      this.#dimensions.clear();
      return;
    }
    const { viewer } = this.#picture;
    this.#dimensions.draw(this.#measured, viewer.joints, ([x, y, z]) => viewer.screenPosition(x, y, z));
  }

  /** Redraws the picture. */
  invalidate(): void {
    this.#picture?.invalidate();
  }
}

/** The training motions in words. */
function titleOf({ keySet, keyClips }: Readonly<AppState>, trainedOn: readonly string[]): string {
  const { action } = parseSet(keySet);
  if (keyClips.length > 1) return words.chosenClips(trainedOn.length);
  return capitalised(spoken(keyClips.length === 1 || action === "" ? (trainedOn[0] ?? "") : action));
}
