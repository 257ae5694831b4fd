import "./whole";
import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { caseFile, casesAbsent } from "../../tests/cases";
import { ROLES } from "../humanoid";
import { loadBuiltIn } from "./built_in";
import { Engine } from "./engine";
import { fileRead, linesOf, noteOf, Saying } from "./file_read";
import type { FileReading } from "./types";

const RAW = {
  frames: 240,
  rateHz: 60,
  up: "y",
  mirrored: false,
  floor: 0,
  unit: 0.01,
  height: 1.7,
  confidence: 1,
  skeleton: "a",
  joints: ["Hips", "Spine"],
  roles: ROLES.map((_, i) => (i < 2 ? i : null)),
} as const;
const said = (reading: FileReading, remembered = false) => ({ reading, remembered });
const raw = { ...RAW, joints: [...RAW.joints], roles: [...RAW.roles] };

describe("what is said of a file", () => {
  it("is said of the file, or else of its skeleton", () => {
    const remembered = { a: { up: "z" as const } };
    const ofFile = new Saying({ reading: { up: "x" }, remembered });
    expect(ofFile.answer("a")).toBe("up x");
    expect(ofFile.remembered).toBe(false);
    const ofSkeleton = new Saying({ remembered });
    expect(ofSkeleton.answer("a")).toBe("up z");
    expect([ofSkeleton.reading, ofSkeleton.remembered]).toEqual([{ up: "z" }, true]);
    const ofNone = new Saying({ remembered });
    expect(ofNone.answer("constructor")).toBe("");
    expect(ofNone.remembered).toBe(false);
  });

  it("says nothing remembered where the file is to be read as it is", () => {
    expect(new Saying({ reading: {}, remembered: { a: { up: "z" } } }).answer("a")).toBe("");
  });
});

it("is a line for each thing", () => {
  const joints = { hips: "Bip01\nL", chest: null, neck: undefined };
  const reading = { up: "-z", floor: -0.93, mirrored: false, unit: undefined, joints } as unknown as FileReading;
  expect(linesOf(reading)).toBe("up -z\nfloor -0.93\nmirrored false\njoints\njoint hips Bip01\ufffdL\njoint chest");
});

describe("how a file was read", () => {
  it("is no guess in a clean file", () => {
    const read = fileRead(raw, [], said({}));
    expect([read.upFrom, read.sidesFrom, read.floorFrom, read.unitFrom, read.jointsFrom]).toEqual([
      "as-is",
      "as-is",
      "measured",
      "measured",
      "names",
    ]);
    expect(read.guesses).toEqual([]);
    expect([read.joints.hips, read.joints.spine, read.joints.chest]).toEqual(["Hips", "Spine", null]);
  });

  it("counts what can be corrected as guesses until a person says it", () => {
    const doubtful = { ...raw, up: "-y" as const, mirrored: true, confidence: 0.6 };
    expect(fileRead(doubtful, [], said({})).guesses).toEqual(["up", "sides", "joints"]);
    expect(fileRead(doubtful, [], said({ up: "-y", mirrored: true, joints: {} })).guesses).toEqual([]);
    expect(fileRead(raw, [{ code: "up-unsure", text: "" }], said({})).guesses).toEqual(["up"]);
  });

  it("is told in sentences, what may be wrong first", () => {
    expect(noteOf([{ code: "up", text: "Up is +Z in this file." }], "Matched all 21 joints.")).toBe(
      "Up is +Z in this file. Matched all 21 joints.",
    );
    expect(noteOf([], "")).toBe("");
  });
});

describe.skipIf(casesAbsent)("files of other programs", async () => {
  const [engine, motions] = await Promise.all([Engine.load(), loadBuiltIn()]);
  const database = engine.openDatabase({ kind: "demo", motions });
  const open = (name: string, reading?: FileReading) => {
    const bytes = new Uint8Array(readFileSync(caseFile(name))).buffer;
    const input = engine.openInput(database, { kind: "bvh", name, bytes, reading });
    const { info } = input;
    input.dispose();
    return info;
  };

  it("are read by the body, and their guesses are said", () => {
    expect(open("00_clean").reading).toMatchObject({ up: "y", mirrored: false, jointsFrom: "names", guesses: [] });
    const down = open("A05_ydown_full");
    expect(down.reading).toMatchObject({ up: "-y", upFrom: "guessed", guesses: ["up"] });
    expect(down.notes.map(({ code }) => code)).toContain("up");
    expect(open("A06_mirrored_lefthanded").reading).toMatchObject({ mirrored: true, guesses: ["sides"] });
    const low = open("A20_ground_-93").reading!;
    expect([low.floorFrom, low.guesses]).toEqual(["measured", []]);
    expect(low.floorMetres).toBeCloseTo(-0.93, 1);
    expect(low.heightMetres).toBeGreaterThan(1.5);
    expect(low.heightMetres).toBeLessThan(2);
  });

  it("are read as a person says, and then as they would have been", () => {
    const as = open("A05_ydown_full", { up: "y", floor: 0.5, mirrored: true, unit: 0.02 }).reading!;
    expect(as).toMatchObject({ up: "y", upFrom: "said", mirrored: true, sidesFrom: "said", guesses: [] });
    expect([as.floorMetres, as.floorFrom, as.metresPerUnit, as.unitFrom]).toEqual([0.5, "said", 0.02, "said"]);
    const clean = open("00_clean");
    const same = open("00_clean", { up: "y", mirrored: false, floor: clean.reading!.floorMetres });
    expect(same.poses).toEqual(clean.poses);
    expect(same.reading!.skeleton).toEqual(clean.reading!.skeleton);
  });

  it("refuse joints that there are not, and readings that are none", () => {
    expect(() => open("00_clean", { joints: { left_hand: "Paw" } })).toThrow(
      "This skeleton has no joint 'Paw', which was chosen as the left wrist.",
    );
    expect(() => open("00_clean", { up: "w" as "x" })).toThrow("There is no up axis 'w'");
    expect(() => open("00_clean", { unit: 0 })).toThrow("'unit 0' is not a valid length in metres.");
  });

  it("have the joints that were found as what can be said of them", () => {
    const found = open("00_clean");
    const same = open("00_clean", { joints: found.reading!.joints });
    expect(same.reading!.joints).toEqual(found.reading!.joints);
    expect(same.poses).toEqual(found.poses);
  });
});
