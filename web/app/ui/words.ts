/** Sentences and names derived from the state: titles, captions, file names. Pure functions. */

import { DRIVE, type InputLibrary, isLive } from "../../player/input_library";
import type { Selection } from "../../ui/polygon/selection";
import { strings } from "../strings/strings";

/** Weights from which a style is named alone, and from which it is named with “mostly”. */
const ALL = 0.95;
const MOST = 0.5;
/** Weight from which a second style is named. */
const NAMED = 0.25;

/** A small number as a word. */
export function numberWord(n: number): string {
  return strings.page.numbers[n] ?? String(n);
}

/** An engine name as words: hyphens become spaces. */
export const spoken = (name: string): string => name.replace(/[-_]+/g, " ");

/** The display name of an input: a dropped file keeps its own. */
export function inputTitle(library: Pick<InputLibrary, "isDropped">, name: string): string {
  return library.isDropped(name) || isLive(name) ? name : spoken(name);
}

/** Text with a capital first letter. */
export const capitalised = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

/** The title of the stage: the action, if it is known, and the style, “Walk, mostly proud”. */
export function stageTitle(
  action: string | undefined,
  selection: Selection,
  intensity: number,
  neutral: string,
): string {
  const how = manner(selection, intensity, neutral);
  return action === undefined ? capitalised(how) : strings.page.manner.title(capitalised(spoken(action)), how);
}

/** The style in words, “mostly proud”. */
export function manner(selection: Selection, intensity: number, neutral: string): string {
  const sorted = [...selection].sort((a, b) => b.weight - a.weight);
  const [first, second] = sorted;
  if (!first || Math.abs(intensity) < 0.05) return spoken(neutral);
  const name = spoken(first.name);
  if (intensity < 0) return strings.page.manner.opposite(name);
  const amount = first.name === neutral ? 1 : intensity;
  if (first.weight >= MOST && amount <= 0.5) return strings.page.manner.little(name);
  const more = amount >= 1.25;
  if (first.weight >= ALL) return more ? strings.page.manner.very(name) : name;
  const exaggerated = (how: string) => (more ? strings.page.manner.exaggerated(how) : how);
  if (first.weight >= MOST) return exaggerated(strings.page.manner.mostly(name));
  if (second && second.weight >= NAMED) return exaggerated(strings.page.manner.two(name, spoken(second.name)));
  return strings.page.manner.mix(numberWord(sorted.filter((s) => s.weight >= 0.05).length));
}

/** The line under the title; `database` is the name of the open one, empty for the built-in one. */
export function stageCaption(
  input: string,
  { styles, parts, keys }: { styles: number; parts: number; keys: number },
  rateHz: number,
  database = "",
): string {
  const { caption } = strings.page;
  return [
    input === DRIVE ? caption.steered : isLive(input) ? caption.live : caption.input(input),
    database === "" ? caption.styles(styles) : caption.stylesOf(styles, database),
    ...(parts > 0 ? [caption.parts(parts)] : []),
    ...(keys > 1 ? [caption.keys(keys)] : []),
    caption.rate(Math.round(rateHz)),
  ].join(" · ");
}

/** Name of an exported file: the input's and the heaviest style's. */
export function exportName(input: string, selection: Selection, ending = "bvh"): string {
  const heaviest = selection.reduce(
    (a, b) => (b.weight > a.weight ? b : a),
    selection[0] ?? { name: "styled", weight: 1 },
  );
  const plain = (text: string) =>
    text
      .replace(/\.[^.]*$/, "")
      .replace(/[^\p{L}\p{N}]+/gu, "-")
      .replace(/^-+|-+$/g, "");
  return `${plain(input) || "motion"}-${plain(heaviest.name) || "styled"}.${ending}`;
}

/** Whether a module or style sheet of this page could not be imported. The browsers and Vite word it differently. */
export function isMissingModule(error: unknown): boolean {
  return (
    error instanceof Error &&
    /dynamically imported module|importing a module script|unable to preload css/i.test(error.message)
  );
}

/** An error as one text: the sentence and the hint, if there is one. */
export function errorText(error: unknown): string {
  if (isMissingModule(error)) return strings.page.partNotLoaded;
  const { message, hint } = error as { message?: unknown; hint?: unknown };
  const parts = [message, hint].filter((part): part is string => typeof part === "string" && part !== "");
  return parts.length > 0 ? parts.join(" ") : strings.page.engine.silentFailure;
}

/** The rejection of a cancelled operation. */
export function cancelled(): DOMException {
  return new DOMException(strings.page.engine.cancelled, "AbortError");
}
