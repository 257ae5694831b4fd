/** Cost of a character's frame; timings are printed, not asserted. */
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { expect, test } from "vitest";
import { bindCharacter } from "../../web/character/character";
import { POSE_FLOATS } from "../../web/humanoid";
import { movingAnimation } from "../humanoid_animation";
import { FAMILIES } from "../rigs/families";
import { makeRig } from "../rigs/rig";

const FRAMES = 20_000;

test("a pose is applied in microseconds, and the module's memory stays as it is", async () => {
  const character = await bindCharacter(await new GLTFLoader().parseAsync(makeRig(FAMILIES[2]!).glb.buffer, ""));
  const { poses } = movingAnimation();
  const frames = Array.from({ length: 61 }, (_, f) => poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS));
  const perform = () => {
    for (let i = 0; i < FRAMES; i++) character.apply(frames[i % 61]!);
  };
  perform();
  const [start, heap] = [performance.now(), process.memoryUsage()];
  perform();
  const micros = (1000 * (performance.now() - start)) / FRAMES;
  const after = process.memoryUsage();
  console.info(
    `apply: ${micros.toFixed(1)} µs; heap ${((after.heapUsed - heap.heapUsed) / FRAMES).toFixed(0)} B a call before collection`,
  );
  // WebAssembly memory never shrinks.
  expect(after.arrayBuffers).toBeLessThanOrEqual(heap.arrayBuffers);
  character.dispose();
});
