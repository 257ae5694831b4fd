/** State of the Crowd view: the agents, the styles of places, the route, and the current selection. */

import { type FieldVertex, MAX_CROWD, MAX_ROUTE_POINTS, MAX_VERTICES, type Place } from "../../client/crowd/limits";
import { choice, type Field, type Fields, flag, number, SEPARATOR } from "../../link/fields";
import type { Range } from "../../ui/controls/range";

/** Kinds of agents: they walk by a walk model, or perform the input of Play. */
export const CROWD_KINDS = ["walkers", "performers"] as const;
export type CrowdKind = (typeof CROWD_KINDS)[number];

/** Number of agents, and the seed of all random choices. */
export interface People {
  count: number;
  seed: number;
}

/** An invalid value in a link. The view reports it, and keeps its own value. */
export class Refused {
  constructor(
    /** The text of the link. */
    readonly text: string,
    /** What was expected. */
    readonly why: RefusedWhy,
  ) {}
}

/** The invalid part of the link: the kind of agents, their number, the number of vertices, a vertex, or the route. */
type RefusedWhy = "kind" | "count" | "vertices" | "vertex" | "route";

export interface CrowdState {
  crowdKind: CrowdKind | Refused;
  crowd: People | Refused;
  /** Styles by place; `undefined` until a model provides the initial ones. */
  field: readonly FieldVertex[] | undefined | Refused;
  /** The route that all agents follow; an empty one removes it. */
  route: readonly Place[] | Refused;
  /** Index of the selected vertex, and of the agent whose card is open, or −1. */
  crowdVertex: number;
  crowdWalker: number;
  /** Whether the camera follows that agent. */
  crowdFollow: boolean;
  crowdCamera: CrowdCamera;
  /** Whether the field is drawn on the ground. */
  crowdMap: boolean;
}

export const CROWD_CAMERAS = ["orbit", "above", "along"] as const;
export type CrowdCamera = (typeof CROWD_CAMERAS)[number];

export const CROWD_RANGES = {
  count: { min: 1, max: MAX_CROWD, digits: 0 },
  seed: { min: 0, max: 9999, digits: 0 },
  /** Metres along x and z. */
  place: { min: -100, max: 100, digits: 2 },
  reach: { min: 0.5, max: 10, digits: 1 },
  intensity: { min: -1, max: 2, digits: 2 },
} as const satisfies Record<string, Range>;

/** A field without vertices, as opposed to a default field. */
const EMPTY = "none";

const within = (value: number, { min, max }: Range): boolean => value >= min && value <= max;
const numbersOf = (parts: readonly string[]): number[] =>
  parts.map((part) => (part.trim() === "" ? Number.NaN : Number(part)));
const plain = (value: number, { digits }: Range): string => String(Number(value.toFixed(digits)) + 0);

/** `300_1`: count and seed. */
function decodePeople(text: string): People | Refused {
  const [count, seed = 1, ...rest] = numbersOf(text.split("_"));
  const { count: counts, seed: seeds } = CROWD_RANGES;
  const valid =
    Number.isInteger(count) && within(count!, counts) && Number.isInteger(seed) && within(seed, seeds) && !rest.length;
  return valid ? { count: count!, seed } : new Refused(text, "count");
}

/** `proud_2.5_-1_3_1`: style, x, z, reach and intensity. Styles may have underscores. */
function decodeVertex(text: string): FieldVertex | undefined {
  const parts = text.split("_");
  const [x, z, reach, intensity] = numbersOf(parts.slice(-4)) as [number, number, number, number];
  const style = parts.slice(0, -4).join("_");
  const { place, reach: reaches, intensity: intensities } = CROWD_RANGES;
  const valid = within(x, place) && within(z, place) && within(reach, reaches) && within(intensity, intensities);
  return style !== "" && valid ? { style, x, z, reach, intensity } : undefined;
}

function decodeField(text: string): readonly FieldVertex[] | Refused {
  if (text === EMPTY) return [];
  const texts = text.split(SEPARATOR.entry, MAX_VERTICES + 1);
  if (texts.length > MAX_VERTICES) return new Refused(text, "vertices");
  const vertices = texts.map(decodeVertex);
  return vertices.every((vertex) => vertex !== undefined) ? vertices : new Refused(text, "vertex");
}

function encodeField(vertices: readonly FieldVertex[]): string {
  const { place, reach: reaches, intensity: intensities } = CROWD_RANGES;
  const entries = vertices.map(({ style, x, z, reach, intensity }) =>
    [
      style.replaceAll(SEPARATOR.entry, " "),
      plain(x, place),
      plain(z, place),
      plain(reach, reaches),
      plain(intensity, intensities),
    ].join("_"),
  );
  return entries.length > 0 ? entries.join(SEPARATOR.entry) : EMPTY;
}

/** `-5_0;5_2;…`: x and z of every point. */
function decodeRoute(text: string): readonly Place[] | Refused {
  if (text === "") return [];
  const points = text.split(SEPARATOR.entry, MAX_ROUTE_POINTS + 1).map((point) => numbersOf(point.split("_")));
  const valid = points.every((point) => point.length === 2 && point.every((v) => within(v, CROWD_RANGES.place)));
  const enough = points.length > 1 && points.length <= MAX_ROUTE_POINTS;
  return valid && enough ? (points as unknown as Place[]) : new Refused(text, "route");
}

function encodeRoute(points: readonly Place[]): string {
  return points.map((point) => point.map((v) => plain(v, CROWD_RANGES.place)).join("_")).join(SEPARATOR.entry);
}

/** A field of the state whose value in a link may be invalid. */
function refusable<T>(
  key: string,
  initial: T,
  encode: (value: T) => string,
  decode: (text: string) => T | Refused,
): Field<T | Refused> {
  return {
    key,
    initial,
    undoable: true,
    encode: (value) => (value instanceof Refused ? value.text : encode(value)),
    decode,
  };
}

export const CROWD_FIELDS: Fields<CrowdState> = {
  crowdKind: refusable<CrowdKind>(
    "people",
    "walkers",
    (kind) => kind,
    (text) => CROWD_KINDS.find((kind) => kind === text) ?? new Refused(text, "kind"),
  ),
  crowd: refusable<People>("crowd", { count: 200, seed: 1 }, ({ count, seed }) => `${count}_${seed}`, decodePeople),
  field: refusable<readonly FieldVertex[] | undefined>(
    "field",
    undefined,
    (field) => (field ? encodeField(field) : ""),
    (text) => (text === "" ? undefined : decodeField(text)),
  ),
  route: refusable<readonly Place[]>("route", [], encodeRoute, decodeRoute),
  crowdVertex: number("vertex", 0, { min: 0, max: MAX_VERTICES - 1, digits: 0 }, false),
  crowdWalker: number("who", -1, { min: -1, max: MAX_CROWD - 1, digits: 0 }, false),
  crowdFollow: flag("with", false, false),
  crowdCamera: choice("seen", "orbit", CROWD_CAMERAS),
  crowdMap: flag("map", true, false),
};
