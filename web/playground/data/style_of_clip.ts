/** A style from one clip: what was dropped onto the polygon becomes a vertex of it, in a database that is kept here. */
import { createBuildClient } from "../../worker/build/client";
import type { CallOptions, DatabaseInfo } from "../../worker/protocol";
import { strings } from "../strings/strings";
import { errorText } from "../words";
import { keep, listShelf, type Shelved } from "./shelf";

/** What became of a clip. */
export interface StyleOfClip {
  database: Shelved;
  /** Why the browser will not keep it; empty if it is kept. */
  lost: string;
}

/**
 * Adds a clip to a database as a style.
 * @param known what is open, and its file; without one it is the built-in database
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
    const { refused: _, neutral: __, ...built } = await client.addStyle(file, clip, style, options);
    const shelved = await listShelf().catch(() => []);
    const name = databaseName(
      file ? known.name.replace(/\.strutdb$/i, "") : strings.data.shelf.builtIn,
      style,
      shelved.map((d) => d.name),
    );
    const database = { name, ...built };
    const lost = await keep(database).then(() => "", errorText);
    return { database, lost };
  } finally {
    client.dispose();
  }
}

/** Words of file names that say nothing about style. */
const NOT_STYLES = new Set(["walk", "walking", "run", "running", "clip", "take", "motion", "dataset", "bvh", "mocap"]);

/** The words of a file's name that are no action, no number and no habit: “dataset-2_walk_elderly_001” is elderly. */
export function styleName(file: string, actions: readonly string[], styles: readonly string[]): string {
  const stem = file.replace(/\.bvh$/i, "");
  const words = stem.split(/[\s_.-]+/).filter((word) => /\p{L}{2}/u.test(word));
  const known = new Set(actions.map((action) => action.toLowerCase()));
  const telling = words.filter((word) => !known.has(word.toLowerCase()) && !NOT_STYLES.has(word.toLowerCase()));
  return free(telling.join(" ").slice(0, 40) || stem.slice(0, 40) || strings.data.style.unnamed, styles);
}

/** What a database with a further style is called: “Built-in + elderly”. */
export function databaseName(base: string, style: string, taken: readonly string[]): string {
  return free(strings.data.style.database(base, style), taken);
}

/** The name, with a number where it is taken. */
function free(name: string, taken: readonly string[]): string {
  let found = name;
  for (let n = 2; taken.includes(found); n++) found = `${name} ${n}`;
  return found;
}
