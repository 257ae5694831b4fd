/**
 * The Model panel: switches of the stages after the regression; folded away its method, its parameters, and labels of the
 * input.
 */

import { type DatabaseInfo, METHODS, type Method } from "../../../client/protocol";
import { PLAY_RANGES } from "../../../link/play";
import { button, Toggle } from "../../../ui/controls/buttons";
import type { DialRange } from "../../../ui/controls/dial";
import { icon } from "../../../ui/controls/icons";
import { Knob } from "../../../ui/controls/knob";
import { html } from "../../../ui/dom";
import { type AppState, FIELDS } from "../../state/state";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";
import { Fold } from "../../ui/fold";
import { spoken } from "../../ui/words";

type KnobField = "k" | "lambda" | "rho" | "kappa" | "delta" | "tempo";

/** The knobs from left to right; with a logarithmic scale if ratios matter. */
const KNOBS: readonly { field: KnobField; symbol: string; scale: DialRange["scale"] }[] = [
  { field: "k", symbol: "K", scale: "log" },
  { field: "lambda", symbol: "λ", scale: "log" },
  { field: "rho", symbol: "ρ", scale: "linear" },
  { field: "kappa", symbol: "κ", scale: "linear" },
  { field: "delta", symbol: "δ", scale: "log" },
  { field: "tempo", symbol: "η", scale: "linear" },
];

const TOGGLES = ["timing", "footplant", "coherence"] as const;

/** Labels of the input that the user may set. */
const LABELS = ["action", "inputStyle"] as const;

/** The fields that are folded away. */
const ADVANCED = [...KNOBS.map(({ field }) => field), "method", ...LABELS] as const;
/** All fields of this panel. */
const FIELDS_HERE = [...TOGGLES, ...ADVANCED] as const;
/** Key in localStorage: whether the advanced settings are open. */
const FOLD_KEY = "strut.advanced";

export class ModelPanel {
  readonly element: HTMLElement;
  readonly #knobs: { field: KnobField; knob: Knob }[];
  readonly #toggles: { field: (typeof TOGGLES)[number]; toggle: Toggle }[];
  readonly #method = html("select", {
    "aria-label": strings.play.model.method,
    "aria-description": strings.play.model.methodWhy,
  });
  readonly #labels = LABELS.map((field) => ({
    field,
    select: html("select", {
      "aria-label": strings.play.model.labels[field].name,
      "aria-description": strings.play.model.labels.why,
    }),
  }));
  readonly #reset: HTMLButtonElement;
  readonly #advanced: Fold;

  constructor(store: Store) {
    this.#knobs = KNOBS.map(({ field, symbol, scale }) => ({
      field,
      knob: new Knob(
        { symbol, ...strings.play.model.knobs[field] },
        { ...PLAY_RANGES[field], scale },
        FIELDS[field].initial,
        {
          onInput: (value) => store.edit({ [field]: value }, field),
          ...store.gestureListeners,
        },
      ),
    }));
    this.#toggles = TOGGLES.map((field) => {
      const { name, description } = strings.play.model.toggles[field];
      const toggle = new Toggle(name, (on) => store.edit({ [field]: on }));
      toggle.description = description;
      return { field, toggle };
    });
    this.#method.append(
      ...METHODS.map((method) => html("option", { value: method }, strings.play.model.methods[method])),
    );
    this.#method.addEventListener("change", () => store.edit({ method: this.#method.value as Method }));
    for (const { field, select } of this.#labels)
      select.addEventListener("change", () => store.edit({ [field]: select.value }));
    const fields = FIELDS_HERE;
    const defaults = Object.fromEntries(fields.map((field) => [field, FIELDS[field].initial])) as Partial<AppState>;
    this.#reset = button(strings.play.model.reset, () => store.edit(defaults), { label: true, class: "plain" });
    this.#reset.setAttribute("aria-label", strings.play.model.resetModel);
    const row = (name: string, why: string, ...selects: HTMLSelectElement[]) =>
      html(
        "div",
        { class: "row labels", title: why },
        html("span", { class: "label", "aria-hidden": "true" }, name),
        ...selects.map((select) => html("div", { class: "select plain-select" }, select, icon("chevron"))),
      );
    const { advanced, method, methodWhy, labels } = strings.play.model;
    this.#advanced = new Fold(advanced.name, FOLD_KEY, [
      row(method, methodWhy, this.#method),
      html("div", { class: "knobs" }, ...this.#knobs.map(({ knob }) => knob.element)),
      row(labels.name, labels.why, ...this.#labels.map(({ select }) => select)),
    ]);
    this.element = html(
      "section",
      { class: "section model", "aria-labelledby": "model-heading" },
      html(
        "div",
        { class: "section-heading" },
        html("h2", { id: "model-heading" }, strings.play.model.heading),
        this.#reset,
      ),
      html("div", { class: "toggles" }, ...this.#toggles.map(({ toggle }) => toggle.element)),
      this.#advanced.element,
    );
  }

  /** Sets the labels of another database. */
  set database({ actions, styles }: DatabaseInfo) {
    for (const { field, select } of this.#labels) {
      const names = field === "action" ? actions : styles;
      const { value } = select;
      select.replaceChildren(
        html("option", { value: "" }, strings.play.model.labels[field].unknown),
        ...names.map((name) => html("option", { value: name }, spoken(name))),
      );
      select.value = value;
    }
  }

  show(state: Readonly<AppState>): void {
    for (const { field, knob } of this.#knobs) knob.value = state[field];
    for (const { field, toggle } of this.#toggles) toggle.on = state[field];
    this.#method.value = state.method;
    for (const { field, select } of this.#labels) select.value = state[field];
    const isChanged = (field: (typeof FIELDS_HERE)[number]) => state[field] !== FIELDS[field].initial;
    this.#reset.disabled = !FIELDS_HERE.some(isChanged);
    this.#advanced.note = strings.play.model.advanced.changed(ADVANCED.filter(isChanged).length);
  }
}
