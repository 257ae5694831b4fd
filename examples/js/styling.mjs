// The code of the package's README that runs in Node. The folder has clips/, which `strut demo-db --bvh clips` wrote.

// anchor style
import { loadStrut } from "strut-motion";

const strut = await loadStrut();
const db = await strut.openDatabase("strut:walk");
const motion = await strut.openMotion("strut:neutral-walk");

const result = await strut.stylize(motion, db, { styles: { proud: 1 } });
const text = result.toBVH(); // on the motion's own skeleton
const [first] = result.trace; // what the engine did in every frame

// end style

import { readFileSync } from "node:fs";

const poses = await motion.poses(db);

// anchor push
const stylizer = await strut.createStylizer(db, { styles: { old: 1 } });
stylizer.setStyles({ proud: 0.5, old: 0.5 });
const styled = await stylizer.push(poses); // 87 numbers a frame: root x y z, then x y z w of 21 joints
// end push

const files = ["walk_neutral_001.bvh", "walk_old_001.bvh"].map(
  (name) => new File([readFileSync(`clips/${name}`)], name),
);
const clip = await strut.openMotion(readFileSync("clips/walk_depressed_001.bvh", "utf8"));

// anchor read
const take = await strut.openMotion(readFileSync("clips/walk_depressed_001.bvh", "utf8"), {
  reading: { up: "y", floor: 0, joints: { chest: null } }, // what you do not say is read from the body
});
for (const { code, text } of take.notes) console.warn(`${code}: ${text}`);
const guesses = take.reading?.guesses; // such as ["up"]
const joints = take.reading?.joints; // { hips: "Hips", chest: null, … }
// end read

// anchor own
const mine = await strut.openDatabase(files); // BVH files whose names say action and style: walk_old_1.bvh
const more = await strut.addStyle(mine, clip, "tired");
const file = await more.toFile(); // a .strutdb
// end own

const read = [guesses, joints?.chest];
console.log(
  JSON.stringify([
    text.slice(0, 9),
    first.frame,
    styled.poses.length / poses.length,
    more.info.styles,
    file.size,
    read,
  ]),
);
strut.dispose();
