// The package's contract in Node. The consumer folder has the package, three.js and the files. Prints a report.
import { readFileSync, writeFileSync } from "node:fs";
import { loadStrut } from "strut-motion";
import * as THREE from "three";

const source = readFileSync("demo.strutdb").buffer;
const fileOrText = readFileSync("walk.bvh", "utf8");
const options = { styles: { old: 1 } };
const fractions = [];
const onProgress = ({ fraction }) => fractions.push(fraction);
const { signal } = new AbortController();

const strut = await loadStrut();
const db = await strut.openDatabase(source, { onProgress, signal });
const motion = await strut.openMotion(fileOrText);
const result = await strut.stylize(motion, db, { styles: { proud: 1 }, k: 40, rho: 0.7, onProgress, signal });
writeFileSync("package.bvh", result.toBVH());
const glb = result.toGLB();
const root = rigOf(glb);
const clip = result.toAnimationClip(THREE, root);
const vrma = result.toVRMA();

const poses = (await motion.poses(db)).slice(0, 87 * 20);
const live = await strut.createStylizer(db, options);
const before = await live.push(poses);
live.reset();
live.setStyles({ proud: 0.5, old: 0.5 });
const styled = await live.push(poses);

const playback = await strut.createPlayback(motion, db, options);
const played = await playback.step(0.5);

const other = await loadStrut();
const others = await other.openDatabase("strut:walk");
const refusals = [];
for (const wrong of [
  () => strut.openDatabase("strut:none"),
  () => strut.openMotion("strut:none"),
  () => strut.openMotion("missing.bvh"),
  () => strut.openMotion("HIERARCHY\nnothing"),
  () => strut.stylize(motion, db, { styles: { nobody: 1 } }),
  () => strut.stylize(motion, db, { stiles: {} }),
  () => other.stylize(motion, db, {}),
  () => motion.poses(others),
  () => strut.stylize(motion, { info: db.info, dispose() {} }, {}),
  () => strut.stylize(motion, db, { signal: AbortSignal.abort() }),
])
  refusals.push(
    await wrong().then(
      () => "none",
      ({ code, message }) => `${code}: ${message}`,
    ),
  );

const walk = await strut.openDatabase("strut:walk");
const builtIn = await strut.openMotion("strut:neutral-walk");
const proud = await strut.stylize(builtIn, walk, { styles: { proud: 1 }, bvh: false });

console.log(
  JSON.stringify({
    thread: strut.thread,
    version: strut.version,
    motion: { name: motion.name, frames: motion.frames, rateHz: motion.rateHz, durationSecs: motion.durationSecs },
    trace: [result.trace.length, Object.keys(result.trace[0])],
    glb: glb.length,
    vrma: vrma.length,
    clip: { duration: clip.duration, tracks: clip.tracks.length, valid: clip.validate() },
    durationOutSecs: result.durationOutSecs,
    rising: fractions.every((fraction, i) => fraction <= 1 && (fraction >= (fractions[i - 1] ?? 0) || fraction === 0)),
    live: [before.poses.length, styled.poses.length, before.poses.some((value, i) => value !== styled.poses[i])],
    played: played.inputFrame,
    refusals,
    walk: {
      styles: walk.info.styles,
      actions: walk.info.actions,
      frames: builtIn.frames,
      out: proud.poses.length / 87,
    },
  }),
);
other.dispose();
strut.dispose();

/** Returns the joints of a GLB as three.js objects, as GLTFLoader would without the mesh. */
function rigOf(bytes) {
  const length = new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true);
  const { nodes } = JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length)));
  const objects = nodes.map(({ name }) => Object.assign(new THREE.Object3D(), { name }));
  for (const [i, { children = [] }] of nodes.entries()) for (const child of children) objects[i].add(objects[child]);
  return objects.find(({ name }) => name === "hips");
}
