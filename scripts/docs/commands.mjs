// Checks that the commands in documents exist: `strut` with its options, npm scripts, programs of the repository.
import { existsSync, readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { root } from "../steps.mjs";
import { codesOf } from "./codes.mjs";

/** Languages of blocks with commands. */
const SHELL = new Set(["sh", "bash", "shell"]);

/** npm's built-in commands. */
const NPM = new Set(["start", "test", "init", "install", "ci", "pack", "publish"]);

/** Folders with programs that have their own options. */
const PROGRAMS = ["scripts", "bench", "evaluation"];

/** Environment settings before a command. */
const SETTINGS = /^([A-Z_]+=\S+ )+/;
/** Beginning of a command that is checked. */
const COMMAND = /^(strut|npm|npx|node|python) /;

/** Returns whether a line of a block needs no test: a command that is checked, a comment, or an empty line. */
export const isChecked = (line) =>
  /^\s*(#|$)/.test(line) || COMMAND.test(line.trim().replace(SETTINGS, "")) || /^pip install /.test(line);

/** Returns the commands in a block of code: its lines, with continuation lines joined. */
const linesOf = (code) =>
  code
    .replace(/\\?\n\s+(?=\S)/g, " ")
    .split("\n")
    .map((line) => line.trim());

/** Returns the words of a command, without the brackets and bars of a synopsis. */
const wordsOf = (command) =>
  command
    .replace(/'[^']*'|"[^"]*"/g, "TEXT")
    .split(/[\s()[\]|]+/)
    .filter(Boolean);

/** Returns the options among words: `--long`, `--long=VALUE`, `-s`. */
const optionsOf = (words) => words.flatMap((word) => /^--?[a-zA-Z][\w-]*/.exec(word)?.[0] ?? []);

const isOptionOf = ({ arguments: known }, option) =>
  ["--help", "-h", "--version"].includes(option) ||
  known.some(({ long, short }) => option === `--${long}` || option === `-${short}`);

/** Returns the values of a long option. Words in capitals are placeholders. */
function valuesAfter(words, long) {
  const index = words.indexOf(`--${long}`);
  const value = index < 0 ? "" : (words[index + 1] ?? "");
  return /^[a-z]/.test(value) ? value.split(",") : [];
}

/** Returns the faults of the words after `strut`. */
function strutFaults(words, commands) {
  const [name, ...rest] = words;
  if (name === undefined || !/^[a-z][a-z-]*$/.test(name)) return [];
  const command = commands.find((each) => each.name === name);
  if (!command) return [`'strut' has no command '${name}'`];
  const options = optionsOf(rest);
  const wrong = options.filter((option) => !isOptionOf(command, option));
  const values = command.arguments.flatMap(({ long, possible_values: known }) =>
    valuesAfter(rest, long)
      .filter((value) => known.length > 0 && !known.includes(value))
      .map((value) => `'strut ${name} --${long}' takes no '${value}'`),
  );
  return [...wrong.map((option) => `'strut ${name}' has no option '${option}'`), ...values];
}

let read;

/** Returns the text of all programs that npm scripts run. */
function programs() {
  read ??= PROGRAMS.flatMap((folder) =>
    readdirSync(join(root, folder), { recursive: true })
      .filter((name) => name.endsWith(".mjs") && !name.startsWith("docs/"))
      .map((name) => readFileSync(join(root, folder, name), "utf8")),
  ).join("\n");
  return read;
}

/** Returns options that do not occur in the text of a program. */
const missingOptions = (options, text, what) =>
  options.filter((option) => !text.includes(option)).map((option) => `${what} has no option '${option}'`);

/** Returns the faults of the words after `npm`. */
function npmFaults([first, second, ...rest], commands) {
  if (first === "run" && second === "strut")
    return strutFaults(
      rest.filter((word) => word !== "--"),
      commands,
    );
  const name = first === "run" ? second : first;
  if (NPM.has(name) && first !== "run" && !["start", "test"].includes(name)) return [];
  const { scripts } = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
  if (!/^[a-z]/.test(name ?? "")) return [];
  if (!scripts[name]) return [`npm has no script '${name}'`];
  return missingOptions(optionsOf(rest), programs(), `'npm run ${name}'`);
}

/** Returns the faults of a program of the repository: `node FILE …`. */
function programFaults([path, ...rest], file) {
  if (path === undefined || !/\.(m?js|py)$/.test(path)) return [];
  const found = [path, join(dirname(file), path)].map((each) => join(root, each)).find((each) => existsSync(each));
  // A name without a folder is the user's own file.
  if (!found) return path.includes("/") ? [`there is no ${path}`] : [];
  return missingOptions(optionsOf(rest), readFileSync(found, "utf8"), path);
}

/** Returns the faults of `npx PROGRAM … PATH`. */
function npxFaults([program, ...rest]) {
  const paths = rest.filter((word) => /^(tests|web|scripts)\//.test(word));
  return [
    ...(existsSync(join(root, "node_modules", ".bin", program)) ? [] : [`npx has no program '${program}'`]),
    ...paths.filter((path) => !existsSync(join(root, path))).map((path) => `there is no ${path}`),
  ];
}

/** Returns a message for each fault of a command. @param file the document, a path in the repository */
function faultsOf(text, file, commands) {
  const [program, ...words] = wordsOf(text.replace(SETTINGS, ""));
  if (program === "strut") return strutFaults(words, commands);
  if (program === "npm") return npmFaults(words, commands);
  if (program === "npx") return npxFaults(words);
  if (program === "node" || program === "python") return programFaults(words, file);
  if (program?.startsWith("--")) {
    const isKnown = commands.some((command) => isOptionOf(command, optionsOf([program])[0]));
    return isKnown || programs().includes(program) ? [] : [`no program has the option '${program}'`];
  }
  return [];
}

/**
 * Returns commands and options in the code of a document that do not exist.
 * @param commands output of `strut reference`
 * @returns a message for each
 */
export function commandFaults(markdown, file, commands) {
  return codesOf(markdown).flatMap(({ line, language, code }) => {
    const isBlock = language !== undefined;
    const texts = !isBlock ? [code] : SHELL.has(language) || language === "text" ? linesOf(code) : [];
    return texts.flatMap((text) => faultsOf(text, file, commands).map((fault) => `${file}:${line}: ${fault}`));
  });
}
