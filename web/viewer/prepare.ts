/** What the first viewer needs and takes long to make. */

import { acquireGeometry } from "./mannequin/geometry";
import { QUALITY_LEVELS } from "./stage/quality";
import { firstLevel } from "./stage/screen";

/** Builds the mannequin's geometry at the quality that a viewer begins with, and keeps it for all viewers of the page. */
export function prepareMannequin(): void {
  acquireGeometry(QUALITY_LEVELS[firstLevel()]!.detail);
}
