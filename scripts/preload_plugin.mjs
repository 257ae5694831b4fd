// A Vite plugin: the page preloads files that it always needs and requests late. Its first script imports parts
// dynamically, so that each runs in a separate task; its style sheet names the font.

/**
 * Makes `page` preload the chunks of `modules`, with all their imports, and the font. Each is identified by the end of
 * its path.
 */
export function preloadPlugin(page, { modules, font }) {
  return {
    name: "preload",
    transformIndexHtml: {
      order: "post",
      handler(html, { bundle, filename }) {
        if (!bundle || !filename.endsWith(page)) return [];
        const chunks = Object.values(bundle).filter((file) => file.type === "chunk");
        const parts = chunks.filter(({ moduleIds }) =>
          modules.some((module) => moduleIds.some((id) => id.endsWith(module))),
        );
        const scripts = [...withImports(bundle, parts)].filter((name) => !html.includes(name));
        const fonts = Object.values(bundle).filter(({ originalFileNames }) =>
          originalFileNames?.some((path) => path.endsWith(font)),
        );
        return [
          ...fonts.map(({ fileName }) => link(fileName, { rel: "preload", as: "font", type: "font/woff2" })),
          // They come before the engine, which a worker requests: a walker is shown without it.
          ...scripts.map((name) => link(name, { rel: "modulepreload" })),
        ];
      },
    },
  };
}

function link(name, attributes) {
  return { tag: "link", attrs: { ...attributes, crossorigin: true, href: `./${name}` }, injectTo: "head" };
}

/** Returns the names of chunks and of all their static imports. */
function withImports(bundle, chunks) {
  const names = new Set(chunks.map(({ fileName }) => fileName));
  // The set grows during the iteration.
  for (const name of names) for (const imported of bundle[name]?.imports ?? []) names.add(imported);
  return names;
}
