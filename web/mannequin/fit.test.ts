import fc from "fast-check";
import { Quaternion, Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { createWorldPose, DEFAULT_PROPORTIONS, JOINT, JOINTS, restPose, worldFromLocal } from "../humanoid";
import { fitTo } from "./fit";
import type { Slot } from "./part";
import { bodyParts } from "./parts";
import { SlotRows } from "./slot_rows";
import { RIGID_SLOTS, SLOTS, slotIndex } from "./slots";
import { WAIST_RINGS, waistSlot } from "./waist";

const PARTS = bodyParts(0.5);

/** A point of a slot in the world. */
function place(rows: SlotRows, slot: Slot, point: Vector3): Vector3 {
  const at = (row: number, column: number) => rows.values[12 * slotIndex(slot) + 4 * row + column]!;
  const row = (r: number) => at(r, 0) * point.x + at(r, 1) * point.y + at(r, 2) * point.z + at(r, 3);
  return new Vector3(row(0), row(1), row(2));
}

/** Lowest point of the parts on a slot. */
function lowest(rows: SlotRows, slot: Slot): number {
  let low = Number.POSITIVE_INFINITY;
  for (const { surface } of PARTS.filter((part) => part.slot === slot))
    for (let i = 0; i < surface.positions.length; i += 3)
      low = Math.min(low, place(rows, slot, new Vector3().fromArray(surface.positions, i)).y);
  return low;
}

/** Proportions of bodies from a child's to a giant's, with their own legs, feet and hips. */
const anyProportions = fc
  .record({
    size: fc.double({ min: 0.6, max: 1.5, noNaN: true }),
    factors: fc.array(fc.double({ min: 0.7, max: 1.4, noNaN: true }), { minLength: JOINTS, maxLength: JOINTS }),
    lean: fc.double({ min: -0.1, max: 0.1, noNaN: true }),
  })
  .map(({ size, factors, lean }) => {
    const p = DEFAULT_PROPORTIONS.map((offset, i) => offset * size * factors[Math.floor(i / 3)]!);
    for (const side of ["left", "right"] as const) p[3 * JOINT[`${side}_lower_leg`]] = lean * size;
    return p;
  });

describe("fit", () => {
  it("leaves the mannequin as it is on its own proportions", () => {
    const { jointFromSlot, stature } = fitTo(DEFAULT_PROPORTIONS);
    expect(stature).toBeCloseTo(1, 6);
    for (const slot of RIGID_SLOTS)
      for (let i = 0; i < 16; i++)
        expect(jointFromSlot[16 * slotIndex(slot) + i], `${slot} ${i}`).toBeCloseTo(i % 5 === 0 ? 1 : 0, 5);
  });

  it("puts the soles on the ground of the T-pose, whatever the proportions", () => {
    fc.assert(
      fc.property(anyProportions, (proportions) => {
        const rows = new SlotRows();
        const pose = restPose();
        pose[1] = proportions[1]!;
        rows.setPose(fitTo(proportions), pose);
        // The splines between the soles' stations swing out by a fraction of a millimetre.
        for (const slot of ["left_foot", "left_toes"] as const)
          expect(Math.abs(lowest(rows, slot)), slot).toBeLessThan(5e-4);
      }),
      { numRuns: 40 },
    );
  });

  it("keeps the legs' joints where the proportions put them", () => {
    fc.assert(
      fc.property(anyProportions, (proportions) => {
        const fit = fitTo(proportions);
        const pose = restPose();
        new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), 0.7).toArray(pose, 3 + 4 * JOINT.left_lower_leg);
        const [given, drawn] = [createWorldPose(), createWorldPose()];
        worldFromLocal(proportions, pose, given);
        worldFromLocal(fit.proportions, pose, drawn);
        for (const role of ["left_foot", "left_toes", "right_lower_leg", "right_toes"] as const)
          for (let axis = 0; axis < 3; axis++)
            expect(drawn.positions[3 * JOINT[role] + axis]).toBeCloseTo(given.positions[3 * JOINT[role] + axis]!, 5);
      }),
      { numRuns: 40 },
    );
  });

  it("ends a stretched shell at the next joint", () => {
    const proportions = Float32Array.from(DEFAULT_PROPORTIONS);
    proportions.set([0.05, -0.5, 0.02], 3 * JOINT.left_lower_leg);
    const rows = new SlotRows();
    rows.setPose(fitTo(proportions), restPose());
    const knee = place(rows, "left_thigh", new Vector3(0, -0.391, 0));
    for (const [axis, value] of knee.toArray().entries())
      expect(value).toBeCloseTo(rows.world.positions[3 * JOINT.left_lower_leg + axis]!, 5);
  });

  it("survives proportions that make no sense", () => {
    const fit = fitTo(new Float32Array(3 * JOINTS));
    expect(fit.jointFromSlot.every(Number.isFinite)).toBe(true);
    expect(() => fitTo([1, 2])).toThrow(RangeError);
  });
});

describe("the waist", () => {
  it("begins in the pelvis and ends in the ribcage, however the body bends", () => {
    const pose = restPose();
    new Quaternion().setFromAxisAngle(new Vector3(0.5, 0.7, 0.5).normalize(), 0.6).toArray(pose, 3 + 4 * JOINT.spine);
    new Quaternion().setFromAxisAngle(new Vector3(1, 0, 0), -0.4).toArray(pose, 3 + 4 * JOINT.chest);
    const rows = new SlotRows();
    rows.setPose(fitTo(DEFAULT_PROPORTIONS), pose);
    const side = new Vector3(0.1, 0, 0);
    const first = place(rows, waistSlot(0), side);
    expect(first.distanceTo(place(rows, "pelvis", new Vector3(0.1, 0.055, -0.001)))).toBeLessThan(1e-5);
    const last = place(rows, waistSlot(WAIST_RINGS - 1), side);
    expect(last.distanceTo(place(rows, "ribcage", new Vector3(0.1, -0.045, 0.003)))).toBeLessThan(1e-5);
    // No ring stands out: the distances between rings are short and even.
    const steps = Array.from({ length: WAIST_RINGS - 1 }, (_, i) =>
      place(rows, waistSlot(i), new Vector3()).distanceTo(place(rows, waistSlot(i + 1), new Vector3())),
    );
    expect(Math.max(...steps)).toBeLessThan(2.5 * Math.min(...steps));
  });

  it("is as wide as pelvis and ribcage make it", () => {
    const wide = Float32Array.from(DEFAULT_PROPORTIONS);
    wide[3 * JOINT.left_upper_leg] = 0.168;
    wide[3 * JOINT.right_upper_leg] = -0.168;
    const rows = new SlotRows();
    rows.setPose(fitTo(wide), restPose());
    expect(rows.values[12 * SLOTS.indexOf(waistSlot(0))]).toBeCloseTo(Math.SQRT2, 4);
    expect(rows.values[12 * SLOTS.indexOf(waistSlot(WAIST_RINGS - 1))]).toBeCloseTo(1, 4);
  });
});
