/** Settings of training and of synthesis, in a menu. */

import { Segment } from "../../../ui/controls/buttons";
import { Slider } from "../../../ui/controls/slider";
import { html, setText } from "../../../ui/dom";
import { KEY_STYLE_RANGES, type KeyCurve, type KeyLearning } from "../../state/key_style";
import { strings } from "../../strings/strings";
import { ComponentMap } from "./components";

export interface ModelMenuListeners {
  onComponents: (components: number) => void;
  onLearning: (learning: KeyLearning) => void;
  onHard: (hard: boolean) => void;
  onCurve: (curve: KeyCurve) => void;
  onSettle: () => void;
}

export class ModelMenu {
  readonly element: HTMLElement;
  readonly map = new ComponentMap();
  readonly #said = html("span");
  readonly #components: Slider;
  readonly #learning: Segment<KeyLearning>;
  readonly #choosing: Segment<"smooth" | "hard">;
  readonly #curve: Segment<KeyCurve>;

  constructor(listeners: ModelMenuListeners) {
    const words = strings.keyStyle;
    this.#components = new Slider(words.componentCount, KEY_STYLE_RANGES.components, 0, {
      onInput: listeners.onComponents,
      onSettle: listeners.onSettle,
    });
    this.#components.words = words.byRule;
    this.#learning = new Segment<KeyLearning>(
      words.learning,
      [
        { value: "som", label: words.som },
        { value: "em", label: words.em },
      ],
      listeners.onLearning,
    );
    this.#choosing = new Segment<"smooth" | "hard">(
      words.choosing,
      [
        { value: "smooth", label: words.smooth },
        { value: "hard", label: words.hard },
      ],
      (value) => listeners.onHard(value === "hard"),
    );
    this.#curve = new Segment<KeyCurve>(
      words.curve,
      [
        { value: "spline", label: words.curves.spline },
        { value: "monotone", label: words.curves.monotone },
      ],
      listeners.onCurve,
    );
    const row = (name: string, control: HTMLElement) =>
      html("div", { class: "row" }, html("span", { class: "label", "aria-hidden": "true" }, name), control);
    this.element = html(
      "div",
      { class: "model-menu" },
      this.map.element,
      html(
        "details",
        {},
        html("summary", { class: "button" }, this.#said),
        html(
          "div",
          { class: "model-settings", role: "group", "aria-label": words.modelSettings },
          this.#components.element,
          row(words.learning, this.#learning.element),
          row(words.choosing, this.#choosing.element),
          html("p", { class: "caption" }, words.smoothWhy),
          row(words.curve, this.#curve.element),
        ),
      ),
    );
  }

  say(words: string): void {
    setText(this.#said, words);
  }

  show(components: number, learning: KeyLearning, hard: boolean, curve: KeyCurve): void {
    this.#components.value = components;
    this.#learning.value = learning;
    this.#choosing.value = hard ? "hard" : "smooth";
    this.#curve.value = curve;
  }
}
