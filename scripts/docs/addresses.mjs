// Translation of links in Markdown files to addresses of the documentation site.
import { existsSync, statSync } from "node:fs";
import { join, posix } from "node:path";
import { root } from "../steps.mjs";
import { slugOf } from "./markdown.mjs";

const PICTURE = /\.(svg|png|jpg|webp)$/;

/** Returns whether an address leads out of the repository, or stays on its page. */
export const isElsewhere = (href) => /^([a-z][a-z+.-]*:|#)/i.test(href);

/**
 * Returns the addresses of one site.
 * @param pages each with `file`, its Markdown, and `out`, its path in the site
 * @returns `resolverOf(page)`, which translates the addresses of a page; `pictures`, a map from the files that pages
 * show to their paths in the site; `faults`, a message for each broken link
 */
export function addressesOf(pages) {
  const outOf = new Map(pages.map(({ file, out }) => [file, out]));
  const pictures = new Map();
  const faults = [];

  /** Returns the path in the site of a file or folder of the repository. */
  function placeOf(target, hash) {
    if (outOf.has(target)) return `${outOf.get(target)}${hash}`;
    const example = /^examples\/([\w-]+)(?:\/([\w.-]+))?\/?$/.exec(target);
    if (example) return `examples/${example[1]}.html${example[2] ? `#${slugOf(example[2])}` : ""}`;
    if (!PICTURE.test(target) && !/^LICENSE[\w-]*$/.test(target)) return undefined;
    const place = PICTURE.test(target) ? target.replace(/^docs\//, "") : `${target}.txt`;
    pictures.set(target, place);
    return place;
  }

  const resolverOf = (page) => (href) => {
    if (isElsewhere(href)) return href;
    const [path, hash = ""] = href.split(/(?=#)/);
    const target = posix.normalize(posix.join(posix.dirname(page.file), path));
    const exists = existsSync(join(root, target));
    const place = exists && placeOf(target.replace(/\/$/, statSync(join(root, target)).isDirectory() ? "" : "/"), hash);
    if (!place) faults.push(`${page.file}: ${href} leads ${exists ? "to what is not in the site" : "nowhere"}`);
    return place ? posix.relative(posix.dirname(page.out), place.split("#")[0]) + (/#.*/.exec(place)?.[0] ?? "") : href;
  };
  return { resolverOf, pictures, faults };
}
