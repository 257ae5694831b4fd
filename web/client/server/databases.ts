/** Calls about databases. */
import type { BuiltInSet } from "../../engine/built_in";
import type { Database } from "../../engine/database";
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

/** The bytes of a file. @throws StrutError `bad-file` where it is gone, or there is no room for it */
async function bytesOf(file: Blob): Promise<ArrayBuffer> {
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
