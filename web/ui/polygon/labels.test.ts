import { describe, expect, it } from "vitest";
import { circleVertices } from "./geometry";
import { area, type Box, boxOf, coveringLabels, type LabelledVertex, overlap, placeLabels } from "./labels";

const ROOM: Box = { left: -152, right: 152, top: -144, bottom: 120 };

/** A polygon with some selected vertices. */
function polygon(count: number, selected: readonly number[], name = "childish A"): LabelledVertex[] {
  return circleVertices(count, 92).map((position, i) => ({
    name,
    weight: selected.includes(i) ? 0.5 : undefined,
    position,
  }));
}

/** Every vertex of every polygon with 3 to `max` vertices. */
const all = (max: number): [count: number, i: number][] =>
  Array.from({ length: max - 2 }, (_, n) => n + 3).flatMap((count) =>
    Array.from({ length: count }, (_, i): [number, number] => [count, i]),
  );

/** Boxes of the labels of the selected vertices. */
function boxes(vertices: readonly LabelledVertex[]): Box[] {
  const places = placeLabels(vertices, ROOM);
  return vertices.flatMap((vertex, i) => (vertex.weight === undefined ? [] : [boxOf(vertex, places[i]!)]));
}

describe("idle labels", () => {
  const covering = (count: number, selected: number[], name?: string) => {
    const vertices = polygon(count, selected, name);
    return coveringLabels(vertices, placeLabels(vertices, ROOM));
  };

  it("are all shown of nine and ten styles", () => {
    for (const count of [8, 9, 10]) expect(covering(count, [0, 3, 6], "strutting"), `${count}`).not.toContain(true);
  });

  it("give way where there is no room, and none covers another", () => {
    for (const [count, i] of all(40)) {
      const vertices = polygon(count, [i], "childish A");
      const places = placeLabels(vertices, ROOM);
      const hidden = coveringLabels(vertices, places);
      expect(hidden[i]).toBe(false);
      const shown = vertices.flatMap((vertex, j) => (hidden[j] || j === i ? [] : [boxOf(vertex, places[j]!)]));
      for (const [j, box] of shown.entries())
        for (const other of shown.slice(j + 1)) expect(overlap(box, other)).toBe(0);
    }
    expect(covering(40, [0]).filter((hides) => !hides).length).toBeGreaterThan(12);
  });
});

describe("labels", () => {
  it("stand above the bar at the top and beside it at the bottom, name and number on one line", () => {
    const places = placeLabels(polygon(8, [0, 4]), ROOM);
    expect(places[0]).toMatchObject({ x: 0, anchor: "middle", numberBelow: 0 });
    expect(places[0]!.y).toBeLessThan(-130);
    expect(places[4]).toMatchObject({ anchor: "start", numberBelow: 0 });
  });

  it("have the bar between name and number at the sides", () => {
    const [, , right] = placeLabels(polygon(8, [2]), ROOM);
    expect(right).toMatchObject({ x: ROOM.right, anchor: "end" });
    expect(right!.y + right!.numberBelow / 2).toBeCloseTo(0, 0);
  });

  it.each(["proud", "childish A"])(
    "of two neighbours named %s hardly touch, however many vertices there are",
    (name) => {
      for (const [count, i] of all(32)) {
        const [a, b] = boxes(polygon(count, [i, (i + 1) % count], name));
        const share = overlap(a!, b!) / Math.min(area(a!), area(b!));
        expect(share, `${i} and its neighbour of ${count}`).toBeLessThan(0.1);
      }
    },
  );

  it("stay in the room there is", () => {
    for (const [count, i] of all(32))
      for (const { left, right, top, bottom } of boxes(polygon(count, [i], "proud"))) {
        expect(left).toBeGreaterThanOrEqual(ROOM.left);
        expect(right).toBeLessThanOrEqual(ROOM.right);
        expect(top).toBeGreaterThanOrEqual(ROOM.top);
        expect(bottom).toBeLessThanOrEqual(ROOM.bottom + 3);
      }
  });

  it("of idle styles read inwards where a selected one's is in the way", () => {
    const vertices = polygon(25, [0]);
    const places = placeLabels(vertices, ROOM);
    const selected = boxOf(vertices[0]!, places[0]!);
    for (const [i, vertex] of vertices.entries())
      if (i > 0) expect(overlap(boxOf(vertex, places[i]!), selected)).toBe(0);
  });
});
