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
  type Role,
  turned as turnedBy,
  type Vector,
} from "../../humanoid";
import { button } from "../../ui/controls/buttons";
import { Knob } from "../../ui/controls/knob";
import type { Slider } from "../../ui/controls/slider";
import { html, setAttributes, setText, svg } from "../../ui/dom";
import { Choice, createInstant, createKnobs } from "../controls";
import { FigureStage } from "../figure_stage";
import type { FigureInstance, FigureKind, FigureParts, Measure, Table } from "../kind";
import { Latest } from "../latest";
import { LIMBS, LimbHandles } from "../limb_handles";
import { turnOf, withTurn } from "../turned_joints";
import { figure } from "../words/words";
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
  sheet,
  create: (parts) => new JointFigure(parts),
};

/** A displayed pose. */
interface Shown {
  state: PoseState;
  w: Vector;
  proportions: Float32Array;
  /** The mean rotation of the joint, and its rotation in the input. */
  mean: ReturnType<typeof meanOf>;
  given: ReturnType<typeof meanOf>;
}

class JointFigure implements FigureInstance<PoseState> {
  readonly #parts: FigureParts<PoseState>;
  readonly stage: FigureStage;
  readonly #limbs: LimbHandles;
  readonly #joint: Choice<Role>;
  readonly #knobs: Record<(typeof COMPONENTS)[number], Knob>;
  readonly #heading: Knob;
  readonly #instant: Slider;
  readonly #readout = html("p", { class: "readout" });
  readonly #axis = svg("path", { class: "axis", "data-term": "w" });
  readonly #arc = svg("path", { class: "arc", "data-term": "w" });
  /** The bone in the mean rotation, and the actual bone: the two edges of the arc. */
  readonly #bones = {
    mean: svg("path", { class: "edge", "data-term": "mean" }),
    R: svg("path", { class: "edge", "data-term": "R" }),
  };
  readonly #posing = new Latest<PoseState>((state) => this.#pose(state));
  #state: PoseState | undefined;
  #shown: Shown | undefined;

  constructor(parts: FigureParts<PoseState>) {
    this.#parts = parts;
    const { words, container, change, signal } = parts;
    const settle = () => change({}, true);
    this.stage = new FigureStage(
      words,
      { labels: { styled: "", input: "" }, description: words.pose.stage },
      { drawn: () => this.#placeMarks() },
    );
    this.#limbs = new LimbHandles(
      this.stage,
      words.joints,
      {
        turnOf: (joint) => turnOf(this.#state?.turned ?? [], joint),
        onInput: (joint, turn) => change({ joint, turned: withTurn(this.#state?.turned ?? [], joint, turn) }, false),
        onSettle: settle,
      },
      signal,
    );
    this.#joint = new Choice(
      words.joint,
      READ.map((role) => [role, words.joints[role]] as const),
      (joint) => change({ joint }, true),
    );
    const knob = (name: (typeof COMPONENTS)[number], i: number) =>
      new Knob(
        words.pose.knobs[name],
        COMPONENT,
        0,
        { onInput: (degrees) => this.#turnTo(i, degrees), onSettle: settle, onCancel: settle },
        words,
      );
    this.#knobs = { x: knob("x", 0), y: knob("y", 1), z: knob("z", 2) };
    this.#heading = createKnobs(["heading"], words, words.pose.knobs, POSE_RANGES, POSE_FIELDS, change).heading;
    this.#instant = createInstant(words, 0, change);
    this.stage.overlay.append(this.#arc, ...Object.values(this.#bones), this.#axis);
    for (const mark of this.stage.overlay.children) {
      mark.addEventListener("pointerenter", () => parts.point(mark.getAttribute("data-term")!));
      mark.addEventListener("pointerleave", () => parts.point(undefined));
    }
    const restore = button(words.pose.restore, () => change({ turned: [], heading: 0 }, true), {
      label: true,
      class: "restore",
    });
    container.append(
      html("header", { class: "head" }, html("h3", {}, words.pose.stage), this.#readout, restore, this.#joint.element),
      this.stage.element,
      html(
        "div",
        { class: "knobs" },
        ...COMPONENTS.map((name) => this.#knobs[name].element),
        this.#heading.element,
        html("div", { class: "others" }, this.#instant.element),
      ),
    );
  }

  show(state: PoseState): Promise<void> {
    this.#state = state;
    this.#joint.value = state.joint;
    this.#heading.value = state.heading;
    this.#instant.value = state.at;
    return this.#posing.take(state);
  }

  async measure(): Promise<Measure> {
    return this.#state ? measurePose(this.#parts.engine, this.#state) : {};
  }

  sentence(): string {
    if (!this.#shown) return "";
    const { words } = this.#parts;
    const { state, w } = this.#shown;
    const [x, y, z] = w.map((angle) => this.#degrees(angle)) as [string, string, string];
    return words.pose.posed(words.joints[state.joint], this.#degrees(Math.hypot(...w)), x, y, z);
  }

  table(): Table {
    const { words } = this.#parts;
    const shown = this.#shown;
    const rows = shown ? [[words.joints[shown.state.joint], ...shown.w.map((angle) => this.#degrees(angle))]] : [];
    return { head: words.pose.components, rows };
  }

  values(): Readonly<Record<string, string>> {
    if (!this.#shown) return {};
    const { mean, given, state, w } = this.#shown;
    const now = multiply(exp(turnOf(state.turned, state.joint)), given);
    const angleOf = (q: typeof mean) => `${this.#degrees(Math.hypot(...log(q)))}°`;
    return { w: `${this.#degrees(Math.hypot(...w))}°`, mean: angleOf(mean), R: angleOf(now) };
  }

  light(term: string | undefined): void {
    for (const mark of this.stage.overlay.children)
      mark.classList.toggle("lit", mark.getAttribute("data-term") === term);
  }

  #degrees(radians: number): string {
    return figure(radians * DEGREES, 1, this.#parts.words);
  }

  /** Rotates the joint so that a component of w is `degrees`. */
  #turnTo(component: number, degrees: number): void {
    const [state, shown] = [this.#state, this.#shown];
    if (!state || !shown) return;
    const { mean, given } = shown;
    const now = multiply(exp(turnOf(state.turned, state.joint)), given);
    const w = log(multiply(inverse(mean), now)).map((value, i) => (i === component ? degrees / DEGREES : value));
    const wanted = multiply(mean, exp(w as unknown as Vector));
    const turn = log(multiply(wanted, inverse(given)));
    this.#parts.change({ turned: withTurn(state.turned, state.joint, turn) }, false);
  }

  async #pose(state: PoseState): Promise<void> {
    const { engine, signal } = this.#parts;
    const [plain, motion] = await Promise.all([
      motionOf(engine, state.motion, [], 0),
      motionOf(engine, state.motion, state.turned, state.heading),
    ]);
    if (signal.aborted) return;
    const isFirst = !this.#shown;
    const frame = Math.min(state.at, framesOf(motion) - 1);
    const { joint } = state;
    const w = degreesOfFreedom(motion, joint, 0, frame);
    const { proportions } = motion;
    this.#shown = { state, w, proportions, mean: meanOf(motion, joint), given: rotationAt(plain, joint, frame) };
    COMPONENTS.forEach((name, i) => {
      this.#knobs[name].value = Math.round(w[i]! * DEGREES);
    });
    const { viewer } = this.stage;
    if (viewer) {
      const pose = motion.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
      const ghost = Float32Array.from(pose);
      ghost.set(this.#shown.mean, 3 + 4 * JOINT[joint]);
      if (isFirst) viewer.setProportions(proportions);
      viewer.setStyled(pose);
      viewer.setOthers([{ pose: ghost, share: GHOST }]);
      viewer.description = this.sentence();
      viewer.resetTrail();
    }
    setText(this.#readout, this.#parts.words.pose.read(this.#degrees(Math.hypot(...w))));
    this.stage.invalidate();
    this.#parts.changed();
  }

  /** Draws axis and arc over the picture. */
  #placeMarks(): void {
    const [{ viewer }, shown] = [this.stage, this.#shown];
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
