/** Clips for tests that need several styles: the built-in walk, styled by the engine and written as BVH. */
import "../web/engine/whole";
import { loadBuiltIn } from "../web/engine/built_in";
import { Engine } from "../web/engine/engine";
import { DEFAULT_OPTIONS } from "../web/engine/types";

/** Default number of frames of a clip of `walksIn`: about four steps. */
const FRAMES = 150;

/** Returns BVH texts of a walk in each of these styles of the built-in database, at 60 Hz. */
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

/** Returns every nth frame of a clip, at most `most` frames. */
export function everyNth(bvh: string, n: number, most = Number.MAX_SAFE_INTEGER): string {
  const [, head, time, body] = /^([\s\S]*)Frames:\s*\d+\s*Frame Time:\s*(\S+)\s*([\s\S]*)$/.exec(bvh)!;
  const lines = body!.trimEnd().split("\n");
  const kept = lines.filter((_, i) => i % n === 0).slice(0, most);
  return `${head}Frames: ${kept.length}\nFrame Time: ${Number(time) * n}\n${kept.join("\n")}\n`;
}

/** Returns the clip with another frame rate: faster or slower, not resampled. */
export function playedAt(bvh: string, rateHz: number): string {
  return bvh.replace(/Frame Time:\s*\S+/, `Frame Time: ${(1 / rateHz).toFixed(7)}`);
}

/** Parts of joint names in another convention; those of arms and legs depend on their side. */
const FOREIGN_NAMES: readonly [ours: RegExp, theirs: string][] = [
  [/UpperArm$/, "Arm"],
  [/LowerArm$/, "ForeArm"],
  [/UpperLeg$/, "UpLeg"],
  [/LowerLeg$/, "Leg"],
  [/Toes$/, "ToeBase"],
  [/^Chest$/, "Spine1"],
];

/**
 * Returns the clip as another tool would write it: other joint names, inches instead of centimetres, and 30 frames per
 * second.
 */
export function asForeignTool(bvh: string): string {
  const inches = (centimetres: string) => (Number(centimetres) / 2.54).toFixed(5);
  const [hierarchy, motion] = everyNth(bvh, 2).split("MOTION\n") as [string, string];
  const named = hierarchy
    .replace(/(ROOT|JOINT) (\S+)/g, (_, kind, name) => {
      const [ours, theirs] = FOREIGN_NAMES.find(([pattern]) => pattern.test(name)) ?? [/$/, ""];
      return `${kind} Actor_${name.replace(ours, theirs)}`;
    })
    .replace(/OFFSET (\S+) (\S+) (\S+)/g, (_, ...offset) => `OFFSET ${offset.slice(0, 3).map(inches).join(" ")}`);
  const [frames, time, ...lines] = motion.trimEnd().split("\n");
  const poses = lines.map((line) => {
    const values = line.split(" ");
    return [...values.slice(0, 3).map(inches), ...values.slice(3)].join(" ");
  });
  return `${named}MOTION\n${[frames, time, ...poses].join("\n")}\n`;
}
