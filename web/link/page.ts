/** State of the whole page: the view, the open objects, and playback. */
import type { FrameRange } from "../client/protocol";
import type { Theme } from "../ui/theme";
import { choice, type Fields, flag, number, optional, text } from "./fields";

export interface PageState {
  /** The current view. */
  view: ViewName;
  /** Name of the open database on this device; empty for the built-in one. */
  database: string;
  /** Name of the input; empty for the first built-in one. */
  input: string;
  theme: Theme;
  playing: boolean;
  /** Input frame while paused, fractional. */
  frame: number;
  speed: number;
  loop: boolean;
  /** The part of the input that is played. */
  range: FrameRange | undefined;
}

export const VIEW_NAMES = ["play", "learn", "compare", "walk", "key-style", "crowd", "data"] as const;
export type ViewName = (typeof VIEW_NAMES)[number];
export const THEMES = ["auto", "dark", "light"] as const satisfies readonly Theme[];
/** Playback speeds to choose from. */
export const SPEEDS = [0.1, 0.25, 0.5, 1, 1.5, 2, 3, 4] as const;

function encodeRange({ first, last }: FrameRange): string {
  return `${first}-${last}`;
}

function decodeRange(text: string): FrameRange | undefined {
  const [, first, last] = /^(\d{1,7})-(\d{1,7})$/.exec(text) ?? [];
  return first !== undefined && Number(first) < Number(last) ? { first: Number(first), last: Number(last) } : undefined;
}

export const PAGE_FIELDS: Fields<PageState> = {
  view: choice("view", "play", VIEW_NAMES),
  database: text("db", "", true),
  input: text("input", "", true),
  theme: choice("theme", "auto", THEMES),
  playing: flag("play", true, false),
  frame: number("frame", 0, { min: 0, max: 1e7, digits: 2 }, false),
  speed: number("speed", 1, { min: SPEEDS[0], max: 4, digits: 2 }, false),
  loop: flag("loop", true, false),
  range: optional("range", encodeRange, decodeRange, true),
};
