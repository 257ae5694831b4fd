import { describe, expect, it } from "vitest";
import type { FileRead } from "../../../../client/protocol";
import { fileRead } from "../../../../engine/file_read";
import { ROLES } from "../../../../humanoid";
import { jointFile, readJointFile } from "./joint_file";
import { otherNotes } from "./other_notes";
import { rowTexts, saysOfSkeleton, saysRow, withoutRow } from "./rows";

const joints = ROLES.map((role) => `the ${role}`);
const raw = {
  frames: 240,
  rateHz: 60,
  up: "y" as const,
  mirrored: false,
  floor: -0.93,
  unit: 0.01,
  height: 1.744,
  confidence: 1,
  skeleton: "a",
  joints,
  roles: ROLES.map((_, i) => i as number | null),
};
const clean: FileRead = fileRead(raw, [], { reading: {}, remembered: false });

describe("the rows of how a file was read", () => {
  it("say of a clean file what was measured and named", () => {
    const texts = rowTexts(clean, []);
    expect(Object.values(texts).map(({ source }) => source)).toEqual([
      "measured",
      "by name",
      "measured",
      "measured",
      "by name",
    ]);
    expect(Object.values(texts).some(({ guessed }) => guessed)).toBe(false);
    expect(texts.unit.why).toBe("Makes the body 1.74 m tall");
    expect(texts.joints.why).toBe("All found by their names");
  });

  it("mark what was guessed, and say what is unsure in the words of the note", () => {
    const roles = raw.roles.map((joint, i) => (ROLES[i]!.endsWith("toes") ? null : joint));
    const odd = { ...raw, up: "z" as const, mirrored: true, confidence: 0.6, roles };
    const texts = rowTexts(fileRead(odd, [], { reading: {}, remembered: false }), [{ code: "no-floor", text: "" }]);
    expect([texts.up, texts.sides, texts.joints].every(({ guessed }) => guessed)).toBe(true);
    expect(texts.joints.why).toBe("Some found by the shape of the skeleton. No joint for: left toes, right toes");
    expect(texts.floor.why).toBe("No foot is planted: height of the lowest sole");
    const notes = [{ code: "up-unsure", text: "The body lies along +Z." }];
    expect(rowTexts(fileRead(raw, notes, { reading: {}, remembered: false }), notes).up.why).toBe(
      "The body lies along +Z.",
    );
  });

  it("say what a person said, now or before", () => {
    const reading = { up: "z", floor: 0, unit: 0.02, mirrored: true, joints: {} } as const;
    const now = rowTexts(fileRead(raw, [], { reading, remembered: false }), []);
    expect(Object.values(now).every(({ source }) => source === "set by you")).toBe(true);
    expect(now.up.why).toBe("Replaces the detected value");
    const before = rowTexts(fileRead(raw, [], { reading, remembered: true }), []);
    expect(before.up.why).toBe("From an earlier file with this skeleton");
  });

  it("leave the notes that no row says", () => {
    const codes = ["up", "floor", "mirrored", "cut", "floor-changes", "frame-count"];
    const notes = codes.map((code) => ({ code, text: code }));
    expect(otherNotes(notes).map(({ code }) => code)).toEqual(["cut", "floor-changes", "frame-count"]);
  });

  it("can be reset one by one", () => {
    const reading = { up: "z", mirrored: true, swapSides: true, floor: 1 } as const;
    expect(withoutRow(reading, "sides")).toEqual({ up: "z", floor: 1 });
    expect([saysRow(reading, "up"), saysRow(reading, "unit")]).toEqual([true, false]);
    expect([saysOfSkeleton(reading), saysOfSkeleton({ floor: 1 })]).toEqual([true, false]);
  });
});

describe("the file of joints", () => {
  it("is read as it was written", () => {
    expect(readJointFile("joints.json", jointFile(clean.joints))).toEqual({ joints: clean.joints });
    expect(readJointFile("joints.json", '{"joints": {"hips": "Bip01", "chest": null}}')).toEqual({
      joints: { hips: "Bip01", chest: null },
    });
  });

  it("is refused with a sentence where it is none", () => {
    const fault = (text: string) => (readJointFile("a.json", text) as { fault: string }).fault;
    expect(fault("HIERARCHY")).toMatch(/^“a.json” is not a JSON file\./);
    for (const text of [
      "3",
      "null",
      "[]",
      "{}",
      '{"joints": []}',
      '{"joints": {"hips": 3}}',
      '{"joints": {}, "up": 1}',
    ])
      expect(fault(text), text).toMatch(/^“a.json” is not a joint mapping\. /);
    expect(fault('{"joints": {"tail": "Tail"}}')).toMatch(/^“a.json” has an unknown body part “tail”\./);
  });
});
