// npm run strips [-- --recordings DIR --ours DIR --actions walk,jump]: film strips of the built-in motions next to
// recorded ones of the same style and action, as pictures in tests/output. Recordings are those of Xia et al. 2015;
// --ours has the output of `strut demo-db --bvh`.
// npm run strips -- --quiz [--seed N --ours DIR --actions walk,jump]: a test of whether viewers recognise styles. It
// shows the built-in motions with shuffled names in tests/output/quiz with an answer sheet, index.html; the key is in
// tests/output/quiz-key.json. Without a seed, a random one is used; the key contains it, and with it the same quiz is
// made again.
import { randomInt } from "node:crypto";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { parseArgs } from "node:util";
import { chromium } from "playwright-core";
import { createServer } from "vite";
import { answerSheet, keyOf } from "./quiz.mjs";
import { main, root, run, Sentence, step } from "./steps.mjs";

const FLAGS = ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const STYLES = ["neutral", "proud", "angry", "depressed", "strutting", "childlike", "old", "sexy"];
/** Number of an action in the names of the recordings, by the name of our action. */
const ACTIONS = { walk: "01", run: "13", jump: "16", punch: "18", kick: "22" };
const VIEWS = ["side", "front"];
const OUTPUT = join(root, "tests", "output");
const QUIZ = { pictures: join(OUTPUT, "quiz"), key: join(OUTPUT, "quiz-key.json") };
/** Size of the pictures, unless strips need more height. Those of the quiz have room for two views of any action. */
const SIZE = { width: 1140, height: 800 };
const QUIZ_SIZE = { width: 1140, height: 584 };
/** One more than the highest seed. */
const SEEDS = 2 ** 32;

/** Returns our clip of an action in a style. */
const oursOf = (folder, action, style) => join(folder, `${action}_${style}_001.bvh`);

/** Returns the strips of an action: our clip and the recorded clip in every style. */
function stripsOf(action, view, ours, recordings) {
  return STYLES.flatMap((style) => {
    const files = [
      [`${style}`, oursOf(ours, action, style)],
      ["recorded", join(recordings, `${style}_${ACTIONS[action]}_000.bvh`)],
    ];
    return files
      .filter(([, path]) => existsSync(path))
      .map(([title, path]) => ({ title, bvh: readFileSync(path, "utf8"), action, view }));
  });
}

/** Opens Chromium for `work`, which receives a function that writes strips, one below the other, as a picture. */
async function withDrawing(work) {
  const server = await createServer({ root, configFile: false, logLevel: "error", server: { port: 0 } });
  await server.listen();
  const browser = await chromium.launch({
    executablePath: process.env.CHROME_PATH ?? "/usr/bin/chromium",
    args: FLAGS,
  });
  try {
    await work(async (strips, path, viewport) => {
      const page = await browser.newPage({ viewport });
      await page.goto(`${server.resolvedUrls.local[0]}evaluation/strips/`);
      await page.waitForFunction(() => window.drawStrips);
      await page.evaluate((s) => window.drawStrips(s), strips);
      await page.screenshot({ path, fullPage: true, timeout: 120_000 });
      await page.close();
    });
  } finally {
    await browser.close();
    await server.close();
  }
}

/** Draws every action in every style, ours next to the recorded ones, one picture per action and view. */
async function drawBeside(draw, actions, ours, recordings) {
  for (const action of actions)
    for (const view of VIEWS)
      await step(`Drawing ${action}, ${view}`, () =>
        draw(stripsOf(action, view, ours, recordings), join(OUTPUT, `strips-${action}-${view}.png`), SIZE),
      );
}

/**
 * Draws the quiz, one picture per motion, in the order of the names, so that the times of the files give no hint.
 * Strips have no captions: the duration of a stride could be looked up in docs/demo-motions.md.
 */
async function drawQuiz(draw, actions, ours, seed) {
  const key = keyOf(STYLES, actions, seed);
  const missing = key.strips.map(({ action, style }) => oursOf(ours, action, style)).find((path) => !existsSync(path));
  if (missing !== undefined) throw new Sentence(`${missing} is missing; a quiz needs every style of its actions.`);
  // Files of an earlier quiz would be mistaken for a part of this one.
  for (const path of Object.values(QUIZ)) rmSync(path, { recursive: true, force: true });
  mkdirSync(QUIZ.pictures);
  for (const { name, style, action } of key.strips)
    await step(`Drawing ${name} of ${key.strips.length}`, () => {
      const bvh = readFileSync(oursOf(ours, action, style), "utf8");
      return draw(
        VIEWS.map((view) => ({ bvh, action, view })),
        join(QUIZ.pictures, `${name}.png`),
        QUIZ_SIZE,
      );
    });
  const names = key.strips.map(({ name }) => name);
  writeFileSync(join(QUIZ.pictures, "index.html"), answerSheet(names, STYLES));
  writeFileSync(QUIZ.key, `${JSON.stringify(key, undefined, 2)}\n`);
}

/** Returns the given seed, or a random one. */
function seedOf({ quiz, seed }) {
  if (seed === undefined) return randomInt(SEEDS);
  if (!quiz) throw new Sentence("--seed is for --quiz: other strips are not shuffled.");
  if (!/^\d+$/.test(seed) || Number(seed) >= SEEDS)
    throw new Sentence(`Invalid seed '${seed}'. Expected a whole number from 0 to ${SEEDS - 1}.`);
  return Number(seed);
}

await main(async () => {
  const { values } = parseArgs({
    options: {
      recordings: { type: "string", default: process.env.STRUT_MOCAP ?? "../shared/data" },
      ours: { type: "string" },
      actions: { type: "string", default: Object.keys(ACTIONS).join() },
      quiz: { type: "boolean", default: false },
      seed: { type: "string" },
    },
  });
  const actions = values.actions.split(",");
  const unknown = actions.find((action) => !(action in ACTIONS));
  if (unknown !== undefined)
    throw new Sentence(`Unknown action '${unknown}'. Known: ${Object.keys(ACTIONS).join(", ")}.`);
  const seed = seedOf(values);
  const folder = mkdtempSync(join(tmpdir(), "strut-strips-"));
  const ours = values.ours ?? folder;
  const perform = ["demo-db", "-o", join(folder, "demo.strutdb"), "--bvh", folder];
  if (!values.ours)
    await step("Generating the built-in motions", () =>
      run(process.execPath, [join(root, "scripts", "strut.mjs"), ...perform]),
    );
  mkdirSync(OUTPUT, { recursive: true });
  try {
    await withDrawing((draw) =>
      values.quiz
        ? drawQuiz(draw, actions, ours, seed)
        : drawBeside(draw, actions, ours, resolve(values.recordings, "xia")),
    );
  } finally {
    rmSync(folder, { recursive: true });
  }
});
