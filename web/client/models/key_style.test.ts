/** Key-style models trained as on the page, and their poses: real packages on this thread. */

import { beforeAll, describe, expect, it } from "vitest";
import { InlineBuildWorker } from "../../../tests/inline_build_worker";
import { POSE_FLOATS } from "../../humanoid";
import type { DroppedFile, KeyStyleOrder, TrainedKeyStyle } from "../build/protocol";
import { checkAxis, type KeyStyleFrame, type KeyStyleModel, openKeyStyle, trainKeyStyle } from "./key_style";

const FEET = ["foot_separation", "foot_height_difference"];
const WALK: KeyStyleOrder = { clips: [], action: "walk", axes: FEET, components: 0, em: false };

const heard: { label: string; fraction: number }[] = [];
let trained: TrainedKeyStyle;
let model: KeyStyleModel;

function train(order: KeyStyleOrder, files?: DroppedFile[]): Promise<TrainedKeyStyle> {
  const motions = files ? { files } : { database: undefined };
  const options = { onProgress: (progress: (typeof heard)[number]) => heard.push(progress) };
  return trainKeyStyle(motions, order, options, () => new InlineBuildWorker());
}

beforeAll(async () => {
  trained = await train(WALK);
  model = await openKeyStyle({ file: trained.file });
});

/** Largest turn of a joint between two poses, degrees. */
function largestTurn(a: ArrayLike<number>, b: ArrayLike<number>): number {
  let max = 0;
  for (let i = 3; i < POSE_FLOATS; i += 4) {
    const dot = [0, 1, 2, 3].reduce((sum, k) => sum + a[i + k]! * b[i + k]!, 0);
    max = Math.max(max, (2 * Math.acos(Math.min(1, Math.abs(dot))) * 180) / Math.PI);
  }
  return max;
}

/** A point on a circle about the mean, as drawn by hand: clockwise, foot separation first. */
const onTurn = (share: number, radius = 1.35): number[] => {
  const angle = 2 * Math.PI * share;
  return [
    model.mean[0]! + radius * model.deviation[0]! * Math.cos(angle),
    model.mean[1]! - radius * model.deviation[1]! * Math.sin(angle),
  ];
};

describe("training", () => {
  it("learns the built-in walk, and says how far it is", () => {
    expect(trained.trainedOn.every((name) => /^walk.*neutral/.test(name))).toBe(true);
    expect(trained.clips.length).toBeGreaterThan(20);
    expect(model.axes).toEqual(FEET);
    expect(model.units).toEqual(["cm", "cm"]);
    expect(model.values.length).toBe(2 * model.clips.reduce((sum, clip) => sum + clip.frames, 0));
    const fractions = heard.map(({ fraction }) => fraction);
    expect(fractions).toEqual([...fractions].sort((a, b) => a - b));
    expect(heard.at(-1)!.label).toMatch(/^Learning, pass \d+ of \d+\.$/);
  });

  it("finds out style variables that do not say the pose", async () => {
    expect(trained.unexplainedShare).toBe(0);
    expect((await train({ ...WALK, axes: ["head.x - neck.x"] })).unexplainedShare).toBeGreaterThan(0.6);
  });

  it("gives everybody the same model", async () => {
    expect((await train(WALK)).file).toEqual(trained.file);
    expect((await train({ ...WALK, em: true })).file).not.toEqual(trained.file);
  });

  it("says in a sentence what cannot be trained", async () => {
    const refusal = (order: Partial<KeyStyleOrder>) => train({ ...WALK, ...order });
    await expect(refusal({ axes: ["hips_height", "hips_height"] })).rejects.toThrow(/given twice/);
    await expect(refusal({ axes: ["1 + 1"] })).rejects.toThrow(/is 2\.0 .*in every frame/);
    await expect(refusal({ axes: ["hips.y / 0"] })).rejects.toThrow(/has no value in frame 1/);
    await expect(refusal({ axes: ["hipz_height"] })).rejects.toThrow(/Column 1: there is no/);
    await expect(refusal({ axes: [] })).rejects.toThrow(/1 to 3 were expected/);
    await expect(openKeyStyle({ file: new TextEncoder().encode("HIERARCHY") })).rejects.toThrow(
      /not a key-style model/,
    );
  });

  it("takes BVH files, and leaves out what is none", async () => {
    const styling = model.styling();
    styling.set(
      Array.from({ length: 25 }, (_, i) => ({ secs: i / 8, values: onTurn(i / 10) })),
      "spline",
    );
    const files = [
      { path: "mine/circle.bvh", file: new File([styling.toBvh(3, "style")], "circle.bvh") },
      { path: "mine/none.bvh", file: new File(["HIERARCHY"], "none.bvh") },
    ];
    const made = await train({ ...WALK, action: "" }, files);
    expect(made.trainedOn).toEqual(["circle"]);
    expect(made.refused.map(({ path }) => path)).toEqual(["none"]);
    const short = [{ path: "short.bvh", file: new File([styling.toBvh(0.3, "style")], "short.bvh") }];
    await expect(train({ ...WALK, action: "" }, short)).rejects.toThrow(/10 frames .*at least \d+ were expected/);
  });
});

describe("a poser", () => {
  it("walks when the hand turns, without a jump", () => {
    const poser = model.poser();
    poser.jump(onTurn(0));
    let [largest, before] = [0, poser.frame.pose.slice()];
    for (let frame = 1; frame <= 140; frame++) {
      const { pose } = poser.advance(1 / 60, onTurn(frame / 70));
      largest = Math.max(largest, largestTurn(pose, before));
      before = pose.slice();
    }
    expect(largest, "degrees a frame of the screen").toBeLessThan(8);
    expect(before[2], "metres ahead, in two turns").toBeGreaterThan(1.2);
    expect(Math.abs(before[0]!)).toBeLessThan(0.4);
  });

  it("measures what was asked of it, once it has arrived", () => {
    const poser = model.poser();
    const frame = model.nearest(onTurn(0.1));
    const asked = Array.from(model.values.subarray(2 * frame, 2 * frame + 2));
    const { measured, reached, weights } = poser.jump(asked);
    expect(Math.abs(measured[0]! - asked[0]!)).toBeLessThan(4);
    expect(Math.abs(measured[1]! - asked[1]!)).toBeLessThan(2);
    expect(reached[0]).toBeCloseTo(asked[0]!, 3);
    expect(weights.reduce((a, b) => a + b, 0)).toBeCloseTo(1, 5);
  });

  it("stays with what it knows, whatever it is asked for", () => {
    const poser = model.poser();
    for (const asked of [
      [1e9, -1e9],
      [Number.NaN, Number.POSITIVE_INFINITY],
      [0, 500],
    ]) {
      const { pose, reached } = poser.advance(0.1, asked);
      expect(pose.every(Number.isFinite)).toBe(true);
      const known = model.nearest(Array.from(reached));
      const far = Math.hypot(...[0, 1].map((i) => (model.values[2 * known + i]! - reached[i]!) / model.deviation[i]!));
      expect(far).toBeLessThan(0.51);
    }
    expect(poser.advance(Number.NaN, onTurn(0)).pose.every(Number.isFinite)).toBe(true);
  });

  it("takes the screen's time, in any portions", () => {
    const [one, other] = [model.poser(), model.poser()];
    for (let i = 0; i < 6; i++) one.advance(1 / 60, onTurn(0.2));
    other.advance(0.1, onTurn(0.2));
    expect(largestTurn(one.frame.pose, other.frame.pose)).toBeLessThan(0.1);
  });
});

describe("the mode of poses", () => {
  it("takes a temperature and a blur, and is smooth or hard by name", () => {
    const [named, numbers, hard] = [model.poser(), model.poser(), model.poser()];
    named.mode = "hard";
    named.mode = "smooth";
    numbers.mode = { temperature: 2, blur: 0.3 };
    hard.mode = "hard";
    const place = onTurn(0.13);
    expect(Array.from(named.jump(place).pose)).toEqual(Array.from(numbers.jump(place).pose));
    expect(Math.max(...hard.jump(place).weights)).toBe(1);
    expect(Math.max(...numbers.frame.weights)).toBeLessThan(1);
    for (const mode of [
      { temperature: 0, blur: 0 },
      { temperature: Number.NaN, blur: 0 },
      { temperature: 1, blur: -1 },
    ])
      expect(() => {
        numbers.mode = mode;
      }).toThrow(/was expected/);
    expect(model.error({ temperature: 1, blur: 0 })).toBeLessThan(model.error({ temperature: 20, blur: 0 }));
  });
});

describe("learning", () => {
  it("goes update by update, and its end is what training makes", () => {
    const somn = model.learn();
    expect(somn.updates).toBe(20 * somn.frames);
    expect(somn.state).toMatchObject({ updates: 0, sample: -1 });
    const sum = (of: Float32Array) => of.reduce((a, b) => a + b, 0);
    const { r, weights } = somn.step(1);
    expect(somn.state).toMatchObject({ updates: 1, delta: expect.closeTo(0.6, 5) });
    for (const shares of [r, weights]) expect(sum(shares)).toBeCloseTo(1, 5);
    const early = somn.model();
    somn.step(somn.updates);
    expect(somn.state.updates).toBe(somn.updates);
    const late = somn.model();
    const smooth = { temperature: 2, blur: 0 };
    expect(late.error(smooth)).toBeLessThan(early.error(smooth));
    expect(late.error(smooth)).toBeCloseTo(model.error(smooth), 3);
    for (const [i, centre] of late.centres.entries()) expect(centre).toBeCloseTo(model.centres[i]!, 2);
  });

  it("diverges with the signs as printed, and is refused without sense", () => {
    const printed = model.learn({ asPrinted: true });
    printed.step(1);
    const { error } = printed.state;
    expect(printed.step(printed.updates).error).not.toBeLessThan(100 * error);
    expect(() => model.learn({ components: 1000 })).toThrow(/at most 64/);
  });
});

describe("keys", () => {
  let keys: { secs: number; values: number[] }[];
  beforeAll(() => {
    keys = [0, 0.25, 0.5, 0.75, 1].map((secs) => ({ secs, values: onTurn(secs) }));
  });
  const pose = ({ pose }: KeyStyleFrame) => pose.slice();

  it("are gone through, and their variables are a curve between them", () => {
    const styling = model.styling();
    styling.set(keys, "spline");
    const way = styling.way(1, 5);
    for (const [i, { values }] of keys.entries())
      for (const axis of [0, 1]) expect(way[2 * i + axis]).toBeCloseTo(values[axis]!, 3);
    styling.at(0.5, "style");
    expect(Array.from(styling.frame.reached)).toEqual([
      expect.closeTo(keys[2]!.values[0]!, 3),
      expect.closeTo(keys[2]!.values[1]!, 3),
    ]);
  });

  it("are recorded poses for hybrid and key-framing, and these agree there", () => {
    const styling = model.styling();
    styling.set(keys, "spline");
    const recorded = model.recorded(model.nearest(keys[1]!.values))!;
    for (const between of ["hybrid", "frame"] as const)
      expect(largestTurn(pose(styling.at(0.25, between)), recorded), between).toBeLessThan(0.1);
    const apart = largestTurn(pose(styling.at(0.4, "style")), pose(styling.at(0.4, "frame")));
    expect(apart, "in between they differ").toBeGreaterThan(1);
  });

  it("become a motion and a BVH file", () => {
    const styling = model.styling();
    styling.set(keys, "monotone");
    const poses = styling.perform(1, "style");
    expect(poses.length).toBe(31 * POSE_FLOATS);
    expect(styling.toBvh(1, "style")).toMatch(/^HIERARCHY\nROOT/);
    expect(poses[30 * POSE_FLOATS + 2]! - poses[2]!, "the feet carry it ahead").toBeGreaterThan(0.5);
  });

  it("are refused where they are none", () => {
    const styling = model.styling();
    expect(() => styling.set([keys[1]!, keys[0]!], "spline")).toThrow(/ascending/);
    expect(() => styling.set([{ secs: 0, values: [Number.NaN, 0] }], "spline")).toThrow(/not finite/);
    expect(() => styling.set([], "spline")).toThrow(/no key/);
  });
});

describe("style variables", () => {
  it("are named, or expressions whose errors point at the character", async () => {
    expect(await checkAxis("torso_lean")).toEqual({ unit: "°" });
    expect(await checkAxis("hand_l.y - shoulder_l.y")).toEqual({ unit: "cm" });
    expect(await checkAxis("hand_l.y - sholder_l.y")).toMatchObject({ column: 11 });
    expect(await checkAxis("hand_l.y -")).toMatchObject({ column: 10 });
  });
});

describe("the map of what is known", () => {
  it("knows the recorded places and not those far away", () => {
    const support = (values: number[]) =>
      model.support(
        { min: values[0]!, max: values[0]!, count: 1 },
        { min: values[1]!, max: values[1]!, count: 1 },
        values,
      )[0]!;
    expect(support([model.mean[0]! + 9 * model.deviation[0]!, model.mean[1]!])).toBeLessThan(0);
    const frames = model.values.length / 2;
    let known = 0;
    for (let frame = 0; frame < frames; frame++)
      if (support(Array.from(model.values.subarray(2 * frame, 2 * frame + 2))) >= -1e-4) known++;
    expect(known / frames).toBeGreaterThan(0.97);
  });
});
