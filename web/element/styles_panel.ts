/** The styles that a player mixes, and the polygon over the picture in which they are chosen. */
import type { DatabaseInfo } from "../client/protocol";
import { formatNumber, html } from "../ui/dom";
import { COMPACT, Polygon } from "../ui/polygon/polygon";
import { isBeyondData, type Selection } from "../ui/polygon/selection";
import { triangleOf } from "./settings";

/** Smaller weights are not announced. */
const SAID = 0.005;

export class StylesPanel {
  readonly element = html("div", { class: "styles", part: "styles", hidden: true });
  /** The styles with their weights. */
  selection: Selection = [];
  readonly #polygon: Polygon;
  #beforeGesture: Selection = [];
  /** Styles at the corners of the polygon. */
  #vertices: readonly string[] = [];

  /** @param onChoose called with the visitor's choice */
  constructor(onChoose: (styles: Selection) => void) {
    const onSettle = () => {
      this.#beforeGesture = this.selection;
    };
    const onCancel = () => onChoose(this.#beforeGesture);
    this.#polygon = new Polygon({ onChange: onChoose, onSettle, onCancel }, COMPACT);
    this.element.append(this.#polygon.element);
  }

  /** Shows the selection of the styles of a database. */
  show(info: DatabaseInfo, glide: boolean): void {
    const { vertices, selection } = triangleOf(this.selection, info, this.#vertices);
    this.#vertices = vertices;
    this.#polygon.show({ vertices, selection, whole: false, beyond: isBeyondData(selection, 1) }, glide);
  }

  /** Width of the picture that it covers, CSS pixels. */
  get covered(): number {
    const { element } = this;
    return !element.hidden && getComputedStyle(element).position === "absolute" ? element.offsetWidth / 2 : 0;
  }

  /** Names and weights as text, the heaviest first. */
  get said(): (readonly [name: string, weight: string])[] {
    return [...this.selection]
      .filter(({ weight }) => Math.abs(weight) > SAID)
      .sort((a, b) => b.weight - a.weight)
      .map(({ name, weight }) => [name, formatNumber(weight, 2)] as const);
  }
}
