/** The picture: the body with its measures as dimension lines and the nearest recorded pose, or three of them side by side. */
import { POSE_FLOATS, VIEWER_DEFAULTS } from "../../viewer";
import type { PuppetFrame } from "../../worker/key_style/key_style";
import { button, Segment } from "../controls/buttons";
import { formatNumber, html, setText } from "../dom";
import type { KeyMethod, PlayState } from "../state";
import { strings } from "../strings/strings";
import type { Picture } from "../views";
import { capitalised, numberWord, spoken } from "../words";
import { shortTitleOf } from "./axes";
import { Comparison } from "./comparison";
import { DimensionLines, type Measured } from "./dimension_lines";
import type { Learned, Learner } from "./learner";
import { ModelMenu, type ModelMenuListeners } from "./model_menu";
import type { Performance } from "./performance";
import type { Player } from "./player";
import { parseSet } from "./sets";

const words = strings.keyStyle;

export interface PicturePanelListeners extends ModelMenuListeners {
  onMethod: (method: KeyMethod) => void;
  onGhost: () => void;
}

export class PicturePanel {
  readonly element: HTMLElement;
  readonly #stage = html("div", { class: "maker-stage" });
  readonly #title = html("h1", { class: "stage-title" });
  readonly #caption = html("p", { class: "caption" });
  readonly #dimensions = new DimensionLines();
  readonly #comparison = new Comparison();
  readonly #method: Segment<KeyMethod>;
  readonly #ghost: HTMLButtonElement;
  readonly #menu: ModelMenu;
  #picture: Picture | undefined;
  #ghosted = true;
  /** Whether the camera knows where the body faces. */
  #aimed = false;
  #measured: Measured[] = [];
  readonly #pose = new Float32Array(POSE_FLOATS);

  constructor(learner: Learner, listeners: PicturePanelListeners) {
    this.#menu = new ModelMenu(listeners);
    this.#method = new Segment<KeyMethod>(
      words.method,
      (["style", "hybrid", "frame", "all"] as const).map((value) => ({ value, label: words.methods[value] })),
      listeners.onMethod,
    );
    this.#ghost = button(words.ghost, listeners.onGhost, { icon: "ghost", label: true, class: "chip", keys: "G" });
    this.element = html(
      "section",
      { class: "maker-picture", "aria-label": words.picture },
      this.#stage,
      this.#dimensions.element,
      this.#comparison.element,
      html("div", { class: "stage-heading" }, this.#title, this.#caption),
      html("div", { class: "key-style-method" }, this.#method.element),
      html("div", { class: "key-style-chips" }, this.#ghost),
      this.#menu.element,
      learner.progress.element,
      learner.empty,
    );
  }

  /** Borrows the page's picture until {@link give}. */
  take(borrow: (container: HTMLElement) => Picture): void {
    this.#picture = borrow(this.#stage);
    const { viewer } = this.#picture;
    viewer.description = words.picture;
    viewer.ghost = "overlay";
    this.#aimed = false;
  }

  give(): void {
    if (this.#picture) this.#picture.viewer.description = VIEWER_DEFAULTS.description;
    this.#picture = undefined;
  }

  /** Takes another model's body and components. */
  present({ performance: { model, rows } }: Learned): void {
    this.#picture?.viewer.setProportions(model.proportions);
    this.#comparison.setProportions(model.proportions);
    this.#menu.map.show(model.centres, rows);
    this.jump();
  }

  /** The body is put elsewhere on the floor. */
  jump(): void {
    this.#picture?.viewer.resetTrail();
  }

  /** Shows the fields of the state that concern the picture. */
  show(state: Readonly<PlayState>, learned: Learned | undefined, refused: boolean): void {
    this.#method.value = state.keyMethod;
    this.#comparison.setVisible(state.keyMethod === "all" && learned !== undefined, state.theme);
    this.element.classList.toggle("comparing", this.#comparison.visible);
    this.#ghosted = state.keyGhost;
    this.#ghost.setAttribute("aria-pressed", String(state.keyGhost));
    this.#menu.show(state.keyComponents, state.keyLearning, state.keyHard, state.keyCurve);
    if (!learned) {
      setText(this.#title, refused ? words.nothing : words.training);
      setText(this.#caption, "");
      return;
    }
    const { performance, trained } = learned;
    const n = performance.rows.length;
    this.#menu.say(words.model(performance.model.components, formatNumber(trained.secs, 2)));
    setText(this.#title, titleOf(state, trained.learned));
    const open = trained.leftOpen > 0 ? words.leftOpen(formatNumber(100 * trained.leftOpen, 0)) : "";
    setText(this.#caption, open || words.caption(words.numbers(n, numberWord(n))));
  }

  /** Shows a pose, the variables that it was made of, and the training frame that is nearest to them. */
  showFrame(
    frame: PuppetFrame,
    values: readonly number[],
    nearest: number,
    { model, rows }: Performance,
    player: Player,
  ): void {
    this.#measured = rows.map(({ title, unit, digits }, axis) => {
      const name = model.axes[axis]!;
      const measured = frame.measured[axis]!;
      // Speed is no measure of a pose.
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
    // A body that has come to rest lets the picture rest.
    if (frame.pose.some((value, i) => value !== this.#pose[i])) this.#picture.invalidate();
    this.#pose.set(frame.pose);
    if (this.#comparison.visible) this.#comparison.show((way) => player.poseOf(way) ?? this.#pose);
  }

  /** Draws what follows the camera. */
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

  /** Has the picture drawn once more. */
  invalidate(): void {
    this.#picture?.invalidate();
  }

  dispose(): void {
    this.#comparison.dispose();
  }
}

/** What is learned from, in words. */
function titleOf({ keySet, keyClips }: Readonly<PlayState>, learned: readonly string[]): string {
  const { action } = parseSet(keySet);
  if (keyClips.length > 1) return words.chosenClips(learned.length);
  return capitalised(spoken(keyClips.length === 1 || action === "" ? (learned[0] ?? "") : action));
}
