/** The settings of a player: its attributes, with the state of a link as defaults. */
import { readHash } from "../link/hash";
import { PAGE_FIELDS, type PageState } from "../link/page";
import { PLAY_FIELDS, type PlayState } from "../link/play";
import { firstStyles, type Selection, TRIANGLE, toTriangle, vertexOrder, weightOf } from "../ui/polygon/selection";
import { ATTRIBUTES, type AttributeName, readAttribute, type ValueOf } from "./attributes";

/** The fields of a link that a player uses. */
const FIELDS = { ...PLAY_FIELDS, ...PAGE_FIELDS };
type Linked = PlayState & PageState;

/** Settings that do not need another database or another motion. */
export interface Settings {
  styles: Selection;
  /** Other styling options of a link. */
  linked: Linked;
  loop: boolean;
  speed: number;
  frame: number;
  camera: ValueOf<"camera">;
  ghost: ValueOf<"ghost">;
  /** Whether a visitor can zoom. */
  zooms: boolean;
}

/** The URLs of motion and database: those of its attributes, or else the built-in motion that a link names. */
export function addressesOf(element: Element): { src: string; db: string } {
  const { input } = readHash(FIELDS, readAttribute(element, "state"));
  const isLinked = input !== "" && !element.hasAttribute("src");
  const src = isLinked ? `strut:${input.toLowerCase().replace(/[^a-z0-9]+/g, "-")}` : readAttribute(element, "src");
  // The set of walks has only one input.
  const needsAll = src.startsWith("strut:") && src !== ATTRIBUTES.src.initial;
  const db = needsAll && !element.hasAttribute("db") ? "strut:built-in" : readAttribute(element, "db");
  return { src, db };
}

/** The settings of an element. */
export function settingsOf(element: Element): Settings {
  const linked = readHash(FIELDS, readAttribute(element, "state"));
  const isGiven = (name: AttributeName) => element.hasAttribute(name);
  const hasLinkedStyles = linked.styles.length > 0 && !isGiven("styles");
  return {
    styles: hasLinkedStyles ? linked.styles : readAttribute(element, "styles"),
    linked,
    loop: linked.loop && !isGiven("once"),
    speed: isGiven("speed") ? readAttribute(element, "speed") : linked.speed,
    frame: isGiven("frame") ? readAttribute(element, "frame") : linked.frame,
    camera: isGiven("camera") ? readAttribute(element, "camera") : linked.camera,
    ghost: isGiven("ghost") ? readAttribute(element, "ghost") : linked.ghost,
    zooms: !readAttribute(element, "disable-zoom"),
  };
}

/** The selection, with the neutral style for the remainder to 1. */
export function completed(styles: Selection, neutral: string): Selection {
  const rest = 1 - styles.reduce((sum, { weight }) => sum + weight, 0);
  if (Math.abs(rest) < 5e-3) return styles;
  const own = styles.find(({ name }) => name === neutral)?.weight ?? 0;
  return [...styles.filter(({ name }) => name !== neutral), { name: neutral, weight: own + rest }];
}

/**
 * The triangle that the small polygon shows, its corners clockwise from the top: the heaviest styles, and if they are
 * fewer than three also those that were `shown`, or else the default.
 */
export function triangleOf(
  styles: Selection,
  database: { styles: readonly string[]; neutral: string },
  shown: readonly string[] = [],
): { vertices: string[]; selection: Selection } {
  const order = vertexOrder(database.styles, database.neutral);
  const heaviest = styles.length > TRIANGLE ? toTriangle(styles, order) : styles;
  const others = [...shown, ...firstStyles(database.styles, database.neutral)].filter((name) => order.includes(name));
  const names = [...new Set([...heaviest.map(({ name }) => name), ...others])].slice(0, TRIANGLE);
  const selection = names.map((name) => ({ name, weight: weightOf(heaviest, name) }));
  return { vertices: order.filter((name) => names.includes(name)), selection };
}
