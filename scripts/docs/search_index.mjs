// What the search of the documentation reads: for each section of each page its title and the words that are in it.

/** Words of a text, each once; numbers are left out, as nobody looks for them. */
export function wordsOf(text) {
  const words = text.toLowerCase().match(/[\p{L}][\p{L}\p{N}]*/gu) ?? [];
  return [...new Set(words.filter((word) => word.length > 1))].join(" ");
}

/**
 * The index as a classic script, which a page opened from a disk can load as well.
 * @param pages each with `out`, `title` and `sections`
 */
export function searchIndex(pages) {
  const list = pages.map(({ out, title }) => [out, title]);
  const sections = pages.flatMap(({ sections }, page) =>
    sections.map(({ id, title, text }) => [page, id, title, wordsOf(text.join(" "))]),
  );
  return `strutManual=${JSON.stringify({ pages: list, sections })};\n`;
}
