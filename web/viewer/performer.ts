/** A rigged character on the stage, replacing the mannequin. */
import { Box3, type Mesh, type Object3D } from "three";
import { createWorldPose, JOINT, POSE_FLOATS, restPose, type WorldPose, worldFromLocal } from "../humanoid";
import { fitTo } from "../mannequin/fit";
import { CASTER_LAYER } from "./light/layers";

/** An object that performs poses, such as `Character` of `web/character`. Its creator owns it. */
export interface Performer {
  /** The object to draw: metres, +Y up, on the ground. */
  readonly object: Object3D;
  /** Bone offsets of its own body, 21 × xyz, metres. */
  readonly proportions: ArrayLike<number>;
  /** Its current pose, `POSE_FLOATS` numbers on its own body. */
  readonly pose: ArrayLike<number>;
  /** Sets the body on which poses are defined. */
  setBody(proportions: ArrayLike<number>): void;
  apply(pose: ArrayLike<number>): void;
  /** Advances hair and clothes. */
  update(dtSecs: number): void;
  /** Brings hair and clothes to rest, as after a cut. */
  settle(): void;
}

/** Height of the mannequin, metres. */
const MANNEQUIN_HEIGHT = 1.75;
/** Scale limits: outside them a camera would see only a sole, or would be under the ground. */
const SCALE = { min: 0.2, max: 6 };

/** Joints at the lower ends of thighs and shins. */
const LEG_BONES = [JOINT.left_lower_leg, JOINT.left_foot, JOINT.right_lower_leg, JOINT.right_foot];

/** A performer with the body properties that the stage needs. */
export class Actor {
  readonly performer: Performer;
  readonly proportions: ArrayLike<number>;
  /** Its joints in the world. */
  readonly world: WorldPose = createWorldPose();
  /** Ratio of leg lengths to the mannequin's own. */
  readonly stature: number;
  /** Its height relative to the mannequin's. */
  readonly scale: number;
  /** Middle of the head above its joint, and the head's radius, metres. */
  readonly head: { rise: number; radius: number };
  readonly #pose = restPose();
  /** Ratio of its leg lengths to those of the body on which poses are defined. */
  #legs = 1;

  constructor(performer: Performer) {
    const { object, proportions } = performer;
    [this.performer, this.proportions] = [performer, proportions];
    this.stature = fitTo(proportions).stature;
    this.setBody(proportions);
    this.#pose[1] = proportions[1]!;
    this.perform(this.#pose);
    object.updateMatrixWorld(true);
    const height = new Box3().setFromObject(object).max.y;
    this.scale = Math.min(SCALE.max, Math.max(SCALE.min, height / MANNEQUIN_HEIGHT));
    const radius = Math.max(0, height - this.world.positions[3 * JOINT.head + 1]!) / 2;
    this.head = { rise: radius, radius };
    object.traverse((node) => {
      const mesh = node as Mesh;
      if (!mesh.isMesh) return;
      mesh.castShadow = true;
      mesh.receiveShadow = true;
      mesh.layers.enable(CASTER_LAYER);
      // Skinned meshes leave the bounds of the pose in which they were modelled.
      mesh.frustumCulled = false;
    });
  }

  /** Sets the body on which poses are defined. */
  setBody(proportions: ArrayLike<number>): void {
    this.performer.setBody(proportions);
    this.#legs = legLength(this.proportions) / legLength(proportions);
  }

  /** Performs a pose of the body of {@link setBody}. */
  perform(pose: ArrayLike<number>): void {
    this.performer.apply(pose);
    worldFromLocal(this.proportions, this.performer.pose, this.world);
  }

  /** Poses whose hips travel over the ground as this body's do; the rest is as in `poses`. */
  travelling(poses: ArrayLike<number>): Float32Array {
    const own = Float32Array.from(poses);
    for (let i = 0; i < own.length; i += POSE_FLOATS) for (const axis of [0, 2]) own[i + axis]! *= this.#legs;
    return own;
  }

  /** The poses as this body performs them, a hundredth of a millisecond each. Afterwards it holds the last of them. */
  performed(poses: ArrayLike<number>): Float32Array {
    const own = new Float32Array(poses.length);
    const pose = this.#pose;
    for (let first = 0; first < own.length; first += POSE_FLOATS) {
      for (let i = 0; i < POSE_FLOATS; i++) pose[i] = poses[first + i]!;
      this.performer.apply(pose);
      own.set(this.performer.pose, first);
    }
    return own;
  }
}

/** Length of both legs, from hip to ankle. */
function legLength(proportions: ArrayLike<number>): number {
  const bones = LEG_BONES.map((joint) => Math.hypot(...[0, 1, 2].map((axis) => proportions[3 * joint + axis]!)));
  return bones.reduce((sum, length) => sum + length, 0);
}
