/** Marks at the ends of limbs: a limb is turned in the plane of the picture by its mark, or with the arrow keys. */
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
} from "../../humanoid";
import { setAttributes, svg } from "../../ui/dom";
import { listenToDrags } from "../../ui/drag";
import type { FigureStage } from "./figure_stage";

/** Limbs by the joint that turns them, and the joint at their end, where the mark is. */
export const LIMBS = (["left", "right"] as const).flatMap((side): [joint: Role, end: Role][] => [
  [`${side}_upper_arm`, `${side}_lower_arm`],
  [`${side}_lower_arm`, `${side}_hand`],
  [`${side}_upper_leg`, `${side}_lower_leg`],
  [`${side}_lower_leg`, `${side}_foot`],
]);

/** Radians of an arrow key; with Shift a fifth of it. */
const STEP = (5 * Math.PI) / 180;
/** Radius of a mark, and of what a finger takes hold of, pixels. */
const RADIUS = { mark: 6, target: 22 };

export interface LimbListeners {
  /** How a joint is turned now: an axis times an angle about the axes of its parent, radians. */
  turnOf: (joint: Role) => Vector;
  onInput: (joint: Role, turn: Vector) => void;
  /** The pointer has let go; of keys the figure's element knows. */
  onSettle: () => void;
}

/** A turn followed by another about an axis of the world. @param parent the parent's rotation in the world */
export function turnedFurther(turn: Vector, parent: Quaternion, axis: Vector, angle: number): Vector {
  const [x, y, z] = turned(inverse(parent), axis);
  return log(multiply(exp([angle * x, angle * y, angle * z]), exp(turn)));
}

export class LimbHandles {
  readonly #stage: FigureStage;
  readonly #listeners: LimbListeners;
  readonly #marks = new Map<Role, SVGGElement>();
  /** Unseen until the marks have their places. */
  readonly #layer = svg("svg", { class: "overlay", role: "group", visibility: "hidden" });

  /** @param names what each joint that is turned is called */
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

  /** Brings the marks to the picture that was drawn. */
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
    // What a finger takes hold of overlaps: the mark that is nearest counts, not the one that is drawn last.
    const [joint] = LIMBS.reduce((a, b) => (distanceTo(b[1]) < distanceTo(a[1]) ? b : a));
    const before = this.#listeners.turnOf(joint);
    const parent = this.#parentOf(joint);
    const axis = viewer.lineOfSight;
    const centre = viewer.jointScreenPosition(joint);
    // Seen along an axis, a turn about it is clockwise, as angles are in a picture whose y points down.
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

  /** Left and right turn in the plane of the picture, up and down into it. */
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
