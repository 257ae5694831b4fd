/** Families of rigs as real programs write them: names, bone axes, units, poses and hierarchies. */
import { Quaternion, Vector3 } from "three";
import { ROLES, type Role } from "../../web/humanoid";

/** Local axes of the bones of a family: along the world, along +Y, or along +X, mirrored on the right. */
export type Axes = "world" | "y" | "x" | "mirrored x";

/** Properties of a rig. */
export interface Family {
  readonly name: string;
  /** Names of the 21 joints, in the order of roles. */
  readonly joints: readonly string[];
  readonly axes: Axes;
  /** The bind pose: in the A-pose arms are 45° down and legs 4° apart. */
  readonly pose: "T" | "A";
  /** Size of the whole body relative to the mannequin's. */
  readonly size: number;
  /** Additional factors on single parts and their descendants. */
  readonly shape: Readonly<Partial<Record<Role, number>>>;
  /** Metres per unit inside the armature. */
  readonly metresPerUnit: number;
  /** Rotation of the armature, for example where +Z is up inside it. */
  readonly armature: Quaternion;
  /** Whether the character faces −Z. */
  readonly facesAway: boolean;
  /** Names of joints between spine and chest. */
  readonly trunk: readonly string[];
  /** Names of the joints of one left finger; {@link mirroredName} returns the right ones. */
  readonly finger: readonly string[];
  /** Names of the joints of a lock of hair, which is simulated in a VRM. */
  readonly hair: readonly string[];
  /** Name of a joint above the hips, if there is one. */
  readonly root?: string;
  /** Biped has the spine as parent of the thighs, and the neck as parent of the collarbones. */
  readonly isBiped?: boolean;
  readonly vrm?: 0 | 1;
}

const NO_TURN = new Quaternion();
const Z_UP = new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), -Math.PI / 2);

/** Returns names by part: trunk, then arm and leg of both sides. */
function names(trunk: string[], arm: string[], leg: string[], sided: (part: string, side: "left" | "right") => string) {
  const side = (s: "left" | "right", parts: string[]) => parts.map((part) => sided(part, s));
  return [...trunk, ...side("left", arm), ...side("right", arm), ...side("left", leg), ...side("right", leg)];
}

const capital = (side: string) => side[0]!.toUpperCase() + side.slice(1);

const MIXAMO = (prefix: string) =>
  names(
    ["Hips", "Spine", "Spine2", "Neck", "Head"].map((part) => prefix + part),
    ["Shoulder", "Arm", "ForeArm", "Hand"],
    ["UpLeg", "Leg", "Foot", "ToeBase"],
    (part, side) => `${prefix}${capital(side)}${part}`,
  );

const VROID = names(
  ["Hips", "Spine", "UpperChest", "Neck", "Head"].map((part) => `J_Bip_C_${part}`),
  ["Shoulder", "UpperArm", "LowerArm", "Hand"],
  ["UpperLeg", "LowerLeg", "Foot", "ToeBase"],
  (part, side) => `J_Bip_${capital(side)[0]}_${part}`,
);

const UNREAL = names(
  ["pelvis", "spine_01", "spine_03", "neck_01", "head"],
  ["clavicle", "upperarm", "lowerarm", "hand"],
  ["thigh", "calf", "foot", "ball"],
  (part, side) => `${part}_${side[0]}`,
);

const BIPED = names(
  ["Pelvis", "Spine", "Spine1", "Neck", "Head"].map((part) => `Bip01 ${part}`),
  ["Clavicle", "UpperArm", "Forearm", "Hand"],
  ["Thigh", "Calf", "Foot", "Toe0"],
  (part, side) => `Bip01 ${capital(side)[0]} ${part}`,
);

const UNITY = names(
  ["Hips", "Spine", "Chest", "Neck", "Head"],
  ["Shoulder", "UpperArm", "LowerArm", "Hand"],
  ["UpperLeg", "LowerLeg", "Foot", "Toes"],
  (part, side) => capital(side) + part,
);

const VROID_HAIR = ["J_Sec_Hair1_01", "J_Sec_Hair2_01", "J_Sec_Hair3_01"];

const PLAIN = {
  pose: "T" as const,
  size: 1,
  shape: {},
  metresPerUnit: 1,
  armature: NO_TURN,
  facesAway: false,
  trunk: [],
  finger: [],
  hair: [],
};

/** The eight rigs of the tests. */
export const FAMILIES: readonly Family[] = [
  {
    ...PLAIN,
    name: "VRM 1",
    joints: VROID,
    axes: "y",
    trunk: ["J_Bip_C_Chest"],
    finger: ["J_Bip_L_Index1", "J_Bip_L_Index2"],
    hair: VROID_HAIR,
    root: "Root",
    vrm: 1,
  },
  {
    ...PLAIN,
    name: "VRM 0",
    joints: VROID,
    axes: "world",
    facesAway: true,
    trunk: ["J_Bip_C_Chest"],
    hair: VROID_HAIR,
    vrm: 0,
  },
  {
    ...PLAIN,
    name: "Mixamo in cm",
    joints: MIXAMO("mixamorig:"),
    axes: "y",
    metresPerUnit: 0.01,
    armature: Z_UP,
    trunk: ["mixamorig:Spine1"],
    finger: ["mixamorig:LeftHandIndex1", "mixamorig:LeftHandIndex2", "mixamorig:LeftHandIndex3"],
  },
  {
    ...PLAIN,
    name: "RPM child",
    joints: MIXAMO(""),
    axes: "y",
    pose: "A",
    size: 0.62,
    shape: { head: 1.35 },
    trunk: ["Spine1"],
    finger: ["LeftHandIndex1", "LeftHandIndex2"],
  },
  {
    ...PLAIN,
    name: "Unreal",
    joints: UNREAL,
    axes: "mirrored x",
    pose: "A",
    size: 1.08,
    metresPerUnit: 0.01,
    armature: Z_UP,
    trunk: ["spine_02"],
    finger: ["index_01_l", "index_02_l"],
    root: "root",
  },
  { ...PLAIN, name: "Biped", joints: BIPED, axes: "x", finger: ["Bip01 L Finger0"], root: "Bip01", isBiped: true },
  {
    ...PLAIN,
    name: "unnamed giant",
    joints: ROLES.map((_, i) => `Bone.${String(i).padStart(3, "0")}`),
    axes: "y",
    size: 3,
    shape: { left_upper_leg: 1.05, right_upper_leg: 1.05, head: 0.7 },
  },
  {
    ...PLAIN,
    name: "chibi",
    joints: UNITY,
    axes: "world",
    size: 0.7,
    shape: {
      head: 2.6,
      left_upper_leg: 0.6,
      right_upper_leg: 0.6,
      left_upper_arm: 0.7,
      right_upper_arm: 0.7,
      left_foot: 1.5,
      right_foot: 1.5,
    },
  },
];

/** Returns the name of the same joint on the other side. */
export function mirroredName(name: string): string {
  return name.replace("Left", "Right").replace("_L_", "_R_").replace(/_l$/, "_r").replace(" L ", " R ");
}
