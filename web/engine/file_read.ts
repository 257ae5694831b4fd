/** How a file was read: what the module reports about it, and what the user specified. */
import { ROLES, type Role } from "../humanoid";
import type { FileRead, FileReading, Note, UpAxis } from "./types";

/** What the user specified for skeletons, by their identities. */
export type RememberedReadings = Readonly<Record<string, FileReading>>;

/** What the user specified for a file, or else for its skeleton. */
export interface Said {
  reading?: FileReading | undefined;
  /** Used if nothing is specified for the file itself. */
  remembered?: RememberedReadings | undefined;
}

/** The parts of the module's objects that report how a file was read. */
interface RawRead {
  notes(): string[];
  read(): RawFile | undefined;
}

/** The module's report on how a file was read (`rust/strut-wasm/src/engine/input_file.rs`). */
interface RawFile {
  numbers(): Float64Array;
  joints(): string[];
  skeleton(): string;
  free(): void;
}

/** Notes from the module's codes and texts, which alternate. */
export function notesIn(texts: readonly string[]): Note[] {
  return texts.flatMap((code, i) => (i % 2 === 0 ? [{ code, text: texts[i + 1] ?? "" }] : []));
}

/** The up axes in the engine's order (`rust/strut-core/src/retarget/axes.rs`). */
const AXES = ["x", "-x", "y", "-y", "z", "-z"] as const satisfies readonly UpAxis[];

/** The module's report on how a motion was read. */
interface RawReading {
  frames: number;
  rateHz: number;
  up: UpAxis;
  mirrored: boolean;
  floor: number;
  unit: number;
  height: number;
  confidence: number;
  skeleton: string;
  joints: string[];
  roles: (number | null)[];
}

/** Answers the module's query for the user's reading of a skeleton, and keeps the answer. */
export class Saying {
  /** The user's reading. */
  reading: FileReading = {};
  /** Whether it was specified for an earlier file with the same skeleton. */
  remembered = false;
  readonly #said: Said;

  constructor(said: Said) {
    this.#said = said;
  }

  /** The reading of a skeleton, as the lines that the module expects (`rust/strut-formats/src/reading.rs`). */
  readonly answer = (skeleton: string): string => {
    const { reading, remembered = {} } = this.#said;
    const known = Object.hasOwn(remembered, skeleton) ? remembered[skeleton] : undefined;
    this.remembered = !reading && known !== undefined;
    this.reading = reading ?? known ?? {};
    return linesOf(this.reading);
  };
}

/** One line for each part of a reading. The module refuses lines that it does not know. */
export function linesOf(reading: FileReading): string {
  const { joints, ...others } = reading;
  const lines = Object.entries(others).map(([name, value]) => (value === undefined ? "" : `${name} ${value}`));
  if (joints) lines.push("joints");
  for (const [role, joint] of Object.entries(joints ?? {}))
    if (joint !== undefined) lines.push(joint === null ? `joint ${role}` : `joint ${role} ${joint}`);
  return lines
    .filter((line) => line !== "")
    .map((line) => line.replace(/[\r\n]/g, "\ufffd"))
    .join("\n");
}

/** The notes and the reading that was used for a file. */
export function readingOf(raw: RawRead, saying: Saying): { notes: Note[]; reading: FileRead | undefined } {
  const notes = notesIn(raw.notes());
  const file = raw.read();
  const reading = file && fileRead(readingIn(file), notes, saying);
  file?.free();
  return { notes, reading };
}

function readingIn(file: RawFile): RawReading {
  const [frames = 0, rateHz = 0, up = 0, mirrored, floor = 0, unit = 0, height = 0, confidence = 0, ...roles] =
    file.numbers();
  return {
    frames,
    rateHz,
    up: AXES[up] ?? "y",
    mirrored: mirrored === 1,
    floor: decimal(floor),
    unit: decimal(unit),
    height,
    confidence,
    skeleton: file.skeleton(),
    joints: file.joints(),
    roles: roles.map((joint) => (joint < 0 ? null : joint)),
  };
}

/** A single-precision number in its short decimal form: 0.01, not 0.009999999776. */
const decimal = (value: number): number => Number(value.toPrecision(7));

/** What may be wrong, then the joint mapping, in sentences. */
export function noteOf(notes: readonly Note[], match: string): string {
  return [...notes.map((note) => note.text), match].filter((text) => text !== "").join(" ");
}

/** The complete report, from what the module read and what the user specified. */
export function fileRead(
  raw: RawReading,
  notes: readonly Note[],
  saying: Pick<Saying, "reading" | "remembered">,
): FileRead {
  const { reading: said, remembered } = saying;
  const upFrom = said.up
    ? "said"
    : raw.up !== "y" || notes.some(({ code }) => code === "up-unsure")
      ? "guessed"
      : "as-is";
  const saidSides = said.mirrored !== undefined || said.swapSides === true;
  const sidesFrom = saidSides ? "said" : raw.mirrored ? "guessed" : "as-is";
  const jointsFrom = said.joints ? "said" : raw.confidence < 1 ? "shape" : "names";
  const nameOf = (joint: number | null | undefined) => (joint == null ? null : (raw.joints[joint] ?? null));
  const joints = Object.fromEntries(ROLES.map((role, i) => [role, nameOf(raw.roles[i])])) as Record<
    Role,
    string | null
  >;
  const guesses: FileRead["guesses"][number][] = [];
  if (upFrom === "guessed") guesses.push("up");
  if (sidesFrom === "guessed") guesses.push("sides");
  if (jointsFrom === "shape") guesses.push("joints");
  return {
    frames: raw.frames,
    rateHz: raw.rateHz,
    up: raw.up,
    upFrom,
    mirrored: raw.mirrored,
    sidesFrom,
    floorMetres: raw.floor,
    floorFrom: said.floor === undefined ? "measured" : "said",
    metresPerUnit: raw.unit,
    unitFrom: said.unit === undefined ? "measured" : "said",
    heightMetres: raw.height,
    joints,
    jointsFrom,
    skeleton: { id: raw.skeleton, joints: raw.joints },
    guesses,
    said,
    remembered,
  };
}
