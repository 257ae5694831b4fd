/** An open input motion. */
import type { PackedMotions } from "./built_in";
import type { Database } from "./database";
import { noteOf, readingOf, type Said, Saying } from "./file_read";
import { Handle } from "./handle";
import type {
  Input as RawInput,
  MotionFacts as RawMotionFacts,
  PackedMotions as RawPackedMotions,
} from "./pkg/strut_wasm.js";
import type { InputInfo, MotionFacts } from "./types";
import { type Glue, guarded } from "./wasm";

/** Source of an input. */
export type InputSource = BuiltInInput | InputFile;

interface BuiltInInput {
  kind: "built-in";
  name: string;
  motions: PackedMotions;
}

type InputFile = { kind: "bvh"; name: string; bytes: ArrayBuffer } & Said;

/** A motion on a database's humanoid, with the file from which it was read. */
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
   * Retargets a built-in motion to the database's humanoid.
   * @throws StrutError `bad-input` if there is no motion of this name
   */
  static fromPacked(glue: Glue, database: Database, source: BuiltInInput, motions: RawPackedMotions): Input {
    const raw = guarded(() => glue.Input.fromPacked(database.raw, motions, source.name));
    return new Input(raw, database, source, undefined);
  }

  /**
   * Reads a file and retargets its motion to the database's humanoid.
   * @throws StrutError `bad-file`
   */
  static open(glue: Glue, database: Database, source: InputFile): Input {
    const saying = new Saying(source);
    const raw = guarded(() => glue.Input.fromBvh(database.raw, new Uint8Array(source.bytes), saying.answer));
    return new Input(raw, database, source, saying);
  }

  /** Takes ownership of an input that another package made. */
  static of(raw: RawInput, database: Database, source: Pick<InputSource, "kind" | "name">): Input {
    return new Input(raw, database, source, undefined);
  }
}

/**
 * Facts of a motion's file.
 * @throws StrutError `bad-file`
 */
export function readMotion(glue: Glue, source: InputFile): MotionFacts {
  const saying = new Saying(source);
  return factsOf(() => glue.MotionFacts.ofBvh(new Uint8Array(source.bytes), saying.answer), saying);
}

/**
 * Facts of a built-in motion.
 * @throws StrutError `bad-input` if there is no motion of this name
 */
export function packedFacts(glue: Glue, { name }: BuiltInInput, motions: RawPackedMotions): MotionFacts {
  return factsOf(() => glue.MotionFacts.ofPacked(motions, name), new Saying({}));
}

function factsOf(read: () => RawMotionFacts, saying: Saying): MotionFacts {
  return guarded(() => {
    const raw = read();
    const [frames, rateHz] = [raw.frames(), raw.rateHz()];
    const facts = { frames, rateHz, durationSecs: frames / rateHz, note: raw.note(), ...readingOf(raw, saying) };
    raw.free();
    return facts;
  });
}
