/** Messages between a page and a frame with `embed.html`: settings of the player, and nothing else. */
import { ATTRIBUTE_NAMES, type AttributeName, readAttribute } from "../element/attributes";

/** Settings that the embedding page may read and change: none of them loads anything. */
export const SETTINGS = ["styles", "state", "controls", "once", "frame", "speed", "camera", "ghost", "theme"] as const;
export type Setting = (typeof SETTINGS)[number];

/** Version of the messages. */
const VERSION = 1;

/** A request of the embedding page. */
export interface Request {
  /** New texts of settings; `null` removes one. */
  set: Partial<Record<Setting, string | null>>;
  /** Settings to report. */
  get: Setting[];
  /** Whether to play. */
  playing: boolean | undefined;
}

/** Reads a message; `undefined` if it is invalid. */
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

/** The reply of the page in a frame to the embedding page; `frame` is the displayed input frame. */
export function answer(player: Element, frame: number, names: readonly Setting[], event?: string) {
  const text = (name: Setting) =>
    name === "frame" ? frame.toFixed(2) : (player.getAttribute(name) ?? String(readAttribute(player, name)));
  return toldState(event, Object.fromEntries(names.map((name) => [name, text(name)])));
}

/** A message to the embedding page: settings, and the event that they belong to. */
export function toldState(event: string | undefined, state: Readonly<Record<string, string>>) {
  return { strut: VERSION, ...(event && { event }), state };
}

/** Attributes of a figure that are allowed in the query of a URL. */
const FIGURE_ATTRIBUTES = ["kind", "lang", "hide", "theme"] as const;

/** The attributes of a figure in a URL: those of its query, and the state after #. */
export function figureAttributesOf({ search, hash }: Pick<URL, "search" | "hash">): [name: string, value: string][] {
  const given = new URLSearchParams(search);
  const named = FIGURE_ATTRIBUTES.flatMap((name): [string, string][] => {
    const value = given.get(name);
    return value === null ? [] : [[name, value]];
  });
  return [...named, ["state", hash.slice(1)]];
}

/** The attributes in the query of a URL, as texts; other parameters are ignored. */
export function attributesOf(search: string): [AttributeName, string][] {
  const given = new URLSearchParams(search);
  return ATTRIBUTE_NAMES.flatMap((name): [AttributeName, string][] => {
    const value = given.get(name);
    return value === null ? [] : [[name, value]];
  });
}

const isSetting = (name: unknown): name is Setting => SETTINGS.some((setting) => setting === name);
