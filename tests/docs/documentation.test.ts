// The documentation: generated parts are up to date, links work, code blocks come from tested examples.
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { beforeAll, expect, test } from "vitest";
import { linkFaults, sizes } from "../../scripts/docs/check.mjs";
import { codesOf } from "../../scripts/docs/codes.mjs";
import { commandFaults } from "../../scripts/docs/commands.mjs";
import { elementFaults } from "../../scripts/docs/elements.mjs";
import { anchorOf, withExamples } from "../../scripts/docs/examples.mjs";
import { generatedFaults } from "../../scripts/docs/generated.mjs";
import { renderMarkdown, slugOf } from "../../scripts/docs/markdown.mjs";
import { paragraphsOf, sentencesOf, wordCount } from "../../scripts/docs/prose.mjs";
import { describe as described } from "../../scripts/docs/reference/javascript.mjs";
import { declarationsOf } from "../../scripts/docs/reference/python_stub.mjs";
import { writeDocs } from "../../scripts/docs/site.mjs";
import { readTables } from "../../scripts/element_manifest.mjs";
import { buildPrograms, COMMAND } from "../programs";
import { root } from "../recordings";
import { bvh } from "./engine_use";

beforeAll(async () => {
  buildPrograms();
  await writeDocs();
});

test("the reference and the code blocks are as 'npm run docs' writes them", async () => {
  expect(await generatedFaults(COMMAND)).toEqual([]);
});

test("every link of the site leads somewhere, and it is as small as it should be", () => {
  expect(linkFaults()).toEqual([]);
  const { faults, report } = sizes();
  expect(faults).toEqual([]);
  console.log(report);
});

test("a block of code that comes from no example is named", () => {
  const { faults } = withExamples("Text.\n\n```js\nlet a;\n```\n\n```text\nx\n```\n", "a.md");
  expect(faults).toEqual(["a.md:3: this block of js comes from no example; name one, or make it text"]);
});

test("a block without a language, and a text that looks like code, are named", () => {
  const faultsOf = (language: string, code: string) =>
    withExamples(`\`\`\`${language}\n${code}\n\`\`\`\n`, "a.md").faults;
  expect(faultsOf("", "x")).toEqual(["a.md:1: this block names no language; text is one"]);
  expect(faultsOf("text", "await loadStrut();")).toEqual([
    "a.md:1: this block of text looks like code; name its language",
  ]);
  expect(faultsOf("sh", "rm walk.bvh")).toEqual([
    "a.md:1: this block of sh comes from no example; name one, or make it text",
  ]);
  expect(faultsOf("sh", "# Styles.\nstrut stylize\nN=2 npx vitest run")).toEqual([]);
  expect(faultsOf("html", "<p>")).toHaveLength(1);
  expect(faultsOf("html", "<strut-player></strut-player>")).toEqual([]);
});

test("commands, options and their values that there are not are named", () => {
  const argument = { long: "place", short: "p", possible_values: ["follow", "free"] };
  const commands = [{ name: "live", arguments: [argument] }];
  const faultsOf = (code: string) =>
    commandFaults(`\`${code}\``, "a.md", commands).map((fault) => fault.replace(/^a\.md:1: /, ""));
  expect(faultsOf("strut life")).toEqual(["'strut' has no command 'life'"]);
  expect(faultsOf("strut live --plate x -q")).toEqual([
    "'strut live' has no option '--plate'",
    "'strut live' has no option '-q'",
  ]);
  expect(faultsOf("strut live --place away")).toEqual(["'strut live --place' takes no 'away'"]);
  expect(faultsOf("npm run strut -- live --plate")).toEqual(["'strut live' has no option '--plate'"]);
  expect(faultsOf("npm run dogs")).toEqual(["npm has no script 'dogs'"]);
  expect(faultsOf("npm run docs -- --check --chuck")).toEqual(["'npm run docs' has no option '--chuck'"]);
  expect(faultsOf("node scripts/none.mjs")).toEqual(["there is no scripts/none.mjs"]);
  expect(faultsOf("npx vitest run tests/none.test.ts")).toEqual(["there is no tests/none.test.ts"]);
  expect(faultsOf("--plate")).toEqual(["no program has the option '--plate'"]);
  for (const right of ["strut COMMAND --help", "strut live [--place P | -p P]", "npm start", "--place", "node my.mjs"])
    expect(faultsOf(right), right).toEqual([]);
});

test("attributes and their values that elements do not have are named", async () => {
  const tables = await readTables();
  const faultsOf = (code: string) =>
    elementFaults(`\`\`\`html\n${code}\n\`\`\``, "a.md", tables).map((fault) => fault.replace(/^a\.md:1: /, ""));
  expect(faultsOf('<strut-player style="x" autoplay stiles="old:1"></strut-player>')).toEqual([
    "<strut-player> has no attribute 'stiles'",
  ]);
  expect(faultsOf('<strut-player camera="back"></strut-player>')).toEqual(["the attribute 'camera' takes no 'back'"]);
  expect(faultsOf('<strut-figure kind="scatter" hide="table" knd="x">')).toEqual([
    "<strut-figure> has no attribute 'knd'",
  ]);
  expect(faultsOf("<strut-plaier>")).toEqual(["there is no element <strut-plaier>"]);
  expect(faultsOf('<iframe src="embed.html?controls&style=old">')).toEqual([]);
  expect(faultsOf('<iframe src="embed.html?controls&stiles=old">')).toHaveLength(1);
});

test("the configurations in docs/embedding.md and docs/hosting.md are those that are used", () => {
  const blocks = (name: string, language: string) =>
    codesOf(readFileSync(join(root, "docs", name), "utf8")).filter((code) => code.language === language);
  const [parcel] = blocks("embedding.md", "json");
  const used = JSON.parse(readFileSync(join(root, "tests", "package", "parcel", "package.json"), "utf8")) as object;
  expect(used).toMatchObject(JSON.parse(parcel!.code) as object);
  // All servers send the same headers.
  const values = ["nosniff", "strict-origin-when-cross-origin", "camera=(), microphone=(), geolocation=()"];
  for (const language of ["nginx", "caddy", "headers"])
    for (const value of [...values, "max-age=31536000, immutable", "no-cache", "frame-ancestors 'self'"])
      expect(blocks("hosting.md", language)[0]!.code).toContain(value);
});

test("the engine runs without a page as docs/ARCHITECTURE.md says", () => {
  expect(bvh).toMatch(/^HIERARCHY/);
});

test("an example that there is not is named, and one that changed is written anew", () => {
  const block = (path: string) => `<!-- example: ${path} -->\n\`\`\`js\nold\n\`\`\`\n`;
  expect(withExamples(block("js/none.mjs"), "a.md").faults).toEqual(["a.md: there is no example js/none.mjs"]);
  const { text, faults } = withExamples(block("js/first_style.mjs"), "a.md");
  expect(faults).toEqual([]);
  expect(text).toContain("loadStrut");
  expect(text).not.toContain("old\n");
});

test("an anchor gives its lines without their indentation", () => {
  expect(anchorOf("a\n  // anchor x\n  b\n    c\n  // end x\nd", "x")).toBe("b\n  c");
  expect(anchorOf("a", "x")).toBeUndefined();
});

test("headings have GitHub's anchors, formulas both markups, and links are resolved", () => {
  expect(slugOf("8. Input outside the `database`")).toBe("8-input-outside-the-database");
  const page = renderMarkdown(
    "# T\n\n## A b\n\n## A b\n\n[x](y.md) and $`a_1`$\n\n$$\nb\n$$\n",
    (href) => `to-${href}`,
  );
  expect(page.headings.map(({ id }) => id)).toEqual(["t", "a-b", "a-b-1"]);
  expect(page.links).toEqual(["y.md"]);
  expect(page.html).toContain('href="to-y.md"');
  expect(page.html.match(/<math/g)).toHaveLength(2);
});

test("sentences are counted in words, code as one", () => {
  const [paragraph] = paragraphsOf("One two `three four`. Five\nsix.\n\n| a | b |\n| --- | --- |\n| c | d |\n");
  expect(sentencesOf(paragraph!.text).map(wordCount)).toEqual([3, 2]);
});

test("a stub is read with what its brackets hold together", () => {
  const [found] = declarationsOf(
    'class A:\n    """What."""\n    @property\n    def b(self) -> int: ...\n    def c(\n        self, x: int,\n    ) -> str: ...\n',
  );
  expect(found).toMatchObject({ kind: "class", name: "A", doc: "What." });
  expect(found!.members).toMatchObject([
    { kind: "property", name: "b", signature: "int" },
    { kind: "function", name: "c", signature: "(self, x: int) -> str" },
  ]);
});

test("tags of a comment become sentences", () => {
  expect(described("Opens {@link X.y}. @throws StrutError `bad-file`")).toBe(
    "Opens `X.y`.\n\nThrows `StrutError`: `bad-file`.",
  );
});
