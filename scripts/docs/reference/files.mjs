// The reference of file formats, from the comments of `strut-formats`.
import { Sentence } from "../../steps.mjs";
import { exampleBlock } from "../examples.mjs";
import { constantsOf, fieldsOf, moduleDoc, rustSource } from "./rust_docs.mjs";

const FORMATS = [
  { title: "Motions: `.bvh`", source: "strut-formats/src/bvh/mod.rs" },
  {
    title: "Databases: `.strutdb`",
    source: "strut-formats/src/strutdb/mod.rs",
    writer: "strut-formats/src/strutdb/write.rs",
    metadata: "strut-formats/src/strutdb/metadata.rs",
  },
  {
    title: "Walk models: `.strutwalk`",
    source: "strut-formats/src/walk_model.rs",
    writer: "strut-formats/src/walk_model.rs",
  },
  {
    title: "Key-style models: `.strutkeys`",
    source: "strut-formats/src/key_style_model.rs",
    writer: "strut-formats/src/key_style_model.rs",
  },
  { title: "Tables of labels", source: "strut-formats/src/corpus/table.rs" },
  { title: "Tables of keys", source: "strut-formats/src/style_keys.rs" },
  {
    title: "Packed motions: `.bin`",
    source: "strut-formats/src/strutdb/packed/mod.rs",
    header: "strut-formats/src/strutdb/packed/header.rs",
  },
];

/** How to read a database without Strut. */
const READER = `### In Python

This program needs numpy alone. It reads a database, checks that it is whole, and computes where the joints are.

${exampleBlock("python/strutdb_file.py", "read", "python")}`;

/** Returns a fault for each tensor that only the writer or only the table of the document names. */
function tensorFaults({ title, source, writer }) {
  if (!writer) return [];
  const documented = new Set(
    [...moduleDoc(rustSource(source)).matchAll(/^\| ((?:`\w+`(?:, )?)+) \|/gm)].flatMap(([, names]) =>
      [...names.matchAll(/`(\w+)`/g)].map(([, name]) => name),
    ),
  );
  const text = rustSource(writer).split("#[cfg(test)]")[0];
  const constants = new Map(
    [...text.matchAll(/const (\w+): &str = "(\w+)";/g)].map(([, name, value]) => [name, value]),
  );
  const written = new Set(
    [...text.matchAll(/\(\s*("\w+"|[A-Z_]+),\s*(?:floats|rounded|Written::new)\(/g)].map(([, name]) =>
      name.startsWith('"') ? name.slice(1, -1) : (constants.get(name) ?? name),
    ),
  );
  return [
    ...[...written]
      .filter((name) => !documented.has(name))
      .map((name) => `${title}: the tensor ${name} is written and not described`),
    ...[...documented]
      .filter((name) => !written.has(name))
      .map((name) => `${title}: the tensor ${name} is described and not written`),
  ];
}

/** Returns a Rust value in readable form: `256 << 20` are bytes. */
function readable(text) {
  const shifted = /^(\d+) << (\d+)$/.exec(text);
  if (shifted) return `${(Number(shifted[1]) * 2 ** Number(shifted[2])).toLocaleString("en")}`;
  return text.replaceAll("_", ",").replace(/^std::ops::/, "");
}

const LIMIT = /^(MAX|MIN|FRAME_TIME)/;

function limits(source) {
  const found = constantsOf(source).filter(({ name, value }) => LIMIT.test(name) && /^[\d(]/.test(value));
  if (found.length === 0) return [];
  const rows = found.map(
    ({ value, doc }) => `| ${doc.replace(/\s*\n\s*/g, " ").replaceAll("|", "\\|")} | ${readable(value)} |`,
  );
  return [["| Limit | |", "| --- | ---: |", ...rows].join("\n")];
}

function kind(source) {
  const text = /KIND: Kind =\s*Kind \{([\s\S]*?)\};/.exec(source)?.[1];
  if (!text) return [];
  const field = (name) => new RegExp(`${name}: "([^"]+)"`).exec(text)[1];
  return [`Metadata entry \`${field("entry")}\`, version ${field("version")}. A reader refuses another major version.`];
}

function fields(source, struct, title) {
  const rows = fieldsOf(source, struct).map(
    ({ name, type, doc }) =>
      `| \`${name}\` | \`${type.replaceAll("|", "\\|")}\` | ${doc.replace(/\s*\n\s*/g, " ").replaceAll("|", "\\|")} |`,
  );
  return [`### ${title}`, ["| Field | Type | |", "| --- | --- | --- |", ...rows].join("\n")];
}

/** Returns the constants that a comment names, as written in Rust. */
function constants(source) {
  const doc = moduleDoc(source);
  const named = constantsOf(source).filter(({ name }) => doc.includes(`\`${name}\``) && !LIMIT.test(name));
  if (named.length === 0) return [];
  const rows = named.map(
    ({ name, value, doc: about }) => `| \`${name}\` | \`${value}\` | ${about.replace(/\s*\n\s*/g, " ")} |`,
  );
  return [["| Name | Value | |", "| --- | --- | --- |", ...rows].join("\n")];
}

function section({ title, source, metadata, header }) {
  const text = rustSource(source);
  const doc = moduleDoc(text);
  const more = metadata
    ? [
        ...fields(rustSource(metadata), "Metadata", "The metadata of a database"),
        ...fields(rustSource(metadata), "SkeletonInfo", "Its skeleton"),
        ...fields(rustSource(metadata), "ClipInfo", "A clip"),
        READER,
      ]
    : header
      ? ["### The header", moduleDoc(rustSource(header))]
      : [];
  return [`## ${title}`, doc, ...kind(text), ...constants(text), ...limits(text), ...more].join("\n\n");
}

/** Returns the page as Markdown. Throws a message if a tensor is not described, or a described one does not exist. */
export function filesPage() {
  const faults = FORMATS.flatMap(tensorFaults);
  if (faults.length > 0) throw new Sentence(`the formats differ from their descriptions:\n  ${faults.join("\n  ")}`);
  const container = moduleDoc(rustSource("strut-formats/src/container/mod.rs"));
  return `# File formats

Numbers are little-endian. Readers check every size, shape and index before they use it, and refuse a file with a sentence.

## The container

${container}

| Bytes | Content |
| --- | --- |
| 0–7 | length H of the header, u64 |
| 8 to 8 + H | the header, JSON: for each tensor \`{"dtype", "shape", "data_offsets": [begin, end]}\`, and \`__metadata__\`, an object of strings |
| from 8 + H | the tensors; \`data_offsets\` count from here |

Types are called as in safetensors: \`F32\`, \`U8\`, \`U16\`, \`U32\`, \`I16\`. The metadata entry is a string that holds JSON. Rows of
a tensor lie one after the other, the last index fastest.

${FORMATS.map(section).join("\n\n")}
`;
}
