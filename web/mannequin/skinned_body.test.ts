import { describe, expect, it } from "vitest";
import { DEFAULT_PROPORTIONS, JOINTS } from "../humanoid";
import { fitTo } from "./fit";
import { prismBodies } from "./prism_body";
import { restJoints, type SkinnedBody, skinnedBody } from "./skinned_body";

const fit = fitTo(DEFAULT_PROPORTIONS);

function box({ positions }: SkinnedBody): { low: number[]; high: number[] } {
  const axis = (k: number) => Array.from(positions).filter((_, i) => i % 3 === k);
  const of = (pick: (...values: number[]) => number) => [0, 1, 2].map((k) => pick(...axis(k)));
  return { low: of(Math.min), high: of(Math.max) };
}

/** Share of the triangles that face away from the axis of their joint: their normals agree with their winding. */
function outward({ positions, normals, indices }: SkinnedBody): number {
  let agreeing = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => positions.subarray(3 * indices[i + k]!, 3 * indices[i + k]! + 3));
    const [p, q] = [[0, 1, 2].map((k) => b![k]! - a![k]!), [0, 1, 2].map((k) => c![k]! - a![k]!)];
    const face = [0, 1, 2].map((k) => p![(k + 1) % 3]! * q![(k + 2) % 3]! - p![(k + 2) % 3]! * q![(k + 1) % 3]!);
    const sum = [0, 1, 2].map((k) => [0, 1, 2].reduce((all, v) => all + normals[3 * indices[i + v]! + k]!, 0));
    if (face.reduce((all, value, k) => all + value * sum[k]!, 0) > 0) agreeing++;
  }
  return agreeing / (indices.length / 3);
}

describe("a skinned body", () => {
  const body = skinnedBody(fit, 0.25);

  it("stands on the ground and is as tall as the mannequin", () => {
    const { low, high } = box(body);
    expect(low[1]).toBeCloseTo(0, 2);
    expect(high[1]).toBeGreaterThan(1.6);
    expect(high[1]).toBeLessThan(1.8);
  });

  it("follows joints that there are, the waist two of them", () => {
    expect(Math.max(...body.joints)).toBeLessThan(JOINTS);
    expect(body.blends.some((blend) => blend > 0.2 && blend < 0.8)).toBe(true);
    expect(restJoints(fit)).toHaveLength(3 * JOINTS);
  });

  it("has unit normals that point outwards", () => {
    for (let i = 0; i < body.normals.length; i += 3)
      expect(Math.hypot(...body.normals.subarray(i, i + 3))).toBeCloseTo(1, 5);
    expect(outward(body)).toBeGreaterThan(0.98);
  });
});

describe("a body of prisms", () => {
  const prisms = prismBodies(fit).seen;

  it("has at most 400 triangles", () => {
    expect(prisms.indices.length / 3).toBeLessThanOrEqual(400);
  });

  it("fills the box of the mesh that it stands for", () => {
    const [mesh, far] = [box(skinnedBody(fit, 0.25)), box(prisms)];
    for (const k of [0, 1, 2]) {
      expect(Math.abs(mesh.low[k]! - far.low[k]!)).toBeLessThan(0.03);
      expect(Math.abs(mesh.high[k]! - far.high[k]!)).toBeLessThan(0.03);
    }
  });

  it("has all its faces outwards", () => {
    expect(outward(prisms)).toBe(1);
  });
});
