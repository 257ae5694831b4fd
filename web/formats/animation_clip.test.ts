import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { beforeEach, describe, expect, it } from "vitest";
import { movingAnimation, poseOf } from "../../tests/humanoid_animation";
import { createWorldPose, JOINTS, ROLES, worldFromLocal } from "../humanoid";
import { fitTo } from "../mannequin/fit";
import { type ClipOptions, MissingJointError, toAnimationClip } from "./animation_clip";
import { mannequinGlb } from "./mannequin_glb";

const animation = movingAnimation();
const lastTime = animation.times.at(-1)!;

/** The mannequin as three.js loads its file; its own animation is not played. */
async function loaded(): Promise<THREE.Object3D> {
  return (await new GLTFLoader().parseAsync(mannequinGlb(animation).buffer, "")).scene;
}

let rig: THREE.Object3D;
beforeEach(async () => {
  rig = await loaded();
});

/** Poses the nodes below `root` at a time of the clip. */
function play(root: THREE.Object3D, secs: number, options?: ClipOptions): void {
  const mixer = new THREE.AnimationMixer(root);
  const action = mixer.clipAction(toAnimationClip(THREE, root, animation, options));
  action.setLoop(THREE.LoopOnce, 1).clampWhenFinished = true;
  action.play();
  mixer.setTime(secs);
  root.updateMatrixWorld(true);
}

/** The largest differences between the rig's joints and those of a pose by forward kinematics: metres and degrees. */
function deviation(root: THREE.Object3D, pose: ArrayLike<number>): { metres: number; degrees: number } {
  const world = createWorldPose();
  worldFromLocal(fitTo(animation.proportions).proportions, pose, world);
  let [metres, degrees] = [0, 0];
  for (let joint = 0; joint < JOINTS; joint++) {
    const node = root.getObjectByName(ROLES[joint]!)!;
    const position = new THREE.Vector3().fromArray(world.positions, 3 * joint);
    const turn = new THREE.Quaternion()
      .fromArray(world.rotations, 4 * joint)
      .normalize()
      .invert();
    turn.multiply(node.getWorldQuaternion(new THREE.Quaternion()));
    metres = Math.max(metres, position.distanceTo(node.getWorldPosition(new THREE.Vector3())));
    // The arc cosine of w would be imprecise for small angles.
    degrees = Math.max(degrees, THREE.MathUtils.radToDeg(2 * Math.asin(Math.hypot(turn.x, turn.y, turn.z))));
  }
  return { metres, degrees };
}

/** The pose halfway between two frames: rotations along the shortest arc. */
function between(frame: number): Float32Array {
  const [a, b] = [poseOf(animation, frame), poseOf(animation, frame + 1)];
  const pose = a.map((value, i) => (value + b[i]!) / 2);
  const rotation = (numbers: Float32Array, at: number) => new THREE.Quaternion().fromArray(numbers, at);
  for (let at = 3; at < pose.length; at += 4) rotation(a, at).slerp(rotation(b, at), 0.5).toArray(pose, at);
  return pose;
}

describe("the clip on the loaded mannequin", () => {
  it.each([0, 1, 23, 60])("puts every joint at frame %d where forward kinematics puts it", (frame) => {
    play(rig, animation.times[frame]!);
    const { metres, degrees } = deviation(rig, poseOf(animation, frame));
    expect(metres).toBeLessThan(1e-4);
    expect(degrees).toBeLessThan(0.01);
  });

  it("moves evenly between two frames", () => {
    play(rig, (animation.times[30]! + animation.times[31]!) / 2);
    const { metres, degrees } = deviation(rig, between(30));
    expect(metres).toBeLessThan(1e-4);
    expect(degrees).toBeLessThan(0.01);
  });

  it("has a key at the time of each frame, on a track each for the hips' position and 21 rotations", () => {
    const clip = toAnimationClip(THREE, rig, animation);
    expect(clip.validate()).toBe(true);
    expect(clip.name).toBe("moving");
    expect(clip.duration).toBe(lastTime);
    expect(clip.tracks.map(({ name }) => name)).toEqual([
      "hips.position",
      ...ROLES.map((role) => `${role}.quaternion`),
    ]);
    for (const { times } of clip.tracks) expect(times).toEqual(animation.times);
  });

  it("can be edited without the animation, or another of its tracks, being changed", () => {
    const clip = toAnimationClip(THREE, rig, animation);
    for (const track of clip.tracks) track.shift(1).scale(2);
    for (const { times } of clip.tracks) expect(times.at(-1)).toBeCloseTo(2 * (lastTime + 1), 5);
    expect(animation).toEqual(movingAnimation());
  });

  it("survives JSON", () => {
    const clip = toAnimationClip(THREE, rig, animation);
    const again = THREE.AnimationClip.parse(JSON.parse(JSON.stringify(THREE.AnimationClip.toJSON(clip))));
    expect(again.tracks.map(({ times, values }) => [times, values])).toEqual(
      clip.tracks.map(({ times, values }) => [times, values]),
    );
  });
});

describe("the options of a clip", () => {
  it("name it", () => {
    expect(toAnimationClip(THREE, rig, animation, { name: "proud walk" }).name).toBe("proud walk");
  });

  it("keep it in place: the hips rise and fall over the spot where they start, and nothing else changes", () => {
    const frame = 40;
    play(rig, animation.times[frame]!, { inPlace: true });
    const pose = poseOf(animation, frame);
    const start = poseOf(animation, 0);
    expect(Math.hypot(pose[0]! - start[0]!, pose[2]! - start[2]!)).toBeGreaterThan(0.5);
    const { metres, degrees } = deviation(rig, Float32Array.of(start[0]!, pose[1]!, start[2]!, ...pose.subarray(3)));
    expect(metres).toBeLessThan(1e-4);
    expect(degrees).toBeLessThan(0.01);
  });
});

describe("the nodes of a clip", () => {
  it("are named by their uuids where names repeat", () => {
    const hat = new THREE.Object3D();
    hat.name = "head";
    rig.children.unshift(hat);
    const head = rig.getObjectByName("neck")!.children[0]!;
    const names = toAnimationClip(THREE, rig, animation).tracks.map(({ name }) => name);
    expect(names).toContain(`${head.uuid}.quaternion`);
    expect(names).toContain("neck.quaternion");
    rig.children.shift();
  });

  it("are those of one body, where there are several below the root", async () => {
    const scene = new THREE.Group();
    const other = await loaded();
    scene.add(rig, other);
    play(scene, lastTime);
    expect(deviation(rig, poseOf(animation, 60)).metres).toBeLessThan(1e-4);
    for (const role of ROLES) expect(other.getObjectByName(role)!.quaternion.w, role).toBe(1);
  });

  it("may begin with the root itself", () => {
    const hips = rig.getObjectByName("hips")!;
    play(hips, lastTime);
    expect(deviation(rig, poseOf(animation, 60)).metres).toBeLessThan(1e-4);
  });

  it("are missed by name", () => {
    const make = () => toAnimationClip(THREE, rig, animation);
    rig.getObjectByName("left_hand")!.name = "LeftHand";
    expect(make).toThrow(new MissingJointError("left_hand"));
    expect(make).toThrow("The rig's node “left_lower_arm” has no node “left_hand” below it.");
    rig.getObjectByName("hips")!.name = "Armature";
    expect(make).toThrow("The rig has no node “hips” below it.");
  });
});
