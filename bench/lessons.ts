/** Times of the lessons' calls of the engine, measured in Node for `lessons.mjs`. */
import { readFile } from "node:fs/promises";
import { createLearnTable } from "../web/client/learn/learn_table";
import type { Look } from "../web/client/learn/protocol";
import { type AssetName, placeAssets } from "../web/engine/assets";
import { serveLearnPackage } from "../web/engine/learn/wasm";
import { LESSONS } from "../web/lessons/lessons";

export { KIND_NAMES } from "../web/figures/kinds";

export const LESSON_IDS = LESSONS.map(({ id }) => id);

/** A call of the engine: its time, milliseconds, and the specification's limit. */
export interface TimedCall {
  name: string;
  medianMs: number;
  boundMs: number;
}

/** The files of the engine, which cannot read files itself from a module that Vite runs. */
const FILES: readonly (readonly [AssetName, string])[] = [
  ["strut_learn_bg.wasm", "learn/pkg/strut_learn_bg.wasm"],
  ["strut_wasm_walk_bg.wasm", "walk/pkg/strut_wasm_walk_bg.wasm"],
  ["strut_wasm_key_style_bg.wasm", "key_style/pkg/strut_wasm_key_style_bg.wasm"],
  ["strut_wasm_build_bg.wasm", "build/pkg/strut_wasm_build_bg.wasm"],
  ["first.bin", "motions/first.bin"],
  ["built_in.bin", "motions/built_in.bin"],
  ["built_in.strutwalk", "motions/built_in.strutwalk"],
];

/** Measured frames of the default input. */
const FRAMES = { first: 100, count: 41, step: 7 };
/** The left knee about x. */
const SETTINGS = { dof: 3 * 14, k: 40, noise: 0, taper: true } as const;
/** 25 values of λ from 0.0001 to 10. */
const LAMBDAS = Array.from({ length: 25 }, (_, i) => 10 ** (-4 + (5 * i) / 24));

/** Measures each kind of call on the built-in database, after one warm-up call. */
export async function timeCalls(): Promise<TimedCall[]> {
  const read = async (path: string) =>
    new Uint8Array(await readFile(new URL(`../web/engine/${path}`, import.meta.url)));
  placeAssets(Object.fromEntries(await Promise.all(FILES.map(async ([name, path]) => [name, await read(path)]))));
  serveLearnPackage();
  const engine = createLearnTable();
  const look = (frame: number): Look => ({ input: { name: "neutral walk" }, styles: { old: 1 }, frame });
  const frames = Array.from({ length: FRAMES.count }, (_, i) => FRAMES.first + i * FRAMES.step);

  const timed = async (name: string, boundMs: number, call: (frame: number) => Promise<unknown>) => {
    await call(frames[0]!);
    const times: number[] = [];
    for (const frame of frames.slice(1)) {
      const begin = performance.now();
      await call(frame);
      times.push(performance.now() - begin);
    }
    return { name, boundMs, medianMs: median(times) };
  };
  const once = async (name: string, boundMs: number, call: () => Promise<unknown>) => {
    const begin = performance.now();
    await call();
    return { name, boundMs, medianMs: performance.now() - begin };
  };

  await engine.database();
  const calls = [
    // Each frame differs, and 60 frames before it are replayed.
    await timed("`at` and `classes`", 10, (frame) => engine.classes(look(frame))),
    await timed("`at` and `profile`, five frames", 12, (frame) => engine.profile(look(frame), { length: 5 })),
    await timed("`profile` alone, nine frames", 2, () => engine.profile(look(FRAMES.first), { length: 9 })),
    await timed("`neighbours` alone, K 40", 2, () => engine.neighbours(look(FRAMES.first), 40, {})),
    await timed("`sweep`, 25 λ, K 40", 60, () => engine.sweep(look(FRAMES.first), SETTINGS, LAMBDAS)),
    await timed("`sweep`, 25 λ, K 12", 60, () => engine.sweep(look(FRAMES.first), { ...SETTINGS, k: 12 }, LAMBDAS)),
    await timed("`sweep`, 25 λ, K 160", 60, () => engine.sweep(look(FRAMES.first), { ...SETTINGS, k: 160 }, LAMBDAS)),
  ];

  const clips = await engine.clips("walk");
  const [a, b] = ["neutral", "old"].map((style) => clips.find(({ name }) => name.includes(style)) ?? clips[0]!);
  const register = (by: "dtw" | "imw") => engine.register("walk", a!.cycles[1]!, b!.cycles[1]!, by);
  calls.push(await once("`register` for the first time, after `clips`", 2000, () => register("dtw")));
  calls.push(await timed("`register` by DTW", 100, () => register("dtw")));
  calls.push(await timed("`register` by IMW", 100, () => register("imw")));

  const path = (factor: number) =>
    engine.walkPath({ old: 1 }, { joint: 13, axis: 0 }, { variance: [1, factor, 1], rho: [0, 0] });
  calls.push(await once("`walkPath` for the first time (the model is opened)", 1000, () => path(1)));
  calls.push(await timed("`WalkModel.path`", 2, (frame) => path(frame / FRAMES.first)));

  calls.push(await once("`somn` for the first time (the model is learned)", 2000, () => engine.somn(0, false)));
  let updates = 0;
  const perCall = 100;
  const somn = await timed("", 0, () => {
    updates += perCall;
    return engine.somn(updates, false);
  });
  calls.push({ name: "`Somn.step`, an update", boundMs: 0.02, medianMs: somn.medianMs / perCall });
  return calls;
}

function median(values: readonly number[]): number {
  return values.toSorted((a, b) => a - b)[values.length >> 1]!;
}
