// npm run strips [-- --recordings DIR --ours DIR --actions walk,jump]: film strips of the built-in motions beside recorded ones of
// the same style and action, as pictures in tests/output. Recordings are those of Xia et al. 2015; --ours has what
// `strut demo-db --bvh` wrote before.
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";
import { createServer } from "vite";
import { main, root, run, Sentence, step } from "./steps.mjs";

const FLAGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const STYLES = ["neutral", "proud", "angry", "depressed", "strutting", "childlike", "old", "sexy"];
/** Number of an action in the names of the recordings, and the clip of ours that shows it. */
const ACTIONS = { walk: "01", run: "13", jump: "16", punch: "18", kick: "22" };
const VIEWS = ["side", "front"];
const OUTPUT = join(root, "tests", "output");

/** The strips of an action: ours and the recorded clip in every style. */
function stripsOf(action, view, ours, recordings) {
  return STYLES.flatMap((style) => {
    const files = [
      [`${style}`, join(ours, `${action}_${style}_001.bvh`)],
      ["recorded", join(recordings, `${style}_${ACTIONS[action]}_000.bvh`)],
    ];
    return files
      .filter(([, path]) => existsSync(path))
      .map(([title, path]) => ({ title, bvh: readFileSync(path, "utf8"), action, view }));
  });
}

await main(async () => {
  const { values } = parseArgs({
    options: {
      recordings: { type: "string", default: process.env.STRUT_MOCAP ?? "../shared/data" },
      ours: { type: "string" },
      actions: { type: "string", default: Object.keys(ACTIONS).join() },
    },
  });
  const actions = values.actions.split(",");
  const unknown = actions.find((action) => !(action in ACTIONS));
  if (unknown !== undefined) throw new Sentence(`'${unknown}' is none of ${Object.keys(ACTIONS).join(", ")}.`);
  const folder = mkdtempSync(join(tmpdir(), "strut-strips-"));
  const ours = values.ours ?? folder;
  const perform = ["demo-db", "-o", join(folder, "demo.strutdb"), "--bvh", folder];
  if (!values.ours)
    await step("Performing the built-in motions", () =>
      run(process.execPath, [join(root, "scripts", "strut.mjs"), ...perform]),
    );
  const server = await createServer({ root, configFile: false, logLevel: "error", server: { port: 0 } });
  await server.listen();
  const browser = await chromium.launch({
    executablePath: process.env.CHROME_PATH ?? "/usr/bin/chromium",
    args: FLAGS,
  });
  mkdirSync(OUTPUT, { recursive: true });
  try {
    for (const action of actions)
      for (const view of VIEWS)
        await step(`Drawing ${action}, ${view}`, async () => {
          const page = await browser.newPage({ viewport: { width: 1140, height: 800 } });
          await page.goto(`${server.resolvedUrls.local[0]}evaluation/strips/`);
          await page.waitForFunction(() => window.drawStrips);
          const strips = stripsOf(action, view, ours, resolve(values.recordings, "xia"));
          await page.evaluate((s) => window.drawStrips(s), strips);
          const path = join(OUTPUT, `strips-${action}-${view}.png`);
          await page.screenshot({ path, fullPage: true, timeout: 120_000 });
          await page.close();
        });
  } finally {
    await browser.close();
    await server.close();
    rmSync(folder, { recursive: true });
  }
});
