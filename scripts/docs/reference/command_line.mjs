// The reference of the command line, from the output of `strut reference`.

/** Returns text as a table cell. */
const cell = (text) => text.replace(/\s*\n\s*/g, " ").replaceAll("|", "\\|");

/** Returns an option as it is typed: `-o, --output DB`. */
function typed({ long, short, values, is_repeated }) {
  const value = values.map((name) => (long || short ? ` ${name}` : name)).join("");
  const names = [short && `-${short}`, long && `--${long}`].filter(Boolean).join(", ");
  return `${names}${value}${is_repeated && !value.includes("…") ? "…" : ""}`;
}

/** Returns the meaning of an option as a table cell. */
export function meaning({ help, possible_values: possible, is_required: isRequired, long, short }) {
  const choices = possible.length > 0 ? ` One of ${possible.map((value) => `\`${value}\``).join(", ")}.` : "";
  const required = isRequired && (long || short) ? " Required." : "";
  // The help has the default in brackets.
  const sentence = help.replace(/\s*\[default: [^\]]*\]/, "");
  return cell(`${sentence}${/[.:]$/.test(sentence) ? "" : "."}${choices}${required}`);
}

const initial = ({ default: value, help }) => {
  const described = /\[default: ([^\]]*)\]/.exec(help)?.[1];
  if (value) return `\`${cell(value)}\``;
  return described ? cell(described) : "";
};

function commandSection({ name, about, usage, more, arguments: options }) {
  const [title, ...rest] = about.split("\n\n");
  const rows = options.map((option) => `| \`${cell(typed(option))}\` | ${initial(option)} | ${meaning(option)} |`);
  return [
    `## strut ${name}`,
    `${title}.`,
    ...rest,
    `\`\`\`text\n${usage}\n\`\`\``,
    ["| Option | Default | Meaning |", "| --- | --- | --- |", ...rows].join("\n"),
    ...(more ? [`\`\`\`text\n${more}\n\`\`\``] : []),
  ].join("\n\n");
}

/** Returns the page as Markdown. @param commands parsed output of `strut reference` */
export function commandLinePage(commands) {
  const list = commands.map(({ name, about }) => `| [\`${name}\`](#strut-${name}) | ${cell(about.split("\n\n")[0])} |`);
  return `# Command line

Every command and option, as \`strut COMMAND --help\` prints them. [The guide](../command-line.md) has examples.

| Command | |
| --- | --- |
${list.join("\n")}

Exit codes: 0 done; 1 failed, with \`error: \` and one sentence; 2 wrong usage; 130 ended by Ctrl-C.

${commands.map(commandSection).join("\n\n")}
`;
}
