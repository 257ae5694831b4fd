// Parser of a Python source or stub, for the syntax that this package uses: classes, functions, properties, attributes,
// each with its docstring.

/** Returns the logical lines of a source, in which brackets join lines. Each has its indentation and number. */
function logicalLines(source) {
  const lines = [];
  let depth = 0;
  let string;
  for (const line of source.split("\n")) {
    if (string !== undefined) {
      lines.at(-1).text += `\n${line}`;
      if (line.includes('"""')) string = undefined;
      continue;
    }
    if (depth > 0) lines.at(-1).text += ` ${line.trim()}`;
    else if (line.trim() !== "" && !line.trim().startsWith("#"))
      lines.push({ indent: /^ */.exec(line)[0].length, text: line.trim() });
    const quotes = line.split('"""').length - 1;
    if (quotes === 1) string = true;
    if (quotes === 0) depth += (line.match(/[([{]/g) ?? []).length - (line.match(/[)\]}]/g) ?? []).length;
  }
  return lines.map(({ indent, text }) => ({
    indent,
    text: text.replace(/([([{]) /g, "$1").replace(/,? ([)\]}])/g, "$1"),
  }));
}

/** Returns the text of a docstring without its indentation. */
function docText(text) {
  const lines = text.replace(/^"""|"""$/g, "").split("\n");
  return lines
    .map((line) => line.trim())
    .join("\n")
    .trim();
}

const isDoc = (line) => line?.text.startsWith('"""');

/**
 * Returns the declarations of a source.
 * @returns a list of `{ kind, name, signature, doc, members }`, where `kind` is `class`, `function`, `property` or
 * `attribute`
 */
export function declarationsOf(source) {
  const lines = logicalLines(source);
  return readBlock(lines, 0, 0).declarations;
}

function readBlock(lines, start, indent) {
  const declarations = [];
  let decorators = [];
  let i = start;
  while (i < lines.length && lines[i].indent >= indent) {
    const { text, indent: own } = lines[i];
    i += 1;
    if (text.startsWith("@")) {
      decorators.push(text);
      continue;
    }
    const found = declarationIn(text, decorators);
    decorators = [];
    if (found) declarations.push(found);
    if (found?.kind === "class" || text.startsWith("def ")) {
      if (isDoc(lines[i]) && lines[i].indent > own) found.doc = docText(lines[i].text);
      const inner = readBlock(lines, i, own + 1);
      if (found?.kind === "class") found.members = inner.declarations;
      i = inner.end;
    } else if (found && isDoc(lines[i]) && lines[i].indent === own) found.doc = docText(lines[i].text);
  }
  return { declarations, end: i };
}

function declarationIn(text, decorators) {
  const klass = /^class (\w+)(\(.*\))?:/.exec(text);
  if (klass)
    return { kind: "class", name: klass[1], signature: text.replace(/:(?: \.\.\.)?$/, ""), doc: "", members: [] };
  const def = /^def (\w+)(\(.*\)(?: -> .*?)?):(?: \.\.\.)?$/.exec(text);
  if (def) {
    const isProperty = decorators.includes("@property");
    const isStatic = decorators.includes("@staticmethod") || decorators.includes("@classmethod");
    const returns = /-> (.*)$/.exec(def[2])?.[1] ?? "";
    return {
      kind: isProperty ? "property" : "function",
      name: def[1],
      signature: isProperty ? returns : def[2],
      isStatic,
      doc: "",
    };
  }
  const attribute = /^(\w+): ([^=]+?)(?: = .*)?$/.exec(text) ?? /^([A-Z]\w+) = (.*)$/.exec(text);
  return attribute && { kind: "attribute", name: attribute[1], signature: attribute[2], doc: "" };
}
