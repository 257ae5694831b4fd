/** A mark on the ground below a body, which moves the body by dragging or with the arrow keys. */
import { setAttributes, svg } from "../../ui/dom";
import { listenToDrags } from "../../ui/drag";
import type { FigureStage } from "../figure_stage";

/** Step of an arrow key, metres; with Shift a hundredth. */
const STEP = { coarse: 0.1, fine: 0.01 };
/** Half axes of the mark, and radius of its touch target, pixels. */
const MARK = { rx: 13, ry: 6 };
const TARGET = 22;
/** Distance over which the projection of the ground is differentiated, metres. */
const NEAR = 0.01;

interface GroundListeners {
  /** Position of the mark in the world, and displacement of the body, metres. */
  place: () => { at: readonly [x: number, z: number]; by: readonly [x: number, z: number] } | undefined;
  onInput: (x: number, z: number) => void;
  onSettle: () => void;
}

export class GroundHandle {
  readonly #stage: FigureStage;
  readonly #listeners: GroundListeners;
  readonly #mark: SVGGElement;

  constructor(stage: FigureStage, name: string, listeners: GroundListeners, signal: AbortSignal) {
    this.#stage = stage;
    this.#listeners = listeners;
    this.#mark = svg(
      "g",
      { class: "limb", role: "slider", tabindex: 0, "aria-label": name },
      svg("circle", { class: "target", r: TARGET }),
      svg("ellipse", { class: "mark", ...MARK }),
    );
    // Hidden until it has a position.
    setAttributes(this.#mark, { "aria-valuemin": -1, "aria-valuemax": 1, visibility: "hidden" });
    listenToDrags(this.#mark, (press) => this.#drag(press), signal);
    this.#mark.addEventListener("pointerdown", (event) => event.stopPropagation(), { signal });
    this.#mark.addEventListener("keydown", (event) => this.#key(event), { signal });
    if (stage.viewer) stage.element.append(svg("svg", { class: "overlay", role: "group" }, this.#mark));
  }

  /** Moves the mark to its position in the drawn picture. @param say converts the body's displacement to text */
  place(say: (x: number, z: number) => string): void {
    const [{ viewer }, place] = [this.#stage, this.#listeners.place()];
    if (!viewer || !place) return;
    const { x, y } = viewer.screenPosition(place.at[0], 0, place.at[1]);
    setAttributes(this.#mark, {
      transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`,
      visibility: "visible",
      "aria-valuenow": place.by[0],
      "aria-valuetext": say(...place.by),
    });
  }

  #drag(press: PointerEvent) {
    const [{ viewer }, place] = [this.#stage, this.#listeners.place()];
    if (!viewer || !place) return undefined;
    press.preventDefault();
    this.#mark.focus({ preventScroll: true });
    const [x, z] = place.at;
    const here = viewer.screenPosition(x, 0, z);
    const [east, south] = [viewer.screenPosition(x + NEAR, 0, z), viewer.screenPosition(x, 0, z + NEAR)];
    // The projection of a metre in each direction, linearised.
    const [a, b] = [(east.x - here.x) / NEAR, (south.x - here.x) / NEAR];
    const [c, d] = [(east.y - here.y) / NEAR, (south.y - here.y) / NEAR];
    const area = a * d - b * c;
    const move = ({ clientX, clientY }: PointerEvent) => {
      const [across, down] = [clientX - press.clientX, clientY - press.clientY];
      this.#listeners.onInput(
        place.by[0] + (d * across - b * down) / area,
        place.by[1] + (a * down - c * across) / area,
      );
    };
    if (Math.abs(area) < 1) return undefined;
    return { move, cancel: () => this.#listeners.onInput(...place.by), end: () => this.#listeners.onSettle() };
  }

  /** Left and Right move across the picture, Up away from the viewer. */
  #key(event: KeyboardEvent): void {
    const [{ viewer }, place] = [this.#stage, this.#listeners.place()];
    if (!viewer || !place || event.ctrlKey || event.metaKey || event.altKey) return;
    const [sx, , sz] = viewer.lineOfSight;
    const length = Math.hypot(sx, sz) || 1;
    const away = [sx / length, sz / length] as const;
    const directions: Readonly<Record<string, readonly [x: number, z: number]>> = {
      ArrowUp: away,
      ArrowDown: [-away[0], -away[1]],
      ArrowRight: [-away[1], away[0]],
      ArrowLeft: [away[1], -away[0]],
    };
    const direction = directions[event.key];
    if (!direction) return;
    event.preventDefault();
    event.stopPropagation();
    const step = event.shiftKey ? STEP.fine : STEP.coarse;
    this.#listeners.onInput(place.by[0] + step * direction[0], place.by[1] + step * direction[1]);
  }
}
