/** The handles of a field: they lie on the ground of the picture, and can be dragged over it. */

import type { FieldVertex } from "../../../client/crowd/limits";
import { formatNumber, html, keepCount, setAttributes } from "../../../ui/dom";
import { type Drag, listenToDrags } from "../../../ui/drag";
import { CROWD_RANGES } from "../../state/crowd";
import { strings } from "../../strings/strings";
import { spoken } from "../../ui/words";
import type { FieldEditor } from "./field_editor";

const words = strings.crowd;

/** Step of an arrow key, metres. */
const STEP = 0.25;
/** Change of the reach by a key, metres, and by a pixel of the wheel, as a share of it. */
const REACH_STEP = 0.2;
const WHEEL_SHARE = 0.0012;

/** The picture in which the handles lie. */
interface HandleGround {
  /** The point on the ground under a point of the picture; `undefined` above the horizon. */
  groundAt(x: number, y: number): { x: number; z: number } | undefined;
  screenPosition(x: number, y: number, z: number): { x: number; y: number } | undefined;
  /** Direction from which the camera looks, radians about +Y from +Z. */
  readonly azimuth: number;
}

export class Handles {
  readonly element = html("div", { class: "crowd-handles" });
  readonly #editor: FieldEditor;
  #field: readonly FieldVertex[] = [];
  #ground: HandleGround | undefined;

  constructor(editor: FieldEditor) {
    this.#editor = editor;
  }

  /** Sets the picture in which they lie. */
  set ground(ground: HandleGround | undefined) {
    this.#ground = ground;
  }

  /** Sets the field; hidden if the field is not drawn. */
  show(field: readonly FieldVertex[], chosen: number): void {
    this.#field = field;
    keepCount(this.element, field.length, () => this.#make());
    for (const [i, { style, x, z, reach }] of field.entries()) {
      const name = spoken(style);
      setAttributes(this.element.children[i]!, {
        "aria-label": words.handle(name),
        "aria-valuetext": words.place(formatNumber(x, 2), formatNumber(z, 2), formatNumber(reach, 1)),
        "aria-valuenow": x,
        "aria-current": String(i === chosen),
        "data-style": name,
        title: `${name}: ${words.handleKeys}`,
      });
    }
  }

  /** Moves the handles to their positions in the picture; called for every picture. */
  place(): void {
    for (const [i, { x, z }] of this.#field.entries()) {
      const handle = this.element.children[i] as HTMLElement;
      const at = this.#ground?.screenPosition(x, 0, z);
      handle.hidden = at === undefined;
      if (at) handle.style.transform = `translate(${at.x.toFixed(1)}px, ${at.y.toFixed(1)}px)`;
    }
  }

  #make(): HTMLElement {
    const { place } = CROWD_RANGES;
    const handle = html("div", {
      class: "crowd-handle",
      role: "slider",
      tabindex: 0,
      "aria-valuemin": place.min,
      "aria-valuemax": place.max,
      "aria-valuenow": 0,
    });
    const index = () => [...this.element.children].indexOf(handle);
    listenToDrags(handle, (press) => this.#begin(index(), handle, press));
    const { onSettle } = this.#editor.gestures;
    handle.addEventListener("focus", () => this.#editor.choose(index()));
    handle.addEventListener("blur", onSettle);
    handle.addEventListener("pointerleave", onSettle);
    handle.addEventListener("keydown", (event) => this.#onKey(index(), event));
    handle.addEventListener("wheel", (event) => this.#onWheel(index(), event), { passive: false });
    return handle;
  }

  #begin(index: number, handle: HTMLElement, press: PointerEvent): Drag | undefined {
    const { onSettle, onCancel } = this.#editor.gestures;
    const vertex = this.#field[index];
    const from = this.#groundUnder(press);
    if (!vertex || !from) return undefined;
    press.preventDefault();
    handle.focus({ preventScroll: true });
    onSettle();
    handle.classList.add("dragging");
    // The handle keeps its offset from the pointer.
    const [dx, dz] = [vertex.x - from.x, vertex.z - from.z];
    return {
      move: (event) => {
        const to = this.#groundUnder(event);
        if (to) this.#editor.change(index, { x: to.x + dx, z: to.z + dz });
      },
      cancel: onCancel,
      end: () => {
        handle.classList.remove("dragging");
        onSettle();
      },
    };
  }

  #groundUnder({ clientX, clientY }: PointerEvent): { x: number; z: number } | undefined {
    const { left, top } = this.element.getBoundingClientRect();
    return this.#ground?.groundAt(clientX - left, clientY - top);
  }

  #onKey(index: number, event: KeyboardEvent): void {
    const vertex = this.#field[index];
    if (event.ctrlKey || event.metaKey || event.altKey || !vertex) return;
    const { x, z, reach } = vertex;
    const [right, away] = [
      { ArrowRight: STEP, ArrowLeft: -STEP }[event.key] ?? 0,
      { ArrowUp: STEP, ArrowDown: -STEP }[event.key] ?? 0,
    ];
    const longer = { "+": REACH_STEP, "=": REACH_STEP, "-": -REACH_STEP }[event.key] ?? 0;
    if (right !== 0 || away !== 0) {
      const [dx, dz] = alongAxes(right, away, this.#ground?.azimuth ?? 0);
      this.#editor.change(index, { x: x + dx, z: z + dz });
    } else if (longer !== 0) this.#editor.change(index, { reach: reach + longer });
    else if (event.key === "Delete" || event.key === "Backspace") this.#editor.remove(index);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #onWheel(index: number, event: WheelEvent): void {
    const vertex = this.#field[index];
    if (!vertex) return;
    event.preventDefault();
    const by = Math.exp(-Math.max(-120, Math.min(120, event.deltaY)) * WHEEL_SHARE);
    // A turn of the wheel that is too small to change anything still has an effect.
    const change = vertex.reach * (by - 1);
    this.#editor.change(index, { reach: vertex.reach + Math.sign(change) * Math.max(0.1, Math.abs(change)) });
  }
}

/** A step to the right and away from a camera, along the nearest axes of the ground. */
export function alongAxes(right: number, away: number, azimuth: number): [x: number, z: number] {
  const quarter = (Math.round(azimuth / (Math.PI / 2)) * Math.PI) / 2;
  const [cos, sin] = [Math.round(Math.cos(quarter)), Math.round(Math.sin(quarter))];
  return [right * cos - away * sin + 0, -right * sin - away * cos + 0];
}
