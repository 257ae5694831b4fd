// Error messages in Node for missing files of the package: each is removed in turn. Prints a report.
import { readFileSync, renameSync } from "node:fs";
import { loadStrut } from "strut-motion";

const clips = ["neutral", "old"].map((style) => {
  const name = `walk_${style}_001.bvh`;
  return new File([readFileSync(`clips/${name}`)], name);
});
/** Uses of each file. */
const uses = {
  "walk.bin": (strut) => strut.openDatabase("strut:walk"),
  "built_in.bin": (strut) => strut.openDatabase("strut:built-in"),
  "strut_wasm_build_bg.wasm": (strut) => strut.openDatabase(clips),
  "strut_wasm_walk_bg.wasm": (strut) => strut.openWalk("strut:walk"),
  "strut_wasm_key_style_bg.wasm": (strut) => strut.openKeyStyle("strut:walk"),
  "strut_live_bg.wasm": async (strut) => strut.live(await strut.openDatabase("strut:walk"), { start: async () => {} }),
};
const report = {};
for (const [file, use] of Object.entries(uses)) {
  const path = `node_modules/strut-motion/assets/${file}`;
  const said = async () => {
    const strut = await loadStrut();
    const answer = await use(strut).then(
      () => "done",
      ({ code, message }) => `${code}: ${message}`,
    );
    strut.dispose();
    return answer;
  };
  renameSync(path, `${path}.away`);
  const missing = await said();
  renameSync(`${path}.away`, path);
  // A missing file is requested again later.
  report[file] = [missing, await said()];
}
console.log(JSON.stringify(report));
