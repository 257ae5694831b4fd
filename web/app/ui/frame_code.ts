/** HTML to be copied into other pages. Pure functions. */

/** Permissions of a frame: to run its own scripts, and to save files at the visitor's request. */
const SANDBOX = "allow-scripts allow-same-origin allow-downloads";

/** The HTML of a frame with a page; its size is in CSS pixels. */
export function frameOf(address: string, title: string, { width, height }: { width: number; height: number }): string {
  return `<iframe src="${escaped(address)}" title="${escaped(title)}" width="${width}" height="${height}" loading="lazy" sandbox="${SANDBOX}" allow="fullscreen" style="border:0;max-width:100%"></iframe>`;
}

/** Escapes text for an attribute. */
export function escaped(text: string): string {
  const entities: Record<string, string> = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
  return text.replace(/[&<>"]/g, (character) => entities[character]!);
}
