/** The package of the first seconds produces the same bits as the engine's own package. */
import { readFileSync } from "node:fs";
import { beforeAll, expect, test } from "vitest";
import { loadBuiltIn, type PackedMotions } from "../built_in";
import * as wholeGlue from "../pkg/strut_wasm.js";
import * as startGlue from "./pkg/strut_start.js";

/** The part of either package that is used here. */
type Glue = Pick<typeof startGlue, "Database" | "Input" | "PackedMotions" | "Stylizer" | "interpolatePoses">;

/** Number of poses per push. */
const BATCH = 7;

let motions: PackedMotions;
beforeAll(async () => {
  startGlue.initSync({ module: readFileSync(new URL("./pkg/strut_start_bg.wasm", import.meta.url)) });
  wholeGlue.initSync({ module: readFileSync(new URL("../pkg/strut_wasm_bg.wasm", import.meta.url)) });
  motions = await loadBuiltIn(undefined, "first");
});

/** All results that a page shows of the input in a style. */
function framesBy(glue: Glue, style: string) {
  const packed = new glue.PackedMotions(motions);
  const database = glue.Database.fromPacked(packed);
  const styles = database.styles();
  const names = packed.inputs();
  const input = glue.Input.fromPacked(database, packed, names[0]!);
  const stylizer = new glue.Stylizer(database);
  stylizer.configure(40, 0.1, 0.7, 3, 0.35, 0.5, true, true, true, "mar", undefined, undefined);
  stylizer.setStyles(Float32Array.from(styles, (name) => Number(name === style)));
  const poses = input.poses();
  const floats = (BATCH * poses.length) / input.frames();
  const styled = [];
  for (let at = 0; at < poses.length; at += floats) {
    const batch = stylizer.push(poses.subarray(at, at + floats));
    styled.push([batch, stylizer.durations(), stylizer.planted(), stylizer.classWeights()]);
  }
  const half = glue.interpolatePoses(poses.slice(0, floats / BATCH), poses.slice(floats, floats + floats / BATCH), 0.5);
  const facts = [database.frames(), database.rateHz(), database.actions(), database.neutral(), database.classes()];
  return { styles, names, contacts: input.contacts(), poses, half, facts, styled };
}

test("it styles the first motions as the whole engine does", () => {
  const { styles } = framesBy(startGlue, "");
  expect(styles).toContain("old");
  for (const style of styles) expect(framesBy(startGlue, style)).toEqual(framesBy(wholeGlue, style));
  expect(framesBy(startGlue, "old").styled).not.toEqual(framesBy(startGlue, "proud").styled);
});

test("it says what is wrong with what it cannot do", () => {
  const packed = new startGlue.PackedMotions(motions);
  const database = startGlue.Database.fromPacked(packed);
  const message = (call: () => unknown) => {
    try {
      call();
    } catch (error) {
      return (error as startGlue.EngineError).message;
    }
    return "";
  };
  expect(message(() => startGlue.Database.fromPacked(new startGlue.PackedMotions(new Uint8Array(9))))).toContain(
    "not packed motions",
  );
  expect(message(() => startGlue.Input.fromPacked(database, packed, "dance"))).toContain("'dance'");
});
