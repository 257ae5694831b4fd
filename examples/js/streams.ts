// Live streams, docs/live.md and the package's README: `npm test` checks the types.
import type { Character } from "strut-motion/three";

declare const character: Character;

// anchor stream
import { loadStrut } from "strut-motion";
import { webSocketPoses } from "strut-motion/streams";

const strut = await loadStrut();
const db = await strut.openDatabase("strut:walk");
const source = webSocketPoses("ws://127.0.0.1:39541", { format: "json" });
const live = await strut.live(db, source, { styles: { old: 1 } });
live.onFrame = ({ pose }) => character.apply(pose); // 87 numbers, 60 times a second
live.onTrouble = (sentence) => console.warn(sentence);
live.setStyles({ proud: 1 });
// end stream
