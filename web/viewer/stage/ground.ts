/** The ground: an endless metric grid that fades, and shade under the bodies. It has no colour of its own. */

import {
  Color,
  Group,
  Mesh,
  PlaneGeometry,
  ShaderMaterial,
  ShadowMaterial,
  UniformsUtils,
  Vector2,
  type Vector3,
  type Vector4,
} from "three";
import type { WorldPose } from "../humanoid";
import type { Theme } from "../themes";
import { KEY_FRUSTUM } from "./lights";
import { createOccluders, OCCLUSION_SHADER, placeOccluders } from "./occlusion";
import { type ShadowTaps, setShadowTaps, useSoftShadow } from "./soft_shadow";

/** Distance from the middle at which the grid has faded out, metres. */
const GRID_RADIUS = 6.5;
/** Sides of the squares that shade is computed in, metres. */
const SHADE_SIZE = 3.4;

const WORLD_VERTEX = /* glsl */ `
varying vec3 vWorld;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

// Lines are as wide as a pixel wherever they are, and give way before they alias.
const GRID_FRAGMENT = /* glsl */ `
uniform vec3 colour;
uniform vec2 centre;
uniform float major;
uniform float minor;
varying vec3 vWorld;
float lines(vec2 p, float width) {
  vec2 pixel = fwidth(p);
  vec2 distanceToLine = abs(fract(p - 0.5) - 0.5);
  vec2 line = 1.0 - smoothstep(pixel * width * 0.5, pixel * (width * 0.5 + 1.0), distanceToLine);
  line *= clamp(0.065 / pixel, 0.0, 1.0);
  return max(line.x, line.y);
}
void main() {
  float fade = pow(clamp(1.0 - length(vWorld.xz - centre) / ${GRID_RADIUS.toFixed(1)}, 0.0, 1.0), 1.6);
  gl_FragColor = vec4(colour, fade * max(lines(vWorld.xz, 1.1) * major, lines(vWorld.xz * 4.0, 0.7) * minor));
  #include <colorspace_fragment>
}`;

const BLOB_FRAGMENT = /* glsl */ `
uniform float strength;
uniform vec2 centre;
varying vec3 vWorld;
${OCCLUSION_SHADER}
void main() {
  float edge = 1.0 - smoothstep(0.6, 1.0, length(vWorld.xz - centre) / ${(SHADE_SIZE / 2).toFixed(2)});
  gl_FragColor = vec4(vec3(0.0), strength * edge * bodyOcclusion(vWorld));
}`;

/** Grid, shadow of the character, contact shade of the ghost. */
export class Ground {
  readonly object = new Group();
  readonly #grid: Mesh<PlaneGeometry, ShaderMaterial>;
  readonly #shade: Mesh<PlaneGeometry, ShadowMaterial>;
  readonly #blob: Mesh<PlaneGeometry, ShaderMaterial>;
  readonly #shadeUniforms = {
    occluders: { value: createOccluders() },
    occlusion: { value: 0.5 },
    centre: { value: new Vector2() },
  };

  constructor() {
    this.#grid = new Mesh(
      new PlaneGeometry(2 * GRID_RADIUS, 2 * GRID_RADIUS).rotateX(-Math.PI / 2),
      new ShaderMaterial({
        vertexShader: WORLD_VERTEX,
        fragmentShader: GRID_FRAGMENT,
        uniforms: UniformsUtils.merge([
          {
            colour: { value: new Color() },
            centre: { value: new Vector2() },
            major: { value: 0 },
            minor: { value: 0 },
          },
        ]),
        transparent: true,
        depthWrite: false,
      }),
    );
    this.#grid.position.y = 0.0005;
    this.#grid.renderOrder = -3;

    const shadeGeometry = new PlaneGeometry(SHADE_SIZE, SHADE_SIZE).rotateX(-Math.PI / 2);
    const shadow = new ShadowMaterial({ depthWrite: false });
    useSoftShadow(shadow, KEY_FRUSTUM, (parameters) => {
      Object.assign(parameters.uniforms, this.#shadeUniforms);
      parameters.vertexShader = parameters.vertexShader
        .replace("void main() {", "varying vec3 vWorld;\nvoid main() {")
        .replace("#include <worldpos_vertex>", "#include <worldpos_vertex>\n  vWorld = worldPosition.xyz;");
      parameters.fragmentShader = parameters.fragmentShader
        .replace(
          "void main() {",
          `uniform float occlusion;\nuniform vec2 centre;\nvarying vec3 vWorld;\n${OCCLUSION_SHADER}\nvoid main() {`,
        )
        .replace(
          /gl_FragColor = [^;]*;/,
          `float edge = 1.0 - smoothstep(0.8, 1.0, length(vWorld.xz - centre) / ${(SHADE_SIZE / 2).toFixed(2)});
  float light = (1.0 - opacity * (1.0 - getShadowMask())) * (1.0 - occlusion * bodyOcclusion(vWorld));
  gl_FragColor = vec4(color, edge * (1.0 - light));`,
        );
    });
    this.#shade = new Mesh(shadeGeometry, shadow);
    this.#shade.receiveShadow = true;
    this.#shade.renderOrder = -2;

    this.#blob = new Mesh(
      shadeGeometry,
      new ShaderMaterial({
        vertexShader: WORLD_VERTEX,
        fragmentShader: BLOB_FRAGMENT,
        uniforms: {
          occluders: { value: createOccluders() },
          strength: { value: 0 },
          centre: { value: new Vector2() },
        },
        transparent: true,
        depthWrite: false,
      }),
    );
    this.#blob.position.y = 0.001;
    this.#blob.renderOrder = -2;
    this.object.add(this.#grid, this.#shade, this.#blob);
    for (const mesh of [this.#grid, this.#shade, this.#blob]) mesh.frustumCulled = false;
  }

  /** Takes the theme's colours. */
  setTheme({ grid, shadow }: Theme): void {
    const uniforms = this.#grid.material.uniforms as Record<string, { value: unknown }>;
    (uniforms.colour!.value as Color).set(grid.colour);
    uniforms.major!.value = grid.major;
    uniforms.minor!.value = grid.minor;
    this.#shade.material.color.set(0);
    this.#shade.material.opacity = shadow.key;
    this.#shadeUniforms.occlusion.value = shadow.occlusion;
    this.#blob.material.uniforms.strength!.value = shadow.occlusion * 0.6;
  }

  /** Samples of the soft shadow. */
  set shadowTaps(taps: ShadowTaps) {
    setShadowTaps(this.#shade.material, taps);
  }

  /** Moves the grid's middle to a point on the ground. */
  follow(point: Vector3): void {
    this.#grid.position.set(point.x, this.#grid.position.y, point.z);
    (this.#grid.material.uniforms.centre!.value as Vector2).set(point.x, point.z);
  }

  /** Shades the ground under the character. */
  shadeBody(world: WorldPose, stature: number): void {
    const [x, , z] = world.positions;
    this.#shade.position.set(x!, 0, z!);
    this.#shadeUniforms.centre.value.set(x!, z!);
    placeOccluders(this.#shadeUniforms.occluders.value, world, stature);
  }

  /** Shades the ground under the ghost; `null` if there is none. `fade` (0–1) scales the shade. */
  shadeGhost(world: WorldPose | null, stature: number): void {
    this.#blob.visible = world !== null;
    if (!world) return;
    const [x, , z] = world.positions;
    this.#blob.position.set(x!, this.#blob.position.y, z!);
    const uniforms = this.#blob.material.uniforms;
    (uniforms.centre!.value as Vector2).set(x!, z!);
    placeOccluders(uniforms.occluders!.value as Vector4[], world, stature);
  }

  dispose(): void {
    this.object.removeFromParent();
    for (const mesh of [this.#grid, this.#shade, this.#blob]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
  }
}
