/**
 * Ambient occlusion of the ground by a body, in closed form: the body as spheres, each taking its share of the sky
 * (Quílez, "Sphere ambient occlusion"). It gives what a dome of lights would, without noise, blur or passes.
 */

import { Vector4 } from "three";
import { JOINT, type Role, type WorldPose } from "../humanoid";

/** A sphere between two joints: share of the way, radius in metres at the mannequin's own stature. */
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
export const OCCLUDERS = BALLS.length;

/** GLSL: `bodyOcclusion(vec3 p)`, the share of the sky that the body hides from the ground at p, 0–1. */
export const OCCLUSION_SHADER = /* glsl */ `
uniform vec4 occluders[${OCCLUDERS}];
float bodyOcclusion(vec3 p) {
  float open = 1.0;
  for (int i = 0; i < ${OCCLUDERS}; i++) {
    vec3 d = occluders[i].xyz - p;
    float distance2 = max(dot(d, d), occluders[i].w * occluders[i].w);
    float up = max(d.y, 0.0) * inversesqrt(distance2);
    open *= 1.0 - up * occluders[i].w * occluders[i].w / distance2;
  }
  return 1.0 - open;
}`;

/** A fresh value of the uniform `occluders`. */
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
