/**
 * The memory of the page's module does not grow with the walked time: 10,000 frames, or STRUT_MEMORY_FRAMES (100,000
 * take minutes).
 */

import { readFileSync } from "node:fs";
import { expect, test } from "vitest";
import { loadBuiltIn } from "../../web/engine/built_in";
import { POSE_FLOATS } from "../../web/humanoid";

const FRAMES = Number(process.env.STRUT_MEMORY_FRAMES ?? 10_000);
/** Number of frames per call. */
const BATCH = 30;

/** The part of the package that is used here. */
type Glue = typeof import("../../web/engine/pkg/strut_wasm.js");

test("memory does not grow while frames are styled", { timeout: 3_600_000 }, async () => {
  const folder = new URL("../../web/engine/pkg/", import.meta.url);
  const glue: Glue = await import(/* @vite-ignore */ new URL("strut_wasm.js", folder).href);
  const { memory } = glue.initSync({ module: readFileSync(new URL("strut_wasm_bg.wasm", folder)) });
  const motions = new glue.PackedMotions(await loadBuiltIn());
  const database = glue.Database.fromPacked(motions);
  const input = glue.Input.fromPacked(database, motions, motions.inputs()[0]!);
  const poses = input.poses();
  const stylizer = new glue.Stylizer(database);
  stylizer.setStyles(Float32Array.from(database.styles(), (_, style) => (style < 3 ? 1 / 3 : 0)));

  const total = poses.length / POSE_FLOATS;
  const style = (frames: number) => {
    for (let done = 0; done < frames; done += BATCH) {
      const first = (done % (total - BATCH)) * POSE_FLOATS;
      stylizer.push(poses.subarray(first, first + BATCH * POSE_FLOATS));
      // As the page does after every batch.
      stylizer.durations();
      stylizer.planted();
      stylizer.classWeights();
    }
  };
  // The whole input once, after which all buffers have their final size.
  style(total);
  const before = memory.buffer.byteLength;
  style(FRAMES);
  expect(memory.buffer.byteLength).toBe(before);
  console.log(`${FRAMES} frames, ${before / 1e6} MB before and after`);
});
