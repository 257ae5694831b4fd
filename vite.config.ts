import { defineConfig } from "vite";

// Relative base: the built site works from any folder of any host.
export default defineConfig({
  root: "web/playground",
  base: "./",
  publicDir: "../../public",
  build: { outDir: "../../dist", emptyOutDir: true, target: "es2022", assetsInlineLimit: 0 },
  worker: { format: "es" },
  server: { port: 5173, strictPort: true },
  preview: { port: 5173, strictPort: true },
});
