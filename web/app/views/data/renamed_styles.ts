/** Detects renamed styles by their clips. Pure functions. */

type StyleOfClip = ReadonlyMap<string, string>;

/**
 * New names of styles by their former ones. A style is renamed if all its remaining clips have one other style, which
 * no clip had before.
 */
export function renamedStyles(before: StyleOfClip, now: StyleOfClip): Map<string, string> {
  const former = new Set(before.values());
  const present = new Set(now.values());
  const renamed = new Map<string, string>();
  for (const style of former) {
    if (present.has(style)) continue;
    const paths = [...before.keys()].filter((path) => before.get(path) === style && now.has(path));
    const names = new Set(paths.map((path) => now.get(path)!));
    const [name] = names;
    if (names.size === 1 && name !== undefined && !former.has(name)) renamed.set(style, name);
  }
  return renamed;
}
