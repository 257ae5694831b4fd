import "../engine/whole";
import { describe, expect, it } from "vitest";
import { movingAnimation, poseOf, TALL_BODY } from "../../tests/humanoid_animation";
import { loadBuiltIn } from "../engine/built_in";
import { Engine } from "../engine/engine";
import { JOINT, JOINTS, PARENTS, POSE_FLOATS, ROLES } from "../humanoid";
import { bvhText } from "./bvh";

const animation = { ...movingAnimation(), rateHz: 60 };

describe("BVH text", () => {
  const text = bvhText(animation);

  it("has a joint a role, parents first, and a row a frame", () => {
    const names = [...text.matchAll(/(?:ROOT|JOINT) (\w+)/g)].map(([, name]) => name);
    expect(names).toEqual(
      ROLES.map((role) =>
        role
          .split("_")
          .map((part) => part[0]!.toUpperCase() + part.slice(1))
          .join(""),
      ),
    );
    expect(text).toContain("Frames: 61\n");
    const rows = text.slice(text.indexOf("Frame Time")).trim().split("\n").slice(1);
    expect(rows).toHaveLength(61);
    for (const row of rows) expect(row.split(" ")).toHaveLength(6 + 3 * (JOINTS - 1));
  });

  it("has the body's offsets in centimetres", () => {
    const knee = TALL_BODY[3 * JOINT.left_lower_leg + 1]! * 100;
    expect(text).toMatch(new RegExp(`JOINT LeftLowerLeg\\s+\\{\\s+OFFSET 0 ${Math.round(knee * 1e6) / 1e6} 0`));
    expect(PARENTS[JOINT.left_lower_leg]).toBe(JOINT.left_upper_leg);
  });

  it("is read by the engine as the poses that it was written of, even where an angle is a right one", async () => {
    const [engine, motions] = await Promise.all([Engine.load(), loadBuiltIn()]);
    const database = engine.openDatabase({ kind: "demo", motions });
    const { proportions } = database.info;
    const on = { ...movingAnimation(proportions), rateHz: database.info.rateHz };
    const [x, w] = [Math.sin(Math.PI / 4), Math.cos(Math.PI / 4)];
    for (const frame of [3, 4]) on.poses.set([x, 0, 0, w], frame * POSE_FLOATS + 3 + 4 * JOINT.left_upper_leg);
    const bytes = new TextEncoder().encode(bvhText(on)).buffer as ArrayBuffer;
    const input = engine.openInput(database, { kind: "bvh", name: "moving", bytes, reading: { floor: 0 } });
    expect(input.info.frames).toBe(61);
    // Its feet never rest, so no floor can be measured, which a note reports. The sole height below the ankles is still
    // guessed.
    const ground = input.info.poses[1]! - on.poses[1]!;
    let [degrees, metres] = [0, 0];
    for (let frame = 0; frame < 61; frame++) {
      const [a, b] = [poseOf(on, frame), poseOf(input.info, frame)];
      metres = Math.max(metres, Math.hypot(a[0]! - b[0]!, a[1]! + ground - b[1]!, a[2]! - b[2]!));
      for (let j = 0; j < JOINTS; j++)
        degrees = Math.max(degrees, degreesBetween(a.slice(3 + 4 * j), b.slice(3 + 4 * j)));
    }
    console.info(
      `BVH: ${degrees.toFixed(4)}°, ${(1000 * metres).toFixed(4)} mm, ground ${(1000 * ground).toFixed(1)} mm off`,
    );
    expect(degrees).toBeLessThan(0.1);
    expect(metres).toBeLessThan(0.001);
    expect(Math.abs(ground)).toBeLessThan(0.02);
    input.dispose();
    database.dispose();
  });
});

/** Angle between two rotations. */
function degreesBetween(a: Float32Array, b: Float32Array): number {
  const sign = a[0]! * b[0]! + a[1]! * b[1]! + a[2]! * b[2]! + a[3]! * b[3]! < 0 ? -1 : 1;
  const chord = Math.hypot(...[0, 1, 2, 3].map((k) => a[k]! - sign * b[k]!));
  return (4 * Math.asin(Math.min(1, chord / 2)) * 180) / Math.PI;
}
