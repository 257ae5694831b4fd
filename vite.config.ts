import { existsSync } from "node:fs";
import { resolve } from "node:path";
import { defineConfig } from "vite";
import { evaluationPlugin } from "./scripts/evaluation_plugin.mjs";
import { katexPlugin } from "./scripts/katex_plugin.mjs";
import { offlinePlugin } from "./scripts/offline_plugin.mjs";
import { preloadPlugin } from "./scripts/preload_plugin.mjs";
import { threePlugin } from "./scripts/three_plugin.mjs";

/** The benchmark is left out where the packages that it measures are not built: `npm start` does not wait for them. */
const measured = ["gpu", "scalar"].map((name) => resolve(import.meta.dirname, `bench/pkg/${name}/stamp`));
const pages = measured.every((stamp) => existsSync(stamp)) ? ["index", "bench"] : ["index"];

// Relative base: the built site works from any folder of any host.
export default defineConfig({
  root: "web/app",
  base: "./",
  publicDir: "../../public",
  plugins: [
    evaluationPlugin(),
    katexPlugin(),
    threePlugin(),
    preloadPlugin("/index.html", {
      modules: ["web/viewer/viewer.ts", "web/app/shell/app.ts"],
      font: "inter-latin-wght-normal.woff2",
    }),
    offlinePlugin(),
  ],
  build: {
    outDir: "../../dist",
    // scripts/site_files.mjs reads what is loaded with what.
    manifest: true,
    // scripts/notices.mjs makes the site's notices of it.
    license: { fileName: ".vite/licenses.json" },
    emptyOutDir: true,
    target: "es2022",
    // The browsers of the README: they know `light-dark()` themselves, also where a figure stands on another page.
    cssTarget: ["chrome123", "edge123", "firefox125", "safari17.5"],
    assetsInlineLimit: 0,
    rolldownOptions: {
      input: {
        ...Object.fromEntries(pages.map((page) => [page, resolve(import.meta.dirname, `web/app/${page}.html`)])),
        "strut-figure": resolve(import.meta.dirname, "web/figures/index.ts"),
      },
      // Other pages load figures by this name, so it must last.
      output: {
        entryFileNames: ({ name }) => (name === "strut-figure" ? "[name].js" : "assets/[name]-[hash].js"),
        // What every page and view has: as files of their own they would each cost a request on the way to the first picture.
        codeSplitting: {
          groups: [{ name: "page", test: /web\/(ui|humanoid|link|app\/ui)\/.*\.ts$/, minShareCount: 3 }],
        },
      },
    },
  },
  worker: { format: "es" },
  server: { port: 5173, strictPort: true },
  preview: { port: 5173, strictPort: true },
});
