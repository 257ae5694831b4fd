/** What the first viewer needs and takes long to make. */

import { prepareGeometry } from "./mannequin/geometry";
import { askPage, graphics } from "./stage/graphics";
import { QUALITY_LEVELS } from "./stage/quality";
import { firstLevel, Screen, type Size } from "./stage/screen";

/**
 * Makes in steps what the first viewer needs: the mannequin's geometry at the quality that a viewer begins with, kept for all
 * viewers of the page, and the context and the renderer for a picture of this size, CSS pixels. Where the page gets no
 * context, whatever a worker got, nothing draws.
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
