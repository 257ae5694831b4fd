// node bench/crowd.mjs: time of a crowd's tick in WebAssembly, on one thread, including the reading of all joints: of
// walkers, and of performers of the first built-in input.
import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import * as crowds from "../web/engine/crowd/pkg/strut_crowd.js";
import * as performers from "../web/engine/performers/pkg/strut_performers.js";
import * as engine from "../web/engine/pkg/strut_wasm.js";

const COUNTS = [100, 200, 300, 1000];
/** Number of warm-up ticks, and of measured ticks. */
const [WARM, TICKS] = [60, 300];
const JOINT_FLOATS = 21 * 8;
/** Three styles as on a first visit, spread wider for more people: style index, then x, z, radius and intensity. */
const PLACES = [-3.4, 3.4, 3.2, 1, 4, 0.8, 3.2, 1.1, -1.5, -5.2, 4, 1];

const read = (path) => readFileSync(new URL(`../web/engine/${path}`, import.meta.url));
const load = (glue, path) => glue.initSync({ module: read(path) }).memory;

function measure(name, styles, memory, make) {
  for (const count of COUNTS) {
    const crowd = make(count);
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
    const mb = (memory.buffer.byteLength / 1e6).toFixed(1);
    console.log(`${count} ${name}: ${at(0.5)} ms median, ${at(0.95)} ms p95, ${at(1)} ms most; ${mb} MB`);
  }
}

/**
 * Returns the recording of the first built-in input in every built-in style, as the page's engine passes it to its
 * crowd.
 */
function recorded() {
  load(engine, "pkg/strut_wasm_bg.wasm");
  const motions = new engine.PackedMotions(gunzipSync(read("motions/first.bin")));
  const database = engine.Database.fromPacked(motions);
  const input = engine.Input.fromPacked(database, motions, motions.inputs()[0]);
  const recording = new engine.Recording(new engine.Stylizer(database), input, 0, input.frames());
  const begin = performance.now();
  const frames = recording.run(input.frames());
  const numbers = recording.numbers();
  const secs = ((performance.now() - begin) / 1000).toFixed(1);
  const styles = database.styles().length;
  console.log(
    `${frames} frames in ${styles} styles: recorded in ${secs} s, ${(numbers.byteLength / 1e6).toFixed(1)} MB`,
  );
  return { numbers, styles };
}

const ofCrowds = load(crowds, "crowd/pkg/strut_crowd_bg.wasm");
const model = new crowds.WalkModel(gunzipSync(read("motions/built_in.strutwalk")));
measure("walkers", model.styles().length, ofCrowds, (count) => new crowds.Crowd(model, count, 1));

const { numbers, styles } = recorded();
const ofPerformers = load(performers, "performers/pkg/strut_performers_bg.wasm");
measure("performers", styles, ofPerformers, (count) => new performers.Performers(numbers, count, 1));
