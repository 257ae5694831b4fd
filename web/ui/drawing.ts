/**
 * Drawings with text use units, which are CSS pixels at the normal text size. If the user's text is larger, a unit is
 * larger by the same factor.
 */
import { setAttributes } from "./dom";
import { textZoom } from "./media";

/** A size, units. */
export interface Size {
  width: number;
  height: number;
}

/** Inner size of an element, units. */
export function sizeOf({ clientWidth, clientHeight }: Element): Size {
  const unit = textZoom();
  return { width: clientWidth / unit, height: clientHeight / unit };
}

/** A length in units for style sheets. */
export const rem = (units: number): string => `${(units / 16).toFixed(4)}rem`;

/** Sets the size of a drawing, units. Its origin is at the top left. */
export function setSize(root: SVGSVGElement, { width, height }: Size): void {
  const unit = textZoom();
  setAttributes(root, { viewBox: `0 0 ${width} ${height}`, width: width * unit, height: height * unit });
}

/** Position of the pointer, units from the top left of an element. */
export function placeIn(element: Element, { clientX, clientY }: MouseEvent): { x: number; y: number } {
  const { left, top } = element.getBoundingClientRect();
  const unit = textZoom();
  return { x: (clientX - left) / unit, y: (clientY - top) / unit };
}
