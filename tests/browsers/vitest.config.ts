import { defineConfig } from "vitest/config";

/** Configuration of the tasks in browsers other than Chromium: `npm run browsers`. */
export default defineConfig({
  test: {
    include: ["tests/browsers/*.tasks.ts"],
    testTimeout: 300_000,
    hookTimeout: 300_000,
    maxWorkers: 1,
    expect: { poll: { timeout: 120_000 } },
  },
});
