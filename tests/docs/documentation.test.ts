// The documentation: what is generated is as it is committed, links lead somewhere, code blocks come from tested examples.
import { beforeAll, expect, test } from "vitest";
import { linkFaults, sizes } from "../../scripts/docs/check.mjs";
import { anchorOf, withExamples } from "../../scripts/docs/examples.mjs";
import { generatedFaults } from "../../scripts/docs/generated.mjs";
import { renderMarkdown, slugOf } from "../../scripts/docs/markdown.mjs";
import { paragraphsOf, sentencesOf, wordCount } from "../../scripts/docs/prose.mjs";
import { describe as described } from "../../scripts/docs/reference/javascript.mjs";
import { declarationsOf } from "../../scripts/docs/reference/python_stub.mjs";
import { writeDocs } from "../../scripts/docs/site.mjs";
import { buildPrograms, COMMAND } from "../programs";

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
