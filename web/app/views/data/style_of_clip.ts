/** A style from one clip: a clip dropped onto the polygon becomes a further style, in a database that is kept here. */
import { createBuildClient } from "../../../client/build/client";
import type { CallOptions, DatabaseInfo } from "../../../client/protocol";
import { strings } from "../../strings/strings";
import { errorText } from "../../ui/words";
import { freeName } from "./free_name";
import { addDatabase, type SavedDatabase } from "./saved_databases";

/** The database that a clip was added to. */
export interface StyleOfClip {
  database: SavedDatabase;
  /** Why the browser does not keep it, a sentence; empty if it does. */
  lost: string;
}

/**
 * Adds a clip to a database as a style.
 * @param known what is open
 * @param file its file; without one it is the built-in database
 * @throws StrutError with why the clip is no style
 */
export async function styleOfClip(
  known: DatabaseInfo,
  file: Blob | undefined,
  clip: File,
  style: string,
  options: CallOptions,
): Promise<StyleOfClip> {
  const client = createBuildClient();
  try {
    const { refused: _, neutral: __, twoManners: ___, ...built } = await client.addStyle(file, clip, style, options);
    const base = file ? known.name.replace(/\.strutdb$/i, "") : strings.data.saved.builtIn;
    const database = { name: strings.data.style.database(base, style), ...built };
    try {
      return { database: { ...database, name: await addDatabase(database) }, lost: "" };
    } catch (error) {
      return { database, lost: errorText(error) };
    }
  } finally {
    client.dispose();
  }
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
