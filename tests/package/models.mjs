// Builds and trains with the package in Node. Writes files for the comparison with the command, and prints a report.
import { readFileSync, writeFileSync } from "node:fs";
import { loadStrut } from "strut-motion";

const strut = await loadStrut();
const fractions = [];
const onProgress = ({ fraction }) => fractions.push(fraction);
const names = ["walk_neutral_001.bvh", "walk_old_001.bvh", "walk_proud_001.bvh"];
// Like the files of a folder in a browser.
const files = names.map((name) => {
  const file = new File([readFileSync(`clips/${name}`)], name);
  return Object.defineProperty(file, "webkitRelativePath", { value: `two/${name}` });
});
const built = await strut.openDatabase(files.slice(0, 2), { onProgress });
writeFileSync("built.strutdb", Buffer.from(await (await built.toFile()).arrayBuffer()));

const motion = await strut.openMotion(files[2]);
const more = await strut.addStyle(built, motion, "cross");
writeFileSync("more.strutdb", Buffer.from(await (await more.toFile()).arrayBuffer()));
const styled = await strut.stylize(motion, more, { styles: { cross: 1 } });

const walk = await strut.openWalk("strut:walk", { onProgress });
const keys = await strut.openKeyStyle("strut:walk", { axes: ["foot_separation"] });
const refusals = [];
for (const wrong of [
  () => strut.openDatabase([]),
  () => strut.openDatabase([new File(["x"], "x.txt")]),
  () => strut.openDatabase([new File([readFileSync("walk.bvh")], "1.bvh")]),
  () => strut.openWalk(new Blob(["no model"])),
  () => strut.openKeyStyle("strut:walk", { axes: ["nonsense("] }),
  async () => strut.addStyle(built, await strut.openMotion("strut:neutral-walk"), "x"),
  async () => (await strut.openDatabase("strut:walk")).toFile(),
  () => strut.openWalk("strut:walk", { signal: AbortSignal.abort() }),
])
  refusals.push(
    await wrong().then(
      () => "none",
      ({ code, message }) => `${code}: ${message}`,
    ),
  );

console.log(
  JSON.stringify({
    built: built.info.styles,
    more: more.info.styles,
    styled: styled.poses.length > 0,
    walk: { styles: walk.styles.length, pose: walk.walker().next().pose.length },
    keys: keys.axes,
    last: fractions.at(-1),
    refusals,
  }),
);
strut.dispose();
