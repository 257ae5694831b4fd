// Makes the tables of docs/evaluation.md available as module values at build time, so that no number is copied.

/**
 * Returns the tables of a document by the names of their sections in camel case. A row has its cells by column title.
 */
export function tablesOf(markdown) {
  const tables = {};
  for (const section of markdown.split(/^## /m).slice(1)) {
    const [heading, ...lines] = section.split("\n");
    const [head, , ...rows] = lines.filter((line) => line.startsWith("|")).map(cellsOf);
    if (!head) continue;
    tables[camelCase(heading)] = rows.map((row) =>
      Object.fromEntries(head.map((name, i) => [name, cellValue(row[i])]).filter(([, value]) => value !== undefined)),
    );
  }
  return tables;
}

const cellsOf = (line) =>
  line
    .slice(1, line.lastIndexOf("|"))
    .split("|")
    .map((cell) => cell.trim());

/** Returns a number, a name, or nothing. */
function cellValue(cell) {
  if (cell === undefined || cell === "") return undefined;
  return Number.isFinite(Number(cell)) ? Number(cell) : cell;
}

function camelCase(heading) {
  const [first, ...words] = heading.toLowerCase().match(/[a-z0-9]+/g) ?? [""];
  return first + words.map((word) => word[0].toUpperCase() + word.slice(1)).join("");
}

/** Vite's plugin: `evaluation.md` is a module with an export per table; a page contains only the imported ones. */
export function evaluationPlugin() {
  return {
    name: "strut-evaluation",
    enforce: "pre",
    transform(code, id) {
      if (!/\/docs\/evaluation\.md$/.test(id.split("?")[0])) return null;
      const tables = Object.entries(tablesOf(code)).filter(([name]) => /^[a-z]\w*$/.test(name));
      return {
        code: tables.map(([name, rows]) => `export const ${name} = ${JSON.stringify(rows)};`).join("\n"),
        map: null,
      };
    },
  };
}
