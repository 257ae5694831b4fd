import { validateBytes } from "gltf-validator";
import { AnimationMixer, type Bone, type Object3D, type SkinnedMesh, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { describe, expect, it } from "vitest";
import { createWorldPose, DEFAULT_PROPORTIONS, JOINT, POSE_FLOATS, ROLES, restPose, worldFromLocal } from "../humanoid";
import { fitTo } from "../mannequin/fit";
import { mannequinGlb } from "./mannequin_glb";

/** Severity of the validator's warnings; errors have a smaller number. */
const WARNING = 1;

/** Two frames; in the second the left arm is raised, the right knee bent, the body bowed, and it is a metre ahead. */
function animation() {
  const poses = new Float32Array(2 * POSE_FLOATS);
  poses.set(restPose());
  const moved = restPose();
  moved[2] = 1;
  const turn = (joint: number, axis: 0 | 1 | 2, angle: number) => {
    moved.set([0, 0, 0, Math.cos(angle / 2)], 3 + 4 * joint);
    moved[3 + 4 * joint + axis] = Math.sin(angle / 2);
  };
  turn(JOINT.left_upper_arm, 2, 1.2);
  turn(JOINT.right_lower_leg, 0, 0.9);
  turn(JOINT.spine, 0, 0.4);
  poses.set(moved, POSE_FLOATS);
  return { name: "bow", proportions: DEFAULT_PROPORTIONS, poses, times: new Float32Array([0, 0.75]) };
}

/** The file as three.js reads it, at the end of its animation. */
async function opened(): Promise<{ scene: Object3D; durationSecs: number }> {
  const bytes = mannequinGlb(animation());
  const { scene, animations } = await new GLTFLoader().parseAsync(bytes.buffer, "");
  const mixer = new AnimationMixer(scene);
  const action = mixer.clipAction(animations[0]!);
  action.clampWhenFinished = true;
  action.setLoop(2200, 1).play();
  mixer.setTime(0.75);
  scene.updateMatrixWorld(true);
  return { scene, durationSecs: animations[0]!.duration };
}

describe("the mannequin as glTF", () => {
  it("is valid", async () => {
    const { issues } = await validateBytes(mannequinGlb(animation()));
    expect(issues.messages.filter(({ severity }) => severity <= WARNING)).toEqual([]);
    // The length in the header differs from the file's.
    const damaged = mannequinGlb(animation());
    damaged[8]! ^= 4;
    expect((await validateBytes(damaged)).issues.numErrors).toBeGreaterThan(0);
  });

  it("has every joint where forward kinematics puts it", async () => {
    const { scene, durationSecs } = await opened();
    expect(durationSecs).toBeCloseTo(0.75, 6);
    const world = createWorldPose();
    worldFromLocal(fitTo(DEFAULT_PROPORTIONS).proportions, animation().poses.subarray(POSE_FLOATS), world);
    for (const [joint, role] of ROLES.entries()) {
      const at = scene.getObjectByName(role)!.getWorldPosition(new Vector3());
      expect(at.distanceTo(new Vector3().fromArray(world.positions, 3 * joint)), role).toBeLessThan(1e-5);
    }
  });

  it("carries its skin along: what was at a hand is at the hand", async () => {
    const { scene } = await opened();
    const meshes: SkinnedMesh[] = [];
    scene.traverse((object) => {
      if ((object as SkinnedMesh).isSkinnedMesh) meshes.push(object as SkinnedMesh);
    });
    expect(meshes.length).toBe(2);
    const hand = scene.getObjectByName("left_hand") as Bone;
    const centre = hand.getWorldPosition(new Vector3());
    const near = (mesh: SkinnedMesh) => {
      let min = Number.POSITIVE_INFINITY;
      const v = new Vector3();
      for (let i = 0; i < mesh.geometry.getAttribute("position").count; i++)
        min = Math.min(min, mesh.localToWorld(mesh.getVertexPosition(i, v)).distanceTo(centre));
      return min;
    };
    expect(Math.min(...meshes.map(near))).toBeLessThan(0.06);
    // No vertex is left at the hand's former position.
    expect(centre.y).toBeGreaterThan(1.5);
  });
});
