/** The shadows of a crowd on the ground: an outline of each near walker in the key light, and a soft spot under each walker. */

import {
  DoubleSide,
  EqualStencilFunc,
  Group,
  IncrementStencilOp,
  type InstancedBufferAttribute,
  InstancedBufferGeometry,
  type IUniform,
  Mesh,
  PlaneGeometry,
  ShaderMaterial,
  Vector3,
} from "three";
import { JOINT } from "../../humanoid";
import type { SkinnedBody } from "../../mannequin/skinned_body";
import type { Theme } from "../themes";
import { fill, walkerAttribute } from "./crowd_bodies";
import { CROWD_SHADER, type JointTextures, PLACE_SHADER } from "./joint_textures";
import { BODIES, type BodyLevels } from "./levels";

/** Height above the ground at which a body's shadow has faded out, because it is blurred there, metres. */
const BLURRED = 2.4;
/** Half the size of a soft spot, metres. */
const SPOT = 0.42;

const OUTLINE_VERTEX = /* glsl */ `
${CROWD_SHADER}
uniform vec3 toLight;
uniform float least;
varying float vShade;
void main() {
  lookUpTurns();
  vec3 point = crowdPoint(position);
  vShade = 1.0 - smoothstep(0.0, ${BLURRED.toFixed(1)}, point.y);
  point -= toLight * (max(point.y, 0.0) / toLight.y);
  gl_Position = projectionMatrix * viewMatrix * vec4(point.x, 0.002, point.z, 1.0);
  // Height of somebody there as a share of the picture's.
  float size = 0.85 * projectionMatrix[1][1] / gl_Position.w;
  vShade *= smoothstep(least, 1.6 * least, size);
}`;

const OUTLINE_FRAGMENT = /* glsl */ `
uniform float darkness;
varying float vShade;
void main() { gl_FragColor = vec4(0.0, 0.0, 0.0, darkness * vShade); }`;

const SPOT_VERTEX = /* glsl */ `
${PLACE_SHADER}
varying vec2 vUv;
void main() {
  vec3 hips = jointPosition(${JOINT.hips});
  vUv = position.xz;
  vec2 place = hips.xz + ${SPOT.toFixed(2)} * position.xz;
  gl_Position = projectionMatrix * viewMatrix * vec4(place.x, 0.001, place.y, 1.0);
}`;

const SPOT_FRAGMENT = /* glsl */ `
uniform float darkness;
varying vec2 vUv;
void main() {
  float near = max(0.0, 1.0 - length(vUv));
  gl_FragColor = vec4(0.0, 0.0, 0.0, darkness * near * near);
}`;

export class CrowdShadows {
  readonly object = new Group();
  readonly #outlines: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  readonly #spots: Mesh<InstancedBufferGeometry, ShaderMaterial>;
  readonly #outline: { toLight: IUniform<Vector3>; darkness: IUniform<number>; least: IUniform<number> };
  readonly #spot = { darkness: { value: 0 } };

  constructor(textures: JointTextures, body: SkinnedBody) {
    this.#outline = { toLight: { value: new Vector3(0, 1, 0) }, darkness: { value: 0 }, least: { value: 0 } };
    const shared = { transparent: true, depthWrite: false };
    const { uniforms } = textures;
    this.#outlines = new Mesh(
      new InstancedBufferGeometry(),
      new ShaderMaterial({
        ...shared,
        vertexShader: OUTLINE_VERTEX,
        fragmentShader: OUTLINE_FRAGMENT,
        uniforms: { ...uniforms, ...this.#outline },
        // When flattened, inner faces may be on top. Overlapping shadows are as dark as a single one.
        side: DoubleSide,
        stencilWrite: true,
        stencilFunc: EqualStencilFunc,
        stencilRef: 0,
        stencilZPass: IncrementStencilOp,
      }),
    );
    const square = new PlaneGeometry(2, 2).rotateX(-Math.PI / 2);
    const spots = new InstancedBufferGeometry();
    spots.setAttribute("position", square.getAttribute("position"));
    spots.setIndex(square.getIndex());
    this.#spots = new Mesh(
      spots,
      new ShaderMaterial({
        ...shared,
        vertexShader: SPOT_VERTEX,
        fragmentShader: SPOT_FRAGMENT,
        uniforms: { ...uniforms, ...this.#spot },
      }),
    );
    for (const [order, mesh] of [this.#spots, this.#outlines].entries()) {
      mesh.frustumCulled = false;
      mesh.renderOrder = -2 + order;
      this.object.add(mesh);
    }
    this.setBody(body);
  }

  /** Sets the body whose outline is drawn. */
  setBody(body: SkinnedBody): void {
    fill(this.#outlines.geometry, body);
  }

  /** Sets the theme's darkness. */
  setTheme({ shadow }: Theme): void {
    this.#outline.darkness.value = shadow.key * 0.8;
    this.#spot.darkness.value = shadow.occlusion * 0.55;
  }

  /**
   * Sets the visible walkers and the direction to the key light. Outlines are drawn for walkers taller than `least`, a
   * share of the picture's height; they fade in.
   */
  arrange(
    levels: BodyLevels,
    heights: ArrayLike<number>,
    pictureHeight: number,
    least: number,
    toLight: Vector3,
  ): void {
    this.#outline.toLight.value.copy(toLight);
    this.#outline.least.value = least;
    const { counts, walkers } = levels;
    const count = walkers.far.length;
    const [outlined, spotted] = [instances(this.#outlines, count), instances(this.#spots, count)];
    let [tall, all] = [0, 0];
    for (const body of BODIES)
      for (let i = 0; i < counts[body]; i++) {
        const walker = walkers[body][i]!;
        spotted[all++] = walker;
        if (heights[walker]! > least * pictureHeight) outlined[tall++] = walker;
      }
    this.#outlines.geometry.instanceCount = tall;
    this.#spots.geometry.instanceCount = all;
    for (const mesh of [this.#outlines, this.#spots]) mesh.visible = mesh.geometry.instanceCount > 0;
  }

  dispose(): void {
    this.object.removeFromParent();
    for (const mesh of [this.#outlines, this.#spots]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
  }
}

/** The array of the walker indices of a mesh, to be written. */
function instances({ geometry }: Mesh<InstancedBufferGeometry>, count: number): Uint16Array {
  if (geometry.getAttribute("walker")?.count !== Math.max(1, count))
    geometry.setAttribute("walker", walkerAttribute(count));
  const attribute = geometry.getAttribute("walker") as InstancedBufferAttribute;
  attribute.needsUpdate = true;
  return attribute.array as Uint16Array;
}
