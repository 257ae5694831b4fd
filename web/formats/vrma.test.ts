import { validateBytes } from "gltf-validator";
import { describe, expect, it } from "vitest";
import { movingAnimation, poseOf, TALL_BODY } from "../../tests/humanoid_animation";
import { JOINT, JOINTS, POSE_FLOATS } from "../humanoid";
import { vrmAnimation } from "./vrma";

/** Severity of the validator's warnings; errors have a smaller number. */
const WARNING = 1;

/** The bones that VRM 1.0 requires of every humanoid, with the nearest required bone above each. */
const REQUIRED_BONES: Record<string, string | undefined> = {
  hips: undefined,
  spine: "hips",
  head: "spine",
  leftUpperArm: "spine",
  leftLowerArm: "leftUpperArm",
  leftHand: "leftLowerArm",
  rightUpperArm: "spine",
  rightLowerArm: "rightUpperArm",
  rightHand: "rightLowerArm",
  leftUpperLeg: "hips",
  leftLowerLeg: "leftUpperLeg",
  leftFoot: "leftLowerLeg",
  rightUpperLeg: "hips",
  rightLowerLeg: "rightUpperLeg",
  rightFoot: "rightLowerLeg",
};

/** The optional bones of VRM 1.0 that the canonical humanoid has. */
const OPTIONAL_BONES = ["chest", "neck", "leftShoulder", "rightShoulder", "leftToes", "rightToes"];

interface Node {
  name: string;
  translation: number[];
  children?: number[];
}

/** The parts of the document that the tests read. */
interface Document {
  extensionsUsed: string[];
  extensions: {
    VRMC_vrm_animation: { specVersion: string; humanoid: { humanBones: Record<string, { node: number }> } };
  };
  scenes: { nodes: number[] }[];
  nodes: Node[];
  animations: {
    name: string;
    samplers: { input: number; output: number; interpolation: string }[];
    channels: { sampler: number; target: { node: number; path: string } }[];
  }[];
  accessors: { bufferView: number; count: number; type: "SCALAR" | "VEC3" | "VEC4" }[];
  bufferViews: { byteOffset: number; byteLength: number }[];
}

/** A GLB file's document, and the numbers of its accessors. */
function parse(bytes: Uint8Array): { document: Document; numbersOf: (accessor: number) => Float32Array } {
  const view = new DataView(bytes.buffer);
  const jsonLength = view.getUint32(12, true);
  const document: Document = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + jsonLength)));
  const numbersOf = (accessor: number) => {
    const { byteOffset, byteLength } = document.bufferViews[document.accessors[accessor]!.bufferView]!;
    const start = 28 + jsonLength + byteOffset;
    return new Float32Array(bytes.slice(start, start + byteLength).buffer);
  };
  return { document, numbersOf };
}

const animation = movingAnimation();
const { document, numbersOf } = parse(vrmAnimation(animation));
const { humanBones } = document.extensions.VRMC_vrm_animation.humanoid;
const [{ samplers, channels }] = document.animations as [Document["animations"][number]];
const parentOf = (node: number) => document.nodes.findIndex(({ children }) => children?.includes(node));

/** The numbers of a bone's track, frame after frame. */
function track(bone: string, path: string): Float32Array {
  const channel = channels.find(({ target }) => target.node === humanBones[bone]!.node && target.path === path);
  return numbersOf(samplers[channel!.sampler]!.output);
}

describe("a VRM animation", () => {
  it("is valid binary glTF", async () => {
    const { issues } = await validateBytes(vrmAnimation(animation));
    expect(issues.messages.filter(({ severity }) => severity <= WARNING)).toEqual([]);
  });

  it("declares its extension and version", () => {
    expect(document.extensionsUsed).toEqual(["VRMC_vrm_animation"]);
    expect(document.extensions.VRMC_vrm_animation.specVersion).toBe("1.0");
  });

  it("needs a body", () => {
    expect(() => vrmAnimation({ ...animation, proportions: [1, 2] })).toThrow(RangeError);
  });
});

describe("the humanoid of a VRM animation", () => {
  it("has every bone that VRM requires and the optional ones that the body has, a node each", () => {
    expect(Object.keys(humanBones).sort()).toEqual([...Object.keys(REQUIRED_BONES), ...OPTIONAL_BONES].sort());
    expect(new Set(Object.values(humanBones).map(({ node }) => node)).size).toBe(JOINTS);
  });

  it.each(Object.entries(REQUIRED_BONES))("has %s below %s", (bone, above) => {
    let node = parentOf(humanBones[bone]!.node);
    while (node >= 0 && !(document.nodes[node]!.name in REQUIRED_BONES)) node = parentOf(node);
    expect(document.nodes[node]?.name).toBe(above);
  });

  it("has its neck and shoulders on the chest, which follows the spine", () => {
    for (const bone of ["neck", "leftShoulder", "rightShoulder"])
      expect(parentOf(humanBones[bone]!.node), bone).toBe(humanBones.chest!.node);
    expect(parentOf(humanBones.chest!.node)).toBe(humanBones.spine!.node);
  });

  it("rests in the body's T-pose, its hips at their height, with neither rotations nor scales", () => {
    expect(document.scenes[0]!.nodes).toEqual([humanBones.hips!.node]);
    for (const node of document.nodes)
      expect(Object.keys(node)).toEqual(expect.not.arrayContaining(["rotation", "scale", "matrix"]));
    for (let joint = 0; joint < JOINTS; joint++)
      expect(document.nodes[joint]!.translation).toEqual([...TALL_BODY.subarray(3 * joint, 3 * joint + 3)]);
  });
});

describe("the tracks of a VRM animation", () => {
  it("have a key at the time of each frame", () => {
    for (const { input } of samplers) expect(numbersOf(input)).toEqual(animation.times);
  });

  it("turn every bone, move the hips alone, and scale nothing", () => {
    const paths = channels.map(({ target }) => `${document.nodes[target.node]!.name} ${target.path}`);
    const rotations = Object.keys(humanBones).map((bone) => `${bone} rotation`);
    expect(paths.sort()).toEqual([...rotations, "hips translation"].sort());
  });

  it.each([
    ["hips", "hips"],
    ["chest", "chest"],
    ["left_upper_arm", "leftUpperArm"],
    ["left_lower_arm", "leftLowerArm"],
    ["right_hand", "rightHand"],
    ["right_upper_leg", "rightUpperLeg"],
    ["left_toes", "leftToes"],
  ] as const)("give the rotations of the %s to %s", (role, bone) => {
    const rotations = track(bone, "rotation");
    for (let frame = 0; frame < animation.times.length; frame++) {
      const first = 3 + 4 * JOINT[role];
      const given = poseOf(animation, frame).subarray(first, first + 4);
      for (let k = 0; k < 4; k++) expect(rotations[4 * frame + k]).toBeCloseTo(given[k]!, 6);
    }
  });

  it("give the root's path to the hips, in metres", () => {
    const path = track("hips", "translation");
    for (let frame = 0; frame < animation.times.length; frame++)
      expect(path.subarray(3 * frame, 3 * frame + 3)).toEqual(poseOf(animation, frame).subarray(0, 3));
  });

  it("are unit quaternions, whatever the length of those of the poses", () => {
    const long = movingAnimation();
    for (let i = 3; i < long.poses.length; i++) if (i % POSE_FLOATS >= 3) long.poses[i]! *= 1.5;
    const again = parse(vrmAnimation(long));
    const output = again.document.animations[0]!.samplers[1]!.output;
    const [x, y, z, w] = again.numbersOf(output);
    expect(Math.hypot(x!, y!, z!, w!)).toBeCloseTo(1, 6);
  });
});
