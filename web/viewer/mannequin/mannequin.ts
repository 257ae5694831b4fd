/** One mannequin on the stage: a mesh that is posed. */

import { Group, Mesh } from "three";
import { DEFAULT_PROPORTIONS, restPose, type WorldPose } from "../../humanoid";
import { type Fit, fitTo } from "../../mannequin/fit";
import { SlotRows } from "../../mannequin/slot_rows";
import { CASTER_LAYER } from "../light/layers";
import { acquireGeometry, releaseGeometry } from "./geometry";
import type { Look } from "./materials";
import type { SlotUniforms } from "./slot_skinning";

/**
 * A mannequin. All mannequins share the geometry. A pose costs forward kinematics and one affine transform per slot.
 *
 * @typeParam L - The look, which draws it.
 */
export class Mannequin<L extends Look> {
  /** The object to add to a scene. */
  readonly object = new Group();
  readonly look: L;
  readonly #rows = new SlotRows();
  readonly #pose: Float32Array = restPose();
  #fit: Fit = fitTo(DEFAULT_PROPORTIONS);
  #proportions: ArrayLike<number> = DEFAULT_PROPORTIONS;
  #detail: number;

  /** `look` makes the materials from the mannequin's uniforms; `detail` is that of the geometry, at most 1. */
  constructor(look: (uniforms: SlotUniforms) => L, detail = 1) {
    this.look = look({ slotRows: { value: this.#rows.values } });
    this.#detail = detail;
    const geometry = acquireGeometry(detail);
    for (const { material, order, shadow, receivesShadow } of this.look.layers) {
      const mesh = new Mesh(geometry, material);
      mesh.renderOrder = order;
      mesh.castShadow = shadow !== undefined;
      mesh.receiveShadow = receivesShadow;
      if (shadow) {
        mesh.customDepthMaterial = shadow;
        mesh.layers.enable(CASTER_LAYER);
      }
      // The geometry's bounds are those of the rest pose.
      mesh.frustumCulled = false;
      this.object.add(mesh);
    }
    this.setPose(this.#pose);
  }

  /** Joints of the last pose in the world. */
  get world(): WorldPose {
    return this.#rows.world;
  }

  /** The last pose. */
  get pose(): Readonly<Float32Array> {
    return this.#pose;
  }

  /** The bone offsets that were set. */
  get proportions(): ArrayLike<number> {
    return this.#proportions;
  }

  /** The fit of the body to its proportions. */
  get fit(): Fit {
    return this.#fit;
  }

  /** Changes the detail of the geometry, at most 1, and applies the look's current materials. */
  setDetail(detail: number): void {
    const geometry = acquireGeometry(detail);
    for (const [i, { material, receivesShadow }] of this.look.layers.entries()) {
      const mesh = this.object.children[i] as Mesh;
      mesh.geometry = geometry;
      mesh.material = material;
      mesh.receiveShadow = receivesShadow;
    }
    releaseGeometry(this.#detail);
    this.#detail = detail;
  }

  /** Sets bone offsets, 21 × xyz in metres (see `web/mannequin/fit.ts` for the effects). */
  setProportions(proportions: ArrayLike<number>): void {
    this.#proportions = proportions;
    this.#fit = fitTo(proportions);
    this.setPose(this.#pose);
  }

  /** Sets a pose of `POSE_FLOATS` numbers; it is copied. */
  setPose(pose: ArrayLike<number>): void {
    if (pose !== this.#pose) this.#pose.set(pose);
    this.#rows.setPose(this.#fit, this.#pose);
  }

  /** Frees the materials and this mannequin's share of the geometry. */
  dispose(): void {
    this.object.removeFromParent();
    this.object.clear();
    this.look.dispose();
    releaseGeometry(this.#detail);
  }
}
