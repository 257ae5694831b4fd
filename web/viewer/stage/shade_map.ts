/**
 * The shade on the ground, computed in the ground's own plane: one small texture around the characters, drawn before
 * the picture. Its cost does not depend on the size of the picture, and the noise of its samples is smoothed by
 * magnification.
 */

import {
  LinearFilter,
  Mesh,
  OrthographicCamera,
  PlaneGeometry,
  RGFormat,
  type Scene,
  ShadowMaterial,
  Vector2,
  type Vector3,
  type WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import type { WorldPose } from "../../humanoid";
import { SHADE_LAYER } from "../light/layers";
import { KEY_FRUSTUM } from "../light/lights";
import { type ShadowTaps, setShadowTaps, useSoftShadow } from "../light/soft_shadow";
import { createOccluders, hideOccluders, OCCLUSION_SHADER, placeOccluders } from "./occlusion";

/** Side of the shaded square, metres. */
export const SHADE_SIZE = 4.8;
/** Share of the sky that a ghost hides, compared with a body. */
const GHOST_SHARE = 0.6;
/** Height of the camera over the ground, metres. */
const ABOVE = 1;

/** Red: share of the key light that is blocked. Green: share of the sky that is hidden. */
export class ShadeMap {
  /** To be added to the scene; invisible except for the map. */
  readonly object: Mesh<PlaneGeometry, ShadowMaterial>;
  /** Middle of the square on the ground. */
  readonly centre = new Vector2();
  readonly #camera = new OrthographicCamera(-SHADE_SIZE / 2, SHADE_SIZE / 2, SHADE_SIZE / 2, -SHADE_SIZE / 2, 0.1, 2);
  readonly #target = new WebGLRenderTarget(1, 1, {
    format: RGFormat,
    minFilter: LinearFilter,
    magFilter: LinearFilter,
    depthBuffer: false,
    generateMipmaps: false,
  });
  readonly #body = createOccluders();
  readonly #ghost = createOccluders();

  constructor() {
    const material = new ShadowMaterial({ depthTest: false, depthWrite: false, transparent: false });
    useSoftShadow(material, KEY_FRUSTUM, (parameters) => {
      Object.assign(parameters.uniforms, {
        bodyOccluders: { value: this.#body },
        ghostOccluders: { value: this.#ghost },
      });
      parameters.vertexShader = parameters.vertexShader
        .replace("void main() {", "varying vec3 vWorld;\nvoid main() {")
        .replace("#include <worldpos_vertex>", "#include <worldpos_vertex>\n  vWorld = worldPosition.xyz;");
      parameters.fragmentShader = parameters.fragmentShader
        .replace("void main() {", `varying vec3 vWorld;\n${OCCLUSION_SHADER}\nvoid main() {`)
        .replace(
          /gl_FragColor = [\s\S]*\}/,
          `float open = skyLeft(bodyOccluders, vWorld) * mix(1.0, skyLeft(ghostOccluders, vWorld), ${GHOST_SHARE});
  gl_FragColor = vec4(1.0 - getShadowMask(), 1.0 - open, 0.0, 1.0);
}`,
        );
    });
    this.object = new Mesh(new PlaneGeometry(SHADE_SIZE, SHADE_SIZE).rotateX(-Math.PI / 2), material);
    this.object.receiveShadow = true;
    this.object.frustumCulled = false;
    this.object.layers.set(SHADE_LAYER);
    this.#camera.layers.set(SHADE_LAYER);
    // Looking down with −Z up, so that texture coordinates grow with x and fall with z.
    this.#camera.up.set(0, 0, -1);
  }

  /** The map. */
  get texture() {
    return this.#target.texture;
  }

  /** Side of the map in texels. */
  set resolution(texels: number) {
    this.#target.setSize(texels, texels);
  }

  /** Samples of the soft shadow. */
  set shadowTaps(taps: ShadowTaps) {
    setShadowTaps(this.object.material, taps);
  }

  /** Places the occluders of a character; `null` if it casts no shade. `stature` as in `fit.ts`. */
  setOccluder(who: "body" | "ghost", world: WorldPose | null, stature: number): void {
    const occluders = who === "body" ? this.#body : this.#ghost;
    if (world) placeOccluders(occluders, world, stature);
    else hideOccluders(occluders);
  }

  /** Draws the map around a point on the ground, and with it the light's shadow map. */
  render(renderer: WebGLRenderer, scene: Scene, centre: Vector3): void {
    this.centre.set(centre.x, centre.z);
    this.object.position.set(centre.x, 0, centre.z);
    this.object.updateMatrixWorld();
    this.#camera.position.set(centre.x, ABOVE, centre.z);
    this.#camera.lookAt(centre.x, 0, centre.z);
    renderer.setRenderTarget(this.#target);
    renderer.render(scene, this.#camera);
    renderer.setRenderTarget(null);
  }

  /** Compiles the materials of the map and of the light's shadow map, as they are in a scene. Resolves when it is done. */
  async compile(renderer: WebGLRenderer, scene: Scene): Promise<void> {
    renderer.setRenderTarget(this.#target);
    const compiling: Promise<unknown>[] = [renderer.compileAsync(this.object, this.#camera, scene)];
    scene.traverse((object) => {
      if (!(object instanceof Mesh) || !object.castShadow || !object.customDepthMaterial) return;
      const drawn = new Mesh(object.geometry, object.customDepthMaterial);
      compiling.push(renderer.compileAsync(drawn, this.#camera, scene));
    });
    renderer.setRenderTarget(null);
    await Promise.all(compiling);
  }

  dispose(): void {
    this.object.removeFromParent();
    this.object.geometry.dispose();
    this.object.material.dispose();
    this.#target.dispose();
  }
}
