/** Location of real motion capture, for tests that need it. */
import { existsSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

/** Root of the repository. */
export const root = dirname(dirname(fileURLToPath(import.meta.url)));

/**
 * Returns the folder of recordings: `$STRUT_MOCAP`, else `../shared/data`; undefined, with a printed reason, if neither
 * exists.
 */
export function recordings(): string | undefined {
  const places = [process.env.STRUT_MOCAP, resolve(root, "../shared/data")];
  const found = places.find((place) => place !== undefined && existsSync(join(place, "xia")));
  if (!found) console.warn("skipping: no recordings in $STRUT_MOCAP or ../shared/data");
  return found;
}
