/** Motions for characters, and their foot contacts: heights of soles and foot skate, of the input and of a rig. */
import "../../web/engine/whole";
import { type Bone, type Object3D, type SkinnedMesh, Vector3 } from "three";
import { loadBuiltIn } from "../../web/engine/built_in";
import { Engine } from "../../web/engine/engine";
import { DEFAULT_OPTIONS, type StyleWeights } from "../../web/engine/types";
import { createWorldPose, JOINT, POSE_FLOATS, type Role, worldFromLocal } from "../../web/humanoid";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";

/** A motion on a body. */
export interface Performance {
  readonly name: string;
  readonly proportions: Float32Array;
  readonly poses: Float32Array;
  readonly planted: Uint8Array;
  readonly timeOut: Float32Array;
}

/** Styles in which characters are tested. */
export const STYLES: readonly { name: string; styles: StyleWeights }[] = [
  { name: "neutral", styles: {} },
  { name: "old", styles: { old: 1 } },
  { name: "proud", styles: { proud: 1 } },
];

/** Returns every built-in input in these styles. */
export async function performances(): Promise<Performance[]> {
  const [engine, motions] = await Promise.all([Engine.load(), loadBuiltIn()]);
  const database = engine.openDatabase({ kind: "demo", motions });
  const { proportions } = database.info;
  return engine.inputsOf(motions).flatMap((name) =>
    STYLES.map((style): Performance => {
      const input = engine.openInput(database, { kind: "built-in", name, motions });
      const stylizer = engine.createStylizer(database, { ...DEFAULT_OPTIONS, styles: style.styles });
      const job = engine.createClipJob(input, stylizer);
      while (!job.run(1000));
      const { poses, planted, timeOut } = job.result();
      return { name: `${name}, ${style.name}`, proportions, poses, planted, timeOut };
    }),
  );
}

/** The feet of a body: their vertices in the frames of the joints that they follow. */
export interface Feet {
  /** Vertices of ankle and toes of the left and of the right foot, xyz each. */
  readonly vertices: readonly { role: Role; local: Vector3 }[][];
}

/** Motion of the soles of a body. */
export interface Soles {
  /** Height of the lowest vertex of each foot, left and right interleaved, one pair per frame. */
  readonly heights: Float32Array;
  /** Horizontal travel of the standing vertex since the previous frame, left and right. */
  readonly travels: Float32Array;
}

/** Follows the lowest vertices over a motion. `place` transforms a vertex of a frame to the world. */
function follow(
  frames: number,
  feet: Feet,
  pose: (frame: number) => void,
  place: (role: Role, v: Vector3) => void,
): Soles {
  const heights = new Float32Array(2 * frames);
  const travels = new Float32Array(2 * frames);
  const stood = [-1, -1];
  const before = [0, 1].map((side) => feet.vertices[side]!.map(() => new Vector3()));
  const point = new Vector3();
  for (let f = 0; f < frames; f++) {
    pose(f);
    for (const side of [0, 1]) {
      let [lowest, at] = [Infinity, 0];
      for (const [i, { role, local }] of feet.vertices[side]!.entries()) {
        place(role, point.copy(local));
        if (i === stood[side])
          travels[2 * f + side] = Math.hypot(point.x - before[side]![i]!.x, point.z - before[side]![i]!.z);
        if (point.y < lowest) [lowest, at] = [point.y, i];
        before[side]![i]!.copy(point);
      }
      heights[2 * f + side] = lowest;
      stood[side] = at;
    }
  }
  return { heights, travels };
}

/**
 * Returns the vertices of a skinned character's feet: for each foot those whose first joint is the ankle's or the
 * toes'.
 */
export function feetOf(object: Object3D, nodeOf: (role: Role) => Object3D): Feet {
  const vertices: Feet["vertices"] = [[], []];
  object.traverse((node) => {
    const mesh = node as SkinnedMesh;
    if (!mesh.isSkinnedMesh) return;
    const { position, skinIndex, skinWeight } = mesh.geometry.attributes;
    for (const [side, roles] of [
      [0, ["left_foot", "left_toes"]],
      [1, ["right_foot", "right_toes"]],
    ] as const)
      for (const role of roles) {
        const bone = mesh.skeleton.bones.indexOf(nodeOf(role) as Bone);
        for (let v = 0; v < position!.count; v++) {
          if (skinIndex!.getX(v) !== bone || skinWeight!.getX(v) < 0.5) continue;
          const local = new Vector3().fromBufferAttribute(position!, v).applyMatrix4(mesh.skeleton.boneInverses[bone]!);
          vertices[side]!.push({ role, local });
        }
      }
  });
  return { vertices };
}

/** Returns the soles of the input: the mannequin's feet on the body of the motion. */
export function inputSoles({ proportions, poses, planted }: Performance): Soles {
  const world = createWorldPose();
  const q = world.rotations;
  return follow(
    planted.length / 2,
    MANNEQUIN_FEET,
    (f) => worldFromLocal(proportions, poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS), world),
    (role, v) => {
      const j = JOINT[role];
      v.applyQuaternion({ x: q[4 * j]!, y: q[4 * j + 1]!, z: q[4 * j + 2]!, w: q[4 * j + 3]! } as never);
      v.x += world.positions[3 * j]!;
      v.y += world.positions[3 * j + 1]!;
      v.z += world.positions[3 * j + 2]!;
    },
  );
}

/** Returns the soles of a performing character. */
export function characterSoles(
  { poses, planted }: Performance,
  feet: Feet,
  nodeOf: (role: Role) => Object3D,
  apply: (pose: Float32Array) => void,
): Soles {
  return follow(
    planted.length / 2,
    feet,
    (f) => apply(poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS)),
    (role, v) => v.applyMatrix4(nodeOf(role).matrixWorld),
  );
}

/** The mannequin's own feet, read from a rig whose joints are not rotated. */
const MANNEQUIN_FEET: Feet = { vertices: [[], []] };

/** Reads {@link MANNEQUIN_FEET}. Call it before {@link inputSoles}. */
export async function readMannequinFeet(): Promise<void> {
  const { GLTFLoader } = await import("three/addons/loaders/GLTFLoader.js");
  const plain = { ...FAMILIES.at(-1)!, size: 1, shape: {} };
  const { scene } = await new GLTFLoader().parseAsync(makeRig(plain).glb.buffer, "");
  const names: Partial<Record<Role, string>> = {
    left_foot: "LeftFoot",
    left_toes: "LeftToes",
    right_foot: "RightFoot",
    right_toes: "RightToes",
  };
  const feet = feetOf(scene, (role) => scene.getObjectByName(names[role]!)!);
  for (const side of [0, 1]) MANNEQUIN_FEET.vertices[side]!.splice(0, Infinity, ...feet.vertices[side]!);
}
