/** The anchor of a heading as GitHub makes it. */
export function slugOf(text: string): string;
/** A page's markup, its headings, its text by sections, and the addresses that it has. */
export function renderMarkdown(
  source: string,
  resolve?: (href: string) => string,
): {
  html: string;
  headings: { level: number; id: string; text: string }[];
  sections: { id: string; title: string; text: string[] }[];
  links: string[];
};
