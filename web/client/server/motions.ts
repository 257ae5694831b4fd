/** Calls about motions, which are retargeted to the humanoid of every database with which they are used. */
import type { ClipJob } from "../../engine/clip_job";
import type { InputSource as EngineInputSource, Input } from "../../engine/input";
import type { InputInfo, InputSource, MotionFacts, Performed, StyledClip, StylizeOptions } from "../protocol";
import type { Caller } from "../rpc_server";
import { OpenDatabase } from "./databases";
import type { Host } from "./host";
import type { OpenThing } from "./registry";
import { runToEnd, stage } from "./time_slices";

export class OpenMotion implements OpenThing {
  static readonly noun = "motion";
  readonly uses = [];

  constructor(readonly source: InputSource) {}

  dispose(): void {}
}

/** A motion on the humanoid of a database. */
export class CarriedMotion implements OpenThing {
  static readonly noun = "motion";
  readonly uses: readonly number[];

  constructor(
    readonly input: Input,
    motion: number,
    database: number,
  ) {
    this.uses = [motion, database];
  }

  static keyOf(motion: number, database: number): string {
    return `${motion} on ${database}`;
  }

  dispose(): void {
    this.input.dispose();
  }
}

export function openMotion({ open }: Host, _: Caller, id: number, source: InputSource): undefined {
  open.add(id, new OpenMotion(source));
}

export async function readMotion(host: Host, caller: Caller, motion: number): Promise<MotionFacts> {
  const { source } = host.open.get(OpenMotion, motion);
  await stage(caller, "Reading the motion", 0);
  return host.engine.readMotion(await fileOf(host, caller, source));
}

export async function motionOn(host: Host, caller: Caller, motion: number, database: number): Promise<InputInfo> {
  return copyOf((await carriedMotion(host, caller, motion, database)).input.info);
}

export async function stylize(
  host: Host,
  caller: Caller,
  motion: number,
  database: number,
  options: StylizeOptions,
  bvh: boolean,
): Promise<StyledClip> {
  const carried = await carriedMotion(host, caller, motion, database);
  const { job, frameMs } = await styleClip(host, caller, carried, database, options);
  try {
    const result = job.result();
    const notes = [...carried.input.info.notes, ...result.notes];
    return { ...result, frameMs, bvh: bvh ? job.toBvh() : "", notes };
  } finally {
    job.dispose();
  }
}

export function counterpart(
  { open, counterparts }: Host,
  _: Caller,
  motion: number,
  style: string,
): Performed | undefined {
  const { source } = open.get(OpenMotion, motion);
  return source.kind === "built-in" ? counterparts(source.name, style) : undefined;
}

/** A motion on a database's humanoid, read once for each database. */
export async function carriedMotion(
  host: Host,
  caller: Caller,
  motion: number,
  database: number,
): Promise<CarriedMotion> {
  const { source } = host.open.get(OpenMotion, motion);
  const key = CarriedMotion.keyOf(motion, database);
  const known = host.open.find(CarriedMotion, key);
  if (known) return known;
  await stage(caller, "Reading the motion", 0);
  const input = await readInput(host, caller, source, database);
  const meanwhile = host.open.find(CarriedMotion, key);
  if (!meanwhile) return host.open.add(key, new CarriedMotion(input, motion, database));
  input.dispose();
  return meanwhile;
}

/**
 * Styles a whole motion in time slices; the caller owns the job. `frameMs` is the mean cost of a frame.
 * @throws StrutError `cancelled`, also if the motion or the database is closed meanwhile
 */
export async function styleClip(
  { engine, open }: Host,
  caller: Caller,
  carried: CarriedMotion,
  database: number,
  options: StylizeOptions,
  owner: OpenThing = carried,
): Promise<{ job: ClipJob; frameMs: number }> {
  const stylizer = engine.createStylizer(open.get(OpenDatabase, database).database, options);
  let job: ClipJob | undefined;
  try {
    job = engine.createClipJob(carried.input, stylizer, options.track);
    const isCancelled = () => caller.isCancelled() || !open.has(owner);
    return { job, frameMs: await runToEnd(job, { ...caller, isCancelled }) };
  } catch (thrown) {
    job?.dispose();
    throw thrown;
  } finally {
    stylizer.dispose();
  }
}

async function readInput(host: Host, caller: Caller, source: InputSource, database: number): Promise<Input> {
  const file = await fileOf(host, caller, source);
  return host.engine.openInput(host.open.get(OpenDatabase, database).database, file);
}

/** A source with the bytes of its file, or with its set of built-in motions. */
async function fileOf({ builtIn }: Host, caller: Caller, source: InputSource): Promise<EngineInputSource> {
  if (source.kind === "built-in") return { ...source, motions: await builtIn.load(caller, source.set) };
  const { bytes } = source;
  return { ...source, bytes: "size" in bytes ? await bytes.arrayBuffer() : bytes };
}

/** Sent arrays are transferred; the worker keeps its own. */
function copyOf(info: InputInfo): InputInfo {
  return { ...info, poses: info.poses.slice(), contacts: info.contacts.slice() };
}
