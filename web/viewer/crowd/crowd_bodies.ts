/** The bodies of a crowd: one instanced mesh for each level of detail, posed in the vertex shader, and their shadows. */

import {
  BufferAttribute,
  Color,
  Group,
  InstancedBufferAttribute,
  InstancedBufferGeometry,
  type IUniform,
  type Material,
  Mesh,
  MeshLambertMaterial,
  MeshStandardMaterial,
} from "three";
import type { Fit } from "../../mannequin/fit";
import { restJoints, type SkinnedBody, skinnedBody } from "../../mannequin/skinned_body";
import type { Shading } from "../light/shading";
import { editShader } from "../mannequin/shader_edit";
import type { Theme } from "../themes";
import { CROWD_SHADER, type CrowdUniforms, type JointTextures } from "./joint_textures";
import { BODIES, type Body, type BodyLevels } from "./levels";

/** Detail of the mannequin's mesh used as the middle body. */
const MIDDLE_DETAIL = 0.25;
/** Share of their colour with which dark parts glow without the reflections of the room. */
const MATT_SHEEN = 0.1;

/** Colours of the two tones. */
interface ToneUniforms {
  [name: string]: IUniform;
  shell: IUniform<Color>;
  joint: IUniform<Color>;
}

export class CrowdBodies {
  readonly object = new Group();
  readonly #textures: JointTextures;
  readonly #tones: ToneUniforms = { shell: { value: new Color() }, joint: { value: new Color() } };
  readonly #meshes: Record<Body, Mesh<InstancedBufferGeometry>>;
  readonly #materials = new Map<Shading, Material>();
  #fit: Fit;
  #nearDetail: number;
  /** Number of walkers for which the meshes have room; −1 before allocation. */
  #capacity = -1;

  constructor(textures: JointTextures, fit: Fit, far: SkinnedBody, detail: number, shading: Shading) {
    this.#textures = textures;
    this.#fit = fit;
    this.#nearDetail = detail;
    const material = this.#material(shading);
    const mesh = () => {
      const made = new Mesh(new InstancedBufferGeometry(), material);
      // Walkers outside the view are not among the instances.
      made.frustumCulled = false;
      this.object.add(made);
      return made;
    };
    this.#meshes = { near: mesh(), middle: mesh(), far: mesh() };
    this.setBody(fit, far);
  }

  /** Sets the fit of all walkers to their bones, and the body of distant walkers. */
  setBody(fit: Fit, far: SkinnedBody): void {
    this.#fit = fit;
    this.#textures.setRest(restJoints(fit));
    fill(this.#meshes.middle.geometry, skinnedBody(fit, MIDDLE_DETAIL));
    fill(this.#meshes.far.geometry, far);
    this.#buildNear();
  }

  /** Sets the detail of the nearest bodies, at most 1, and the shading of all. */
  setQuality(detail: number, shading: Shading): void {
    for (const body of BODIES) this.#meshes[body].material = this.#material(shading);
    if (detail === this.#nearDetail) return;
    this.#nearDetail = detail;
    this.#buildNear();
  }

  /** Sets the theme's colours. */
  setTheme({ shell, joint }: Theme): void {
    this.#tones.shell.value.set(shell);
    this.#tones.joint.value.set(joint);
  }

  /** Sets which walker has which body. */
  arrange(levels: BodyLevels): void {
    const count = levels.walkers.far.length;
    if (count !== this.#capacity) {
      this.#capacity = count;
      for (const body of BODIES) this.#meshes[body].geometry.setAttribute("walker", walkerAttribute(count));
    }
    for (const body of BODIES) {
      const { geometry } = this.#meshes[body];
      const walkers = geometry.getAttribute("walker") as InstancedBufferAttribute;
      const worn = levels.counts[body];
      (walkers.array as Uint16Array).set(levels.walkers[body]);
      walkers.clearUpdateRanges();
      walkers.addUpdateRange(0, worn);
      walkers.needsUpdate = true;
      geometry.instanceCount = worn;
      this.#meshes[body].visible = worn > 0;
    }
  }

  dispose(): void {
    this.object.removeFromParent();
    for (const body of BODIES) this.#meshes[body].geometry.dispose();
    for (const material of this.#materials.values()) material.dispose();
  }

  #buildNear(): void {
    fill(this.#meshes.near.geometry, skinnedBody(this.#fit, this.#nearDetail));
    this.#capacity = -1;
  }

  /** The material for a shading; made on first use, since compiling it is slow. */
  #material(shading: Shading): Material {
    const made = this.#materials.get(shading);
    if (made) return made;
    const material = shading === "physical" ? new MeshStandardMaterial({ roughness: 0.55 }) : new MeshLambertMaterial();
    dress(material, this.#textures.uniforms, this.#tones, shading);
    this.#materials.set(shading, material);
    return material;
  }
}

/** Indices of the walkers that are drawn. */
export function walkerAttribute(count: number): InstancedBufferAttribute {
  return new InstancedBufferAttribute(new Uint16Array(Math.max(1, count)), 1);
}

/** Sets the vertices of a body. */
export function fill(geometry: InstancedBufferGeometry, body: SkinnedBody): void {
  // GPU buffers are created again.
  geometry.dispose();
  geometry.setAttribute("position", new BufferAttribute(body.positions, 3));
  geometry.setAttribute("normal", new BufferAttribute(body.normals, 3));
  geometry.setAttribute("joints", new BufferAttribute(body.joints, 2));
  geometry.setAttribute("blend", new BufferAttribute(body.blends, 1));
  geometry.setAttribute("tone", new BufferAttribute(body.tones, 1));
  geometry.setIndex(new BufferAttribute(body.indices, 1));
  geometry.instanceCount = 0;
}

/** Patches one of three.js's own materials to pose and tint each walker. */
function dress(material: Material, crowd: CrowdUniforms, tones: ToneUniforms, shading: Shading): void {
  editShader(material, { ...crowd, ...tones }, (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace(
        "void main() {",
        `${CROWD_SHADER}
attribute float tone;
uniform sampler2D tints;
uniform vec3 shell;
uniform vec3 joint;
varying vec3 vCoat;
varying float vTone;
void main() {
  lookUpTurns();
  vec4 tint = texelFetch(tints, ivec2(int(walker + 0.5), 0), 0);
  vCoat = mix(mix(shell, joint, tone), tint.rgb * mix(1.0, 0.25, tone), tint.a);
  vTone = tone;`,
      )
      .replace("#include <beginnormal_vertex>", "vec3 objectNormal = crowdDirection(normal);")
      .replace("#include <begin_vertex>", "vec3 transformed = crowdPoint(position);");
    shader.fragmentShader = shader.fragmentShader
      .replace("void main() {", "varying vec3 vCoat;\nvarying float vTone;\nvoid main() {")
      .replace("#include <color_fragment>", "#include <color_fragment>\n  diffuseColor.rgb = vCoat;");
    if (shading === "matt")
      shader.fragmentShader = shader.fragmentShader.replace(
        "#include <emissivemap_fragment>",
        `totalEmissiveRadiance = vCoat * (${MATT_SHEEN.toFixed(2)} * vTone);`,
      );
  });
}
