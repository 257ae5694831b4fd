/** A pose, and one of its joints in the mean rotation: w is the axis and the angle between them. */
import {
  DEGREES,
  exp,
  inverse,
  JOINT,
  log,
  multiply,
  PARENTS,
  POSE_FLOATS,
  quaternionAt,
  turned as turnedBy,
  type Vector,
} from "../../humanoid";
import { button } from "../../ui/controls/buttons";
import { Knob } from "../../ui/controls/knob";
import { html, setAttributes, svg } from "../../ui/dom";
import type { Viewer } from "../../viewer";
import type { FigureKind, FigureParts } from "../kind";
import { LIMBS, LimbHandles } from "../limb_handles";
import { SceneFigure } from "../scene_figure";
import { turnOf, withTurn } from "../turned_joints";
import sheet from "./pose.css?inline";
import { degreesOfFreedom, framesOf, meanOf, measurePose, motionOf, rotationAt } from "./pose_measure";
import { COMPONENT, POSE_FIELDS, POSE_RANGES, type PoseState, READ } from "./pose_state";

/** Length of the axis per radian, and largest length, metres. */
const AXIS = { radian: 0.8, most: 0.8 };
/** Length of the arrow's head, pixels. */
const HEAD = 8;
/** Number of segments of the arc. */
const PIECES = 16;
/** Opacity of the mean, as a share of a ghost's. */
const GHOST = 0.9;

const COMPONENTS = ["x", "y", "z"] as const;

export const JOINT_KIND: FigureKind<PoseState> = {
  fields: POSE_FIELDS,
  measure: measurePose,
  sheet,
  create: (parts) => new JointFigure(parts),
};

/** A displayed pose. */
interface Shown {
  state: PoseState;
  pose: Float32Array;
  w: Vector;
  proportions: Float32Array;
  /** The mean rotation of the joint, and its rotation in the input. */
  mean: ReturnType<typeof meanOf>;
  given: ReturnType<typeof meanOf>;
}

class JointFigure extends SceneFigure<PoseState, Shown> {
  readonly #limbs: LimbHandles;
  /** A knob for each component of w. */
  readonly #knobs: readonly Knob[];
  readonly #axis = svg("path", { class: "axis", "data-term": "w" });
  readonly #arc = svg("path", { class: "arc", "data-term": "w" });
  /** The bone in the mean rotation, and the actual bone: the two edges of the arc. */
  readonly #bones = {
    mean: svg("path", { class: "edge", "data-term": "mean" }),
    R: svg("path", { class: "edge", "data-term": "R" }),
  };

  constructor(parts: FigureParts<PoseState>) {
    const { words } = parts;
    const { pose, joints } = words;
    super(parts, { labels: { styled: "", input: "" }, description: pose.stage });
    const settle = () => this.settle();
    this.#limbs = new LimbHandles(
      this.stage,
      joints,
      {
        turnOf: (joint) => turnOf(this.state?.turned ?? [], joint),
        onInput: (joint, turn) =>
          this.change({ joint, turned: withTurn(this.state?.turned ?? [], joint, turn) }, false),
        onSettle: settle,
      },
      parts.signal,
    );
    this.#knobs = COMPONENTS.map((name, i) => {
      const onInput = (degrees: number) => this.#turnTo(i, degrees);
      return new Knob(pose.knobs[name], COMPONENT, 0, { onInput, onSettle: settle, onCancel: settle }, words);
    });
    this.stage.overlay.append(this.#arc, ...Object.values(this.#bones), this.#axis);
    const restore = button(pose.restore, () => this.change({ turned: [], heading: 0 }), {
      label: true,
      class: "restore",
    });
    this.lay({
      title: pose.stage,
      picture: this.stage.element,
      head: [this.readout, restore, this.choice("joint", words.joint, READ, (role) => joints[role])],
      foot: [],
      controls: [
        ...this.#knobs.map(({ element }) => element),
        ...this.knobs(["heading"], pose.knobs, POSE_RANGES),
        html("div", { class: "others" }, this.instant("at", 0)),
      ],
    });
  }

  protected async load(state: PoseState): Promise<Shown> {
    const { engine } = this.parts;
    const { joint } = state;
    const [plain, motion] = await Promise.all([
      motionOf(engine, state.motion, [], 0),
      motionOf(engine, state.motion, state.turned, state.heading),
    ]);
    const frame = Math.min(state.at, framesOf(motion) - 1);
    return {
      state,
      pose: motion.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS),
      w: degreesOfFreedom(motion, joint, 0, frame),
      proportions: motion.proportions,
      mean: meanOf(motion, joint),
      given: rotationAt(plain, joint, frame),
    };
  }

  protected override redraw(): void {
    this.#knobs.forEach((knob, i) => {
      knob.value = Math.round(this.shown!.w[i]! * DEGREES);
    });
    super.redraw();
  }

  protected pose(viewer: Viewer, { state, pose, mean, proportions }: Shown, _: PoseState, before?: Shown): void {
    const ghost = Float32Array.from(pose);
    ghost.set(mean, 3 + 4 * JOINT[state.joint]);
    if (!before) viewer.setProportions(proportions);
    viewer.setStyled(pose);
    viewer.setOthers([{ pose: ghost, share: GHOST }]);
    viewer.resetTrail();
  }

  protected override read({ w }: Shown): string {
    return this.words.pose.read(this.#degrees(Math.hypot(...w)));
  }

  protected describe({ state, w }: Shown): string {
    const [x, y, z] = w.map((angle) => this.#degrees(angle)) as [string, string, string];
    return this.words.pose.posed(this.words.joints[state.joint], this.#degrees(Math.hypot(...w)), x, y, z);
  }

  protected get columns() {
    return this.words.pose.components;
  }

  protected rows({ state, w }: Shown): string[][] {
    return [[this.words.joints[state.joint], ...w.map((angle) => this.#degrees(angle))]];
  }

  protected override quantities({ mean, given, state, w }: Shown) {
    const now = multiply(exp(turnOf(state.turned, state.joint)), given);
    const angleOf = (q: typeof mean) => `${this.#degrees(Math.hypot(...log(q)))}°`;
    return { w: `${this.#degrees(Math.hypot(...w))}°`, mean: angleOf(mean), R: angleOf(now) };
  }

  #degrees(radians: number): string {
    return this.number(radians * DEGREES, 1);
  }

  /** Rotates the joint so that a component of w is `degrees`. */
  #turnTo(component: number, degrees: number): void {
    const [state, shown] = [this.state, this.shown];
    if (!state || !shown) return;
    const { mean, given } = shown;
    const now = multiply(exp(turnOf(state.turned, state.joint)), given);
    const w = log(multiply(inverse(mean), now)).map((value, i) => (i === component ? degrees / DEGREES : value));
    const wanted = multiply(mean, exp(w as unknown as Vector));
    const turn = log(multiply(wanted, inverse(given)));
    this.change({ turned: withTurn(state.turned, state.joint, turn) }, false);
  }

  /** Draws axis and arc over the picture. */
  protected override placeMarks(): void {
    const [{ viewer }, shown] = [this.stage, this.shown];
    if (!viewer || !shown) return;
    this.#limbs.place();
    const { state, w, mean, proportions } = shown;
    const joint = JOINT[state.joint];
    const { positions, rotations } = viewer.joints;
    const from: Vector = [positions[3 * joint]!, positions[3 * joint + 1]!, positions[3 * joint + 2]!];
    const centred = multiply(quaternionAt(rotations, PARENTS[joint]!), mean);
    const place = ([x, y, z]: Vector) => viewer.screenPosition(from[0] + x, from[1] + y, from[2] + z);
    const angle = Math.hypot(...w);
    const length = Math.min(AXIS.most, AXIS.radian * angle);
    const [start, end] = [place([0, 0, 0]), place(scaled(turnedBy(centred, w), angle > 0 ? length / angle : 0))];
    setAttributes(this.#axis, { d: arrow(start, end) });
    const child = JOINT[LIMBS.find(([of]) => of === state.joint)![1]];
    const bone: Vector = [proportions[3 * child]!, proportions[3 * child + 1]!, proportions[3 * child + 2]!];
    const points = Array.from({ length: PIECES + 1 }, (_, i) =>
      place(turnedBy(multiply(centred, exp(scaled(w, i / PIECES))), bone)),
    );
    const at = ({ x, y }: Pixel) => `${x.toFixed(1)} ${y.toFixed(1)}`;
    setAttributes(this.#arc, { d: `M${at(start)}L${points.map(at).join("L")}Z` });
    setAttributes(this.#bones.mean, { d: `M${at(start)}L${at(points[0]!)}` });
    setAttributes(this.#bones.R, { d: `M${at(start)}L${at(points.at(-1)!)}` });
  }
}

function scaled([x, y, z]: Vector, by: number): Vector {
  return [by * x, by * y, by * z];
}

interface Pixel {
  x: number;
  y: number;
}

/** An arrow in the picture; only its line if it is short. */
function arrow(from: Pixel, to: Pixel): string {
  const [dx, dy] = [to.x - from.x, to.y - from.y];
  const length = Math.hypot(dx, dy);
  if (length < 1) return "";
  const head = Math.min(HEAD, length) / length;
  const [x, y] = [to.x - head * dx, to.y - head * dy];
  const [sx, sy] = [0.5 * head * dy, -0.5 * head * dx];
  return `M${from.x} ${from.y}L${to.x} ${to.y}L${x + sx} ${y + sy}M${to.x} ${to.y}L${x - sx} ${y - sy}`;
}
