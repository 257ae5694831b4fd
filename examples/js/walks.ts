// Walks without an input, the package's README: `npm test` checks the types.
import { loadStrut } from "strut-motion";

const strut = await loadStrut();
const mine = await strut.openDatabase("styles.strutdb");

// anchor walk
const model = await strut.openWalk(mine); // trained on the database; or a .strutwalk file
const walker = model.walker();
const { pose } = walker.next(); // walks without end, a frame in microseconds
// end walk

console.log(pose);
