/** Marks at the ends of limbs: a mark rotates its limb in the plane of the picture, by dragging or with the arrow keys. */
import {
  exp,
  inverse,
  JOINT,
  log,
  multiply,
  PARENTS,
  type Quaternion,
  quaternionAt,
  type Role,
  turned,
  type Vector,
} from "../humanoid";
import { setAttributes, svg } from "../ui/dom";
import { listenToDrags } from "../ui/drag";
import type { FigureStage } from "./figure_stage";

/** Limbs by the joint that rotates them, and the joint at their end, where the mark is. */
export const LIMBS = (["left", "right"] as const).flatMap((side): [joint: Role, end: Role][] => [
  [`${side}_upper_arm`, `${side}_lower_arm`],
  [`${side}_lower_arm`, `${side}_hand`],
  [`${side}_upper_leg`, `${side}_lower_leg`],
  [`${side}_lower_leg`, `${side}_foot`],
]);

/** Step of an arrow key, radians; with Shift a fifth of it. */
const STEP = (5 * Math.PI) / 180;
/** Radius of a mark, and of its touch target, pixels. */
const RADIUS = { mark: 6, target: 22 };

interface LimbListeners {
  /** Current rotation of a joint: an axis times an angle about the axes of its parent, radians. */
  turnOf: (joint: Role) => Vector;
  onInput: (joint: Role, turn: Vector) => void;
  /** Called when the pointer is released; the figure's element handles keys. */
  onSettle: () => void;
}

/** A rotation followed by another about an axis of the world. @param parent the parent's rotation in the world */
function turnedFurther(turn: Vector, parent: Quaternion, axis: Vector, angle: number): Vector {
  const [x, y, z] = turned(inverse(parent), axis);
  return log(multiply(exp([angle * x, angle * y, angle * z]), exp(turn)));
}

export class LimbHandles {
  readonly #stage: FigureStage;
  readonly #listeners: LimbListeners;
  readonly #marks = new Map<Role, SVGGElement>();
  /** Hidden until the marks have positions. */
  readonly #layer = svg("svg", { class: "overlay", role: "group", visibility: "hidden" });

  /** @param names name of each joint that can be rotated */
  constructor(
    stage: FigureStage,
    names: Readonly<Record<Role, string>>,
    listeners: LimbListeners,
    signal: AbortSignal,
  ) {
    this.#stage = stage;
    this.#listeners = listeners;
    for (const [joint, end] of LIMBS) {
      const mark = svg(
        "g",
        {
          class: "limb",
          role: "slider",
          tabindex: 0,
          "aria-label": names[joint],
          "aria-valuemin": 0,
          "aria-valuemax": 180,
        },
        svg("circle", { class: "target", r: RADIUS.target }),
        svg("circle", { class: "mark", r: RADIUS.mark }),
      );
      listenToDrags(mark, (press) => this.#drag(press), signal);
      mark.addEventListener("pointerdown", (event) => event.stopPropagation(), { signal });
      mark.addEventListener("keydown", (event) => this.#key(joint, event), { signal });
      this.#marks.set(end, mark);
      this.#layer.append(mark);
    }
    if (stage.viewer) stage.element.append(this.#layer);
  }

  /** Moves the marks to the joints of the drawn picture. */
  place(): void {
    const { viewer } = this.#stage;
    if (!viewer) return;
    setAttributes(this.#layer, { visibility: "visible" });
    for (const [joint, end] of LIMBS) {
      const { x, y } = viewer.jointScreenPosition(end);
      const degrees = Math.round((Math.hypot(...this.#listeners.turnOf(joint)) * 180) / Math.PI);
      setAttributes(this.#marks.get(end)!, {
        transform: `translate(${x.toFixed(1)} ${y.toFixed(1)})`,
        "aria-valuenow": degrees,
        "aria-valuetext": `${degrees}°`,
      });
    }
  }

  #drag(press: PointerEvent) {
    const { viewer, element } = this.#stage;
    if (!viewer) return undefined;
    const { left, top } = element.getBoundingClientRect();
    const distanceTo = (end: Role) => {
      const { x, y } = viewer.jointScreenPosition(end);
      return Math.hypot(press.clientX - left - x, press.clientY - top - y);
    };
    // Touch targets overlap: the nearest mark is grabbed, not the one drawn last.
    const [joint] = LIMBS.reduce((a, b) => (distanceTo(b[1]) < distanceTo(a[1]) ? b : a));
    const before = this.#listeners.turnOf(joint);
    const parent = this.#parentOf(joint);
    const axis = viewer.lineOfSight;
    const centre = viewer.jointScreenPosition(joint);
    // Seen along an axis, a rotation about it is clockwise, like angles in a picture whose y points down.
    const angleOf = ({ clientX, clientY }: PointerEvent) =>
      Math.atan2(clientY - top - centre.y, clientX - left - centre.x);
    const first = angleOf(press);
    press.preventDefault();
    this.#marks.get(LIMBS.find(([of]) => of === joint)![1])!.focus({ preventScroll: true });
    return {
      move: (event: PointerEvent) =>
        this.#listeners.onInput(joint, turnedFurther(before, parent, axis, angleOf(event) - first)),
      cancel: () => this.#listeners.onInput(joint, before),
      end: () => this.#listeners.onSettle(),
    };
  }

  /** Left and Right rotate in the plane of the picture, Up and Down out of it. */
  #key(joint: Role, event: KeyboardEvent): void {
    const { viewer } = this.#stage;
    if (!viewer || event.ctrlKey || event.metaKey || event.altKey) return;
    const sight = viewer.lineOfSight;
    const across: Vector = [-sight[2], 0, sight[0]];
    const length = Math.hypot(...across) || 1;
    const level: Vector = [across[0] / length, 0, across[2] / length];
    const keys: Readonly<Record<string, readonly [axis: Vector, sign: number]>> = {
      ArrowLeft: [sight, -1],
      ArrowRight: [sight, 1],
      ArrowUp: [level, 1],
      ArrowDown: [level, -1],
    };
    const turning = keys[event.key];
    if (!turning) return;
    const [axis, sign] = turning;
    event.preventDefault();
    event.stopPropagation();
    const angle = sign * STEP * (event.shiftKey ? 0.2 : 1);
    const turn = turnedFurther(this.#listeners.turnOf(joint), this.#parentOf(joint), axis, angle);
    this.#listeners.onInput(joint, turn);
  }

  #parentOf(joint: Role): Quaternion {
    return quaternionAt(this.#stage.viewer!.joints.rotations, PARENTS[JOINT[joint]]!);
  }
}
