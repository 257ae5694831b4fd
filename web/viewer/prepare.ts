/** Resources of the first viewer that take long to make. */

import { prepareGeometry } from "./mannequin/geometry";
import { askPage, graphics } from "./stage/graphics";
import { QUALITY_LEVELS } from "./stage/quality";
import { firstLevel, Screen, type Size } from "./stage/screen";

/**
 * Makes in steps the resources of the first viewer: the mannequin's geometry at the initial quality, kept for all
 * viewers of the page, and the context and renderer for a picture of this size, CSS pixels. If the page gets no
 * context, even though a worker got one, nothing is drawn.
 */
export function* preparation(picture: Size): Generator<undefined> {
  if (graphics() === "none") return;
  yield* prepareGeometry(QUALITY_LEVELS[firstLevel()]!.detail);
  yield;
  try {
    yield* Screen.prepare(picture);
  } catch (error) {
    if (askPage() !== "none") throw error;
  }
}
