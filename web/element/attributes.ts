/**
 * The attributes of `<strut-player>` in one table, from which its properties, `custom-elements.json`, the types for
 * JSX, the parameters of `embed.html` and the table in `docs/embedding.md` are made.
 */
import { decodeSelection, encodeSelection } from "../link/fields";
import { CAMERA_PRESETS, GHOST_MODES } from "../link/play";
import type { Selection } from "../ui/polygon/selection";

/** One attribute. */
export interface Attribute<T> {
  /** The value if the attribute is missing or invalid. */
  initial: T;
  /** The type of the property, in TypeScript. */
  type: string;
  /** Whether the attribute is a boolean one: present or not. */
  isFlag: boolean;
  /** Parses a text; `undefined` if it is invalid. */
  parse(text: string): T | undefined;
  /** The text of a value; `null` to remove the attribute. */
  write(value: T): string | null;
  /** A sentence for documentation. */
  doc: string;
}

/** Controls that the bar and the stage can show. */
const CONTROLS = ["play", "seek", "styles", "ghost", "fullscreen", "link"] as const;
export type Control = (typeof CONTROLS)[number];

const PLAYER_THEMES = ["auto", "light", "dark"] as const;
const LOADING = ["lazy", "eager"] as const;

function text(initial: string, doc: string): Attribute<string> {
  return { initial, type: "string", isFlag: false, parse: (value) => value, write: (value) => value, doc };
}

function flag(doc: string): Attribute<boolean> {
  return { initial: false, type: "boolean", isFlag: true, parse: () => true, write: (on) => (on ? "" : null), doc };
}

function number(initial: number, min: number, max: number, doc: string): Attribute<number> {
  const parse = (value: string) => {
    const parsed = Number(value);
    return value.trim() !== "" && Number.isFinite(parsed) ? Math.min(max, Math.max(min, parsed)) : undefined;
  };
  return { initial, type: "number", isFlag: false, parse, write: String, doc };
}

function choice<const T extends string>(values: readonly [T, ...T[]], doc: string): Attribute<T> {
  const type = values.map((value) => `"${value}"`).join(" | ");
  const parse = (value: string) => values.find((known) => known === value);
  return { initial: values[0], type, isFlag: false, parse, write: (value) => value, doc };
}

/** `proud:0.5,old:0.5` as in links; a name without a weight has full weight. */
function parseStyles(value: string): Selection | undefined {
  const named = value.split(",").map((part) => (part.includes(":") ? part.trim() : `${part.trim()}:1`));
  return decodeSelection(named.join(","));
}

const styles: Attribute<Selection> = {
  initial: [
    { name: "proud", weight: 0.5 },
    { name: "old", weight: 0.5 },
  ],
  type: "string | Readonly<Record<string, number>>",
  isFlag: false,
  parse: parseStyles,
  write: encodeSelection,
  doc: "The styles and their weights, such as proud:0.5,old:0.5. The remainder to 1 is neutral; a name without a weight has weight 1.",
};

const controls: Attribute<readonly Control[]> = {
  initial: [],
  type: "string | boolean",
  isFlag: false,
  parse: (value) => {
    const words = value.split(/[\s,]+/).filter((word) => word !== "");
    return words.length === 0 ? CONTROLS : CONTROLS.filter((control) => words.includes(control));
  },
  write: (value) => (value.length === 0 ? null : value.length === CONTROLS.length ? "" : value.join(" ")),
  doc: `Controls for visitors: all of them if the attribute has no value, or some of ${CONTROLS.join(" ")}.`,
};

/** The table. */
export const ATTRIBUTES = {
  src: text("strut:neutral-walk", "The motion: URL of a BVH file, or a built-in one."),
  db: text("strut:walk", "The database: URL of a .strutdb file, strut:walk or strut:built-in."),
  character: text("", "URL of a character to show instead of the mannequin: .glb, .vrm or .fbx."),
  poster: text("", "URL of a picture to show until the character is loaded."),
  styles,
  state: text("", "Playground state: the part of a playground link after #. Other attributes override it."),
  controls,
  autoplay: flag("Starts playback when the player becomes visible, unless the visitor prefers reduced motion."),
  once: flag("Stops at the end instead of looping."),
  frame: number(0, 0, 1e7, "The first input frame to play."),
  speed: number(1, 0.1, 4, "Playback speed, 0.1 to 4."),
  camera: choice(CAMERA_PRESETS, "Camera position."),
  ghost: choice(GHOST_MODES, "Whether the input is drawn beside the styled character, over it, or not at all."),
  "disable-zoom": flag(
    "Disables zooming. Without it the wheel zooms while the picture has the focus, or with Ctrl or Cmd held.",
  ),
  theme: choice(PLAYER_THEMES, "Colour theme; auto follows the page."),
  loading: choice(LOADING, "When the player loads: near the visible area, or at once."),
  alt: text("", "Text for screen readers; by default, a description of the motion and the styles."),
} as const;

/** Names of the attributes. */
export type AttributeName = keyof typeof ATTRIBUTES;

/** The value of an attribute. */
export type ValueOf<K extends AttributeName> = (typeof ATTRIBUTES)[K] extends Attribute<infer T> ? T : never;

/** The name of an attribute as a property: `disable-zoom` becomes `disableZoom`. */
export type PropertyName<K extends string> = K extends `${infer A}-${infer B}` ? `${A}${Capitalize<B>}` : K;

export function propertyOf(name: string): string {
  return name.replace(/-(.)/g, (_, letter: string) => letter.toUpperCase());
}

export const ATTRIBUTE_NAMES = Object.keys(ATTRIBUTES) as AttributeName[];

/** The value of an element's attribute. */
export function readAttribute<K extends AttributeName>(element: Element, name: K): ValueOf<K> {
  const attribute = ATTRIBUTES[name] as unknown as Attribute<ValueOf<K>>;
  const given = element.getAttribute(name);
  return (given === null ? undefined : attribute.parse(given)) ?? attribute.initial;
}

/** Writes a property to an element's attribute: a value, its text, or what frameworks pass for “none” and “present”. */
export function writeProperty<K extends AttributeName>(element: Element, name: K, value: unknown): void {
  const attribute = ATTRIBUTES[name] as unknown as Attribute<unknown>;
  const text = typeof value === "boolean" || value === null || value === undefined ? (value ? "" : null) : undefined;
  const written = text !== undefined ? text : typeof value === "string" ? value : attribute.write(value);
  if (written === null) element.removeAttribute(name);
  else if (element.getAttribute(name) !== written) element.setAttribute(name, written);
}
