/** The Model panel: the knobs of the regression, and what is switched on behind it. */
import { type DatabaseInfo, METHODS, type Method } from "../../worker/protocol";
import { button, Toggle } from "../controls/buttons";
import type { DialRange } from "../controls/dial";
import { icon } from "../controls/icons";
import { Knob } from "../controls/knob";
import { html } from "../dom";
import { FIELDS, type PlayState, RANGES } from "../state";
import type { Store } from "../store";
import { spoken } from "../words";

type KnobField = "k" | "lambda" | "rho" | "kappa" | "delta";

/** The knobs from left to right. Those whose effect goes by ratio turn logarithmically. */
const KNOBS: readonly {
  field: KnobField;
  symbol: string;
  name: string;
  description: string;
  scale: DialRange["scale"];
}[] = [
  { field: "k", symbol: "K", name: "Neighbours", description: "K: neighbours of the pose in each class", scale: "log" },
  {
    field: "lambda",
    symbol: "λ",
    name: "Ridge",
    description: "λ: how strongly the fit is held back, in units of K",
    scale: "log",
  },
  {
    field: "rho",
    symbol: "ρ",
    name: "Kept content",
    description: "ρ: share of what is unlike the data that is given back",
    scale: "linear",
  },
  {
    field: "kappa",
    symbol: "κ",
    name: "Tolerance",
    description: "κ: deviations from the data that still count as like it",
    scale: "linear",
  },
  {
    field: "delta",
    symbol: "δ",
    name: "Mixture width",
    description: "δ: small picks one class, large mixes many",
    scale: "log",
  },
];

const TOGGLES = [
  {
    field: "timing",
    name: "Timing",
    description: "Whether the style has its own timing: watch the ticks of the timeline",
  },
  { field: "footplant", name: "Footplant", description: "Whether planted feet are held: without it watch them slide" },
  {
    field: "coherence",
    name: "Coherence",
    description: "Whether the output is kept from trembling where the database does not know the input",
  },
] as const;

/** What may be said of the input. */
const LABELS = [
  { field: "action", name: "Action of the input", unknown: "any action" },
  { field: "inputStyle", name: "Style of the input", unknown: "any style" },
] as const;

/** All fields of this panel. */
const FIELDS_HERE = [...[...KNOBS, ...TOGGLES].map(({ field }) => field), "method", "action", "inputStyle"] as const;

/** Names of the methods, as people choose them. */
export const METHOD_NAMES: Readonly<Record<Method, string>> = {
  mar: "mixture of regressions",
  lar: "one regression",
  knn: "mean of the neighbours",
  nn: "nearest neighbour",
};

export class ModelPanel {
  readonly element: HTMLElement;
  readonly #knobs: { field: KnobField; knob: Knob }[];
  readonly #toggles: { field: (typeof TOGGLES)[number]["field"]; toggle: Toggle }[];
  readonly #method = html("select", { "aria-label": "Method" });
  readonly #labels = LABELS.map(({ field, name }) => ({ field, select: html("select", { "aria-label": name }) }));
  readonly #reset: HTMLButtonElement;

  constructor(store: Store) {
    this.#knobs = KNOBS.map(({ field, scale, ...text }) => ({
      field,
      knob: new Knob(text, { ...RANGES[field], scale }, FIELDS[field].initial, {
        onInput: (value) => store.edit({ [field]: value }, field),
        onSettle: () => store.endGesture(),
      }),
    }));
    this.#toggles = TOGGLES.map(({ field, name, description }) => {
      const toggle = new Toggle(name, (on) => store.edit({ [field]: on }));
      toggle.element.title = description;
      return { field, toggle };
    });
    this.#method.append(...METHODS.map((method) => html("option", { value: method }, METHOD_NAMES[method])));
    this.#method.addEventListener("change", () => store.edit({ method: this.#method.value as Method }));
    for (const { field, select } of this.#labels)
      select.addEventListener("change", () => store.edit({ [field]: select.value }));
    const fields = FIELDS_HERE;
    const defaults = Object.fromEntries(fields.map((field) => [field, FIELDS[field].initial])) as Partial<PlayState>;
    this.#reset = button("Reset", () => store.edit(defaults), { label: true, class: "plain" });
    this.#reset.setAttribute("aria-label", "Reset the model");
    const method = html("div", { class: "select plain-select" }, this.#method, icon("chevron"));
    method.title = "How the neighbours become a prediction; a knob that a method does not use has no effect";
    this.element = html(
      "section",
      { class: "section model", "aria-labelledby": "model-heading" },
      html("div", { class: "section-heading" }, html("h2", { id: "model-heading" }, "Model"), method, this.#reset),
      html("div", { class: "knobs" }, ...this.#knobs.map(({ knob }) => knob.element)),
      html("div", { class: "toggles" }, ...this.#toggles.map(({ toggle }) => toggle.element)),
      html(
        "div",
        {
          class: "row labels",
          title: "Say what the input is, and only such examples are looked for: watch what it reads as, and the cost",
        },
        html("span", { class: "label", "aria-hidden": "true" }, "Input is"),
        ...this.#labels.map(({ select }) => html("div", { class: "select plain-select" }, select, icon("chevron"))),
      ),
    );
  }

  /** Takes the labels of another database. */
  set database({ actions, styles }: DatabaseInfo) {
    for (const [i, { select }] of this.#labels.entries()) {
      const { field, unknown } = LABELS[i]!;
      const names = field === "action" ? actions : styles;
      const { value } = select;
      select.replaceChildren(
        html("option", { value: "" }, unknown),
        ...names.map((name) => html("option", { value: name }, spoken(name))),
      );
      select.value = value;
    }
  }

  show(state: Readonly<PlayState>): void {
    for (const { field, knob } of this.#knobs) knob.value = state[field];
    for (const { field, toggle } of this.#toggles) toggle.on = state[field];
    this.#method.value = state.method;
    for (const { field, select } of this.#labels) select.value = state[field];
    this.#reset.disabled = FIELDS_HERE.every((field) => state[field] === FIELDS[field].initial);
  }
}
