import { writeFileSync } from "node:fs";
import { loadStrut } from "strut-motion";

const strut = await loadStrut();
const database = await strut.openDatabase("strut:walk"); // or the URL of a .strutdb file
const motion = await strut.openMotion("strut:neutral-walk"); // or the URL or the text of a BVH file

const styled = await strut.stylize(motion, database, { styles: { proud: 0.7 } });
writeFileSync("walk-proud.bvh", styled.toBVH());

strut.dispose();
