/** Messages of senders, valid and hostile. */
import fc from "fast-check";
import { describe, expect, test } from "vitest";
import { POSE_FLOATS } from "../humanoid";
import { BINARY_FRAME_BYTES, readBinary, readBvh, readJson } from "./messages";

const number = fc.float({ noNaN: true, noDefaultInfinity: true });
const vector = (length: number) => fc.array(number, { minLength: length, maxLength: length });
const frame = fc.record({
  t: fc.double({ noNaN: true, noDefaultInfinity: true }),
  p: vector(3),
  q: fc.array(vector(4), { maxLength: 30 }),
});

describe("JSON", () => {
  test("a frame is its time, a place and rotations", () => {
    fc.assert(
      fc.property(frame, ({ t, p, q }) => {
        const message = readJson(JSON.stringify({ t, p, q }));
        // JSON has no negative zero.
        const plain = (numbers: Iterable<number>) => Array.from(numbers, (n) => n + 0);
        expect(message).toMatchObject({ kind: "frame", secs: JSON.parse(JSON.stringify(t)) });
        if (message?.kind === "frame")
          expect(plain(message.pose)).toEqual(plain(Float32Array.from([...p, ...q.flat()])));
      }),
    );
  });

  test("joints are told by their names, parents and offsets", () => {
    const joints = {
      names: ["hips", "spine"],
      parents: [-1, 0],
      offsets: [
        [0, 0, 0],
        [0, 10, 0],
      ],
      unit: 0.01,
    };
    const skeleton = { kind: "joints", ...joints, offsets: [0, 0, 0, 0, 10, 0] };
    expect(readJson(JSON.stringify({ strut: 1, ...joints }))).toEqual({ kind: "skeleton", skeleton });
    const { unit: _, ...withoutUnit } = joints;
    expect(readJson(JSON.stringify({ strut: 1, ...withoutUnit }))).toMatchObject({ kind: "skeleton" });
  });

  test.each([
    ["no JSON", "{"],
    ["no object", "[1]"],
    ["null", "null"],
    ["no time", '{"p":[0,0,0],"q":[]}'],
    ["a time that is text", '{"t":"1","p":[0,0,0],"q":[]}'],
    ["a time that is too large", '{"t":1e999,"p":[0,0,0],"q":[]}'],
    ["a place of two numbers", '{"t":1,"p":[0,0],"q":[]}'],
    ["a rotation of three numbers", '{"t":1,"p":[0,0,0],"q":[[0,0,1]]}'],
    ["a rotation with null", '{"t":1,"p":[0,0,0],"q":[[0,0,0,null]]}'],
    ["too many joints", JSON.stringify({ t: 1, p: [0, 0, 0], q: Array(513).fill([0, 0, 0, 1]) })],
    ["lists in lists", `{"t":1,"p":[0,0,0],"q":${"[".repeat(20_000)}${"]".repeat(20_000)}}`],
    ["another version", '{"strut":2,"names":["a"],"parents":[-1],"offsets":[[0,0,0]]}'],
    ["a joint without a parent", '{"strut":1,"names":["a","b"],"parents":[-1],"offsets":[[0,0,0],[0,0,0]]}'],
    ["a parent that is half", '{"strut":1,"names":["a"],"parents":[0.5],"offsets":[[0,0,0]]}'],
    ["an offset of two numbers", '{"strut":1,"names":["a"],"parents":[-1],"offsets":[[0,0]]}'],
    ["a unit below zero", '{"strut":1,"names":["a"],"parents":[-1],"offsets":[[0,0,0]],"unit":-1}'],
    ["no joint", '{"strut":1,"names":[],"parents":[],"offsets":[]}'],
  ])("%s is no message", (_, text) => {
    expect(readJson(text)).toBeUndefined();
  });

  test("whatever comes, nothing is thrown, and what is read has numbers only", () => {
    fc.assert(
      fc.property(fc.oneof(fc.json(), fc.string()), (text) => {
        const message = readJson(text);
        if (message?.kind === "frame") expect(message.pose.every((n) => !Number.isNaN(n))).toBe(true);
      }),
    );
  });
});

describe("binary", () => {
  test("a frame is a time and a pose", () => {
    fc.assert(
      fc.property(fc.double({ noNaN: true, noDefaultInfinity: true }), vector(POSE_FLOATS), (secs, pose) => {
        const bytes = new DataView(new ArrayBuffer(BINARY_FRAME_BYTES));
        bytes.setFloat64(0, secs, true);
        for (const [i, value] of pose.entries()) bytes.setFloat32(8 + 4 * i, value, true);
        expect(readBinary(bytes.buffer)).toEqual({ kind: "frame", secs, pose: Float32Array.from(pose) });
      }),
    );
  });

  test("bytes of another number, or without a time, are no message", () => {
    for (const bytes of [0, 8, BINARY_FRAME_BYTES - 1, BINARY_FRAME_BYTES + 1])
      expect(readBinary(new ArrayBuffer(bytes))).toBeUndefined();
    const untimed = new DataView(new ArrayBuffer(BINARY_FRAME_BYTES));
    untimed.setFloat64(0, Number.NaN, true);
    expect(readBinary(untimed.buffer)).toBeUndefined();
  });
});

describe("BVH", () => {
  const channels = (text: string) => {
    const message = readBvh(text);
    return message?.kind === "frame" ? [...message.pose] : message;
  };

  test("first the joints, then channels", () => {
    const header = "HIERARCHY\nROOT hips\n{\n}\nMOTION\nFrames: 0\nFrame Time: 0.01";
    expect(readBvh(header)).toEqual({ kind: "skeleton", skeleton: { kind: "bvh", header } });
    expect(readBvh("1 -2.5 3e2")).toEqual({ kind: "frame", secs: undefined, pose: Float32Array.of(1, -2.5, 300) });
  });

  test("what motion capture programs write around them is skipped", () => {
    expect(channels("0 Avatar00 1 2 3 ||")).toEqual([1, 2, 3]);
    expect(channels("Char-00 1 2 3||\r\n")).toEqual([1, 2, 3]);
    expect(channels("1 2 3")).toEqual([1, 2, 3]);
  });

  test.each(["", "||", "1 2 NaN", "1 2 Infinity", "1 0x10", "one two three", "0 name", "1 2 3e"])(
    "%j is no frame",
    (text) => {
      expect(readBvh(text)).toBeUndefined();
    },
  );

  test("whatever comes, nothing is thrown", () => {
    fc.assert(fc.property(fc.string(), (text) => void readBvh(text)));
  });
});
