/** Settings of training and of synthesis, in a menu. */

import { Segment } from "../../../ui/controls/buttons";
import { Slider } from "../../../ui/controls/slider";
import { html, setText } from "../../../ui/dom";
import { KEY_STYLE_RANGES, type KeyCurve, type KeyLearning } from "../../state/key_style";
import type { AppState } from "../../state/state";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { ComponentMap } from "./components";

export class ModelMenu {
  readonly element: HTMLElement;
  readonly map = new ComponentMap();
  readonly #said = html("span");
  readonly #components: Slider;
  readonly #learning: Segment<KeyLearning>;
  readonly #choosing: Segment<"smooth" | "hard">;
  readonly #curve: Segment<KeyCurve>;

  constructor(store: Store) {
    const words = strings.keyStyle;
    this.#components = new Slider(words.componentCount, KEY_STYLE_RANGES.components, 0, {
      onInput: (keyComponents) => store.edit({ keyComponents }, "key-style components"),
      onSettle: () => store.endGesture(),
    });
    this.#components.words = words.byRule;
    this.#learning = new Segment<KeyLearning>(
      words.learning,
      [
        { value: "som", label: words.som },
        { value: "em", label: words.em },
      ],
      (keyLearning) => store.edit({ keyLearning }),
    );
    this.#choosing = new Segment<"smooth" | "hard">(
      words.choosing,
      [
        { value: "smooth", label: words.smooth },
        { value: "hard", label: words.hard },
      ],
      (value) => store.edit({ keyHard: value === "hard" }),
    );
    this.#curve = new Segment<KeyCurve>(
      words.curve,
      [
        { value: "spline", label: words.curves.spline },
        { value: "monotone", label: words.curves.monotone },
      ],
      (keyCurve) => store.edit({ keyCurve }),
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

  show({ keyComponents, keyLearning, keyHard, keyCurve }: Readonly<AppState>): void {
    this.#components.value = keyComponents;
    this.#learning.value = keyLearning;
    this.#choosing.value = keyHard ? "hard" : "smooth";
    this.#curve.value = keyCurve;
  }
}
