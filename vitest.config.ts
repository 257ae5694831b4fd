import { defineConfig } from "vitest/config";
import { evaluationPlugin } from "./scripts/evaluation_plugin.mjs";
import { katexPlugin } from "./scripts/katex_plugin.mjs";

/** The projects run one after the other, in this order. */
const projects = [
  // Beside the code; as many files at once as there are cores (Vitest would leave one idle).
  { name: "unit", include: ["web/**/*.test.ts"], maxWorkers: "100%" },
  // The page's modules beside the native programs.
  { name: "native", include: ["tests/**/*.test.ts"], exclude: ["tests/{e2e,visual}/**"], maxWorkers: "100%" },
  // One Chromium at a time: drawing in software takes every core. The files share what they import, above all Vite and
  // Playwright, which take a second and a half to load.
  { name: "browser", include: ["tests/{e2e,visual}/**/*.test.ts"], maxWorkers: 1, isolate: false },
];

export default defineConfig({
  plugins: [evaluationPlugin(), katexPlugin()],
  test: {
    // Bounds for slow machines; what fails does not wait for them.
    testTimeout: 300_000,
    hookTimeout: 300_000,
    expect: { poll: { timeout: 60_000 } },
    projects: projects.map((project, groupOrder) => ({
      extends: true,
      test: { ...project, sequence: { groupOrder } },
    })),
  },
});
