/** Calls about databases. */
import type { BuiltInSet } from "../../engine/built_in";
import type { Database, SlicedFile } from "../../engine/database";
import { StrutError } from "../../engine/errors";
import type { DatabaseInfo, DatabaseSource } from "../protocol";
import type { Host } from "./host";
import type { OpenThing } from "./registry";
import { type Caller, stage } from "./time_slices";

export class OpenDatabase implements OpenThing {
  static readonly noun = "database";
  readonly uses = [];

  constructor(readonly database: Database) {}

  dispose(): void {
    this.database.dispose();
  }
}

export async function openDatabase(
  { engine, builtIn, open }: Host,
  caller: Caller,
  id: number,
  source: DatabaseSource,
): Promise<DatabaseInfo> {
  await stage(caller, "Opening the database", 0);
  const database = engine.openDatabase(
    source.kind === "demo"
      ? { kind: "demo", motions: await builtIn.load(caller, source.set) }
      : { ...source, bytes: await bytesOf(source.file) },
  );
  try {
    await stage(caller, "Opening the database", 0.9);
  } catch (thrown) {
    database.dispose();
    throw thrown;
  }
  open.add(id, new OpenDatabase(database));
  return { ...database.info, proportions: database.info.proportions.slice() };
}

/** What workers of browsers have. */
declare const FileReaderSync: (new () => { readAsArrayBuffer(blob: Blob): ArrayBuffer }) | undefined;

/** Files from this size on are read in slices, which takes longer, so that they need not be in memory as a whole; bytes. */
const SLICED_BYTES = 256e6;

/** The bytes of a file, or a way to read them. @throws StrutError `bad-file` where it is gone, or there is no room for it */
async function bytesOf(file: Blob): Promise<ArrayBuffer | SlicedFile> {
  if (file.size >= SLICED_BYTES && typeof FileReaderSync === "function") {
    const reader = new FileReaderSync();
    const read = (begin: number, end: number) => new Uint8Array(reader.readAsArrayBuffer(file.slice(begin, end)));
    return { size: file.size, read };
  }
  try {
    return await file.arrayBuffer();
  } catch (cause) {
    const message = `The file, of ${Math.ceil(file.size / 1e6)} MB, could not be read.`;
    throw new StrutError({ code: "bad-file", message, hint: "Open it again, or build a smaller database." }, cause);
  }
}

export async function builtInInputs({ engine, builtIn }: Host, caller: Caller, set: BuiltInSet): Promise<string[]> {
  return engine.inputsOf(await builtIn.load(caller, set));
}
