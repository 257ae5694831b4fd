// The tables of docs/evaluation.md are modules' values when the page is built: no number is copied.

/** The tables of a document by the names of their sections in camel case; a row has its cells by the heads of the columns. */
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

/** A number, a name, or nothing. */
function cellValue(cell) {
  if (cell === undefined || cell === "") return undefined;
  return Number.isFinite(Number(cell)) ? Number(cell) : cell;
}

function camelCase(heading) {
  const [first, ...words] = heading.toLowerCase().match(/[a-z0-9]+/g) ?? [""];
  return first + words.map((word) => word[0].toUpperCase() + word.slice(1)).join("");
}

/** Vite's plugin: `evaluation.md` is a module with an export for each table, of which a page has what it imports. */
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
