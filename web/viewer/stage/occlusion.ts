/**
 * Ambient occlusion of the ground by a body, in closed form: the body is a set of spheres, each of which hides a part
 * of the sky (Quílez, "Sphere ambient occlusion"). The result is that of a dome of lights, without noise, blur or extra
 * passes.
 */

import { Vector4 } from "three";
import { JOINT, type Role, type WorldPose } from "../../humanoid";

/** A sphere between two joints: relative position between them, radius in metres at the mannequin's own stature. */
type Ball = readonly [from: Role, to: Role, share: number, radius: number];

const side = (s: "left" | "right"): Ball[] => [
  [`${s}_foot`, `${s}_toes`, 0, 0.045],
  [`${s}_foot`, `${s}_toes`, 0.55, 0.044],
  [`${s}_foot`, `${s}_toes`, 1, 0.036],
  [`${s}_foot`, `${s}_toes`, 1.35, 0.03],
  [`${s}_lower_leg`, `${s}_foot`, 0.7, 0.042],
  [`${s}_lower_leg`, `${s}_foot`, 0.35, 0.055],
  [`${s}_upper_leg`, `${s}_lower_leg`, 0.75, 0.058],
  [`${s}_upper_leg`, `${s}_lower_leg`, 0.25, 0.078],
  [`${s}_lower_arm`, `${s}_hand`, 1.2, 0.045],
];
const BALLS: readonly Ball[] = [
  ["hips", "spine", 0, 0.13],
  ["chest", "neck", 0.3, 0.15],
  ["neck", "head", 1.8, 0.1],
  ...side("left"),
  ...side("right"),
];

/** Number of spheres. */
const OCCLUDERS = BALLS.length;

/** GLSL: the uniforms and `skyLeft(occluders, p)`, the share of the sky that is visible from the ground at p. */
export const OCCLUSION_SHADER = /* glsl */ `
uniform vec4 bodyOccluders[${OCCLUDERS}];
uniform vec4 ghostOccluders[${OCCLUDERS}];
float skyLeft(vec4 occluders[${OCCLUDERS}], vec3 p) {
  float open = 1.0;
  for (int i = 0; i < ${OCCLUDERS}; i++) {
    vec3 d = occluders[i].xyz - p;
    float radius2 = occluders[i].w * occluders[i].w;
    float distance2 = max(dot(d, d), radius2 + 1e-6);
    open *= 1.0 - max(d.y, 0.0) * inversesqrt(distance2) * radius2 / distance2;
  }
  return open;
}`;

/** A new value of one of the uniforms, in which no sphere hides anything. */
export function createOccluders(): Vector4[] {
  return BALLS.map(() => new Vector4());
}

/** Places the spheres on a body of the given stature (ratio of leg lengths to the mannequin's own). */
export function placeOccluders(occluders: readonly Vector4[], world: WorldPose, stature: number): void {
  const p = world.positions;
  for (const [i, [from, to, share, radius]] of BALLS.entries()) {
    const a = 3 * JOINT[from];
    const b = 3 * JOINT[to];
    const at = (axis: number) => p[a + axis]! + share * (p[b + axis]! - p[a + axis]!);
    occluders[i]!.set(at(0), at(1), at(2), radius * stature);
  }
}

/** Makes all spheres vanish. */
export function hideOccluders(occluders: readonly Vector4[]): void {
  for (const occluder of occluders) occluder.set(0, 0, 0, 0);
}
