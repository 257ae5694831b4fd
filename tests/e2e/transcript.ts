/** What a screen reader reads of a page from top to bottom: the browser's accessibility tree, a line a thing. */
import type { CDPSession, Page } from "playwright-core";

type Node = Awaited<ReturnType<typeof treeOf>>[number];

/** Roles that say nothing by themselves: what is in them is read. */
const SILENT = new Set(["generic", "none", "paragraph", "LineBreak", "InlineTextBox", "ListMarker", "RootWebArea"]);
/** Roles whose children are read as part of their name or value. */
const WHOLE = new Set(["button", "link", "heading", "option", "MenuListOption", "slider", "image", "meter", "textbox"]);
/** Regions that speak when something happens, wherever the reader is: what they said last depends on what was done before. */
const LIVE = new Set(["alert", "status"]);
/** Properties that are said, and how. */
const SAID: Readonly<Record<string, (value: unknown) => string>> = {
  level: (value) => `level ${value}`,
  checked: (value) => (value === "true" ? "checked" : value === "mixed" ? "partly checked" : "not checked"),
  pressed: (value) => (value === "true" ? "pressed" : "not pressed"),
  selected: (value) => (value === true ? "selected" : ""),
  expanded: (value) => (value === true ? "expanded" : "collapsed"),
  valuetext: (value) => String(value),
};
/** Figures that depend on the machine. */
const MEASURED = /\d+(?:[.,]\d+)?(?= ?(?:ms|fps|s)\b)/g;

async function treeOf(session: CDPSession) {
  const { nodes } = await session.send("Accessibility.getFullAXTree");
  return nodes;
}

/** The transcript of what is on the page now. */
export async function transcriptOf(page: Page): Promise<string> {
  const session = await page.context().newCDPSession(page);
  await session.send("Accessibility.enable");
  const nodes = await treeOf(session);
  await session.detach();
  const byId = new Map(nodes.map((node) => [node.nodeId, node]));
  const lines: string[] = [];
  read(nodes[0]!, 0, byId, lines);
  return `${lines.join("\n")}\n`;
}

function read(node: Node, depth: number, byId: ReadonlyMap<string, Node>, lines: string[]): void {
  if (depth === 0 && LIVE.has(role(node))) return;
  const said = node.ignored ? undefined : lineOf(node);
  if (said !== undefined) lines.push("  ".repeat(depth) + said);
  if (said !== undefined && WHOLE.has(role(node))) return;
  for (const id of node.childIds ?? []) {
    const child = byId.get(id);
    if (child) read(child, said === undefined ? depth : depth + 1, byId, lines);
  }
}

const role = (node: Node): string => String(node.role?.value ?? "none");

/** What is said of a node; `undefined` for one that says nothing itself. */
function lineOf(node: Node): string | undefined {
  const name = String(node.name?.value ?? "").trim();
  if (role(node) === "StaticText") return name === "" ? undefined : masked(name);
  if (SILENT.has(role(node))) return undefined;
  const value = rounded(node.value?.value);
  const states = (node.properties ?? []).map(({ name, value }) => SAID[name]?.(value.value) ?? "");
  const has = states.some((state) => state !== "" && state === String(value));
  const parts = [name && `“${name}”`, value !== undefined && !has ? String(value) : "", ...states];
  return masked([role(node), ...parts.filter((part) => part !== "")].join(" "));
}

/** A number as it was meant: the browser keeps 32 bits of it. */
const rounded = (value: unknown): unknown => (typeof value === "number" ? Number(value.toFixed(4)) : value);

const masked = (text: string): string => text.replace(/\s+/g, " ").replace(MEASURED, "…");
