import "./whole";
import { describe, expect, it } from "vitest";
import { JOINTS, POSE_FLOATS } from "../humanoid";
import { loadBuiltIn } from "./built_in";
import { Engine } from "./engine";
import { FirstSteps } from "./first_steps";

describe("the first steps", () => {
  it("are the first built-in input, to a fifth of a degree and to two millimetres", async () => {
    const [engine, motions, steps] = await Promise.all([Engine.load(), loadBuiltIn(), FirstSteps.load()]);
    const database = engine.openDatabase({ kind: "demo", motions });
    const { info } = engine.openInput(database, { kind: "built-in", name: engine.inputsOf(motions)[0]!, motions });
    expect([steps.frames, steps.rateHz]).toEqual([info.frames, info.rateHz]);
    for (let frame = 0; frame < steps.frames; frame++) {
      const pose = steps.poseAt(frame);
      const input = info.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
      expect(Math.hypot(...[0, 1, 2].map((i) => pose[i]! - input[i]!))).toBeLessThan(0.002);
      for (let joint = 0; joint < JOINTS; joint++) {
        const at = 3 + 4 * joint;
        const dot = [0, 1, 2, 3].reduce((sum, i) => sum + pose[at + i]! * input[at + i]!, 0);
        expect((360 / Math.PI) * Math.acos(Math.min(1, Math.abs(dot)))).toBeLessThan(0.2);
      }
    }
    database.dispose();
  });
});
