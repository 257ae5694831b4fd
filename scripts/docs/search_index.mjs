// Index of the documentation's search: for each section of each page its title and its words.

/** Returns the words of a text, each once. Numbers are omitted, since they are not searched. */
export function wordsOf(text) {
  const words = text.toLowerCase().match(/[\p{L}][\p{L}\p{N}]*/gu) ?? [];
  return [...new Set(words.filter((word) => word.length > 1))].join(" ");
}

/**
 * Returns the index as a classic script, which pages opened from a disk can load, too.
 * @param pages each with `out`, `title` and `sections`
 */
export function searchIndex(pages) {
  const list = pages.map(({ out, title }) => [out, title]);
  const sections = pages.flatMap(({ sections }, page) =>
    sections.map(({ id, title, text }) => [page, id, title, wordsOf(text.join(" "))]),
  );
  return `strutManual=${JSON.stringify({ pages: list, sections })};\n`;
}
