/** Returns the anchor of a heading as on GitHub. */
export function slugOf(text: string): string;
/** Returns a page's markup, its headings, its text by sections, and its addresses. */
export function renderMarkdown(
  source: string,
  resolve?: (href: string) => string,
): {
  html: string;
  headings: { level: number; id: string; text: string }[];
  sections: { id: string; title: string; text: string[] }[];
  links: string[];
};
