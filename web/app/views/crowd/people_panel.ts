/** The panels of the agents, their route, and the cost of drawing them. */

import { button, Segment } from "../../../ui/controls/buttons";
import { Slider } from "../../../ui/controls/slider";
import { formatNumber, html, setText } from "../../../ui/dom";
import { CROWD_KINDS, CROWD_RANGES, type CrowdKind, type People } from "../../state/crowd";
import type { Store } from "../../state/store";
import { strings } from "../../strings/strings";

const words = strings.crowd;

/** Measurements; `undefined` until they are available. */
export interface Figures {
  fps: number | undefined;
  tickMs: number | undefined;
  frameMs: number | undefined;
  drawnBy: string;
}

export class PeoplePanel {
  readonly element: HTMLElement;
  readonly #kind: Segment<CrowdKind>;
  readonly #count: Slider;
  readonly #seed = html("input", {
    type: "number",
    class: "text crowd-seed",
    min: CROWD_RANGES.seed.min,
    max: CROWD_RANGES.seed.max,
    step: 1,
    "aria-label": words.seed,
  });
  readonly #limit = html("p", { class: "crowd-people-limit caption", role: "status" });
  readonly #draw: HTMLButtonElement;
  readonly #clear: HTMLButtonElement;
  readonly #route = html("p", { class: "caption" });
  readonly #cost = html("span");
  readonly #figures = { fps: html("dd"), tickMs: html("dd"), frameMs: html("dd"), drawnBy: html("dd") };

  /**
   * @param people the current agents
   * @param onDraw starts or ends drawing a route by hand
   */
  constructor(store: Store, people: () => People, onDraw: () => void) {
    const { onSettle } = store.gestureListeners;
    const onSeed = (seed: number) => store.edit({ crowd: { ...people(), seed } });
    this.#kind = new Segment(
      words.kinds,
      CROWD_KINDS.map((value) => ({ value, label: words.of[value].kind })),
      (crowdKind) => store.edit({ crowdKind }),
    );
    this.#count = new Slider(words.count, CROWD_RANGES.count, 200, {
      onInput: (count) => store.edit({ crowd: { ...people(), count } }, "crowd count"),
      onSettle,
    });
    const { min, max } = CROWD_RANGES.seed;
    this.#seed.addEventListener("change", () => {
      const seed = this.#seed.valueAsNumber;
      if (Number.isInteger(seed) && seed >= min && seed <= max) onSeed(seed);
      else this.#seed.value = String(this.#shownSeed);
    });
    const shuffle = button(words.shuffle, () => onSeed(min + Math.floor(Math.random() * (max - min + 1))), {
      icon: "random",
      label: true,
      class: "outlined",
    });
    this.#draw = button(words.draw, onDraw, { icon: "trail", label: true, class: "outlined" });
    this.#clear = button(words.clear, () => store.edit({ route: [] }), {
      icon: "remove",
      label: true,
      class: "outlined",
    });
    const figure = (name: string | HTMLElement, value: HTMLElement) =>
      html("div", { class: "row" }, html("dt", { class: "label" }, name), value);
    const { fps, tickMs, frameMs, drawnBy } = this.#figures;
    this.element = html(
      "div",
      {},
      section(
        "crowd-people-heading",
        words.peopleHeading,
        [this.#kind.element],
        this.#count.element,
        html(
          "div",
          { class: "row" },
          html("span", { class: "label", "aria-hidden": "true" }, words.seed),
          this.#seed,
          shuffle,
        ),
        this.#limit,
      ),
      section("crowd-route-heading", words.route, [this.#clear, this.#draw], this.#route),
      section(
        "crowd-cost-heading",
        words.cost,
        [],
        html(
          "dl",
          { class: "crowd-figures" },
          figure(words.rate, fps),
          figure(this.#cost, tickMs),
          figure(words.drawingCost, frameMs),
          figure(words.drawnBy, drawnBy),
        ),
      ),
    );
  }

  #shownSeed = 1;

  /** `limit` explains why there are fewer agents than requested. */
  showPeople(kind: CrowdKind, { count, seed }: People, limit: string): void {
    this.#kind.value = kind;
    this.#kind.element.title = words.of[kind].why;
    setText(this.#cost, words.of[kind].cost);
    this.#count.value = count;
    this.#shownSeed = seed;
    if (document.activeElement !== this.#seed) this.#seed.value = String(seed);
    setText(this.#limit, limit);
    this.#limit.hidden = limit === "";
  }

  showRoute(has: boolean, drawing: boolean): void {
    setText(this.#route, drawing ? words.drawHint : has ? words.following : words.wandering);
    this.#draw.setAttribute("aria-pressed", String(drawing));
    this.#clear.hidden = !has;
  }

  showFigures({ fps, tickMs, frameMs, drawnBy }: Figures): void {
    const said = (value: number | undefined, say: (value: number) => string) =>
      value === undefined ? "–" : say(value);
    setText(
      this.#figures.fps,
      said(fps, (n) => words.fps(Math.round(n))),
    );
    setText(
      this.#figures.tickMs,
      said(tickMs, (ms) => words.perTick(formatNumber(ms, 1))),
    );
    setText(
      this.#figures.frameMs,
      said(frameMs, (ms) => words.perFrame(formatNumber(ms, 1))),
    );
    setText(this.#figures.drawnBy, drawnBy || "–");
    this.#figures.drawnBy.title = drawnBy;
  }
}

function section(id: string, title: string, actions: readonly HTMLElement[], ...rows: HTMLElement[]): HTMLElement {
  const heading = html("div", { class: "section-heading" }, html("h2", { id }, title), ...actions);
  return html("section", { class: "crowd-section", "aria-labelledby": id }, heading, ...rows);
}
