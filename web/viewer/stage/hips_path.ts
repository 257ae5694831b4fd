/** The path of the hips over the ground: solid behind the character, dashed ahead of it. */

import { BufferAttribute, BufferGeometry, Color, DoubleSide, DynamicDrawUsage, Mesh, ShaderMaterial } from "three";
import { POSE_FLOATS } from "../../humanoid";
import type { Theme } from "../themes";

/** Points kept per half. */
const POINTS = 160;
/** Minimum distance between two kept points, metres. */
const SPACING = 0.03;
/** Length ahead that is drawn, metres. */
const AHEAD = 2.6;
/** Half width of the line, metres. */
const HALF_WIDTH = 0.006;
/** Length of a dash and of a gap, metres. */
export const DASH = 0.06;
const OPACITY = 0.42;

const VERTEX = /* glsl */ `
attribute vec2 stroke;
varying vec2 vStroke;
void main() {
  vStroke = stroke;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const FRAGMENT = /* glsl */ `
uniform vec3 colour;
uniform float dash;
varying vec2 vStroke;
void main() {
  if (dash > 0.0 && fract(vStroke.y / (2.0 * dash)) > 0.5) discard;
  gl_FragColor = vec4(colour, vStroke.x);
  #include <colorspace_fragment>
}`;

/** A ribbon on the ground through points that change every frame. */
export class Ribbon {
  readonly mesh: Mesh<BufferGeometry, ShaderMaterial>;
  readonly #positions: BufferAttribute;
  /** Opacity and distance along the ribbon. */
  readonly #strokes: BufferAttribute;

  /** @param points maximum number of points of the ribbon */
  constructor(dash: number, points = POINTS) {
    this.#positions = new BufferAttribute(new Float32Array(6 * points), 3).setUsage(DynamicDrawUsage);
    this.#strokes = new BufferAttribute(new Float32Array(4 * points), 2).setUsage(DynamicDrawUsage);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.#positions);
    geometry.setAttribute("stroke", this.#strokes);
    const indices: number[] = [];
    for (let i = 0; i < points - 1; i++) indices.push(2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 1, 2 * i + 3, 2 * i + 2);
    geometry.setIndex(indices);
    this.mesh = new Mesh(
      geometry,
      new ShaderMaterial({
        vertexShader: VERTEX,
        fragmentShader: FRAGMENT,
        uniforms: { colour: { value: new Color() }, dash: { value: dash } },
        transparent: true,
        depthWrite: false,
        side: DoubleSide,
      }),
    );
    this.mesh.position.y = 0.0015;
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -2;
  }

  setColour(colour: string): void {
    (this.mesh.material.uniforms.colour as { value: Color }).value.set(colour);
  }

  /** Sets `count` points as x, z, opacity, distance along the ribbon. */
  set(points: Float32Array, count: number): void {
    for (let i = 0; i < count; i++) {
      const a = 4 * Math.max(0, i - 1);
      const b = 4 * Math.min(count - 1, i + 1);
      const dx = points[b]! - points[a]!;
      const dz = points[b + 1]! - points[a + 1]!;
      const scale = HALF_WIDTH / (Math.hypot(dx, dz) || 1);
      const [x, z, opacity, along] = [points[4 * i]!, points[4 * i + 1]!, points[4 * i + 2]!, points[4 * i + 3]!];
      this.#positions.setXYZ(2 * i, x - dz * scale, 0, z + dx * scale);
      this.#positions.setXYZ(2 * i + 1, x + dz * scale, 0, z - dx * scale);
      this.#strokes.setXY(2 * i, opacity, along);
      this.#strokes.setXY(2 * i + 1, opacity, along);
    }
    this.mesh.geometry.setDrawRange(0, 6 * Math.max(0, count - 1));
    this.#positions.needsUpdate = true;
    this.#strokes.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    this.mesh.material.dispose();
  }
}

/** Both halves of the path. */
export class HipsPath {
  readonly behind = new Ribbon(0);
  readonly ahead = new Ribbon(DASH);
  /** Trail of the hips, x and z, oldest first. */
  readonly #trail: number[] = [];
  readonly #points = new Float32Array(4 * POINTS);
  #clip: Float32Array | null = null;
  /** Distance from the clip's start to each of its frames, metres. */
  #distances = new Float32Array(0);

  /** Sets the theme's colours. */
  setTheme({ mark }: Theme): void {
    for (const ribbon of [this.behind, this.ahead]) ribbon.setColour(mark);
  }

  /** Sets the poses of the whole clip, whose part ahead is drawn; `null` draws none. */
  setClip(poses: Float32Array | null): void {
    this.#clip = poses;
    const frames = poses ? Math.floor(poses.length / POSE_FLOATS) : 0;
    this.#distances = new Float32Array(frames);
    for (let frame = 1; frame < frames; frame++) {
      const [a, b] = [(frame - 1) * POSE_FLOATS, frame * POSE_FLOATS];
      this.#distances[frame] =
        this.#distances[frame - 1]! + Math.hypot(poses![b]! - poses![a]!, poses![b + 2]! - poses![a + 2]!);
    }
  }

  /** Adds the hips' current position to the trail. */
  push(x: number, z: number): void {
    const trail = this.#trail;
    const far = trail.length < 2 || Math.hypot(x - trail.at(-2)!, z - trail.at(-1)!) > SPACING;
    if (!far) return;
    trail.push(x, z);
    if (trail.length > 2 * (POINTS - 1)) trail.splice(0, 2);
  }

  /** Clears the trail. */
  clear(): void {
    this.#trail.length = 0;
  }

  /**
   * Draws both halves from the hips' current position. The clip's frame `frame` is placed there, rotated by `turn`
   * radians about +Y, because the character may have left the clip's own path.
   */
  draw(x: number, z: number, frame: number, turn: number): void {
    const points = this.#points;
    const count = this.#trail.length / 2;
    for (let i = 0; i < count; i++) {
      points.set([this.#trail[2 * i]!, this.#trail[2 * i + 1]!, OPACITY * Math.min(1, (i / count) * 1.6), 0], 4 * i);
    }
    if (count) points.set([x, z, OPACITY, 0], 4 * count);
    this.behind.set(points, count ? count + 1 : 0);
    this.ahead.set(points, this.#layAhead(x, z, frame, turn));
  }

  #layAhead(x: number, z: number, frame: number, turn: number): number {
    const clip = this.#clip;
    const frames = this.#distances.length;
    const first = Math.max(0, Math.floor(frame));
    if (!clip || first >= frames - 1) return 0;
    const points = this.#points;
    const share = Math.min(1, frame - first);
    const between = (values: ArrayLike<number>, stride: number, offset: number) => {
      const a = values[first * stride + offset]!;
      return a + (values[(first + 1) * stride + offset]! - a) * share;
    };
    const x0 = between(clip, POSE_FLOATS, 0);
    const z0 = between(clip, POSE_FLOATS, 2);
    const start = between(this.#distances, 1, 0);
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    points.set([x, z, OPACITY, start], 0);
    let count = 1;
    let last = start;
    for (let f = first + 1; f < frames && count < POINTS && last < start + AHEAD; f++) {
      const along = this.#distances[f]!;
      if (along - last < SPACING) continue;
      const dx = clip[f * POSE_FLOATS]! - x0;
      const dz = clip[f * POSE_FLOATS + 2]! - z0;
      const fade = Math.max(0, 1 - (along - start) / AHEAD);
      points.set([x + c * dx + s * dz, z - s * dx + c * dz, OPACITY * Math.min(1, fade * 1.6), along], 4 * count++);
      last = along;
    }
    return count;
  }

  dispose(): void {
    this.behind.dispose();
    this.ahead.dispose();
  }
}
