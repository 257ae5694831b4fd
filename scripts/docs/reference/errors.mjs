// The reference of error codes, from the lists of JavaScript and Rust, which must agree.
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { root, Sentence } from "../../steps.mjs";
import { rustSource } from "./rust_docs.mjs";

const ERRORS = join(root, "web", "engine", "errors.ts");

/** Returns the codes of JavaScript's errors, each with its description. */
function codesOfJavaScript() {
  const source = readFileSync(ERRORS, "utf8");
  const documented = new Map(
    [...source.matchAll(/^ \* - `([a-z-]+)`: (.*?)[;.]$/gm)].map(([, code, meaning]) => [
      code,
      meaning.replaceAll("`", "`"),
    ]),
  );
  const type = /type StrutErrorCode =([^;]*);/.exec(source)[1];
  const codes = [...type.matchAll(/"([a-z-]+)"/g)].map(([, code]) => code);
  const faults = [
    ...codes
      .filter((code) => !documented.has(code))
      .map((code) => `${code} has no description in web/engine/errors.ts`),
    ...[...documented.keys()]
      .filter((code) => !codes.includes(code))
      .map((code) => `${code} is described in web/engine/errors.ts and is no code`),
  ];
  return { documented, codes, faults };
}

/** Returns the codes that the engine's WebAssembly packages throw in JavaScript. */
function codesOfWasm() {
  const folders = readdirSync(join(root, "rust")).filter((name) => name.startsWith("strut-wasm"));
  const codes = folders.flatMap((folder) =>
    readdirSync(join(root, "rust", folder, "src"), { recursive: true })
      .filter((name) => name.endsWith(".rs"))
      .flatMap((name) =>
        [...rustSource(join(folder, "src", name)).matchAll(/code: "([a-z-]+)"/g)].map(([, code]) => code),
      ),
  );
  return [...new Set(codes)];
}

/** Returns the codes of tasks, in manifests and in Python. */
function codesOfTasks() {
  const body = /pub fn name\(self\)[^{]*\{([\s\S]*?)\n {4}\}/.exec(rustSource("strut-tasks/src/error.rs"))[1];
  return [...new Set([...body.matchAll(/=> "([a-z-]+)"/g)].map(([, code]) => code))];
}

/** Returns the codes in the declaration of Python's exception. */
function codesOfPython() {
  const source = readFileSync(join(root, "rust", "strut-python", "python", "strut", "_errors.py"), "utf8");
  return [.../code: Literal\[([^\]]*)\]/.exec(source)[1].matchAll(/"([a-z-]+)"/g)].map(([, code]) => code);
}

/** Returns the page as Markdown. Throws a message if the lists do not agree. */
export function errorsPage() {
  const { documented, codes, faults } = codesOfJavaScript();
  const [wasm, tasks, python] = [codesOfWasm(), codesOfTasks(), codesOfPython()];
  const unknown = [
    ...wasm
      .filter((code) => !codes.includes(code))
      .map((code) => `WebAssembly gives ${code}, which web/engine/errors.ts lacks`),
    // An I/O error is an OSError in Python, and does not occur in JavaScript.
    ...tasks
      .filter((code) => code !== "io" && !codes.includes(code))
      .map((code) => `tasks give ${code}, which web/engine/errors.ts lacks`),
    ...tasks
      .filter((code) => code !== "io" && !python.includes(code))
      .map((code) => `tasks give ${code}, which Python's StrutError lacks`),
    ...python
      .filter((code) => !tasks.includes(code))
      .map((code) => `Python's StrutError declares ${code}, which no task gives`),
  ];
  if (faults.length + unknown.length > 0)
    throw new Sentence(`error codes do not agree:\n  ${[...faults, ...unknown].join("\n  ")}`);
  const meaning = (code) =>
    code === "io" ? "the system could not read or write; an `OSError` in Python" : documented.get(code);
  const mark = (list, code) => (list.includes(code) ? "yes" : "");
  const rows = [...codes, "io"].map(
    (code) =>
      `| \`${code}\` | ${meaning(code)} | ${mark(codes, code)} | ${mark(python, code)} | ${mark(tasks, code)} |`,
  );
  return `# Errors

Every error has a code for programs, and a message of one sentence that states what was expected. If you can solve the problem,
a hint explains how.

| Code | Meaning | JavaScript | Python | Manifests of batches |
| --- | --- | --- | --- | --- |
${rows.join("\n")}

## In each language

| | An error is |
| --- | --- |
| JavaScript | a \`StrutError\` with \`code\`, \`message\` and \`hint\`; calls reject with it |
| Python | a \`strut.StrutError\` with \`code\`, \`message\` and \`hint\`; \`OSError\` where the system cannot read or write |
| Command line | \`error: \` and the message on the standard error; exit code 1, or 2 for wrong usage |
| Batches | \`status\`, \`code\` and \`message\` in a line of the manifest |
`;
}
