/** The clips of the Data view and their labels: plain data and functions on it. */
import type { FoundClip, Labelled, ReadEvent, Roles, Skeleton } from "../../../client/build/protocol";
import { strings } from "../../strings/strings";

const words = strings.data;

/** Roles with a lower confidence are shown for checking; those found by joint names have 1, by shape alone 0.6. */
export const SURE = 0.8;

/** A clip with its labels. */
export interface Row {
  /** Index among the clips that were found. */
  readonly index: number;
  readonly path: string;
  readonly licence: string;
  action: string;
  style: string;
  take: number | undefined;
  /** Whether the user edited the labels. */
  edited: boolean;
  /** Why the name gives no labels; empty if it does. */
  unlabelled: string;
  /** Why the file cannot be used; empty if it can, as far as known. */
  fault: string;
  /** `undefined` until the file was read. */
  read: { frames: number; rateHz: number; skeleton: number } | undefined;
}

/** A skeleton, and the joints that the user chose for its roles. */
export interface KnownSkeleton extends Skeleton {
  chosen: Roles | undefined;
}

/** A key shared by skeletons with the same joints. */
export function skeletonKey({ joints }: Skeleton): string {
  return joints.join("\n");
}

/** Number of clips of every action in every style. */
export interface ClassTable {
  actions: string[];
  styles: string[];
  count(action: string, style: string): number;
}

/** A field of a row that the user can edit. */
export type LabelField = "action" | "style" | "take";

/** The row of a clip that was found. */
export function rowOf({ path, licence }: FoundClip, index: number): Row {
  return {
    index,
    path,
    licence,
    action: "",
    style: "",
    take: undefined,
    edited: false,
    unlabelled: "",
    fault: "",
    read: undefined,
  };
}

/** Sets the labels from names or a table; labels edited by the user are kept. */
export function applyLabels(rows: readonly Row[], labels: readonly Labelled[]): void {
  for (const row of rows) {
    const found = labels[row.index];
    if (row.edited || !found) continue;
    if ("reason" in found) Object.assign(row, { action: "", style: "", take: undefined, unlabelled: found.reason });
    else Object.assign(row, { ...found, unlabelled: "" });
  }
}

/** Adds the read properties of some clips to their rows, and new skeletons to the known ones. */
export function applyRead(rows: readonly Row[], skeletons: KnownSkeleton[], event: ReadEvent): void {
  skeletons.push(...event.skeletons.map((skeleton) => ({ ...skeleton, chosen: undefined })));
  for (const { index, ...read } of event.clips) {
    const row = rows[index];
    if (!row) continue;
    if ("fault" in read) row.fault = read.fault;
    else row.read = read;
  }
}

/** Why a clip will not be part of the database; empty if it will. */
export function obstacle(row: Row, skeletons: readonly KnownSkeleton[]): string {
  if (row.fault) return row.fault;
  if (!row.action.trim() || !row.style.trim()) return row.unlabelled || words.unlabelled;
  const skeleton = row.read && skeletons[row.read.skeleton];
  return skeleton && !skeleton.chosen ? skeleton.fault : "";
}

/** Counts the clips of every class; actions and styles are sorted as in the database. */
export function classTable(rows: readonly Row[]): ClassTable {
  const counts = new Map<string, Map<string, number>>();
  const styles = new Set<string>();
  for (const { action, style } of rows) {
    const ofAction = counts.get(action) ?? new Map<string, number>();
    counts.set(action, ofAction.set(style, (ofAction.get(style) ?? 0) + 1));
    styles.add(style);
  }
  return {
    actions: [...counts.keys()].sort(),
    styles: [...styles].sort(),
    count: (action, style) => counts.get(action)?.get(style) ?? 0,
  };
}

/** The style that is most likely the neutral one. */
export function likelyNeutral(styles: readonly string[]): string {
  const known = ["neutral", "normal", "natural", "plain", "普通", "ニュートラル"];
  const named = known.map((name) => styles.find((style) => style.toLowerCase() === name)).find(Boolean);
  return named ?? styles[0] ?? "";
}

/** Sentences about data that the database will lack. */
export function concerns({ actions, styles, count }: ClassTable): string[] {
  const sentences: string[] = [];
  if (styles.length === 1) sentences.push(words.oneStyle);
  const single = styles.filter((style) => actions.reduce((sum, action) => sum + count(action, style), 0) === 1);
  if (single.length > 0 && styles.length > 1) sentences.push(words.single(single));
  for (const action of actions) {
    const missing = styles.filter((style) => count(action, style) === 0);
    if (missing.length > 0) sentences.push(words.missing(missing, action));
  }
  return sentences;
}

/** Name of a database of these paths: the first folder's or archive's. */
export function databaseName(paths: readonly string[]): string {
  const [first = ""] = paths;
  const slash = first.indexOf("/");
  const top = slash > 0 ? first.slice(0, slash).replace(/\.zip$/i, "") : "";
  return top || words.unnamed;
}
