/** The engine without a page, as docs/ARCHITECTURE.md shows it. */
// anchor engine
import "../../web/engine/whole";
import { loadBuiltIn } from "../../web/engine/built_in";
import { Engine } from "../../web/engine/engine";
import { DEFAULT_OPTIONS } from "../../web/engine/types";

const [engine, motions] = await Promise.all([Engine.load(), loadBuiltIn()]);
const database = engine.openDatabase({ kind: "demo", motions });
const input = engine.openInput(database, { kind: "built-in", name: "neutral walk", motions });
const stylizer = engine.createStylizer(database, { ...DEFAULT_OPTIONS, styles: { proud: 0.7 } });
const job = engine.createClipJob(input, stylizer);
while (!job.run(60));
const bvh = job.toBvh();

// end engine

export { bvh };
