/**
 * Databases that do not fit are refused with a message; if memory runs out nevertheless, nothing that was open is lost.
 */

import { readFileSync } from "node:fs";
import { afterEach, expect, test } from "vitest";
import * as bench from "../../bench/pkg/simd/strut_bench.js";
import { crc32 } from "../../web/client/build/crc32";
import type { StrutClient } from "../../web/client/client";
import { createStrutClient } from "../../web/client/client";
import { loadBuiltIn } from "../../web/engine/built_in";
import type { SlicedFile } from "../../web/engine/database";
import { Engine } from "../../web/engine/engine";
import * as glue from "../../web/engine/pkg/strut_wasm.js";
import { DEFAULT_OPTIONS } from "../../web/engine/types";
import { POSE_FLOATS } from "../../web/humanoid";
import { InlineWorker } from "../inline_worker";

/** The 32-bit address space. */
const ADDRESSABLE = 2 ** 32;
const BYTES_OF_PAGE = 2 ** 16;

let client: StrutClient | undefined;
afterEach(() => client?.dispose());

/** Returns a client that plays the built-in database. */
async function playing(): Promise<StrutClient> {
  client = await createStrutClient({ spawn: () => new InlineWorker() });
  await client.openDatabase({ kind: "demo" });
  await client.openInput({ kind: "built-in", name: "neutral walk" });
  await client.seek(50);
  return client;
}

/** Returns a file whose header claims this number of frames, and that is otherwise empty. */
function forged(frames: number): File {
  const clip = {
    name: "a",
    action: "walk",
    style: "neutral",
    take: 1,
    frames,
    first_frame: 0,
    source: "",
    licence: "",
  };
  const skeleton = { names: [], parents: [], offsets_cm: [], roles: [] };
  const about = { version: "1.0", checksum: "00000000", generator: "test", rate_hz: 60, skeleton, pose_columns: [] };
  const strut = { ...about, actions: ["walk"], styles: ["neutral", "proud"], neutral: "neutral", clips: [clip] };
  const counterpart = { dtype: "F32", shape: [0, 2, 1], data_offsets: [0, 0] };
  const bytesWith = (json: string) => {
    const header = Buffer.from(JSON.stringify({ __metadata__: { strut: json }, counterpart }));
    const length = Buffer.alloc(8);
    length.writeBigUInt64LE(BigInt(header.length));
    return Buffer.concat([length, header]);
  };
  const blank = JSON.stringify(strut);
  const sum = crc32(bytesWith(blank)).toString(16).padStart(8, "0");
  return new File([bytesWith(blank.replace("00000000", sum))], "large.strutdb");
}

test("a file that is gone is refused with a sentence", async () => {
  const client = await playing();
  const before = await client.step(0);
  const engine = await Engine.load();
  const gone: SlicedFile = { size: 1e9, read: () => new Uint8Array() };
  expect(() => engine.openDatabase({ kind: "strutdb", name: "gone", bytes: gone })).toThrow(
    "The file could not be read.",
  );
  expect((await client.step(0)).pose).toEqual(before.pose);
});

test("a file that is read in slices opens as one that is in memory", async () => {
  bench.initSync({ module: readFileSync(new URL("../../bench/pkg/simd/strut_bench_bg.wasm", import.meta.url)) });
  const bytes = bench.Workload.procedural(50_000).database();
  const engine = await Engine.load();
  let slices = 0;
  const open = (read: SlicedFile["read"]) =>
    engine.openDatabase({ kind: "strutdb", name: "sliced", bytes: { size: bytes.length, read } });
  const sliced = open((begin, end) => {
    slices += 1;
    return bytes.slice(begin, end);
  });
  expect(slices).toBeGreaterThan(2);
  const whole = engine.openDatabase({ kind: "strutdb", name: "sliced", bytes: bytes.buffer as ArrayBuffer });
  expect(sliced.info).toEqual(whole.info);
  const input = engine.openInput(whole, { kind: "built-in", name: "neutral walk", motions: await loadBuiltIn() });
  const [a, b] = [sliced, whole].map((database) => {
    const stylizer = engine.createStylizer(database);
    stylizer.setWeights(Float32Array.from(database.info.styles, (_, style) => (style === 1 ? 1 : 0)));
    return stylizer.push(input.info.poses.subarray(0, 60 * POSE_FLOATS)).poses;
  });
  expect(a).toEqual(b);
  const gone = (begin: number, end: number) => {
    return bytes.slice(begin, begin > 0 ? begin : end);
  };
  expect(() => open(gone)).toThrow("The file could not be read.");
  expect(() => open((begin) => bytes.slice(begin, begin + 5))).toThrow("The file could not be read.");
});

const open = (file: File) => client!.openDatabase({ kind: "strutdb", name: "large", file });

/** Returns the engine's instance on this thread. */
function instance() {
  const module = readFileSync(new URL("../../web/engine/pkg/strut_wasm_bg.wasm", import.meta.url));
  // An existing instance's exports are returned.
  return glue.initSync({ module });
}

/** Allocates all of the instance's memory except for at most `left` bytes. */
function fill(left: number): void {
  const { memory, __wbindgen_malloc: allocate } = instance();
  for (let size = 2 ** 29; size >= BYTES_OF_PAGE; size /= 2)
    while (memory.buffer.byteLength + size + BYTES_OF_PAGE <= ADDRESSABLE - left) allocate(size - 64, 8);
}

/** Allocates all of it, including freed memory, except for pieces too small for the targets of 16 rows. */
function exhaust(): void {
  const { __wbindgen_malloc: allocate } = instance();
  for (let size = 2 ** 29; size >= 2 ** 11; size /= 2) {
    try {
      for (;;) allocate(size - 64, 8);
    } catch {
      // It traps when no space of this size is left.
    }
  }
}

test("a database of fifty million frames is refused by what its header says", async () => {
  const client = await playing();
  const before = await client.step(0);
  const bytes = instance().memory.buffer.byteLength;
  const sentence = /^The database has 50000000 frames: styling needs \d+ MB of memory; 3000 MB are available\.$/;
  await expect(open(forged(50_000_000))).rejects.toMatchObject({
    code: "bad-file",
    message: expect.stringMatching(sentence),
    hint: expect.stringContaining("build-db"),
  });
  expect(instance().memory.buffer.byteLength).toBe(bytes);
  expect((await client.step(0)).pose).toEqual(before.pose);
});

test("one for which there is no memory any more is refused, and what is open plays on", async () => {
  const client = await playing();
  const before = await client.step(0);
  fill(2 ** 29);
  await expect(open(forged(1_500_000))).rejects.toMatchObject({
    code: "bad-file",
    message: expect.stringMatching(/^The database has 1500000 frames: .* MB of memory; less is available\.$/),
  });
  expect((await client.step(0)).pose).toEqual(before.pose);
});

test("where memory runs out, a sentence says so, and all that was open is opened again", async () => {
  const client = await playing();
  const before = await client.step(0);
  const restarted = new Promise((resolve) => {
    client.onRestart = resolve;
  });
  exhaust();
  // There is no space for the targets of further styles.
  const styles = { proud: 0.2, old: 0.2, angry: 0.2, depressed: 0.2 };
  await client.configure({ ...DEFAULT_OPTIONS, styles });
  await expect(client.step(0.1)).rejects.toMatchObject({
    code: "fault",
    message: "The engine ran out of memory.",
  });
  expect(await restarted).toEqual({ why: "The engine ran out of memory.", lost: [], reason: "" });
  expect((await client.step(0)).inputFrame).toBeCloseTo(before.inputFrame, 5);
  expect(instance().memory.buffer.byteLength).toBeLessThan(ADDRESSABLE / 8);
});
