/** Calls about databases. */
import type { BuiltInSet } from "../../engine/built_in";
import type { Database, SlicedFile } from "../../engine/database";
import type { DatabaseInfo, DatabaseSource } from "../protocol";
import type { Caller } from "../rpc_server";
import type { Host } from "./host";
import type { OpenThing } from "./registry";
import { stage } from "./time_slices";

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

/** Available in workers of browsers. */
declare const FileReaderSync: (new () => { readAsArrayBuffer(blob: Blob): ArrayBuffer }) | undefined;

/** Files of at least this size are read in slices, which takes longer, so that they need not be in memory as a whole; bytes. */
const SLICED_BYTES = 256e6;

/** The bytes of a file, or a reader of its slices, which fails if the file is gone. */
async function bytesOf(file: Blob): Promise<ArrayBuffer | SlicedFile> {
  const read = (begin: number, end: number) => {
    try {
      return new Uint8Array(new FileReaderSync!().readAsArrayBuffer(file.slice(begin, end)));
    } catch {
      return new Uint8Array();
    }
  };
  const sliced = { size: file.size, read };
  const isSmall = file.size < SLICED_BYTES || typeof FileReaderSync !== "function";
  // A file that does not fit into memory may still be read in slices.
  return isSmall ? file.arrayBuffer().catch(() => sliced) : sliced;
}

export async function builtInInputs({ engine, builtIn }: Host, caller: Caller, set: BuiltInSet): Promise<string[]> {
  return engine.inputsOf(await builtIn.load(caller, set));
}
