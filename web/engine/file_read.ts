/** How a file was read: from what the module says of it, and what a person said. */
import { ROLES, type Role } from "../humanoid";
import type { FileRead, FileReading, Note, UpAxis } from "./types";

/** What people said of skeletons, by their identities. */
export type RememberedReadings = Readonly<Record<string, FileReading>>;

/** What is said of a file: of it, or else of its skeleton. */
export interface Said {
  reading?: FileReading | undefined;
  /** What counts where nothing is said of the file itself. */
  remembered?: RememberedReadings | undefined;
}

/** The parts of the module's objects that say how a file was read. */
interface RawRead {
  note(): string;
  notes(): string;
  reading(): string | undefined;
}

/** What the module says of how a file was read (`rust/strut-formats/src/reading.rs`). */
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

/** Answers the module's question for what is said of a skeleton, and keeps the answer. */
export class Saying {
  /** What was said. */
  reading: FileReading = {};
  /** Whether it was said of an earlier file with the skeleton. */
  remembered = false;
  readonly #said: Said;

  constructor(said: Said) {
    this.#said = said;
  }

  /** The reading of a skeleton as JSON. */
  readonly answer = (skeleton: string): string => {
    const { reading, remembered = {} } = this.#said;
    const known = Object.hasOwn(remembered, skeleton) ? remembered[skeleton] : undefined;
    this.remembered = !reading && known !== undefined;
    this.reading = reading ?? known ?? {};
    return JSON.stringify(this.reading);
  };
}

/** What is said of how a file was read. */
export function readingOf(raw: RawRead, saying: Saying): { notes: Note[]; reading: FileRead | undefined } {
  const notes = JSON.parse(raw.notes()) as Note[];
  const text = raw.reading();
  return { notes, reading: text === undefined ? undefined : fileRead(JSON.parse(text) as RawReading, notes, saying) };
}

/** What may be wrong, then the match of the skeletons, in sentences. */
export function noteOf(notes: readonly Note[], match: string): string {
  return [...notes.map((note) => note.text), match].filter((text) => text !== "").join(" ");
}

/** The whole of it, from what the module read and what a person said. */
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
