import { describe, expect, it } from "vitest";
import { loft, mirror, orient, type Station, type Surface, sectionAt, vertexNormals } from "./loft";
import { buildMesh, TONES } from "./mesh";
import { bodyParts } from "./parts";
import { SLOTS, slotIndex } from "./slots";
import { waistSlot } from "./waist";

const BARREL: Station[] = [
  [0, 1, 1, 1, 1],
  [1, 2, 1.5, 2, 1],
  [3, 1, 1, 1, 1, 0.2, -0.1],
];

/** Edges without exactly one neighbour in the opposite direction. */
function openEdges({ indices }: Surface): number {
  const edges = new Map<string, number>();
  for (let t = 0; t < indices.length; t += 3)
    for (const [i, j] of [
      [0, 1],
      [1, 2],
      [2, 0],
    ] as const) {
      const [a, b] = [indices[t + i]!, indices[t + j]!];
      const key = a < b ? `${a} ${b}` : `${b} ${a}`;
      edges.set(key, (edges.get(key) ?? 0) + (a < b ? 1 : -1) + 10);
    }
  return [...edges.values()].filter((count) => count !== 20).length;
}

/** Volume inside a closed surface, negative if it is inside out. */
function volume({ positions, indices }: Surface): number {
  const p = (vertex: number) => positions.slice(3 * vertex, 3 * vertex + 3) as [number, number, number];
  let sum = 0;
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [p(indices[t]!), p(indices[t + 1]!), p(indices[t + 2]!)];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum / 6;
}

describe("loft", () => {
  it("passes through its stations", () => {
    for (const station of BARREL)
      expect(sectionAt(BARREL, station[0])).toEqual([...station, ...[0, 0].slice(station.length - 5)]);
  });

  it("is closed and faces outwards, also when it is turned or mirrored", () => {
    const surface = loft(BARREL, { startCap: 0.3, endCap: 0.5 });
    const turned = orient(surface, [
      [0, 1, 0],
      [1, 0, 0],
      [0, 0, 1],
    ]);
    for (const s of [surface, turned, mirror(surface)]) {
      expect(openEdges(s)).toBe(0);
      expect(volume(s)).toBeCloseTo(volume(surface), 6);
    }
    expect(volume(surface)).toBeGreaterThan(0);
  });

  it("is open where it has no cap", () => {
    expect(openEdges(loft(BARREL, { startCap: 0, segments: 28 }))).toBe(28);
  });

  it("has the volume of an elliptic cylinder where it is one", () => {
    const cylinder: Station[] = [
      [0, 1, 1, 0.5, 0.5],
      [2, 1, 1, 0.5, 0.5],
    ];
    const surface = loft(cylinder, { startCap: 1e-6, endCap: 1e-6, exponent: 2, segments: 200 });
    expect(volume(surface)).toBeCloseTo(Math.PI * 1 * 0.5 * 2, 2);
  });
});

describe.each([1, 0.6, 0.5])("the body at detail %d", (detail) => {
  const parts = bodyParts(detail);
  const isOpen = (slot: string, i: number) =>
    slot === waistSlot(0) || (slot === "head" && parts.findLastIndex((part) => part.slot === "head") === i);

  it("is made of closed parts that face outwards, but for the waist and the face plate", () => {
    for (const [i, { slot, surface }] of parts.entries()) {
      if (isOpen(slot, i)) continue;
      expect(openEdges(surface), slot).toBe(0);
      expect(volume(surface), slot).toBeGreaterThan(1e-7);
    }
  });

  it("has unit normals that point away from the solid", () => {
    for (const [i, { slot, surface }] of parts.entries()) {
      const normals = vertexNormals(surface);
      for (let v = 0; v < normals.length; v += 3)
        expect(Math.hypot(normals[v]!, normals[v + 1]!, normals[v + 2]!)).toBeCloseTo(1, 4);
      if (isOpen(slot, i)) continue;
      // Moving every vertex outwards makes the solid larger.
      const grown = { ...surface, positions: surface.positions.map((x, k) => x + 1e-4 * normals[k]!) };
      expect(volume(grown), slot).toBeGreaterThan(volume(surface));
    }
  });

  it("is the same on both sides", () => {
    const of = (side: string) => parts.filter(({ slot }) => slot.startsWith(side));
    expect(of("left_").length).toBe(of("right_").length);
    for (const [i, left] of of("left_").entries())
      expect(volume(of("right_")[i]!.surface)).toBeCloseTo(volume(left.surface), 9);
  });

  it("becomes one mesh with two groups, every slot in use", () => {
    const { positions, normals, slots, indices, groups } = buildMesh(detail);
    expect(groups.length).toBe(TONES.length);
    expect(groups.reduce((sum, group) => sum + group.count, 0)).toBe(indices.length);
    const vertices = slots.length;
    expect(vertices).toBeLessThan(65536);
    expect([positions.length, normals.length]).toEqual([3 * vertices, 3 * vertices]);
    expect(Math.max(...indices)).toBe(vertices - 1);
    expect(new Set(slots)).toEqual(new Set(SLOTS.map((slot) => slotIndex(slot))));
  });
});

describe("the budget of triangles", () => {
  it("is kept at every level of detail", () => {
    const triangles = (detail: number) => buildMesh(detail).indices.length / 3;
    expect(triangles(1)).toBeLessThan(40_000);
    expect(triangles(0.5)).toBeLessThan(14_000);
  });
});
