import { existsSync } from "node:fs";
import { resolve } from "node:path";
import { defineConfig } from "vite";
import { katexPlugin } from "./scripts/katex_plugin.mjs";

/** The benchmark is left out where the packages that it measures are not built: `npm start` does not wait for them. */
const pages = existsSync(resolve(import.meta.dirname, "bench/pkg/scalar/stamp")) ? ["index", "bench"] : ["index"];

// Relative base: the built site works from any folder of any host.
export default defineConfig({
  root: "web/app",
  base: "./",
  publicDir: "../../public",
  plugins: [katexPlugin()],
  build: {
    outDir: "../../dist",
    // scripts/size.mjs reads what is loaded with what.
    manifest: true,
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
    rolldownOptions: {
      input: Object.fromEntries(pages.map((page) => [page, resolve(import.meta.dirname, `web/app/${page}.html`)])),
    },
  },
  worker: { format: "es" },
  server: { port: 5173, strictPort: true },
  preview: { port: 5173, strictPort: true },
});
