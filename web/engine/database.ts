/** An open database. */
import type { PackedMotions } from "./built_in";
import { Handle } from "./handle";
import type { Database as RawDatabase, PackedMotions as RawPackedMotions } from "./pkg/strut_wasm.js";
import type { DatabaseInfo } from "./types";
import { type Glue, guarded } from "./wasm";

/** A file that is read in slices. */
export interface SlicedFile {
  /** Number of bytes. */
  size: number;
  /** The bytes from `begin` up to `end`; empty if they cannot be read. Never throws. */
  read(begin: number, end: number): Uint8Array;
}

/** Source of a database. */
export type DatabaseSource = { kind: "demo"; motions: PackedMotions } | DatabaseFile;

/** A `.strutdb` file. */
interface DatabaseFile {
  kind: "strutdb";
  name: string;
  bytes: ArrayBuffer | SlicedFile;
}

/** A database with its search index. */
export class Database extends Handle<RawDatabase> {
  readonly info: DatabaseInfo;

  private constructor(raw: RawDatabase, name: string) {
    super(raw, "database");
    this.info = guarded(() => describe(raw, name));
  }

  /** The built-in database. @throws StrutError `bad-file` if the bytes are invalid */
  static fromPacked(glue: Glue, motions: RawPackedMotions): Database {
    return new Database(
      guarded(() => glue.Database.fromPacked(motions)),
      "built-in",
    );
  }

  /** @throws StrutError `bad-file` if the bytes are invalid */
  static open(glue: Glue, { name, bytes }: DatabaseFile): Database {
    const raw = guarded(() =>
      bytes instanceof ArrayBuffer
        ? glue.Database.fromBytes(new Uint8Array(bytes))
        : glue.Database.fromSlices(bytes, bytes.size),
    );
    return new Database(raw, name);
  }

  /** Takes ownership of a database that another package made. */
  static of(raw: RawDatabase, name: string): Database {
    return new Database(raw, name);
  }
}

function describe(raw: RawDatabase, name: string): DatabaseInfo {
  const actions = raw.actions();
  const styles = raw.styles();
  const table = raw.classes();
  const classes = Array.from({ length: table.length / 3 }, (_, i) => ({
    action: actions[table[3 * i]!]!,
    style: styles[table[3 * i + 1]!]!,
    frames: table[3 * i + 2]!,
  }));
  return {
    name,
    frames: raw.frames(),
    rateHz: raw.rateHz(),
    actions,
    styles,
    neutral: styles[raw.neutral()]!,
    proportions: raw.proportions(),
    classes,
  };
}
