/** What the first viewer needs and takes long to make. */

import { acquireGeometry } from "./mannequin/geometry";
import { askPage } from "./stage/graphics";
import { QUALITY_LEVELS } from "./stage/quality";
import { firstLevel, Screen } from "./stage/screen";

/** Builds the mannequin's geometry at the quality that a viewer begins with, and keeps it for all viewers of the page. */
export function prepareMannequin(): void {
  acquireGeometry(QUALITY_LEVELS[firstLevel()]!.detail);
}

/** Makes the context and the renderer of the first viewer. Where the page gets no context, whatever a worker got, nothing draws. */
export function prepareScreen(): void {
  try {
    Screen.prepare();
  } catch (error) {
    if (askPage() !== "none") throw error;
  }
}
