/** A style from one clip: a clip dropped onto the polygon becomes a further style, in a database that is kept here. */
import { createBuildClient } from "../../../client/build/client";
import type { CallOptions, DatabaseInfo } from "../../../client/protocol";
import { strings } from "../../strings/strings";
import { errorText } from "../../ui/words";
import { freeName } from "./free_name";
import { addDatabase, replaceDatabase, type SavedDatabase } from "./saved_databases";

/** The database that a clip was added to. */
export interface StyleOfClip {
  database: SavedDatabase;
  /** Why the browser does not keep it, a sentence; empty if it does. */
  lost: string;
  /** Why the style may look wrong, a sentence; empty if nothing is known against it. */
  doubt: string;
}

/** A database that a clip is added to. */
export interface StyleBase {
  known: DatabaseInfo;
  /** Its file; without one it is the built-in database. */
  file: Blob | undefined;
}

/** What a clip is to be. */
export interface ClipStyle {
  style: string;
  /** The action that it shows; `undefined`: the one that it fits best. */
  action: string | undefined;
}

/**
 * Adds a clip to a database as a style.
 * @param replaced name of a database on this device whose place the new one takes
 * @throws StrutError with why the clip is no style
 */
export async function styleOfClip(
  { known, file }: StyleBase,
  clip: File,
  { style, action }: ClipStyle,
  replaced: string | undefined,
  options: CallOptions,
): Promise<StyleOfClip> {
  const client = createBuildClient();
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

/** So much of a file is read to know how long it lasts, bytes: the hierarchy comes first. */
const HEAD_BYTES = 512 * 1024;

/** How long a clip lasts by what its file says, seconds; `undefined` where it does not say. */
export async function secondsOf(clip: Blob): Promise<number | undefined> {
  const head = await clip.slice(0, HEAD_BYTES).text();
  const [, frames] = /^\s*Frames:\s*(\d+)/im.exec(head) ?? [];
  const [, secs] = /^\s*Frame Time:\s*([\d.eE+-]+)/im.exec(head) ?? [];
  const length = Number(frames) * Number(secs);
  return Number.isFinite(length) ? length : undefined;
}

/** The action of a database that a file's name has as a word. */
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

/** Longest name that is suggested, characters. */
const LONGEST = 40;

/** The words of a file's name that are no action, no number and not usual: “dataset-2_walk_elderly_001” is elderly. */
export function styleName(file: string, actions: readonly string[], styles: readonly string[]): string {
  const stem = file.replace(/\.bvh$/i, "");
  const words = stem.split(/[\s_.-]+/).filter((word) => /\p{L}{2}/u.test(word));
  const known = new Set(actions.map((action) => action.toLowerCase()));
  const telling = words.filter((word) => !known.has(word.toLowerCase()) && !NOT_STYLES.has(word.toLowerCase()));
  const name = telling.join(" ").slice(0, LONGEST) || stem.slice(0, LONGEST) || strings.data.style.unnamed;
  return freeName(name, styles);
}
