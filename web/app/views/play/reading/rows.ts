/** Texts of the panel about each part of a reading. Pure functions. */
import type { FileRead, FileReading, Note } from "../../../../client/protocol";
import { ROLES } from "../../../../humanoid";
import { formatNumber } from "../../../../ui/dom";
import { spoken } from "../../../ui/words";
import type { Likeness } from "../likeness";
import { readingWords as words } from "./strings.en";

/** The parts of a reading that the user can change. */
export const ROW_NAMES = ["up", "sides", "floor", "unit", "joints"] as const;
export type RowName = (typeof ROW_NAMES)[number];

/** Texts of a row. */
export interface RowText {
  /** One to three words: the source of the value. */
  source: string;
  /** Whether it is a guess that may be wrong. */
  guessed: boolean;
  /** A sentence: from what it was determined. */
  why: string;
}

/** Common units of length, metres. */
export const UNITS = [
  { metres: 1, name: words.unit.metres },
  { metres: 0.1, name: words.unit.decimetres },
  { metres: 0.01, name: words.unit.centimetres },
  { metres: 0.0254, name: words.unit.inches },
  { metres: 0.001, name: words.unit.millimetres },
] as const;

/** Texts of all rows. */
export function rowTexts(read: FileRead, notes: readonly Note[]): Record<RowName, RowText> {
  const has = (code: string) => notes.some((note) => note.code === code);
  const unsure = notes.find(({ code }) => code === "up-unsure")?.text;
  const missing = ROLES.filter((role) => read.joints[role] === null).map(spoken);
  const without = missing.length > 0 ? words.joints.some(missing.join(", ")) : undefined;
  const found: Record<RowName, RowText> = {
    up:
      read.upFrom === "guessed"
        ? guessed(unsure ?? words.up.guessed)
        : { ...measured(words.up.measured), source: words.sources.measured },
    sides: read.sidesFrom === "guessed" ? guessed(words.sides.guessed) : named(words.sides.byName),
    floor: measured(has("no-floor") ? words.floor.lowest : words.floor.measured),
    unit: measured(words.unit.tall(formatNumber(read.heightMetres, 2))),
    joints:
      read.jointsFrom === "shape"
        ? guessed([words.joints.byShape, without].filter(Boolean).join(". "))
        : named(without ?? words.joints.all),
  };
  const said: Partial<Record<RowName, RowText>> = {
    ...(read.upFrom === "said" && { up: saidOf(read) }),
    ...(read.sidesFrom === "said" && { sides: saidOf(read) }),
    ...(read.floorFrom === "said" && { floor: saidOf(read) }),
    // The resulting height of the body then shows whether the unit is plausible.
    ...(read.unitFrom === "said" && { unit: { ...saidOf(read), why: found.unit.why } }),
    ...(read.jointsFrom === "said" && { joints: { ...saidOf(read), why: without ?? words.joints.none } }),
  };
  return { ...found, ...said };
}

/**
 * The text about the recognised class of a file; `said` tells whether the user set labels. It never counts as a guess
 * of the reading.
 */
export function likenessText(likeness: Likeness | undefined, said: boolean): RowText {
  const text = (source: string, why: string): RowText => ({ source, guessed: false, why });
  const { likeness: say, sources } = words;
  if (!likeness) return said ? text(sources.said, say.said) : text(say.unknown, say.waiting);
  const { kind, read, centimetres } = likeness;
  const weight = formatNumber(read.weight, 2);
  const whys: Record<Likeness["kind"], string> = {
    class: say.weight(weight),
    action: say.share(weight),
    far: centimetres === undefined ? say.farther : say.far(centimetres),
    still: say.still,
    alike: say.alike(weight),
  };
  const known = kind === "class" || kind === "action";
  if (said) return text(sources.said, known ? say.said : whys[kind]);
  if (!known) return text(say.unlike, whys[kind]);
  const action = spoken(read.action);
  return text(kind === "class" ? say.class(action, spoken(read.style)) : say.action(action), whys[kind]);
}

/** Fields of a reading that belong to each row. */
const FIELDS = {
  up: ["up"],
  sides: ["mirrored", "swapSides"],
  floor: ["floor"],
  unit: ["unit"],
  joints: ["joints"],
} as const satisfies Record<RowName, readonly (keyof FileReading)[]>;

/** A reading without the fields of a row. */
export function withoutRow(reading: FileReading, row: RowName): FileReading {
  const fields: readonly string[] = FIELDS[row];
  return Object.fromEntries(Object.entries(reading).filter(([name]) => !fields.includes(name)));
}

/** Whether a reading specifies a field of a row. */
export function saysRow(reading: FileReading, row: RowName): boolean {
  return Object.keys(withoutRow(reading, row)).length < Object.keys(reading).length;
}

/** Whether a reading specifies a field that is stored for its skeleton. */
export const saysOfSkeleton = (reading: FileReading): boolean =>
  ROW_NAMES.some((row) => row !== "floor" && saysRow(reading, row));

const guessed = (why: string): RowText => ({ source: words.sources.guessed, guessed: true, why });
const measured = (why: string): RowText => ({ source: words.sources.measured, guessed: false, why });
const named = (why: string): RowText => ({ source: words.sources.named, guessed: false, why });
const saidOf = ({ remembered }: FileRead): RowText => ({
  source: words.sources.said,
  guessed: false,
  why: remembered ? words.saidBefore : words.saidNow,
});
