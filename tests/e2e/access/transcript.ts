/** Transcript of a page for a screen reader: Chromium's accessibility tree in order, one line per item. */
import type { CDPSession, Page } from "playwright-core";

/** A node of the tree in the DevTools protocol. */
interface Node {
  nodeId: string;
  backendDOMNodeId?: number;
  ignored: boolean;
  role?: { value?: string };
  name?: { value?: string };
  description?: { value?: string };
  value?: { value?: string | number };
  properties?: { name: string; value: { value?: unknown } }[];
  childIds?: string[];
}

/** A spoken item, with its children. */
interface Heard {
  role: string;
  name: string;
  rest: string;
  inside: Heard[];
}

/** Text without its own role. */
const TEXT = "text";
/** Roles that are not spoken: only their children are. */
const SILENT = new Set([
  "generic",
  "none",
  "GenericContainer",
  "Legend",
  "Section",
  "sectionheader",
  "sectionfooter",
  "strong",
  "emphasis",
  "DescriptionListTerm",
  "Abbr",
  "Iframe",
  "ListMarker",
  "SvgRoot",
  "Canvas",
  "RootWebArea",
  "group",
]);
/** Roles whose texts are joined. */
const WHOLE = new Set(["paragraph", "term", "definition", "caption", "cell", "rowheader", "columnheader"]);
/** Roles of which a screen reader speaks the name, not the contents. */
const NAMED_BY_CONTENT = new Set([
  "button",
  "link",
  "heading",
  "checkbox",
  "radio",
  "slider",
  "switch",
  "tab",
  "option",
  "DisclosureTriangle",
  "image",
  "combobox",
  "textbox",
  "spinbutton",
  "progressbar",
]);
/** Live regions, which are announced when they change. */
const LIVE = new Set(["status", "alert", "log"]);
/** States that are spoken. */
const STATES = [
  "level",
  "checked",
  "pressed",
  "selected",
  "expanded",
  "disabled",
  "invalid",
  "busy",
  "live",
  "current",
];
/** Roles whose value text or current state is only in attributes, which the protocol does not return. */
const WITH_ATTRIBUTES = new Set(["slider", "spinbutton", "link", "button", "listitem"]);

/** Measured values, which differ between machines, and their replacements in the transcript. */
const MEASURED: readonly (readonly [RegExp, string])[] = [
  [/−?\b[\d.]+ (ms|fps)\b/g, "… $1"],
  [/trained in [\d.]+ s/g, "trained in … s"],
  // Present only after frames were counted for a while.
  [/(term “(?:Rate|Walking|Drawing|Drawn by)”\n *definition) “.*”/g, "$1 “…”"],
  [/text “[^”\n]*(grid 1 m)”/g, "text “… $1”"],
];

/** The last announcement of the page, in the region at its end: it depends on timing. */
const ANNOUNCED = /\n {2}status \(live polite\)\n {4}text “[^”]*”$/;

/** Returns the transcript of a page, masked. A level of nesting is two spaces. */
export async function transcriptOf(session: CDPSession): Promise<string> {
  const { nodes } = (await session.send("Accessibility.getFullAXTree")) as { nodes: Node[] };
  const byId = new Map(nodes.map((node) => [node.nodeId, node]));
  for (const node of nodes)
    if (!node.ignored && WITH_ATTRIBUTES.has(node.role?.value ?? "")) await addAttributes(session, node);
  const lines: string[] = [];
  const write = (all: readonly Heard[], depth: number) => {
    for (const { role, name, rest, inside } of all) {
      lines.push(`${"  ".repeat(depth)}${role}${name && ` “${name}”`}${rest}`);
      write(inside, depth + 1);
    }
  };
  write(joined(heard(nodes[0]!, byId)), 0);
  const text = lines.join("\n").replace(ANNOUNCED, "");
  return `${MEASURED.reduce((masked, [measured, mask]) => masked.replace(measured, mask), text)}\n`;
}

/** Returns {@link transcriptOf} once it no longer changes. */
export async function settledTranscript(page: Page): Promise<string> {
  const session = await page.context().newCDPSession(page);
  await session.send("Accessibility.enable");
  let before = "";
  for (let same = 0; same < 3; ) {
    await page.waitForTimeout(150);
    const now = await transcriptOf(session);
    same = now === before ? same + 1 : 0;
    before = now;
  }
  await session.detach();
  return before;
}

/** Returns controls of a transcript without a name, or with the same role, name and description as another one. */
export function ambiguous(transcript: string): string[] {
  const control =
    /^ *((?:button|link|checkbox|radio|slider|combobox|textbox|spinbutton|switch)\b(?: “[^”]*”)?).*?( — .*)?$/;
  const all = transcript.split("\n").flatMap((line) => {
    const [, named, description = ""] = control.exec(line) ?? [];
    return named === undefined ? [] : [named + description];
  });
  return [...new Set(all.filter((one, i) => !one.includes("“") || all.indexOf(one) !== i))];
}

/** Adds the value text and the current state to the properties of a node. */
async function addAttributes(session: CDPSession, node: Node): Promise<void> {
  const { node: element } = await session.send("DOM.describeNode", { backendNodeId: node.backendDOMNodeId! });
  const { attributes = [] } = element;
  const of = (name: string) => attributes[attributes.findIndex((one, i) => i % 2 === 0 && one === name) + 1];
  for (const [attribute, name] of [
    ["aria-valuetext", "valuetext"],
    ["aria-current", "current"],
  ] as const)
    if (attributes.includes(attribute)) node.properties?.unshift({ name, value: { value: of(attribute) } });
}

function heard(node: Node, byId: ReadonlyMap<string, Node>): Heard[] {
  const role = node.role?.value ?? "";
  const name = plain(node.name?.value);
  if (role === "StaticText") return name === "" ? [] : [{ role: TEXT, name, rest: "", inside: [] }];
  if (role === "InlineTextBox" || role === "LineBreak" || role === "MenuListPopup") return [];
  const inside = (node.childIds ?? []).flatMap((id) => heard(byId.get(id)!, byId));
  if (LIVE.has(role) && inside.length === 0) return [];
  // The text of a label is the name of its control.
  if (role === "LabelText")
    return inside.filter(
      (one) => one.role !== TEXT || !inside.some((other) => other !== one && other.name === one.name),
    );
  const silent = node.ignored || (SILENT.has(role) && name === "");
  if (silent) return inside;
  if (WHOLE.has(role) && inside.every((one) => one.role === TEXT)) {
    const text = plain(inside.map((one) => one.name).join(" "));
    return text === "" ? [] : [{ role: role === "paragraph" ? TEXT : role, name: text, rest: "", inside: [] }];
  }
  const kept = NAMED_BY_CONTENT.has(role) ? inside.filter((one) => one.role !== TEXT) : joined(inside);
  return [{ role, name, rest: restOf(node, name), inside: kept }];
}

/** Returns value, states and description of a node. */
function restOf({ value, description, properties = [] }: Node, name: string): string {
  const of = (property: string) => properties.find((one) => one.name === property)?.value.value;
  const spoken = plain(String(of("valuetext") || (value?.value ?? "")));
  const states = STATES.flatMap((state) => {
    const is = of(state);
    const said = is !== undefined && is !== false && is !== "false" && is !== "off" && is !== "";
    // The states "not pressed" and "not checked" are spoken, too.
    const both = state === "checked" || state === "pressed" || state === "expanded";
    if (!said) return both && is !== undefined ? [`not ${state}`] : [];
    return [is === true || is === "true" ? state : `${state} ${is}`];
  });
  const more = plain(description?.value);
  return [
    spoken === "" || spoken === name ? "" : ` = ${spoken}`,
    states.length > 0 ? ` (${states.join(", ")})` : "",
    more === "" || more === name ? "" : ` — ${more}`,
  ].join("");
}

/** Joins neighbouring texts. */
function joined(all: readonly Heard[]): Heard[] {
  const list: Heard[] = [];
  for (const one of all) {
    const last = list.at(-1);
    if (one.role === TEXT && last?.role === TEXT)
      list[list.length - 1] = { ...last, name: plain(`${last.name} ${one.name}`) };
    else list.push(one);
  }
  return list;
}

/** Returns text on one line with single spaces. */
const plain = (text: string | undefined) => (text ?? "").replace(/[\s\u00a0\u202f]+/g, " ").trim();
