/**
 * Crowd data for the shaders: the position of every joint in the last tick and in the current one, and the tint of
 * every walker.
 */

import {
  DataTexture,
  FloatType,
  type IUniform,
  RGBAFormat,
  SRGBColorSpace,
  type Texture,
  UnsignedByteType,
  Vector3,
} from "three";
import { CROWD_WALKER_FLOATS, JOINTS } from "../../humanoid";

/** Texels per walker: two per joint. */
const WALKER_TEXELS = 2 * JOINTS;

/** Uniforms of all materials that draw the crowd. */
export interface CrowdUniforms {
  [name: string]: IUniform;
  lastJoints: IUniform<Texture>;
  presentJoints: IUniform<Texture>;
  /** Interpolation of the picture between the last tick and the current one, 0–1. */
  share: IUniform<number>;
  /** Positions of the joints in the T-pose, metres. */
  restJoints: IUniform<Vector3[]>;
  /** Tint of every walker, sRGB, and its share of the colour. */
  tints: IUniform<Texture>;
}

/** GLSL: `jointPosition(joint)`, the world position of a joint of the instance's walker. */
export const PLACE_SHADER = /* glsl */ `
attribute float walker;
uniform highp sampler2D lastJoints;
uniform highp sampler2D presentJoints;
uniform float share;
vec3 jointPosition(int joint) {
  ivec2 at = ivec2(2 * joint, int(walker + 0.5));
  return mix(texelFetch(lastJoints, at, 0).xyz, texelFetch(presentJoints, at, 0).xyz, share);
}`;

/**
 * GLSL: `crowdPoint(p)` and `crowdDirection(n)`, from the T-pose to the world, for the instance's walker; call them
 * after `lookUpTurns()`.
 */
export const CROWD_SHADER = /* glsl */ `
${PLACE_SHADER}
attribute vec2 joints;
attribute float blend;
uniform vec3 restJoints[${JOINTS}];
vec4 firstTurn;
vec4 secondTurn;
vec3 turned(vec4 q, vec3 v) { return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v); }
vec4 jointRotation(int joint) {
  ivec2 at = ivec2(2 * joint + 1, int(walker + 0.5));
  vec4 last = texelFetch(lastJoints, at, 0);
  vec4 present = texelFetch(presentJoints, at, 0);
  return normalize(mix(last, dot(last, present) < 0.0 ? -present : present, share));
}
void lookUpTurns() {
  firstTurn = jointRotation(int(joints.x + 0.5));
  if (blend > 0.0) secondTurn = jointRotation(int(joints.y + 0.5));
}
vec3 byJoint(float number, vec4 turn, vec3 p) {
  int joint = int(number + 0.5);
  return jointPosition(joint) + turned(turn, p - restJoints[joint]);
}
vec3 crowdPoint(vec3 p) {
  vec3 point = byJoint(joints.x, firstTurn, p);
  return blend > 0.0 ? mix(point, byJoint(joints.y, secondTurn, p), blend) : point;
}
vec3 crowdDirection(vec3 n) {
  vec3 direction = turned(firstTurn, n);
  return blend > 0.0 ? normalize(mix(direction, turned(secondTurn, n), blend)) : direction;
}`;

/** The textures of one crowd. */
export class JointTextures {
  readonly uniforms: CrowdUniforms;
  #count = 0;

  constructor() {
    this.uniforms = {
      lastJoints: { value: jointTexture(1) },
      presentJoints: { value: jointTexture(1) },
      share: { value: 1 },
      restJoints: { value: Array.from({ length: JOINTS }, () => new Vector3()) },
      tints: { value: tintTexture(1) },
    };
  }

  /** Number of walkers. */
  get count(): number {
    return this.#count;
  }

  /** Sets the positions of the body's joints in the T-pose, 21 × xyz, metres. */
  setRest(joints: ArrayLike<number>): void {
    for (const [joint, point] of this.uniforms.restJoints.value.entries())
      point.fromArray(joints as number[], 3 * joint);
  }

  /**
   * Sets a tick: `CROWD_WALKER_FLOATS` numbers and four bytes of tint per walker. If the number of walkers has changed,
   * or they are other walkers, there is no interpolation from the last tick.
   */
  set(joints: Float32Array, tints: Uint8Array, isOther: boolean): void {
    const count = joints.length / CROWD_WALKER_FLOATS;
    const { lastJoints, presentJoints } = this.uniforms;
    if (count !== this.#count) {
      this.dispose();
      this.#count = count;
      lastJoints.value = jointTexture(count);
      presentJoints.value = jointTexture(count);
      this.uniforms.tints.value = tintTexture(count);
      isOther = true;
    }
    [lastJoints.value, presentJoints.value] = [presentJoints.value, lastJoints.value];
    upload(presentJoints.value, joints);
    if (isOther) upload(lastJoints.value, joints);
    upload(this.uniforms.tints.value, tints);
  }

  dispose(): void {
    for (const name of ["lastJoints", "presentJoints", "tints"] as const) this.uniforms[name].value.dispose();
  }
}

function upload(texture: Texture, numbers: Float32Array | Uint8Array): void {
  (texture.image as { data: Float32Array | Uint8Array }).data.set(numbers);
  texture.needsUpdate = true;
}

function jointTexture(count: number): DataTexture {
  return new DataTexture(new Float32Array(count * CROWD_WALKER_FLOATS), WALKER_TEXELS, count, RGBAFormat, FloatType);
}

function tintTexture(count: number): DataTexture {
  const texture = new DataTexture(new Uint8Array(4 * count), count, 1, RGBAFormat, UnsignedByteType);
  texture.colorSpace = SRGBColorSpace;
  return texture;
}
