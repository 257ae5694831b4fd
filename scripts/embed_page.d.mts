/** Types of `embed_page.mjs` for its tests. */
export function writeEmbedPage(where?: { site?: string; dist?: string }): Promise<void>;
