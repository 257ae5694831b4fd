/** Measurements of a motion at an instant, from poses, times and contacts. Pure functions. */
import { JOINT, JOINTS } from "../../../humanoid";
import { type Measured, meanDistance } from "../../../player/measured";

/** A motion that corresponds to its input frame by frame. */
export interface ColumnMotion {
  poses: Float32Array;
  /** Output time of each frame, seconds. */
  timeOut: Float32Array;
  /** Foot contacts, left and right interleaved. */
  planted: Uint8Array;
  /** Mean cost of a frame in the engine, milliseconds; `undefined` for the input. */
  frameMs: number | undefined;
}

/** A motion of a column with the positions of its joints. */
export type MeasuredMotion = Measured<ColumnMotion>;

/** The measurements below a column; `undefined` where nothing can be measured. */
export interface Figures {
  /** Mean distance of the joints from the reference's, regardless of hips and heading, centimetres. */
  difference: number | undefined;
  /** Time offset of the output from the reference's, milliseconds. */
  later: number | undefined;
  /** Mean ground speed of planted feet around the instant, cm/s. */
  skate: number | undefined;
  /** Mean jerk of the joints around the instant as a multiple of the input's. */
  jerk: number | undefined;
  /** Cost of a frame, milliseconds. */
  cost: number | undefined;
}

/** Foot skate and jerk are means over this many frames before and after the instant: half a second at 60 Hz. */
const AROUND = 30;

/** The measurements of a motion at an input frame, compared with the reference. */
export function figuresAt(
  motion: MeasuredMotion,
  input: MeasuredMotion,
  reference: MeasuredMotion | undefined,
  inputFrame: number,
): Figures {
  const f = Math.min(Math.max(0, Math.round(inputFrame)), motion.frames - 1);
  const other = reference === motion ? undefined : reference;
  const jerk = meanJerk(motion, f);
  const inputJerk = meanJerk(input, f);
  return {
    difference: other && 100 * meanDistance(motion, other, f),
    later: other && 1000 * (motion.timeOut[f]! - other.timeOut[f]!),
    skate: footSkate(motion, f),
    jerk: jerk !== undefined && inputJerk ? jerk / inputJerk : undefined,
    cost: motion.frameMs,
  };
}

const window = ({ frames }: MeasuredMotion, f: number): [number, number] => [
  Math.max(0, f - AROUND),
  Math.min(frames - 1, f + AROUND),
];

/** Mean ground speed of planted feet, cm/s; `undefined` if no foot is planted. */
function footSkate(motion: MeasuredMotion, frame: number): number | undefined {
  const { world, planted, timeOut } = motion;
  const [from, to] = window(motion, frame);
  let [travel, secs] = [0, 0];
  for (let f = from; f < to; f++)
    for (const [side, foot, toes] of [
      [0, JOINT.left_foot, JOINT.left_toes],
      [1, JOINT.right_foot, JOINT.right_toes],
    ] as const) {
      if (planted[2 * f + side] !== 1 || planted[2 * (f + 1) + side] !== 1) continue;
      // A foot rolls on its heel or on its ball: the joint that moves less is in contact.
      travel += Math.min(...[foot, toes].map((joint) => groundTravel(world, f, joint)));
      secs += timeOut[f + 1]! - timeOut[f]!;
    }
  return secs > 0 ? (100 * travel) / secs : undefined;
}

function groundTravel(world: Float32Array, frame: number, joint: number): number {
  const a = 3 * (JOINTS * frame + joint);
  const b = a + 3 * JOINTS;
  return Math.hypot(world[b]! - world[a]!, world[b + 2]! - world[a + 2]!);
}

/** Mean magnitude of the joints' third derivative, m/s³; `undefined` if there are too few frames. */
function meanJerk(motion: MeasuredMotion, frame: number): number | undefined {
  const { world, timeOut } = motion;
  const [from, to] = window(motion, frame);
  const secs = (timeOut[to]! - timeOut[from]!) / Math.max(1, to - from);
  if (to - from < 3 || secs <= 0) return undefined;
  const stride = 3 * JOINTS;
  let sum = 0;
  for (let f = from; f + 3 <= to; f++)
    for (let j = 0; j < JOINTS; j++) {
      const i = stride * f + 3 * j;
      const third = (axis: number) =>
        world[i + 3 * stride + axis]! -
        3 * world[i + 2 * stride + axis]! +
        3 * world[i + stride + axis]! -
        world[i + axis]!;
      sum += Math.hypot(third(0), third(1), third(2));
    }
  return sum / ((to - from - 2) * JOINTS) / secs ** 3;
}
