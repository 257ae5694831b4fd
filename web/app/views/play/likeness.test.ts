import { describe, expect, it } from "vitest";
import { DEFAULT_PROPORTIONS, POSE_FLOATS, restPose } from "../../../humanoid";
import { readText } from "./input_panel";
import { isUnlike, type Likeness, likenessOf } from "./likeness";

const RATE = 60;
const FRAMES = 120;
const STYLES = ["neutral", "angry", "proud", "old", "sexy", "childlike", "depressed", "strutting"];
const classes = ["walk", "run", "kick", "punch", "jump"].flatMap((action) =>
  STYLES.map((style) => ({ action, style, frames: 600 })),
);
const database = { classes, proportions: new Float32Array(DEFAULT_PROPORTIONS), rateHz: RATE };

/** A body in the T-pose with given positions of its hips in each frame. */
function posesAt(x: (frame: number) => number): Float32Array {
  const poses = new Float32Array(FRAMES * POSE_FLOATS);
  for (let frame = 0; frame < FRAMES; frame++) {
    poses.set(restPose(), frame * POSE_FLOATS);
    poses[frame * POSE_FLOATS] = x(frame);
  }
  return poses;
}
const moving = { poses: posesAt((frame) => (1.2 * frame) / RATE) };
/** A standing person who sways by 2 cm in two seconds. */
const still = { poses: posesAt((frame) => 0.02 * Math.sin((Math.PI * frame) / RATE)) };

/** The same weights in every frame: the given ones, and the rest distributed to the other classes. */
function analysis(given: Readonly<Record<string, number>>, distanceMetres = 0.1) {
  const names = classes.map(({ action, style }) => `${action} ${style}`);
  const rest = 1 - Object.values(given).reduce((a, b) => a + b, 0);
  const others = classes.length - Object.keys(given).length;
  const frame = names.map((name) => given[name] ?? rest / others);
  return {
    classWeights: Float32Array.from({ length: FRAMES * frame.length }, (_, i) => frame[i % frame.length]!),
    notes: distanceMetres > 0.35 ? [{ code: "unfamiliar", text: "This motion is unlike all of the database." }] : [],
    distanceMetres,
  };
}
const frameOf = ({ read }: Likeness) => ({ ...read });

describe("what an input is like", () => {
  it("is a class that has much of the weight", () => {
    const like = likenessOf(moving, analysis({ "walk proud": 0.81 }), database, true)!;
    expect(like.kind).toBe("class");
    expect(like.read).toMatchObject({ action: "walk", style: "proud" });
    expect(readText(frameOf(like), like).text).toBe("walk, proud");
  });

  it("is nothing where no class has more than a few hundredths", () => {
    const like = likenessOf(moving, analysis({ "punch angry": 0.08 }), database, true)!;
    expect([like.kind, isUnlike(like)]).toEqual(["alike", true]);
    const { text, weight } = readText({ action: "punch", style: "angry", weight: 0.08 }, like);
    expect(text).toBe("unlike any style");
    expect(weight).toBeCloseTo(0.08);
  });

  it("is an action whose styles have the weight together, as recorded runs are", () => {
    const runs = Object.fromEntries(STYLES.map((style) => [`run ${style}`, 0.07]));
    const like = likenessOf(moving, analysis(runs), database, true)!;
    expect([like.kind, isUnlike(like)]).toEqual(["action", false]);
    expect(readText({ action: "run", style: "angry", weight: 0.07 }, like).text).toBe("run, any style");
  });

  it("is nothing where somebody stands still, whatever class begins so", () => {
    const idle = analysis({ "kick neutral": 1 });
    const like = likenessOf(still, idle, database, true)!;
    expect(like.kind).toBe("still");
    expect(readText(frameOf(like), like)).toEqual({ text: "unlike any style", weight: undefined });
    // Another database may have clips of standing persons.
    expect(likenessOf(still, idle, database, false)!.kind).toBe("class");
    expect(likenessOf(moving, idle, database, true)!.kind).toBe("class");
  });

  it("is nothing where the engine's note says that all is far, and says how far", () => {
    const like = likenessOf(moving, analysis({ "kick neutral": 1 }, 0.481), database, true)!;
    expect(like).toMatchObject({ kind: "far", centimetres: 48 });
    expect(readText(frameOf(like), like)).toEqual({ text: "unlike any style", weight: undefined });
  });

  it("is told of a single frame until the whole is known", () => {
    expect(readText({ action: "punch", style: "angry", weight: 0.08 }, undefined).text).toBe("unlike any style");
    expect(readText({ action: "punch", style: "angry", weight: 0.4 }, undefined).text).toBe("punch, angry");
  });
});
