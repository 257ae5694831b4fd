/** Clips for tests that need several styles: the built-in walk, styled by the engine and written as BVH. */
import { loadBuiltIn } from "../web/engine/built_in";
import { Engine } from "../web/engine/engine";
import { DEFAULT_OPTIONS } from "../web/engine/stylizer";

/** Frames that a clip of `clipsIn` has unless it says otherwise: about four steps. */
const FRAMES = 150;

/** BVH text of a walk of some frames in each of these styles of the built-in database, at 60 Hz. */
export async function walksIn<S extends string>(styles: readonly S[], frames = FRAMES): Promise<Record<S, string>> {
  const [engine, motions] = await Promise.all([Engine.load(), loadBuiltIn()]);
  const database = engine.openDatabase({ kind: "demo", motions });
  const input = engine.openInput(database, { kind: "built-in", name: engine.inputsOf(motions)[0]!, motions });
  const walk = (style: S) => {
    const stylizer = engine.createStylizer(database, { ...DEFAULT_OPTIONS, styles: { [style]: 1 } });
    const job = engine.createClipJob(input, stylizer);
    while (!job.run(1000));
    return everyNth(job.toBvh(), 1, frames);
  };
  return Object.fromEntries(styles.map((style) => [style, walk(style)])) as Record<S, string>;
}

/** The clip with every nth of its frames, at most so many. */
export function everyNth(bvh: string, n: number, most = Number.MAX_SAFE_INTEGER): string {
  const [, head, time, body] = /^([\s\S]*)Frames:\s*\d+\s*Frame Time:\s*(\S+)\s*([\s\S]*)$/.exec(bvh)!;
  const lines = body!.trimEnd().split("\n");
  const kept = lines.filter((_, i) => i % n === 0).slice(0, most);
  return `${head}Frames: ${kept.length}\nFrame Time: ${Number(time) * n}\n${kept.join("\n")}\n`;
}

/** The clip as if it had been recorded at another rate: faster or slower, not resampled. */
export function playedAt(bvh: string, rateHz: number): string {
  return bvh.replace(/Frame Time:\s*\S+/, `Frame Time: ${(1 / rateHz).toFixed(7)}`);
}
