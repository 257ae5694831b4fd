// A live stylizer for a number of pushes of one pose: its memory, and the overhead of a push. Prints a report.
import { loadStrut } from "strut-motion";

const PUSHES = Number(process.argv[2]);
const strut = await loadStrut();
const db = await strut.openDatabase("strut:walk");
const motion = await strut.openMotion("strut:neutral-walk");
const poses = await motion.poses(db);
const frames = poses.length / 87;
const live = await strut.createStylizer(db, { styles: { proud: 1 } });
const pushes = async (count) => {
  for (let i = 0; i < count; i++) {
    // The first use of a style takes memory, which later uses share.
    if (i % 500 === 250) live.setStyles({ old: (i % 3) / 2 });
    const at = 87 * (i % frames);
    await live.push(poses.subarray(at, at + 87));
  }
};
const state = async () => {
  // Another thread releases buffers some time after the collection: wait until a second brings no more.
  let least = Number.POSITIVE_INFINITY;
  for (let idle = 0; idle < 20; idle++) {
    globalThis.gc();
    await new Promise((resolve) => setTimeout(resolve, 50));
    const { arrayBuffers } = process.memoryUsage();
    if (arrayBuffers < least) [least, idle] = [arrayBuffers, 0];
  }
  const { heapUsed, arrayBuffers } = process.memoryUsage();
  return { heap: heapUsed, arrayBuffers, wasm: (await strut.memory()).wasmBytes };
};

await pushes(PUSHES / 10);
const before = await state();
await pushes(PUSHES);
const after = await state();

// The difference between frames one by one and in one call is the overhead of a push.
const timed = async (work) => {
  const started = performance.now();
  await work();
  return performance.now() - started;
};
const batch = poses.slice(0, 87 * 500);
live.reset();
const single = await timed(() => pushes(500));
live.reset();
const whole = await timed(() => live.push(batch));

// As soon as the clip has started: a fast machine finishes it in a few milliseconds.
const controller = new AbortController();
let aborted = Number.NaN;
const onProgress = () => {
  aborted = performance.now();
  controller.abort();
};
const code = await strut.stylize(motion, db, { signal: controller.signal, onProgress }).then(
  () => "none",
  ({ code }) => code,
);
console.log(
  JSON.stringify({
    before,
    after,
    overheadMs: (single - whole) / 500,
    abort: { code, ms: performance.now() - aborted },
  }),
);
strut.dispose();
