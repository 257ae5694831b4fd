/** A virtual stick under the thumb, on the left half of the picture. */
import { html } from "../../../../ui/dom";
import { stickWish, type Wish } from "./wish";

/** Largest deflection, CSS pixels; beyond this share of it the character runs. */
const REACH_PX = 56;
const RUNS = 0.85;

export class TouchStick {
  readonly element = html("div", { class: "drive-stick", hidden: true, "aria-hidden": "true" });
  readonly #knob = html("div", { class: "drive-knob" });
  #held: { pointer: number; x: number; y: number } | undefined;
  #wish: Wish | undefined;

  /**
   * @param picture element that is touched
   * @param isFree whether touches steer
   * @param onUse called when the stick is grabbed
   */
  constructor(picture: HTMLElement, isFree: () => boolean, onUse: () => void, signal: AbortSignal) {
    this.element.append(this.#knob);
    const options = { signal, capture: true };
    const onDown = (event: PointerEvent): void => {
      if (event.pointerType !== "touch" || this.#held || !isFree()) return;
      const { left, top, width } = picture.getBoundingClientRect();
      if (event.clientX > left + width / 2) return;
      // Otherwise the camera would turn.
      event.stopPropagation();
      event.preventDefault();
      picture.setPointerCapture(event.pointerId);
      this.#held = { pointer: event.pointerId, x: event.clientX, y: event.clientY };
      this.element.hidden = false;
      this.element.style.transform = `translate(${event.clientX - left}px,${event.clientY - top}px)`;
      this.#show(0, 0);
      onUse();
    };
    const onMove = (event: PointerEvent): void => {
      if (event.pointerId !== this.#held?.pointer) return;
      event.stopPropagation();
      this.#show(event.clientX - this.#held.x, event.clientY - this.#held.y);
    };
    const onEnd = (event: PointerEvent): void => {
      if (event.pointerId === this.#held?.pointer) this.stop();
    };
    picture.addEventListener("pointerdown", onDown, options);
    picture.addEventListener("pointermove", onMove, options);
    for (const type of ["pointerup", "pointercancel"] as const) picture.addEventListener(type, onEnd, options);
    // If the page scrolled under the thumb, the pointer would be lost.
    picture.addEventListener("touchstart", (event) => this.#held && event.preventDefault(), {
      ...options,
      passive: false,
    });
  }

  /** The input of the stick. */
  get wish(): Wish | undefined {
    return this.#wish;
  }

  /** Releases the stick. */
  stop(): void {
    this.#held = undefined;
    this.#wish = undefined;
    this.element.hidden = true;
  }

  #show(dx: number, dy: number): void {
    const distance = Math.hypot(dx, dy) / REACH_PX;
    const scale = REACH_PX * Math.min(1, 1 / Math.max(distance, 1e-6));
    const [x, y] = distance > 1 ? [(dx / REACH_PX) * scale, (dy / REACH_PX) * scale] : [dx, dy];
    this.#knob.style.transform = `translate(${x}px,${y}px)`;
    this.element.classList.toggle("runs", distance > RUNS);
    this.#wish = stickWish(dx / REACH_PX, -dy / REACH_PX, distance > RUNS ? 2 : 1);
  }
}
