// node bench/crowd.mjs: what a tick of a crowd takes in WebAssembly, one thread, with reading everybody's joints.
import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import * as glue from "../web/engine/crowd/pkg/strut_crowd.js";

const COUNTS = [100, 200, 300, 1000];
/** Ticks that are not counted, and those that are. */
const [WARM, TICKS] = [60, 300];
const JOINT_FLOATS = 21 * 8;
/** Three styles as on a first visit, wider for more people: style number, then x, z, reach and intensity. */
const PLACES = [-3.4, 3.4, 3.2, 1, 4, 0.8, 3.2, 1.1, -1.5, -5.2, 4, 1];

glue.initSync({ module: readFileSync(new URL("../web/engine/crowd/pkg/strut_crowd_bg.wasm", import.meta.url)) });
const model = new glue.WalkModel(
  gunzipSync(readFileSync(new URL("../web/engine/motions/built_in.strutwalk", import.meta.url))),
);
const styles = model.styles().length;

for (const count of COUNTS) {
  const crowd = new glue.Crowd(model, count, 1);
  crowd.setField(Uint32Array.of(1, 2, 3), Float32Array.from(PLACES));
  const [joints, weights] = [new Float32Array(count * JOINT_FLOATS), new Uint8Array(count * styles)];
  const times = [];
  for (let i = 0; i < WARM + TICKS; i++) {
    const begin = performance.now();
    crowd.tick();
    crowd.read(joints, weights);
    if (i >= WARM) times.push(performance.now() - begin);
  }
  crowd.free();
  times.sort((a, b) => a - b);
  const at = (share) => times[Math.floor(share * (times.length - 1))].toFixed(2);
  console.log(`${count} walkers: ${at(0.5)} ms median, ${at(0.95)} ms p95, ${at(1)} ms most`);
}
