/** The Style panel: the polygon, triangle or whole, and the intensity. */
import type { DatabaseInfo } from "../../worker/protocol";
import { Segment } from "../controls/buttons";
import { Slider } from "../controls/slider";
import { html, setText } from "../dom";
import { Polygon } from "../polygon/polygon";
import { isBeyondData, type Selection, toTriangle, vertexOrder } from "../polygon/selection";
import { FIELDS, type PlayState, RANGES } from "../state";
import type { Store } from "../store";
import { numberWord } from "../words";

const HINT = "Drag the point. Arrow keys move it; double-click a corner for all of it.";
const BEYOND = "Beyond the data: joints are held at their limits.";
/** Where it is remembered that the hint was taken. */
const HINT_KEY = "strut.hint";

/** Storage may be refused, as in a private window; then the hint comes again. */
function hintWasTaken(): boolean {
  try {
    return localStorage.getItem(HINT_KEY) !== null;
  } catch {
    return false;
  }
}

function rememberHint(): void {
  try {
    localStorage.setItem(HINT_KEY, "taken");
  } catch {
    // Nothing depends on it.
  }
}

export class StylePanel {
  readonly element: HTMLElement;
  readonly polygon: Polygon;
  readonly #mode: Segment<"triangle" | "whole">;
  readonly #intensity: Slider;
  readonly #caption = html("p", { class: "caption polygon-caption" });
  #database: DatabaseInfo | undefined;
  #vertices: readonly string[] = [];
  #hint = !hintWasTaken();

  constructor(store: Store, top: HTMLElement) {
    this.polygon = new Polygon({
      onChange: (styles, gesture) => {
        this.#takeHint();
        store.edit({ styles }, gesture);
      },
      onSettle: () => store.endGesture(),
    });
    this.#mode = new Segment(
      "Styles mixed",
      [
        { value: "triangle", label: "Three" },
        { value: "whole", label: "All" },
      ],
      (mode) => store.edit({ wholePolygon: mode === "whole", styles: this.#stylesFor(mode, store.state.styles) }),
    );
    this.#intensity = new Slider("Intensity", RANGES.intensity, FIELDS.intensity.initial, {
      onInput: (intensity) => store.edit({ intensity }, "intensity"),
      onSettle: () => store.endGesture(),
    });
    this.element = html(
      "section",
      { class: "section style", "aria-labelledby": "style-heading" },
      top,
      html("div", { class: "section-heading" }, html("h2", { id: "style-heading" }, "Style"), this.#mode.element),
      this.polygon.element,
      this.#caption,
      this.#intensity.element,
    );
  }

  /** Styles clockwise from the top, as the number keys count them. */
  get vertices(): readonly string[] {
    return this.#vertices;
  }

  /** Takes the styles of another database. */
  set database(database: DatabaseInfo) {
    this.#database = database;
    this.#vertices = vertexOrder(database.styles, database.neutral);
    this.#mode.relabel(
      "triangle",
      `${numberWord(Math.min(3, database.styles.length))}`.replace(/^./, (c) => c.toUpperCase()),
    );
    this.#mode.relabel("whole", `All ${numberWord(database.styles.length)}`);
    this.#mode.element.hidden = database.styles.length <= 3;
  }

  /** Shows the state; `glide` where the handle shall travel instead of jumping. */
  show(state: Readonly<PlayState>, glide: boolean): void {
    const { styles: selection, wholePolygon: whole, intensity } = state;
    const beyond = isBeyondData(selection, intensity);
    this.polygon.show({ vertices: this.#vertices, selection, whole, beyond }, glide);
    this.#mode.value = whole ? "whole" : "triangle";
    this.#intensity.value = intensity;
    setText(this.#caption, beyond ? BEYOND : this.#hint && this.#database ? HINT : "");
  }

  #stylesFor(mode: "triangle" | "whole", styles: Selection): Selection {
    return mode === "whole" ? styles : toTriangle(styles, this.#vertices);
  }

  #takeHint(): void {
    if (!this.#hint) return;
    this.#hint = false;
    rememberHint();
  }
}
