/** One mannequin on the stage: a skinned mesh that takes poses. */

import { DetachedBindMode, Group, type Material, Matrix4, SkinnedMesh } from "three";
import { DEFAULT_PROPORTIONS, restPose, type WorldPose } from "../humanoid";
import { type Fit, fitTo } from "./fit";
import { acquireGeometry, releaseGeometry } from "./geometry";
import { PoseSkeleton } from "./pose_skeleton";

/** One drawing of the mannequin's mesh. */
export interface Layer {
  /** One material for the whole body, or one a tone (shell, joints). */
  material: Material | readonly [shell: Material, joint: Material];
  /** three.js render order. */
  order: number;
  castShadow: boolean;
}

/**
 * A mannequin. Its geometry is shared by all; a pose costs forward kinematics and 47 matrices. The caller owns the
 * materials.
 */
export class Mannequin {
  /** To be put into a scene. */
  readonly object = new Group();
  readonly #skeleton = new PoseSkeleton();
  #fit: Fit = fitTo(DEFAULT_PROPORTIONS);
  #pose: Float32Array = restPose();

  constructor(layers: readonly Layer[]) {
    const geometry = acquireGeometry();
    for (const { material, order, castShadow } of layers) {
      const materials = Array.isArray(material) ? [...material] : (material as Material);
      const mesh = new SkinnedMesh(geometry, materials);
      mesh.bindMode = DetachedBindMode;
      mesh.bind(this.#skeleton, new Matrix4());
      mesh.renderOrder = order;
      mesh.castShadow = castShadow;
      mesh.receiveShadow = castShadow;
      // The mesh's own bounds know nothing of the pose.
      mesh.frustumCulled = false;
      this.object.add(mesh);
    }
    this.setPose(this.#pose);
  }

  /** Joints of the last pose in the world. */
  get world(): WorldPose {
    return this.#skeleton.world;
  }

  /** The last pose. */
  get pose(): Readonly<Float32Array> {
    return this.#pose;
  }

  /** How the body was fitted to its proportions. */
  get fit(): Fit {
    return this.#fit;
  }

  /** Takes bone offsets, 21 × xyz in metres (see `fit.ts` for what follows them). */
  setProportions(proportions: ArrayLike<number>): void {
    this.#fit = fitTo(proportions);
    this.setPose(this.#pose);
  }

  /** Takes a pose of `POSE_FLOATS` numbers; it is copied. */
  setPose(pose: ArrayLike<number>): void {
    if (pose !== this.#pose) this.#pose.set(pose);
    this.#skeleton.setPose(this.#fit, this.#pose);
  }

  /** Frees what is this mannequin's own. */
  dispose(): void {
    this.object.removeFromParent();
    this.object.clear();
    this.#skeleton.dispose();
    releaseGeometry();
  }
}
