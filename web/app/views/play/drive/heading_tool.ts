/** The arrow before the character's feet: whoever drags it turns the character on the spot. */

import type { Spot } from "./path_tool";
import { headingOf } from "./wish";

/** The arrow is taken so near to it, CSS pixels: as far as a finger reaches. */
const REACH_PX = 28;

/** What the tool needs of the page. */
export interface HeadingGround {
  /** Where it can be taken on the page; nowhere while it is not shown. */
  arrow(): readonly { x: number; y: number }[];
  /** The place on the ground under a place of the page. */
  groundAt(clientX: number, clientY: number): Spot | undefined;
  /** Where the character is. */
  place(): Spot;
  /** A heading is asked for, radians about +Y. */
  onTurn(heading: number): void;
}

export class HeadingTool {
  #pointer: number | undefined;
  /** Whether the click that ends a drag is still to come. */
  #dragged = false;

  /** To be made before what else listens to the picture: it comes first. */
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
    // A page that scrolls under the finger would take the pointer away.
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
