// The reference of the command line, from what `strut reference` prints.

/** Text in a cell of a table. */
const cell = (text) => text.replace(/\s*\n\s*/g, " ").replaceAll("|", "\\|");

/** How an option is typed: `-o, --output DB`. */
function typed({ long, short, values, is_repeated }) {
  const value = values.map((name) => (long || short ? ` ${name}` : name)).join("");
  const names = [short && `-${short}`, long && `--${long}`].filter(Boolean).join(", ");
  return `${names}${value}${is_repeated && !value.includes("…") ? "…" : ""}`;
}

/** What an option means, as a cell of a table. */
export function meaning({ help, possible_values: possible, is_required: isRequired, long, short }) {
  const choices = possible.length > 0 ? ` One of ${possible.map((value) => `\`${value}\``).join(", ")}.` : "";
  const required = isRequired && (long || short) ? " Required." : "";
  // What help leaves in brackets is the default.
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

/** The page, as Markdown. @param commands what `strut reference` prints, parsed */
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
