/** The build worker's side of the protocol: the open files, and the results made from them. */
import { type Build, DatabaseBuilder, type OnBuildProgress } from "../../engine/build/builder";
import { KeyStyleClips, type KeyStyleOrder, type TrainedKeyStyle } from "../../engine/build/key_style_training";
import { type TrainedWalk, trainWalk } from "../../engine/build/walk_training";
import { buildModule } from "../../engine/build/wasm";
import { loadBuiltIn } from "../../engine/built_in";
import { cancelled } from "../../engine/errors";
import type { Progress } from "../../engine/types";
import type { ResultOf } from "../rpc";
import { answerCalls, type Caller, type ServerPort } from "../rpc_server";
import { otherMessages } from "../server/time_slices";
import type {
  BuildCalls,
  BuiltDatabase,
  ChosenFile,
  DroppedFile,
  Found,
  Labelled,
  ReadClip,
  ReadEvent,
  RefusedFile,
  Skeleton,
} from "./protocol";
import { trainedOnce } from "./saved_walk_models";
import { findSources, folderOf, LICENCE_NAMES, reasonOf, type Source } from "./sources";

/** Maximum number of bytes of a table of labels. */
const MAX_TABLE_BYTES = 64 << 20;
/** Time between two reports of clips that were read, milliseconds. */
const EVENT_MS = 300;
/** Shares of a build's time: reading, preparing, registering; the rest is indexing. */
const SHARES = { reading: 0.2, preparing: 0.15, registering: 0.6 };

/** Share of reading in the training time of a walk model, and of a key-style model. */
const TRAIN_READING = 0.15;
const KEY_STYLE_READING = 0.3;

/** Answers the calls that arrive at `port`. */
export function serveBuilds(port: ServerPort): void {
  const server = new BuildServer(DatabaseBuilder.load());
  answerCalls(port, (method, args, caller) => server.answer(method as keyof BuildCalls, args, caller));
}

/** An unfinished build. */
interface BegunBuild {
  /** Identity of the build's request. */
  readonly key: string;
  readonly build: Build;
  /** Number of files that were read, and those that could not be read. */
  read: number;
  readonly unread: RefusedFile[];
  /** The database, if only its answer was cancelled. */
  built: BuiltDatabase | undefined;
}

/** The calls that concern open files. */
type BuildAnswers = {
  [M in Exclude<keyof BuildCalls, "open">]: (...args: Parameters<BuildCalls[M]>) => Promise<ResultOf<BuildCalls, M>>;
};

class BuildServer {
  private clips: Source[] = [];
  /** Every other call concerns the files that were opened before it. */
  private opening: Promise<Found> | undefined;
  private begun: BegunBuild | undefined;

  constructor(private readonly loading: Promise<DatabaseBuilder>) {
    // The first call reports the load error.
    loading.catch(() => {});
  }

  async answer(method: keyof BuildCalls, args: unknown[], caller: Caller): Promise<unknown> {
    if (method === "open") {
      const [files] = args as Parameters<BuildCalls["open"]>;
      this.opening = this.loading.then((builder) => this.open(builder, files));
      return this.opening;
    }
    const [builder] = await Promise.all([this.loading, this.opening]);
    const answers: BuildAnswers = {
      label: (pattern, table) => this.label(builder, pattern, table),
      readAll: () => this.readAll(builder, caller),
      preview: async (index, roles) => builder.preview(await this.clips[index]!.read(), roles),
      build: (files, neutral) => this.build(builder, files, neutral, caller),
      addStyle: (...given) => this.addStyle(builder, given, caller),
      trainWalk: (database) => this.trainWalk(database, caller),
      trainKeyStyle: (database, files, order) => this.trainKeyStyle(database, files, order, caller),
    };
    // A call pairs each method with its own arguments; TypeScript does not follow that through the index.
    return (answers[method] as (...args: unknown[]) => Promise<unknown>)(...args);
  }

  private async open(builder: DatabaseBuilder, files: DroppedFile[]): Promise<Found> {
    const { clips, licences, notes } = await findSources(files);
    this.clips = clips;
    this.forgetBuild();
    const titles = await titlesOf(builder, licences);
    return {
      clips: clips.map(({ path }) => ({ path, licence: titles.get(folderOf(path)) ?? "" })),
      pattern: builder.guessPattern(clips.map(({ path }) => path)),
      notes,
    };
  }

  private async label(
    builder: DatabaseBuilder,
    pattern: string | undefined,
    table: File | undefined,
  ): Promise<Labelled[]> {
    const bytes = table && new Uint8Array(await table.slice(0, MAX_TABLE_BYTES).arrayBuffer());
    return builder.labelsOf(
      this.clips.map(({ path }) => path),
      pattern,
      bytes,
    );
  }

  private async readAll(builder: DatabaseBuilder, caller: Caller): Promise<undefined> {
    const known = new Map<string, number>();
    let event: ReadEvent = { clips: [], skeletons: [] };
    let told = performance.now();
    const tell = (done: number) => {
      const total = this.clips.length;
      const progress: Progress & ReadEvent = {
        label: `Reading ${clipsOf(total)}, ${done} done.`,
        fraction: done / total,
        ...event,
      };
      caller.report(progress);
      event = { clips: [], skeletons: [] };
      told = performance.now();
    };
    for (const [index, clip] of this.clips.entries()) {
      event.clips.push(await readClip(builder, clip, index, known, event.skeletons));
      if (performance.now() - told > EVENT_MS) tell(index + 1);
    }
    tell(this.clips.length);
    return undefined;
  }

  private async addStyle(
    builder: DatabaseBuilder,
    [database, clip, style, action]: Parameters<BuildCalls["addStyle"]>,
    caller: Caller,
  ): Promise<BuiltDatabase> {
    const [known, bvh] = await Promise.all([bytesOf(database), clip.arrayBuffer()]);
    caller.report({ label: `Registering ${clip.name}.`, fraction: 0.2 });
    return builder.addStyle(known, clip.name, style, new Uint8Array(bvh), action);
  }

  private async trainWalk(database: Blob | undefined, caller: Caller): Promise<TrainedWalk> {
    const bytes = await bytesOf(database);
    return trainedOnce(buildModule(), bytes, () =>
      trainWalk(bytes, (stage, done, total) => caller.report(trainProgress(stage, done, total))),
    );
  }

  private async trainKeyStyle(
    database: Blob | undefined,
    files: DroppedFile[],
    order: KeyStyleOrder,
    caller: Caller,
  ): Promise<TrainedKeyStyle> {
    const clips =
      files.length > 0
        ? await this.readKeyStyle(files, caller)
        : await KeyStyleClips.ofDatabase(await bytesOf(database));
    try {
      return clips.train(order, (done, total) => caller.report(keyStyleProgress(done, total)));
    } finally {
      clips.dispose();
    }
  }

  /** The clips of files and archives. Files that cannot be read are refused. */
  private async readKeyStyle(files: DroppedFile[], caller: Caller): Promise<KeyStyleClips> {
    const { clips } = await findSources(files);
    const read: { name: string; bytes: Uint8Array }[] = [];
    const unread: RefusedFile[] = [];
    for (const [done, { path, read: bytes }] of clips.entries()) {
      const label = `Reading ${clipsOf(clips.length)}, ${done} done.`;
      caller.report({ label, fraction: (KEY_STYLE_READING * done) / clips.length });
      const content = await bytes().catch((thrown) => reasonOf(thrown));
      if (typeof content === "string") unread.push({ path, reason: content });
      else read.push({ name: path.replace(/^.*\//, "").replace(/\.bvh$/i, ""), bytes: content });
    }
    const made = await KeyStyleClips.ofFiles(read);
    made.refused.push(...unread);
    return made;
  }

  private async build(
    builder: DatabaseBuilder,
    files: ChosenFile[],
    neutral: string | undefined,
    caller: Caller,
  ): Promise<BuiltDatabase> {
    const total = files.length;
    const byPath = new Map(files.map((file) => [file.path, file]));
    const key = JSON.stringify([files, neutral]);
    if (this.begun?.key !== key) {
      this.forgetBuild();
      this.begun = { key, build: builder.begin(files, neutral), read: 0, unread: [], built: undefined };
    }
    const { begun } = this;
    const { build, unread } = begun;
    // A failed build cannot continue; only a pause keeps it.
    this.begun = undefined;
    while (begun.read < build.order.length) {
      const done = begun.read;
      const path = build.order[done]!;
      caller.report({ label: `Reading ${clipsOf(total)}, ${done} done.`, fraction: (SHARES.reading * done) / total });
      const { index, roles } = byPath.get(path)!;
      const bytes = await this.clips[index]!.read().catch((thrown) => reasonOf(thrown));
      await this.mayPause(begun, caller);
      try {
        if (typeof bytes === "string") unread.push({ path, reason: bytes });
        else build.add(path, bytes, roles);
      } catch (thrown) {
        unread.push({ path, reason: reasonOf(thrown) });
      }
      begun.read += 1;
    }
    const report: OnBuildProgress = (stage, done, of) => caller.report(buildProgress(stage, done, of));
    while (begun.built === undefined && build.step(report)) await this.mayPause(begun, caller);
    begun.built ??= build.finish(report);
    await this.mayPause(begun, caller);
    return { ...begun.built, refused: [...unread, ...begun.built.refused] };
  }

  /**
   * Handles the messages that arrived meanwhile.
   * @throws StrutError `cancelled` if the build was cancelled, and is paused
   */
  private async mayPause(begun: BegunBuild, caller: Caller): Promise<void> {
    await otherMessages();
    if (!caller.isCancelled()) return;
    this.begun = begun;
    throw cancelled();
  }

  private forgetBuild(): void {
    if (this.begun?.built === undefined) this.begun?.build.dispose();
    this.begun = undefined;
  }
}

/** The bytes of a database, or of the built-in one. */
async function bytesOf(database: Blob | undefined): Promise<Uint8Array> {
  return database ? new Uint8Array(await database.arrayBuffer()) : loadBuiltIn();
}

/** The title of the licence in every folder that has one. */
async function titlesOf(builder: DatabaseBuilder, licences: readonly Source[]): Promise<Map<string, string>> {
  const titles = new Map<string, string>();
  for (const name of LICENCE_NAMES)
    for (const { path, read } of licences) {
      const folder = folderOf(path);
      if (path !== folder + name || titles.has(folder)) continue;
      // A licence that cannot be read counts as missing.
      const text = await read().catch(() => new Uint8Array());
      const title = builder.licenceTitle(text);
      if (title) titles.set(folder, title);
    }
  return titles;
}

/** The properties of a clip. A skeleton that `known` lacks is added to it and to `skeletons`. */
async function readClip(
  builder: DatabaseBuilder,
  clip: Source,
  index: number,
  known: Map<string, number>,
  skeletons: Skeleton[],
): Promise<ReadClip> {
  try {
    const { frames, rateHz, ...skeleton } = builder.inspect(await clip.read());
    const key = JSON.stringify([skeleton.joints, [...skeleton.parents]]);
    let number = known.get(key);
    if (number === undefined) {
      number = known.size;
      known.set(key, number);
      skeletons.push(skeleton);
    }
    return { index, frames, rateHz, skeleton: number };
  } catch (thrown) {
    return { index, fault: reasonOf(thrown) };
  }
}

function trainProgress(stage: "reading" | "training", done: number, total: number): Progress {
  const share = done / Math.max(1, total);
  return stage === "reading"
    ? { label: `Reading ${total} walks, ${done} done.`, fraction: TRAIN_READING * share }
    : { label: "Training the walk model.", fraction: TRAIN_READING + (1 - TRAIN_READING) * share };
}

function keyStyleProgress(done: number, total: number): Progress {
  const fraction = KEY_STYLE_READING + (1 - KEY_STYLE_READING) * (done / Math.max(1, total));
  return { label: `Learning, pass ${done} of ${total}.`, fraction };
}

const clipsOf = (n: number): string => (n === 1 ? "1 clip" : `${n} clips`);

function buildProgress(stage: "preparing" | "registering" | "indexing", done: number, total: number): Progress {
  const { reading, preparing, registering } = SHARES;
  const share = total > 0 ? done / total : 1;
  if (stage === "preparing")
    return { label: `Preparing ${clipsOf(total)}, ${done} done.`, fraction: reading + preparing * share };
  if (stage === "registering")
    return {
      label: `Registering ${clipsOf(total)}, ${done} done.`,
      fraction: reading + preparing + registering * share,
    };
  return { label: "Sorting the frames for the search.", fraction: reading + preparing + registering };
}
