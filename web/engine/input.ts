/** An open input motion. */
import type { PackedMotions } from "./built_in";
import type { Database } from "./database";
import { noteOf, readingOf, type Said, Saying } from "./file_read";
import { Handle } from "./handle";
import type { Input as RawInput } from "./pkg/strut_wasm.js";
import type { InputInfo, MotionFacts } from "./types";
import { type Glue, guarded } from "./wasm";

/** Where an input comes from. */
export type InputSource =
  | { kind: "built-in"; name: string; motions: PackedMotions }
  | ({ kind: "bvh"; name: string; bytes: ArrayBuffer } & Said);

/** A motion on a database's humanoid, with the file that it came from. */
export class Input extends Handle<RawInput> {
  readonly info: InputInfo;

  private constructor(
    raw: RawInput,
    database: Database,
    source: Pick<InputSource, "kind" | "name">,
    saying: Saying | undefined,
  ) {
    super(raw, "input");
    const { rateHz } = database.info;
    // The package of a page's first seconds reads no files.
    const read = saying && guarded(() => ({ ...readingOf(raw, saying), match: raw.note() }));
    const { notes = [], reading, match = "" } = read ?? {};
    this.info = guarded(() => ({
      name: source.name,
      source: source.kind,
      frames: raw.frames(),
      rateHz,
      durationSecs: raw.frames() / rateHz,
      note: noteOf(notes, match),
      notes,
      reading,
      poses: raw.poses(),
      contacts: raw.contacts(),
    }));
  }

  /**
   * Reads the source and carries it over to the database's humanoid.
   * @throws StrutError `bad-file` or, for a built-in name that there is not, `bad-input`
   */
  static open(glue: Glue, database: Database, source: InputSource): Input {
    if (source.kind === "built-in") {
      const raw = guarded(() => glue.Input.fromPacked(database.raw, source.motions, source.name));
      return new Input(raw, database, source, undefined);
    }
    const saying = new Saying(source);
    const raw = guarded(() => glue.Input.fromBvh(database.raw, new Uint8Array(source.bytes), saying.answer));
    return new Input(raw, database, source, saying);
  }

  /** Takes charge of an input that another package made. */
  static of(raw: RawInput, database: Database, source: Pick<InputSource, "kind" | "name">): Input {
    return new Input(raw, database, source, undefined);
  }
}

/**
 * What a motion's file says.
 * @throws StrutError `bad-file` or, for a built-in name that there is not, `bad-input`
 */
export function readMotion(glue: Glue, source: InputSource): MotionFacts {
  return guarded(() => {
    const saying = new Saying(source.kind === "bvh" ? source : {});
    const raw =
      source.kind === "built-in"
        ? glue.MotionFacts.ofPacked(source.motions, source.name)
        : glue.MotionFacts.ofBvh(new Uint8Array(source.bytes), saying.answer);
    const [frames, rateHz] = [raw.frames(), raw.rateHz()];
    const facts = { frames, rateHz, durationSecs: frames / rateHz, note: raw.note(), ...readingOf(raw, saying) };
    raw.free();
    return facts;
  });
}
