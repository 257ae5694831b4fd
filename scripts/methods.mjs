// Checks that comments refer to existing sections of docs/methods/.
import { existsSync, readFileSync } from "node:fs";
import { join } from "node:path";

/** References such as "`docs/methods/mar.md` §2–§4 and §7", and sections of a document that does not exist. */
const REFERENCE = /`docs\/methods\/([a-z_]+\.md)`((?:(?:,| and|–)? ?§\d+[a-z]?)*)/g;
const NOWHERE = /\bspecification(?:,|'s)? §\d+/g;

/**
 * Returns a message for each broken reference of a text.
 * @param folder the folder of the documents
 */
export function referenceFaults(text, folder) {
  // A reference may continue on the next line of a comment.
  const flat = text.replace(/\s*\n\s*\/\/[/!]? ?/g, " ");
  const faults = [...flat.matchAll(NOWHERE)].map(([found]) => `'${found}' names no document; docs/methods/ has them`);
  for (const [, document, sections] of flat.matchAll(REFERENCE)) {
    const path = join(folder, document);
    if (!existsSync(path)) {
      faults.push(`docs/methods/${document} does not exist`);
      continue;
    }
    const content = readFileSync(path, "utf8");
    for (const [, number, part] of sections.matchAll(/§(\d+)([a-z]?)/g))
      if (!hasSection(content, number, part)) faults.push(`docs/methods/${document} has no §${number}${part}`);
  }
  return faults;
}

/** Returns whether a document has a section, "## 6. Styles", and in it a part, "**(c) Adaptation**". */
function hasSection(content, number, part) {
  const begin = new RegExp(`^## ${number}\\. `, "m").exec(content);
  if (!begin) return false;
  const rest = content.slice(begin.index + 1);
  const end = rest.search(/^## /m);
  return part === "" || (end < 0 ? rest : rest.slice(0, end)).includes(`**(${part})`);
}
