/** The ground: an endless metric grid that fades, and shade under the bodies. It has no colour of its own. */

import {
  Color,
  Group,
  type IUniform,
  Mesh,
  PlaneGeometry,
  ShaderMaterial,
  type Texture,
  Vector2,
  type Vector3,
} from "three";
import type { Theme } from "../themes";
import { SHADE_SIZE } from "./shade_map";

/** Distance from the middle at which the grid has faded out, metres. */
const GRID_RADIUS = 6.5;

const WORLD_VERTEX = /* glsl */ `
varying vec3 vWorld;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vWorld = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

// Lines are one pixel wide everywhere, and fade before they alias.
const GRID_FRAGMENT = /* glsl */ `
uniform vec3 colour;
uniform vec2 centre;
uniform float major;
uniform float minor;
varying vec3 vWorld;
float lines(vec2 p, float width) {
  vec2 pixel = fwidth(p);
  vec2 distanceToLine = abs(fract(p - 0.5) - 0.5);
  vec2 line = clamp(0.5 + 0.5 * width - distanceToLine / pixel, 0.0, 1.0);
  line *= clamp(0.065 / pixel, 0.0, 1.0);
  return max(line.x, line.y);
}
void main() {
  float fade = pow(clamp(1.0 - length(vWorld.xz - centre) / ${GRID_RADIUS.toFixed(1)}, 0.0, 1.0), 1.6);
  gl_FragColor = vec4(colour, fade * max(lines(vWorld.xz, 1.2) * major, lines(vWorld.xz * 4.0, 1.0) * minor));
  #include <colorspace_fragment>
}`;

const SHADE_FRAGMENT = /* glsl */ `
uniform sampler2D map;
uniform vec2 centre;
uniform float key;
uniform float occlusion;
varying vec3 vWorld;
void main() {
  vec2 p = (vWorld.xz - centre) / ${SHADE_SIZE.toFixed(2)};
  vec2 blocked = texture2D(map, vec2(p.x, -p.y) + 0.5).rg;
  float light = (1.0 - key * blocked.r) * (1.0 - occlusion * blocked.g);
  gl_FragColor = vec4(0.0, 0.0, 0.0, (1.0 - light) * (1.0 - smoothstep(0.4, 0.5, length(p))));
}`;

/** Grid and shade. */
export class Ground {
  readonly object = new Group();
  readonly #grid: Mesh<PlaneGeometry, ShaderMaterial>;
  readonly #gridUniforms = {
    colour: { value: new Color() },
    centre: { value: new Vector2() },
    major: { value: 0 },
    minor: { value: 0 },
  };
  readonly #shade: Mesh<PlaneGeometry, ShaderMaterial>;
  readonly #shadeUniforms: { map: IUniform<Texture>; centre: IUniform<Vector2>; key: IUniform; occlusion: IUniform };

  /** `shade` is the map of {@link SHADE_SIZE} around `shadeCentre`. */
  constructor(shade: Texture, shadeCentre: Vector2) {
    this.#shadeUniforms = {
      map: { value: shade },
      centre: { value: shadeCentre },
      key: { value: 0 },
      occlusion: { value: 0 },
    };
    this.#grid = layer(2 * GRID_RADIUS, GRID_FRAGMENT, this.#gridUniforms, -3, 0.0005);
    this.#shade = layer(SHADE_SIZE, SHADE_FRAGMENT, this.#shadeUniforms, -2, 0);
    this.object.add(this.#grid, this.#shade);
  }

  /** Sets the theme's colours. */
  setTheme({ grid, shadow }: Theme): void {
    this.#gridUniforms.colour.value.set(grid.colour);
    this.#gridUniforms.major.value = grid.major;
    this.#gridUniforms.minor.value = grid.minor;
    this.#shadeUniforms.key.value = shadow.key;
    this.#shadeUniforms.occlusion.value = shadow.occlusion;
  }

  /** Moves the grid's middle to a point on the ground, and the shade to the position of its map. */
  follow(point: Vector3): void {
    this.#grid.position.set(point.x, this.#grid.position.y, point.z);
    this.#gridUniforms.centre.value.set(point.x, point.z);
    const { x, y: z } = this.#shadeUniforms.centre.value;
    this.#shade.position.set(x, this.#shade.position.y, z);
  }

  dispose(): void {
    this.object.removeFromParent();
    for (const mesh of [this.#grid, this.#shade]) {
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
  }
}

/** A transparent square on the ground. */
function layer(
  size: number,
  fragmentShader: string,
  uniforms: Record<string, IUniform>,
  order: number,
  height: number,
): Mesh<PlaneGeometry, ShaderMaterial> {
  const mesh = new Mesh(
    new PlaneGeometry(size, size).rotateX(-Math.PI / 2),
    new ShaderMaterial({ vertexShader: WORLD_VERTEX, fragmentShader, uniforms, transparent: true, depthWrite: false }),
  );
  mesh.position.y = height;
  mesh.renderOrder = order;
  mesh.frustumCulled = false;
  return mesh;
}
