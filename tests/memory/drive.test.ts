/** The driving module's memory does not grow with the driven time: ten minutes of frames. */

import { readFileSync } from "node:fs";
import { gunzipSync } from "node:zlib";
import { expect, test } from "vitest";
import { DriverFrame, SPEED } from "../../web/engine/drive/driver";

const FRAMES = 36_000;
const RATE_HZ = 60;
const ENGINE = new URL("../../web/engine/", import.meta.url);

const glueOf = (pkg: string, name: string) => import(/* @vite-ignore */ new URL(`${pkg}/${name}.js`, ENGINE).href);
const moduleOf = (pkg: string, name: string) => readFileSync(new URL(`${pkg}/${name}_bg.wasm`, ENGINE));

test("memory does not grow while a character is driven", { timeout: 600_000 }, async () => {
  const glue: typeof import("../../web/engine/drive/pkg/strut_drive.js") = await glueOf("drive/pkg", "strut_drive");
  const { memory } = glue.initSync({ module: moduleOf("drive/pkg", "strut_drive") });
  const engine: typeof import("../../web/engine/pkg/strut_wasm.js") = await glueOf("pkg", "strut_wasm");
  engine.initSync({ module: moduleOf("pkg", "strut_wasm") });
  const takes = engine.Database.fromPacked(
    new engine.PackedMotions(gunzipSync(readFileSync(new URL("motions/drive.bin", ENGINE)))),
  );
  const [proportions, rateHz] = [takes.proportions(), takes.rateHz()];
  const clips = new glue.Clips(proportions, rateHz);
  for (const clip of takes.neutralClips())
    for (const among of [glue.Among.Own, glue.Among.Takes]) {
      const [name, action] = [takes.clipName(clip), takes.clipAction(clip)];
      clips.add(among, name, action, takes.clipPoses(clip), takes.clipContacts(clip), proportions, rateHz);
    }
  const driver = new glue.Driver(clips);
  clips.free();
  const frame = new DriverFrame();
  const round = Float32Array.from({ length: 240 }, (_, i) => (i % 2 ? 2 * Math.sin(i / 20) : 2 - 2 * Math.cos(i / 20)));
  let metres = 0;
  const drive = (frames: number) => {
    for (let i = 0; i < frames; i++) {
      const secs = i / RATE_HZ;
      if (i % 3000 === 1000) driver.setPath(round);
      if (i % 3000 === 2000) driver.setPath(new Float32Array());
      const way = Math.floor(secs / 3) * 2.1;
      const gait = Math.floor(secs) % 9 > 6 ? 0 : 1 + 0.5 * (1 + Math.sin(secs / 5));
      const [x, z] = gait > 0 ? [Math.sin(way), Math.cos(way)] : [0, 0];
      driver.next(x, z, gait, gait > 0 ? undefined : way + 1, undefined, frame.pose[0]!, frame.pose[2]!);
      driver.read(frame.numbers);
      metres += frame.numbers[SPEED]! / RATE_HZ;
    }
  };
  // The whole log once.
  drive(3000);
  const before = memory.buffer.byteLength;
  drive(FRAMES);
  expect(memory.buffer.byteLength).toBe(before);
  expect(metres).toBeGreaterThan(300);
});
