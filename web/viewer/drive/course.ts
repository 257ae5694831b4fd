/** Steering of a driven character on the ground: the path drawn for it, and the next second as asked for and as in its clip. */

import { CircleGeometry, Group, Mesh, MeshBasicMaterial, RingGeometry, Shape, ShapeGeometry } from "three";
import { Ribbon } from "../stage/hips_path";
import type { Theme } from "../themes";

/** Maximum number of points of a displayed path; a longer path is simplified. */
const POINTS = 512;
/** Length of a dash and of a gap of the path, metres. */
const DASH = 0.09;
const OPACITY = { line: 0.75, done: 0.18 };
/**
 * If the distance of the next second is shorter than this, it is not marked, metres: the marks would be hidden under
 * the feet.
 */
const SHORT = 0.25;
/** The arrow that is dragged to turn: its distance in front of the character, and half its width, metres. */
const FACING = { ahead: 0.62, width: 0.075 };
/** The arrow's arc about the character, visible on both sides of the legs: half its angle, radians, and its width. */
const ARC = { half: 0.8, width: 0.018 };
/** Number of marked instants: 1/3, 2/3 and 1 s. */
const INSTANTS = 3;
/** Heights above the ground, metres: the steering's marks are over the clip's, and both over the path. */
const HEIGHTS = { line: 0.002, clip: 0.003, asked: 0.004 };

/** A mark of a position on the ground and its heading. */
class Marker {
  readonly object = new Group();

  constructor(material: MeshBasicMaterial, size: number, height: number) {
    const dot = new Mesh(new CircleGeometry(size, 24), material);
    const head = new Shape();
    head.moveTo(-0.55 * size, 1.35 * size).lineTo(0.55 * size, 1.35 * size);
    head.lineTo(0, 3.1 * size).closePath();
    const arrow = new Mesh(new ShapeGeometry(head), material);
    // Shapes lie in the plane of x and y; a heading of 0 is along +Z.
    for (const mesh of [dot, arrow]) {
      mesh.rotation.x = Math.PI / 2;
      mesh.renderOrder = -1;
      this.object.add(mesh);
    }
    this.object.position.y = height;
    this.object.visible = false;
  }

  dispose(): void {
    for (const mesh of this.object.children) (mesh as Mesh).geometry.dispose();
  }
}

/** One marker per instant, in one colour. */
class Markers {
  readonly object = new Group();
  readonly #material = new MeshBasicMaterial({ transparent: true, depthWrite: false, side: 2, toneMapped: false });
  readonly #markers: Marker[];

  constructor(size: number, height: number) {
    this.#markers = Array.from({ length: INSTANTS }, () => new Marker(this.#material, size, height));
    this.object.add(...this.#markers.map(({ object }) => object));
  }

  set colour(colour: string) {
    this.#material.color.set(colour);
  }

  /** Shows marks at positions, x, z and heading each, of a character at (x, z). */
  show(places: ArrayLike<number>, x: number, z: number): void {
    const last = 3 * (INSTANTS - 1);
    const isWay = Math.hypot(places[last]! - x, places[last + 1]! - z) > SHORT;
    for (const [i, { object }] of this.#markers.entries()) {
      object.visible = isWay;
      object.position.x = places[3 * i]!;
      object.position.z = places[3 * i + 1]!;
      object.rotation.y = places[3 * i + 2]!;
    }
  }

  dispose(): void {
    for (const marker of this.#markers) marker.dispose();
    this.#material.dispose();
  }
}

export class Course {
  readonly object = new Group();
  readonly #line = new Ribbon(DASH, POINTS);
  readonly #asked = new Markers(0.045, HEIGHTS.asked);
  readonly #clip = new Markers(0.032, HEIGHTS.clip);
  readonly #facing = new Group();
  readonly #arrow: Mesh<ShapeGeometry, MeshBasicMaterial>;
  readonly #arc: Mesh<RingGeometry, MeshBasicMaterial>;
  readonly #points = new Float32Array(4 * POINTS);
  #count = 0;

  constructor() {
    this.#line.mesh.position.y = HEIGHTS.line;
    const head = new Shape();
    head
      .moveTo(-FACING.width, 0)
      .lineTo(FACING.width, 0)
      .lineTo(0, 1.6 * FACING.width)
      .closePath();
    const material = new MeshBasicMaterial({ transparent: true, depthWrite: false, side: 2, toneMapped: false });
    this.#arrow = new Mesh(new ShapeGeometry(head), material);
    this.#arrow.rotation.x = Math.PI / 2;
    this.#arrow.position.set(0, HEIGHTS.asked, FACING.ahead);
    this.#arrow.renderOrder = -1;
    this.#arc = new Mesh(
      new RingGeometry(FACING.ahead - ARC.width, FACING.ahead, 32, 1, Math.PI / 2 - ARC.half, 2 * ARC.half),
      material,
    );
    this.#arc.rotation.x = Math.PI / 2;
    this.#arc.position.y = HEIGHTS.asked;
    this.#arc.renderOrder = -1;
    this.#facing.add(this.#arrow, this.#arc);
    this.#facing.visible = false;
    this.object.add(this.#line.mesh, this.#clip.object, this.#asked.object, this.#facing);
  }

  setTheme({ signal, input, ink }: Theme): void {
    this.#line.setColour(ink);
    this.#asked.colour = signal;
    this.#arrow.material.color.set(signal);
    this.#clip.colour = input;
  }

  /** Sets the path to follow, x and z of its points; empty for none. */
  set line(points: ArrayLike<number>) {
    const all = points.length / 2;
    this.#count = Math.min(all, POINTS);
    let along = 0;
    for (let i = 0; i < this.#count; i++) {
      const from = Math.round((i * (all - 1)) / Math.max(1, this.#count - 1));
      const [x, z] = [points[2 * from]!, points[2 * from + 1]!];
      if (i > 0) along += Math.hypot(x - this.#points[4 * i - 4]!, z - this.#points[4 * i - 3]!);
      this.#points.set([x, z, OPACITY.line, along], 4 * i);
    }
    this.#line.set(this.#points, this.#count);
  }

  /** Length of the completed part of the path, metres; it is drawn fainter. */
  set progress(done: number) {
    for (let i = 0; i < this.#count; i++)
      this.#points[4 * i + 2] = this.#points[4 * i + 3]! < done ? OPACITY.done : OPACITY.line;
    this.#line.set(this.#points, this.#count);
  }

  /** Marks the next second of a character whose root is at (x, z): as asked for, and as in the clip. */
  show(asked: ArrayLike<number>, clip: ArrayLike<number>, x: number, z: number): void {
    this.#asked.show(asked, x, z);
    this.#clip.show(clip, x, z);
  }

  /** Shows the arrow in front of a character at (x, z) that faces `heading`, or hides it. */
  face(x: number, z: number, heading: number, isShown: boolean): void {
    this.#facing.visible = isShown;
    this.#facing.position.set(x, 0, z);
    this.#facing.rotation.y = heading;
  }

  /** Positions of the arrow and the ends of its arc on the ground; empty if it is hidden. */
  get arrow(): { x: number; z: number }[] {
    const { visible, position, rotation } = this.#facing;
    const at = (turn: number) => ({
      x: position.x + FACING.ahead * Math.sin(rotation.y + turn),
      z: position.z + FACING.ahead * Math.cos(rotation.y + turn),
    });
    return visible ? [0, ARC.half, -ARC.half].map(at) : [];
  }

  dispose(): void {
    this.object.removeFromParent();
    this.#line.dispose();
    this.#asked.dispose();
    this.#clip.dispose();
    this.#arrow.geometry.dispose();
    this.#arc.geometry.dispose();
    this.#arrow.material.dispose();
  }
}
