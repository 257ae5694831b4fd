/** The ground of a crowd: a map of the styles in which agents walk at each place, and marks on it. */

import { Color, type IUniform, Mesh, PlaneGeometry, ShaderMaterial, Vector2, Vector3, Vector4 } from "three";
import type { Theme } from "../themes";

/** Maximum number of vertices of a field. */
const FIELD_VERTICES = 12;

/** A displayed vertex of a field. */
export interface FieldMark {
  x: number;
  z: number;
  /** Distance of its influence, metres. */
  reach: number;
  /** A CSS colour, not a variable. */
  colour: string;
  chosen: boolean;
}

/** Half the side of the ground, metres. */
const HALF = 60;
/** Distance between two lines of the grid, metres. */
const GRID = 2;
/** How strongly the field colours the ground. */
const COLOUR_OPACITY = 0.28;
/** Radius of a vertex's disc, metres. */
const DISC = 0.26;

const VERTEX = /* glsl */ `
varying vec3 vWorld;
void main() {
  vWorld = position;
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
}`;

/**
 * The fragment shader of a ground with `count` vertices. The shares are those of strut-core's field: φ = (reach² / (d²
 * + 0.25 m²))², φ / (1 + Σ φ). `pixel` is the size of a pixel on the ground, metres, so that all lines have the same
 * width. The isoline at one half is the border of the style. three.js unrolls the loops, so names need a block of their
 * own: without a GPU, looking up numbers by a variable takes most of the time.
 */
const fragment = (count: number) => /* glsl */ `
uniform vec4 marks[${FIELD_VERTICES}];
uniform vec3 colours[${FIELD_VERTICES}];
uniform vec3 grid;
uniform vec3 ink;
uniform vec3 signal;
uniform float gridOpacity;
uniform float radius;
uniform vec2 centre;
uniform vec3 walker;
varying vec3 vWorld;
float line(float value, float width, float pixel) {
  return clamp(0.5 + 0.5 * width - abs(value) / pixel, 0.0, 1.0);
}
vec4 over(vec4 above, vec4 below) {
  float alpha = above.a + below.a * (1.0 - above.a);
  return vec4(alpha > 0.0 ? (above.rgb * above.a + below.rgb * below.a * (1.0 - above.a)) / alpha : above.rgb, alpha);
}
void main() {
  vec2 p = vWorld.xz;
  vec2 pixel = fwidth(p);
  float edge = 0.7 * length(pixel) / ${DISC.toFixed(2)};
  float whole = 1.0;
  float felt[${FIELD_VERTICES}];
  #pragma unroll_loop_start
  for (int i = 0; i < ${count}; i++) {
    {
      vec2 d = p - marks[i].xy;
      float ratio = marks[i].z * marks[i].z / (dot(d, d) + 0.25);
      felt[i] = ratio * ratio;
      whole += felt[i];
    }
  }
  #pragma unroll_loop_end
  vec3 colour = vec3(0.0);
  float amount = 0.0;
  float isoline = 0.0;
  vec3 isocolour = vec3(0.0);
  vec4 discs = vec4(0.0);
  #pragma unroll_loop_start
  for (int i = 0; i < ${count}; i++) {
    {
      float share = felt[i] / whole;
      colour += share * colours[i];
      amount += share;
      float slope = fwidth(share);
      float quarter = max(0.4 * line(abs(share - 0.5) - 0.25, 1.0, slope), 0.75 * line(share - 0.5, 1.1, slope));
      if (quarter > isoline) { isoline = quarter; isocolour = colours[i]; }
      float d = length(p - marks[i].xy) / ${DISC.toFixed(2)};
      if (d < 1.75 + edge) {
        float halo = 1.0 - smoothstep(1.75 - edge, 1.75 + edge, d);
        float ring = 1.0 - smoothstep(1.25 - edge, 1.25 + edge, d);
        float disc = 1.0 - smoothstep(1.0 - edge, 1.0 + edge, d);
        discs = vec4(mix(colours[i], ink, disc), max(ring, (marks[i].w > 0.5 ? 0.5 : 0.26) * halo));
      }
    }
  }
  #pragma unroll_loop_end
  float fade = 1.0 - smoothstep(0.55 * radius, 1.7 * radius, length(p - centre));
  vec2 cell = pixel / ${GRID.toFixed(1)};
  vec2 near = abs(fract(p / ${GRID.toFixed(1)} - 0.5) - 0.5);
  vec2 lines = clamp(1.05 - near / cell, 0.0, 1.0) * clamp(0.1 / cell, 0.0, 1.0);
  vec4 result = vec4(grid, gridOpacity * max(lines.x, lines.y) * fade);
  result = over(vec4(colour / max(amount, 1e-4), ${COLOUR_OPACITY} * amount * fade), result);
  result = over(vec4(isocolour, isoline * fade), result);
  result = over(discs, result);
  if (walker.z > 0.0) {
    float d = length(p - walker.xy) - walker.z;
    result = over(vec4(signal, line(d, 3.0, 0.7 * length(pixel))), result);
  }
  gl_FragColor = result;
  #include <colorspace_fragment>
}`;

export class FieldGround {
  readonly object: Mesh<PlaneGeometry, ShaderMaterial>;
  /** Number of vertices of the program. */
  #count = 0;
  readonly #uniforms = {
    marks: { value: Array.from({ length: FIELD_VERTICES }, () => new Vector4()) },
    colours: { value: Array.from({ length: FIELD_VERTICES }, () => new Color()) },
    grid: { value: new Color() },
    ink: { value: new Color() },
    signal: { value: new Color() },
    gridOpacity: { value: 0 },
    radius: { value: 10 },
    centre: { value: new Vector2() },
    /** Position and radius of the ring around the selected walker; the radius is 0 without a selection. */
    walker: { value: new Vector3() },
  } satisfies Record<string, IUniform>;

  constructor() {
    this.object = new Mesh(
      new PlaneGeometry(2 * HALF, 2 * HALF).rotateX(-Math.PI / 2),
      new ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: fragment(0),
        uniforms: this.#uniforms,
        transparent: true,
        depthWrite: false,
      }),
    );
    this.object.renderOrder = -3;
    this.object.frustumCulled = false;
  }

  /**
   * Sets the field, at most {@link FIELD_VERTICES} vertices. Returns whether another program is needed, which must be
   * compiled.
   */
  setField(field: readonly FieldMark[]): boolean {
    const { marks, colours } = this.#uniforms;
    const drawn = field.slice(0, FIELD_VERTICES);
    for (const [i, { x, z, reach, colour, chosen }] of drawn.entries()) {
      marks.value[i]!.set(x, z, reach, chosen ? 1 : 0);
      colours.value[i]!.set(colour);
    }
    if (drawn.length === this.#count) return false;
    this.#count = drawn.length;
    this.object.material.fragmentShader = fragment(drawn.length);
    this.object.material.needsUpdate = true;
    return true;
  }

  /** Radius in which agents walk, metres: the ground fades beyond it. */
  set radius(radius: number) {
    this.#uniforms.radius.value = radius;
  }

  /** Draws a ring around a walker, or none. */
  setRing(ring: { x: number; z: number; radius: number } | undefined): void {
    this.#uniforms.walker.value.set(ring?.x ?? 0, ring?.z ?? 0, ring?.radius ?? 0);
  }

  /** Sets the theme's colours. */
  setTheme({ grid, ink, signal }: Theme): void {
    const uniforms = this.#uniforms;
    uniforms.grid.value.set(grid.colour);
    uniforms.gridOpacity.value = grid.major;
    uniforms.ink.value.set(ink);
    uniforms.signal.value.set(signal);
  }

  dispose(): void {
    this.object.removeFromParent();
    this.object.geometry.dispose();
    this.object.material.dispose();
  }
}
