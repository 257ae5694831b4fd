// Metadata of <strut-player> for editors and frameworks: custom-elements.json and types for JSX, from web/element/.

import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { build } from "esbuild";
import { root } from "./steps.mjs";

const TAG = "strut-player";

/** Reads the tables of web/element/. */
export async function readTables() {
  const folder = mkdtempSync(join(tmpdir(), "strut-tables-"));
  try {
    const outfile = join(folder, "tables.mjs");
    const contents = 'export * from "./attributes"; export * from "./reference";';
    const stdin = { contents, resolveDir: join(root, "web", "element"), loader: "ts" };
    await build({ stdin, outfile, bundle: true, format: "esm", logLevel: "warning" });
    return await import(pathToFileURL(outfile).href);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

/** https://github.com/webcomponents/custom-elements-manifest, version 2. */
export function manifestOf({ ATTRIBUTES, EVENTS, PARTS, PROPERTIES, SLOTS, METHODS, propertyOf }) {
  const described = (list) => list.map(({ name, doc }) => ({ name, description: doc }));
  const attributes = Object.entries(ATTRIBUTES);
  const typed = ([name, { type, doc }]) => ({ name, type: { text: type }, description: doc });
  const declaration = {
    kind: "class",
    name: "StrutPlayer",
    tagName: TAG,
    customElement: true,
    description: "A figure that walks in a style, live.",
    superclass: { name: "HTMLElement" },
    attributes: attributes.map((attribute) => ({ ...typed(attribute), fieldName: propertyOf(attribute[0]) })),
    members: [
      ...attributes.map((attribute) => ({
        kind: "field",
        ...typed(attribute),
        name: propertyOf(attribute[0]),
        attribute: attribute[0],
        reflects: true,
      })),
      ...described(METHODS).map((method) => ({ kind: "method", ...method })),
    ],
    events: EVENTS.map(({ name, detail, doc }) => ({
      name,
      description: doc,
      type: { text: detail ? `CustomEvent<${detail}>` : "Event" },
    })),
    cssParts: described(PARTS),
    cssProperties: described(PROPERTIES),
    slots: described(SLOTS),
  };
  const exported = { kind: "custom-element-definition", name: TAG, declaration: { name: "StrutPlayer" } };
  const module = { kind: "javascript-module", path: "element.js", declarations: [declaration], exports: [exported] };
  return { schemaVersion: "2.1.0", modules: [module] };
}

/** Returns types for React 19, Preact and Vue; frameworks that are not installed are skipped. */
export function jsxTypesOf({ ATTRIBUTES, EVENTS }) {
  const attributes = Object.entries(ATTRIBUTES).map(([name, { type, isFlag, doc }]) => {
    const allowed = isFlag ? 'boolean | ""' : type === "number" ? "number | string" : type;
    return `  /** ${doc} */\n  ${/\W/.test(name) ? JSON.stringify(name) : name}?: ${allowed} | undefined;`;
  });
  const events = EVENTS.map(({ name, detail, doc }) => {
    const type = detail ? `CustomEvent<${detail}>` : "Event";
    return `  /** ${doc} */\n  on${name}?: ((event: ${type}) => void) | undefined;`;
  });
  const augmentation = (module, inside) =>
    `// @ts-ignore: the framework need not be installed.\ndeclare module "${module}" {\n${inside}\n}`;
  const jsx = (base) => `  namespace JSX {
    interface IntrinsicElements {
      "${TAG}": StrutPlayerAttributes & ${base};
    }
  }`;
  const vue = `  interface GlobalComponents {
    "${TAG}": new () => { $props: StrutPlayerAttributes };
  }`;
  return `/** Types of \`<${TAG}>\` for JSX: \`import type {} from "strut-motion/jsx"\`. */
import type { StrutPlayer } from "./types/package/element.js";

/** Attributes and events. */
export interface StrutPlayerAttributes {
${[...attributes, ...events].join("\n")}
}

/** What every element has. */
interface CommonAttributes {
  id?: string | undefined;
  class?: string | undefined;
  className?: string | undefined;
  slot?: string | undefined;
  lang?: string | undefined;
  style?: unknown;
  ref?: unknown;
  key?: string | number | undefined;
  children?: unknown;
}

declare global {
  interface HTMLElementTagNameMap {
    "${TAG}": StrutPlayer;
  }
}

${augmentation("react", jsx("CommonAttributes"))}
${augmentation("preact", jsx("CommonAttributes"))}
${augmentation("vue", vue)}
`;
}

/** Returns the table of attributes in `docs/embedding.md`. */
export function attributeTableOf({ ATTRIBUTES }) {
  const rows = Object.entries(ATTRIBUTES).map(([name, { type, isFlag, initial, write, doc }]) => {
    const values = isFlag
      ? "present or not"
      : type.includes(' | "')
        ? type.replaceAll('"', "`").replaceAll(" | ", " ")
        : type;
    const first = isFlag ? "" : write(initial);
    const shown = first === null || first === "" ? "" : `\`${first}\``;
    return `| \`${name}\` | ${values.replaceAll("|", "\\|")} | ${shown} | ${doc} |`;
  });
  return ["| Attribute | Values | Default | |", "| --- | --- | --- | --- |", ...rows].join("\n");
}
