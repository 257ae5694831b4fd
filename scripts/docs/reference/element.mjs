// The reference of <strut-player>, from the tables that custom-elements.json is made of.
import { attributeTableOf, manifestOf } from "../../element_manifest.mjs";

const cell = (text) => text.replaceAll("|", "\\|");

const table = (header, rows) => [`| ${header} | |`, "| --- | --- |", ...rows].join("\n");

/** Returns the page as Markdown. @param tables result of `readTables()` */
export function elementPage(tables) {
  const [declaration] = manifestOf(tables).modules[0].declarations;
  const row = ({ name, description }) => `| \`${name}\` | ${cell(description)} |`;
  const methods = declaration.members.filter(({ kind }) => kind === "method");
  const events = declaration.events.map(
    ({ name, type, description }) => `| \`${name}\` | \`${cell(type.text)}\` | ${cell(description)} |`,
  );
  return `# \`<strut-player>\`

A character that moves in a style, as an HTML element. For loading it, see [Embedding](../embedding.md#strut-player).

## Attributes

Each attribute is a property of the same name; that of \`disable-zoom\` is \`disableZoom\`.

${attributeTableOf(tables)}

## Methods

${table("Method", methods.map(row))}

## Events

| Event | Type | |
| --- | --- | --- |
${events.join("\n")}

## CSS parts

${table("Part", declaration.cssParts.map(row))}

## CSS custom properties

${table("Property", declaration.cssProperties.map(row))}

## Slots

${table("Slot", declaration.slots.map(row))}
`;
}
