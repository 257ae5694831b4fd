// Characters in Node: `node characters.mjs FILE [FOLDER OF THE ASSETS]`. Prints the binding, or the error.
import { readFileSync } from "node:fs";
import { loadStrut } from "strut-motion";
import { loadCharacter, loadMotions } from "strut-motion/three";

const [file, assets] = process.argv.slice(2);
const strut = assets ? await loadStrut({ assets }) : undefined;
const bytes = new Uint8Array(readFileSync(file));
const said = await loadCharacter(bytes).then(
  ({ roles }) => ({ roles: Object.keys(roles).length }),
  ({ code, message }) => ({ code, message }),
);
const motions = "roles" in said ? (await loadMotions(bytes)).length : 0;
console.log(JSON.stringify({ ...said, motions }));
strut?.dispose();
