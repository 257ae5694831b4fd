// npm run quality: Lighthouse's scores of accessibility, best practices and SEO for every view, the page for iframes
// and the documentation, with its mobile and its desktop profile. Each must be 100 of 100; audits that cost points are
// listed. The page for iframes is not tested for SEO.
import { join } from "node:path";
import lighthouse, { desktopConfig } from "lighthouse";
import { main, root, Sentence, step } from "../scripts/steps.mjs";
import { freePort, launchChromium, requireBuiltSite } from "./built_site.mjs";
import { serveCompressed } from "./hosted_site.mjs";

const VIEWS = ["play", "compare", "walk", "key-style", "crowd", "learn", "data"];
const CATEGORIES = ["accessibility", "best-practices", "seo"];
/** Categories that are tested on each page. */
const PAGES = {
  ...Object.fromEntries(VIEWS.map((view) => [`#view=${view}`, CATEGORIES])),
  "docs/index.html": CATEGORIES,
  "embed.html": ["accessibility", "best-practices"],
};
const PROFILES = { mobile: undefined, desktop: desktopConfig };

/** Loads a page once. Returns the scores by category, out of 100, and the audits that cost points. */
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
