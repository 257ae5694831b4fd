/** The arrow in front of the character's feet: dragging it turns the character on the spot. */

import type { Spot } from "./path_tool";
import { headingOf } from "./wish";

/** The arrow can be grabbed within this distance, CSS pixels: the size of a fingertip. */
const REACH_PX = 28;

/** The page's interface for the tool. */
interface HeadingGround {
  /** Points in the page at which it can be grabbed; empty while it is hidden. */
  arrow(): readonly { x: number; y: number }[];
  /** The point on the ground under a point of the page. */
  groundAt(clientX: number, clientY: number): Spot | undefined;
  /** Position of the character. */
  place(): Spot;
  /** Called when a heading is requested, radians about +Y. */
  onTurn(heading: number): void;
}

export class HeadingTool {
  #pointer: number | undefined;
  /** Whether the click that ends a drag is still pending. */
  #dragged = false;

  /** To be created before other listeners on the picture, so that it comes first. */
  constructor(picture: HTMLElement, ground: HeadingGround, signal: AbortSignal) {
    const options = { signal, capture: true };
    const take = (event: Event): void => {
      event.stopImmediatePropagation();
      event.preventDefault();
    };
    const onDown = (event: PointerEvent): void => {
      this.#dragged = false;
      if (event.button !== 0 || this.#pointer !== undefined) return;
      const isNear = ({ x, y }: { x: number; y: number }) =>
        Math.hypot(event.clientX - x, event.clientY - y) < REACH_PX;
      if (!ground.arrow().some(isNear)) return;
      take(event);
      picture.setPointerCapture(event.pointerId);
      this.#pointer = event.pointerId;
      this.#dragged = true;
    };
    const onMove = (event: PointerEvent): void => {
      if (event.pointerId !== this.#pointer) return;
      take(event);
      const to = ground.groundAt(event.clientX, event.clientY);
      const { x, z } = ground.place();
      if (to) ground.onTurn(headingOf(to.x - x, to.z - z));
    };
    const onEnd = (event: PointerEvent): void => {
      if (event.pointerId !== this.#pointer) return;
      take(event);
      this.#pointer = undefined;
    };
    const onClick = (event: Event): void => {
      if (this.#dragged) take(event);
      this.#dragged = false;
    };
    picture.addEventListener("pointerdown", onDown, options);
    picture.addEventListener("pointermove", onMove, options);
    for (const type of ["pointerup", "pointercancel"] as const) picture.addEventListener(type, onEnd, options);
    picture.addEventListener("click", onClick, options);
    // If the page scrolled under the finger, the pointer would be lost.
    const onTouch = (event: Event): void => {
      if (this.#pointer !== undefined) event.preventDefault();
    };
    picture.addEventListener("touchstart", onTouch, { ...options, passive: false });
  }

  /** Whether the arrow is being dragged. */
  get isDragged(): boolean {
    return this.#pointer !== undefined;
  }
}
