/**
 * Film strips of every rig, for visual inspection: `tests/output/characters_<style>_<view>.png`. One row per rig, the
 * input's own body first; left limbs are red, right ones blue. Drawn without a browser, in a second.
 */
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { crc32, deflateSync } from "node:zlib";
import { type Object3D, type SkinnedMesh, Vector3 } from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { beforeAll, expect, test } from "vitest";
import { bindCharacter } from "../../web/character/character";
import type { Character } from "../../web/character/types";
import { JOINT, POSE_FLOATS, type Role } from "../../web/humanoid";
import { root } from "../recordings";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";
import { type Performance, performances } from "./performance";

const [COLUMNS, WIDTH, HEIGHT] = [10, 120, 150];
/** Number of frames between two pictures of a strip. */
const EVERY = 8;
/** First frame of the strips. */
const FIRST = 60;
const [RED, BLUE, GREY] = [
  [214, 84, 60],
  [60, 110, 200],
  [170, 170, 165],
] as const;
const PAPER = 250;
const GROUND = 20;

interface Actor {
  name: string;
  character: Character;
  meshes: { mesh: SkinnedMesh; colours: (readonly [number, number, number])[] }[];
  /** Pixels per metre. */
  zoom: number;
}

let actors: Actor[];
let walks: Performance[];

beforeAll(async () => {
  walks = (await performances()).filter(({ name }) => /^neutral walk, /.test(name) && !/punch/.test(name));
  const plain = { ...FAMILIES.at(-1)!, name: "input", size: 1, shape: {} };
  actors = await Promise.all(
    [plain, ...FAMILIES].map(async (family) => {
      const rig = makeRig(family);
      const character = await bindCharacter(await new GLTFLoader().parseAsync(rig.glb.buffer, ""));
      character.setBody(walks[0]!.proportions);
      const box = new Vector3();
      const meshes: Actor["meshes"] = [];
      character.object.updateMatrixWorld(true);
      character.object.traverse((node) => {
        const mesh = node as SkinnedMesh;
        if (!mesh.isSkinnedMesh) return;
        meshes.push({ mesh, colours: coloursOf(mesh, character) });
        const { position } = mesh.geometry.attributes;
        for (let v = 0; v < position!.count; v++)
          box.max(
            mesh.applyBoneTransform(v, new Vector3().fromBufferAttribute(position!, v)).applyMatrix4(mesh.matrixWorld),
          );
      });
      return { name: family.name, character, meshes, zoom: (HEIGHT - GROUND - 14) / box.y };
    }),
  );
});

/** Returns one colour per vertex, by the side of the limb that it follows. */
function coloursOf(mesh: SkinnedMesh, { roles }: Character): Actor["meshes"][number]["colours"] {
  const sides = new Map(Object.entries(roles).map(([role, name]) => [name, role as Role]));
  const colours = mesh.skeleton.bones.map((bone) => {
    for (let node: Object3D | null = bone; node; node = node.parent) {
      const role = sides.get(node.userData.name ?? node.name);
      if (role) return role.startsWith("left") ? RED : role.startsWith("right") ? BLUE : GREY;
    }
    return GREY;
  });
  const { skinIndex } = mesh.geometry.attributes;
  return Array.from({ length: skinIndex!.count }, (_, v) => colours[skinIndex!.getX(v)]!);
}

test.each([0, 1, 2])("strips of style %i, and limbs on their sides", (style) => {
  const walk = walks[style]!;
  const label = walk.name.split(", ").at(-1)!;
  for (const view of ["front", "side"] as const) {
    const picture = new Picture(COLUMNS * WIDTH, actors.length * HEIGHT);
    for (const [row, actor] of actors.entries())
      for (let column = 0; column < COLUMNS; column++) {
        const frame = FIRST + EVERY * column;
        actor.character.apply(walk.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS));
        actor.character.object.updateMatrixWorld(true);
        draw(picture, actor, view, column * WIDTH, row * HEIGHT);
        expect(onTheirSides(actor), `${actor.name}, frame ${frame}`).toBe(true);
      }
    mkdirSync(join(root, "tests", "output"), { recursive: true });
    writeFileSync(join(root, "tests", "output", `characters_${label}_${view}.png`), picture.png());
  }
});

/** Returns whether the left thigh is on the body's left, which is +X for a walk along +Z. */
function onTheirSides({ character }: Actor): boolean {
  const at = (role: Role) => {
    let found = new Vector3();
    character.object.traverse((node) => {
      if ((node.userData.name ?? node.name) === character.roles[role]) found = node.getWorldPosition(new Vector3());
    });
    return found;
  };
  return at("left_upper_leg").x > at("right_upper_leg").x && at("left_upper_arm").x > at("right_upper_arm").x;
}

function draw(picture: Picture, { character, meshes, zoom }: Actor, view: "front" | "side", left: number, top: number) {
  const hips = new Vector3();
  character.object.traverse((node) => {
    if ((node.userData.name ?? node.name) === character.roles.hips) node.getWorldPosition(hips);
  });
  const across = view === "front" ? (v: Vector3) => v.x - hips.x : (v: Vector3) => hips.z - v.z;
  const near = view === "front" ? (v: Vector3) => v.z - hips.z : (v: Vector3) => v.x - hips.x;
  picture.line(left, top + HEIGHT - GROUND, WIDTH);
  for (const { mesh, colours } of meshes) {
    const { position } = mesh.geometry.attributes;
    const points = Array.from({ length: position!.count }, (_, v) => {
      const world = mesh
        .applyBoneTransform(v, new Vector3().fromBufferAttribute(position!, v))
        .applyMatrix4(mesh.matrixWorld);
      return new Vector3(
        left + WIDTH / 2 + zoom * across(world),
        top + HEIGHT - GROUND - zoom * world.y,
        zoom * near(world),
      );
    });
    const index = mesh.geometry.index!;
    for (let i = 0; i < index.count; i += 3) {
      const corners = [0, 1, 2].map((k) => index.getX(i + k));
      const [a, b, c] = corners.map((v) => points[v]!) as [Vector3, Vector3, Vector3];
      picture.triangle(a, b, c, colours[corners[0]!]!, [left, top]);
    }
  }
}

/** Pixels with a depth buffer. */
class Picture {
  private readonly pixels: Uint8Array;
  private readonly depths: Float32Array;

  constructor(
    private readonly width: number,
    private readonly height: number,
  ) {
    this.pixels = new Uint8Array(3 * width * height).fill(PAPER);
    this.depths = new Float32Array(width * height).fill(-Infinity);
  }

  /** Draws a horizontal line behind everything. */
  line(x: number, y: number, length: number): void {
    this.pixels.fill(190, 3 * (y * this.width + x), 3 * (y * this.width + x + length));
  }

  /** Draws a triangle within one cell, lit from the camera. */
  triangle(a: Vector3, b: Vector3, c: Vector3, colour: readonly number[], [left, top]: [number, number]): void {
    const normal = b.clone().sub(a).cross(c.clone().sub(a)).normalize();
    const light = 0.35 + 0.65 * Math.abs(normal.z);
    const area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (Math.abs(area) < 1e-9) return;
    const low = (p: "x" | "y", least: number) => Math.max(least, Math.floor(Math.min(a[p], b[p], c[p])));
    const high = (p: "x" | "y", most: number) => Math.min(most, Math.ceil(Math.max(a[p], b[p], c[p])));
    for (let y = low("y", top); y <= high("y", top + HEIGHT - 1); y++)
      for (let x = low("x", left); x <= high("x", left + WIDTH - 1); x++) {
        const u = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / area;
        const v = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const depth = u * a.z + v * b.z + (1 - u - v) * c.z;
        const at = y * this.width + x;
        if (depth <= this.depths[at]!) continue;
        this.depths[at] = depth;
        for (let k = 0; k < 3; k++) this.pixels[3 * at + k] = colour[k]! * light;
      }
  }

  png(): Buffer {
    const { width, height } = this;
    const rows = Buffer.alloc(height * (1 + 3 * width));
    for (let y = 0; y < height; y++)
      rows.set(this.pixels.subarray(3 * y * width, 3 * (y + 1) * width), y * (1 + 3 * width) + 1);
    const header = Buffer.alloc(13);
    header.writeUInt32BE(width, 0);
    header.writeUInt32BE(height, 4);
    header.set([8, 2], 8);
    const chunk = (type: string, data: Buffer) => {
      const body = Buffer.concat([Buffer.from(type), data]);
      const out = Buffer.alloc(body.length + 8);
      out.writeUInt32BE(data.length, 0);
      out.set(body, 4);
      out.writeUInt32BE(crc32(body), body.length + 4);
      return out;
    };
    const signature = Buffer.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10]);
    return Buffer.concat([
      signature,
      chunk("IHDR", header),
      chunk("IDAT", deflateSync(rows)),
      chunk("IEND", Buffer.alloc(0)),
    ]);
  }
}

test("the walks are along +Z", () => {
  for (const { poses } of walks) expect(poses[poses.length - POSE_FLOATS + 2]! - poses[2]!).toBeGreaterThan(1);
  expect(JOINT.hips).toBe(0);
});
