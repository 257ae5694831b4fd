/** The component map: a cell for each Gaussian of the mixture, with the brightness of its weight in the pose. */

import { formatNumber, html } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import type { RowName } from "./timeline_rows";

export class ComponentMap {
  readonly element = html("div", { class: "components", role: "img" });
  #cells: HTMLElement[] = [];
  #winner = -1;

  /**
   * Shows another model's components.
   *
   * @param centres - Centre of each component, all variables of one component together.
   */
  show(centres: Float32Array, rows: readonly RowName[]): void {
    const count = rows.length === 0 ? 0 : centres.length / rows.length;
    this.#cells = Array.from({ length: count }, (_, i) => {
      const home = rows.map(({ title, unit, digits }, axis) =>
        `${title} ${formatNumber(centres[i * rows.length + axis]!, digits)} ${unit}`.trim(),
      );
      return html("i", { title: strings.keyStyle.component(i + 1, home.join(", ")) });
    });
    this.element.replaceChildren(...this.#cells);
    this.#winner = -1;
  }

  set weights(weights: ArrayLike<number>) {
    let winner = 0;
    for (const [i, cell] of this.#cells.entries()) {
      cell.style.setProperty("--share", (weights[i] ?? 0).toFixed(2));
      if ((weights[i] ?? 0) > (weights[winner] ?? 0)) winner = i;
    }
    if (winner === this.#winner) return;
    this.#winner = winner;
    for (const [i, cell] of this.#cells.entries()) cell.classList.toggle("winner", i === winner);
    this.element.setAttribute("aria-label", strings.keyStyle.components(this.#cells.length, winner + 1));
  }
}
