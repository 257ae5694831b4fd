/** What a page and a frame with `embed.html` say to each other: settings of the player, and nothing else. */
import { ATTRIBUTE_NAMES, type AttributeName, readAttribute } from "../element/attributes";

/** Settings that the page around a frame may read and change: none of them loads anything. */
export const SETTINGS = ["styles", "state", "controls", "once", "frame", "speed", "camera", "ghost", "theme"] as const;
export type Setting = (typeof SETTINGS)[number];

/** Version of the messages. */
const VERSION = 1;

/** What the page asks for. */
export interface Request {
  /** New texts of settings; `null` takes one away. */
  set: Partial<Record<Setting, string | null>>;
  /** Settings that are to be told. */
  get: Setting[];
  /** Whether it is to play. */
  playing: boolean | undefined;
}

/** Reads a message; `undefined` where it is none. */
export function readRequest(data: unknown): Request | undefined {
  if (typeof data !== "object" || data === null || !("strut" in data) || data.strut !== VERSION) return undefined;
  const { set, get, playing } = data as { set?: unknown; get?: unknown; playing?: unknown };
  const given = typeof set === "object" && set !== null ? Object.entries(set) : [];
  const known = given.filter(([name, value]) => isSetting(name) && (typeof value === "string" || value === null));
  return {
    set: Object.fromEntries(known) as Request["set"],
    get: Array.isArray(get) ? get.filter(isSetting) : [],
    playing: typeof playing === "boolean" ? playing : undefined,
  };
}

/** What a frame of the page tells the page around it; `frame` is the input frame that is shown. */
export function answer(player: Element, frame: number, names: readonly Setting[], event?: string) {
  const text = (name: Setting) =>
    name === "frame" ? frame.toFixed(2) : (player.getAttribute(name) ?? String(readAttribute(player, name)));
  return toldState(event, Object.fromEntries(names.map((name) => [name, text(name)])));
}

/** What a page is told: settings, and the event that they come with. */
export function toldState(event: string | undefined, state: Readonly<Record<string, string>>) {
  return { strut: VERSION, ...(event && { event }), state };
}

/** Attributes of a figure that the query of an address may have. */
const FIGURE_ATTRIBUTES = ["kind", "lang", "hide", "theme"] as const;

/** The attributes of a figure in an address: those of its query, and the state behind #. */
export function figureAttributesOf({ search, hash }: Pick<URL, "search" | "hash">): [name: string, value: string][] {
  const given = new URLSearchParams(search);
  const named = FIGURE_ATTRIBUTES.flatMap((name): [string, string][] => {
    const value = given.get(name);
    return value === null ? [] : [[name, value]];
  });
  return [...named, ["state", hash.slice(1)]];
}

/** The attributes in the query of an address, as texts; parameters that are none are passed over. */
export function attributesOf(search: string): [AttributeName, string][] {
  const given = new URLSearchParams(search);
  return ATTRIBUTE_NAMES.flatMap((name): [AttributeName, string][] => {
    const value = given.get(name);
    return value === null ? [] : [[name, value]];
  });
}

const isSetting = (name: unknown): name is Setting => SETTINGS.some((setting) => setting === name);
