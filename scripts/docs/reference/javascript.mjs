// The reference of the JavaScript package, from the comments of its exports.
import { join } from "node:path";
import { root, Sentence } from "../../steps.mjs";
import { commentBefore, exportsOf, find } from "./typescript.mjs";

const PACKAGE = join(root, "web", "package");

const ENTRIES = [
  {
    name: "strut-motion",
    file: "index.ts",
    about: "In browsers: the engine in a worker. In Node: the same as `strut-motion/node`.",
  },
  { name: "strut-motion/node", file: "node.ts", about: "In Node: the engine on the calling thread." },
  {
    name: "strut-motion/inline",
    file: "inline.ts",
    about: "Everything in one file, for notebooks and modules without a URL.",
  },
  { name: "strut-motion/streams", file: "streams.ts", about: "Sources of live poses, for `Strut.live`." },
  { name: "strut-motion/three", file: "three.ts", about: "Rigged characters of three.js." },
  {
    name: "strut-motion/element",
    file: "element.ts",
    about: "The element [`<strut-player>`](strut-player.md), for bundlers.",
  },
];

const cell = (text) => text.replace(/\s*\n\s*/g, " ").replaceAll("|", "\\|");

/** Returns a comment as Markdown: the description, then parameters, result and errors. */
export function describe(comment) {
  const [text, ...tags] = comment
    .replace(/\{@link ([^}|\s]+)[^}]*\}/g, "`$1`")
    .split(/(?:^|\s)@(?=(?:param|returns|throws)\s)/);
  const said = tags.map((tag) => {
    const [, kind, rest] = /^(\w+)\s+([\s\S]*)$/.exec(tag.trim());
    if (kind === "param") return rest.replace(/^(\w+)\s*/, "`$1`: ");
    if (kind === "returns") return `Returns ${rest}`;
    return `Throws ${rest.replace(/^StrutError\b/, "`StrutError`:")}`;
  });
  return [text.trim(), ...said.map((line) => (/[.!?]$/.test(line) ? line : `${line}.`))].filter(Boolean).join("\n\n");
}

/** Returns the code of a declaration without its comments and its body. */
function signature(source, node) {
  const value = node.type === "MethodDefinition" ? node.value : node;
  const end = value.body && !node.type.startsWith("TS") ? value.body.start : node.end;
  const code = source.slice(node.start, end).replace(/\/\*\*(?:(?!\*\/)[\s\S])*\*\/\s*/g, "");
  return withoutIndent(code.replace(/^(?:override |async )+/, "").replace(/[;,]?\s*$/, ""));
}

function withoutIndent(code) {
  const [first, ...rest] = code.split("\n");
  const indents = rest.filter((line) => line.trim() !== "").map((line) => /^ */.exec(line)[0].length);
  const indent = Math.min(...indents, 99);
  return [first, ...rest.map((line) => line.slice(indent))].join("\n");
}

const block = (code) => `\`\`\`ts\n${code}\n\`\`\``;

/** Members that only the browser calls. */
const PLATFORM = /^(observedAttributes|\w+Callback)$/;

/** Returns the members of an interface or a class that its users see, including those that it picks from another. */
function membersOf({ node, source, file }) {
  return [...ownMembers({ node, source }), ...(node.extends ?? []).flatMap((heritage) => picked(heritage, file))];
}

/** Returns the members that `Pick<Type, "name" | …>` names. */
function picked({ expression, typeArguments }, file) {
  if (expression.name !== "Pick") return [];
  const [type, names] = typeArguments.params;
  const wanted = (names.types ?? [names]).map(({ literal }) => literal.value);
  const declaration = find(file, type.typeName.name);
  return membersOf(declaration).filter(({ name }) => wanted.includes(name));
}

function ownMembers({ node, source }) {
  return (node.body?.body ?? [])
    .filter(
      ({ key, kind, accessibility }) =>
        key && key.type !== "PrivateIdentifier" && kind !== "constructor" && accessibility !== "private",
    )
    .filter(({ key }) => !PLATFORM.test(key.name ?? ""))
    .filter(({ key }) => key.type === "Identifier" || key.type === "Literal")
    .map((member) => ({
      member,
      name: member.key.name ?? member.key.value,
      source,
      comment: commentBefore(source, member.start),
    }));
}

const isMethod = ({ type, kind }) => type === "TSMethodSignature" || (type === "MethodDefinition" && kind === "method");

/** Returns the text of a property's type. */
const typeOf = (source, { typeAnnotation, value, kind }) => {
  const annotation = typeAnnotation ?? (kind === "get" ? value.returnType : undefined);
  if (!annotation && value) return source.slice(value.start, value.end);
  return annotation
    ? withoutIndent(source.slice(annotation.typeAnnotation.start, annotation.typeAnnotation.end)).replace(
        /\s*\n\s*/g,
        " ",
      )
    : "";
};

function memberSections(name, declaration, undocumented) {
  const members = membersOf(declaration);
  const missing = (each) => {
    if (each.comment === "") undocumented.push(`${name}.${each.name}`);
    return describe(each.comment);
  };
  const properties = members.filter(({ member }) => !isMethod(member));
  const seen = new Set();
  // A getter and a setter are one property.
  const rows = properties
    .filter((each) => !seen.has(each.name) && seen.add(each.name))
    .map(
      (each) =>
        `| \`${each.name}${each.member.optional ? "?" : ""}\` | \`${cell(typeOf(each.source, each.member))}\` | ${cell(missing(each))} |`,
    );
  const methods = members
    .filter(({ member }) => isMethod(member))
    .map((each) =>
      [`#### ${name}.${each.name}`, block(signature(each.source, each.member)), missing(each)].join("\n\n"),
    );
  const table = rows.length > 0 ? [["| Property | Type | |", "| --- | --- | --- |", ...rows].join("\n")] : [];
  return [...table, ...methods];
}

/** Kinds of declarations in the order in which they are described: those with methods come before plain data. */
const KINDS = [
  "FunctionDeclaration",
  "ClassDeclaration",
  "handle",
  "TSInterfaceDeclaration",
  "TSTypeAliasDeclaration",
  "VariableDeclarator",
];

function rankOf(declaration) {
  const { type } = declaration.node;
  const isHandle = type === "TSInterfaceDeclaration" && membersOf(declaration).some(({ member }) => isMethod(member));
  return KINDS.indexOf(isHandle ? "handle" : type);
}

function entry(name, declaration, undocumented) {
  const { node, start, source, overloads } = declaration;
  const comment = commentBefore(source, start);
  if (comment === "") undocumented.push(name);
  const hasMembers = ["TSInterfaceDeclaration", "ClassDeclaration"].includes(node.type);
  const code = hasMembers ? source.slice(node.start, node.body.start).trim() : signature(source, node);
  const shown = node.type === "VariableDeclarator" ? `const ${code}` : code;
  const overloaded = overloads
    .filter(({ type }) => type === "TSDeclareFunction")
    .map((each) => signature(source, each));
  return [
    `### ${name}`,
    block([shown, ...overloaded].join("\n")),
    describe(comment),
    ...(hasMembers ? memberSections(name, declaration, undocumented) : []),
  ].join("\n\n");
}

/** Returns the page as Markdown. Throws a message if an export has no comment. */
export function javascriptPage() {
  const described = new Map();
  const undocumented = [];
  const sections = ENTRIES.map(({ name, file, about }) => {
    const exported = [...exportsOf(join(PACKAGE, file))].sort(([a], [b]) => a.localeCompare(b));
    const again = exported.filter(([each, { file: from }]) => described.get(each) === from);
    const fresh = exported.filter(([each, { file: from }]) => described.get(each) !== from);
    for (const [each, { file: from }] of fresh) described.set(each, from);
    // Functions first, since users start with them.
    fresh.sort(([, a], [, b]) => rankOf(a) - rankOf(b));
    const also = again.map(([each]) => `[\`${each}\`](#${each.toLowerCase()})`).join(", ");
    return [
      `## ${name}`,
      about,
      fresh.map(([each]) => `[\`${each}\`](#${each.toLowerCase()})`).join(" · "),
      ...(also ? [`It exports as well: ${also}.`] : []),
      ...fresh.map(([each, declaration]) => entry(each, declaration, undocumented)),
    ].join("\n\n");
  });
  if (undocumented.length > 0)
    throw new Sentence(`these exports of the package for JavaScript have no comment: ${undocumented.join(", ")}.`);
  return `# JavaScript

The entries of the package \`strut-motion\`. [Embedding](../embedding.md) says how it is installed and where it runs.

Metres, seconds, radians; +Y up, right-handed, facing +Z. A pose is 87 numbers. They are root x y z, then the quaternions x y z w
of the 21 joints of the canonical humanoid. Each is relative to its parent, that of the hips to the world.

${sections.join("\n\n")}
`;
}
