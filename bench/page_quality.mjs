// npm run quality: every view, the page for frames and the documentation, as Lighthouse judges pages for access, good practice
// and search engines, on its mobile and its desktop profile. Each has to have 100 of 100; what costs points is named. The page
// for frames is not for search engines.
import { join } from "node:path";
import lighthouse, { desktopConfig } from "lighthouse";
import { main, root, Sentence, step } from "../scripts/steps.mjs";
import { freePort, launchChromium, requireBuiltSite } from "./built_site.mjs";
import { serveCompressed } from "./hosted_site.mjs";

const VIEWS = ["play", "compare", "walk", "key-style", "crowd", "learn", "data"];
const CATEGORIES = ["accessibility", "best-practices", "seo"];
/** What each page is judged by. */
const PAGES = {
  ...Object.fromEntries(VIEWS.map((view) => [`#view=${view}`, CATEGORIES])),
  "docs/index.html": CATEGORIES,
  "embed.html": ["accessibility", "best-practices"],
};
const PROFILES = { mobile: undefined, desktop: desktopConfig };

/** Loads a page once; the scores by category, of 100, and the audits that cost points. */
async function judge(url, { port, onlyCategories }, config) {
  const { lhr } = await lighthouse(url, { port, onlyCategories, logLevel: "error" }, config);
  if (lhr.runtimeError) throw new Sentence(`Lighthouse could not load ${url}: ${lhr.runtimeError.message}`);
  const counts = ({ id, weight }) => weight > 0 && lhr.audits[id].score !== null && lhr.audits[id].score < 1;
  const categories = onlyCategories.map((name) => lhr.categories[name]);
  return {
    scores: categories.map(({ score }) => Math.round(100 * score)),
    faults: categories.flatMap(({ auditRefs }) => auditRefs.filter(counts).map(({ id }) => lhr.audits[id].title)),
  };
}

await main(async () => {
  requireBuiltSite();
  const site = await serveCompressed(join(root, "dist"), () => true);
  const port = await freePort();
  const browser = await launchChromium([`--remote-debugging-port=${port}`]);
  const below = [];
  try {
    for (const [profile, config] of Object.entries(PROFILES))
      await step(`Lighthouse, ${profile}: ${CATEGORIES.join(", ")}`, async () => {
        for (const [page, onlyCategories] of Object.entries(PAGES)) {
          const { scores, faults } = await judge(new URL(page, site.url).href, { port, onlyCategories }, config);
          console.log(`  ${page.padEnd(20)} ${scores.join(" ")}${faults.map((fault) => `\n    ${fault}`).join("")}`);
          if (scores.some((score) => score < 100)) below.push(`${page} (${profile})`);
        }
      });
  } finally {
    await browser.close();
    await site.close();
  }
  if (below.length > 0) throw new Sentence(`Below 100: ${below.join(", ")}.`);
});
