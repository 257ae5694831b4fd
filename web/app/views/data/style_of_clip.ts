/** A style from one clip: a clip dropped onto the polygon becomes a new style, in a database stored here. */
import { BuildClient } from "../../../client/build/client";
import type { CallOptions, DatabaseInfo } from "../../../client/protocol";
import { strings } from "../../strings/strings";
import { errorText } from "../../ui/words";
import { freeName } from "./free_name";
import { addDatabase, replaceDatabase, type SavedDatabase } from "./saved_databases";

/** The database to which a clip was added. */
export interface StyleOfClip {
  database: SavedDatabase;
  /** Why the browser did not store it, a sentence; empty if it did. */
  lost: string;
  /** Why the style may look wrong, a sentence; empty if no reason is known. */
  doubt: string;
}

/** A database to which a clip is added. */
export interface StyleBase {
  known: DatabaseInfo;
  /** Its file; `undefined` for the built-in database. */
  file: Blob | undefined;
}

/** Name and action of the new style. */
export interface ClipStyle {
  style: string;
  /** The action that it shows; `undefined` for the one that fits best. */
  action: string | undefined;
}

/**
 * Adds a clip to a database as a style.
 * @param replaced name of a database on this device that the new one replaces
 * @throws StrutError if the clip cannot become a style; the message says why
 */
export async function styleOfClip(
  { known, file }: StyleBase,
  clip: File,
  { style, action }: ClipStyle,
  replaced: string | undefined,
  options: CallOptions,
): Promise<StyleOfClip> {
  const client = new BuildClient();
  try {
    const {
      refused: _,
      neutral: __,
      twoManners: ___,
      doubt,
      ...built
    } = await client.addStyle(file, clip, style, { ...options, action });
    const base = file ? known.name.replace(/\.strutdb$/i, "") : strings.data.saved.builtIn;
    const database = { name: strings.data.style.database(base, style), ...built };
    try {
      const name = replaced ?? (await addDatabase(database));
      if (replaced !== undefined) await replaceDatabase({ ...database, name });
      return { database: { ...database, name }, lost: "", doubt };
    } catch (error) {
      return { database, lost: errorText(error), doubt };
    }
  } finally {
    client.dispose();
  }
}

/** Number of bytes that are read to find the duration of a file: the hierarchy comes first. */
const HEAD_BYTES = 512 * 1024;

/** Duration of a clip according to its file, seconds; `undefined` if it is missing. */
export async function secondsOf(clip: Blob): Promise<number | undefined> {
  const head = await clip.slice(0, HEAD_BYTES).text();
  const [, frames] = /^\s*Frames:\s*(\d+)/im.exec(head) ?? [];
  const [, secs] = /^\s*Frame Time:\s*([\d.eE+-]+)/im.exec(head) ?? [];
  const length = Number(frames) * Number(secs);
  return Number.isFinite(length) ? length : undefined;
}

/** The action of a database that is a word of a file's name. */
export function actionIn(file: string, actions: readonly string[]): string | undefined {
  const words = new Set(
    file
      .replace(/\.bvh$/i, "")
      .toLowerCase()
      .split(/[\s_.-]+/),
  );
  const named = actions.filter((action) => words.has(action.toLowerCase()));
  return named.length === 1 ? named[0] : undefined;
}

/** Words of file names that do not name a style. */
const NOT_STYLES = new Set(["walk", "walking", "run", "running", "clip", "take", "motion", "dataset", "bvh", "mocap"]);

/** Longest suggested name, characters. */
const LONGEST = 40;

/** The words of a file's name that are not actions, numbers or common words: “dataset-2_walk_elderly_001” gives “elderly”. */
export function styleName(file: string, actions: readonly string[], styles: readonly string[]): string {
  const stem = file.replace(/\.bvh$/i, "");
  const words = stem.split(/[\s_.-]+/).filter((word) => /\p{L}{2}/u.test(word));
  const known = new Set(actions.map((action) => action.toLowerCase()));
  const telling = words.filter((word) => !known.has(word.toLowerCase()) && !NOT_STYLES.has(word.toLowerCase()));
  const name = telling.join(" ").slice(0, LONGEST) || stem.slice(0, LONGEST) || strings.data.style.unnamed;
  return freeName(name, styles);
}
