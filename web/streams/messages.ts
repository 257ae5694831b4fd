/** Parses messages of a sender: JSON, binary, and lines of BVH. An invalid message is `undefined`; nothing here throws. */
import type { StreamJoints, StreamSkeleton } from "../engine/live/skeleton";
import { POSE_FLOATS } from "../humanoid";

/** Maximum number of bytes of a message, as in a UDP packet. */
export const MAX_MESSAGE_BYTES = 65_507;
/** Maximum number of joints of a skeleton (`rust/strut-core/src/skeleton.rs`). */
const MAX_JOINTS = 512;
/** Bytes of a binary frame: the time as f64, and a pose of f32, little-endian. */
export const BINARY_FRAME_BYTES = 8 + 4 * POSE_FLOATS;

/** Contents of a message. */
export type Message =
  | { readonly kind: "skeleton"; readonly skeleton: StreamSkeleton }
  /** A frame; without a time the time of arrival is used. */
  | { readonly kind: "frame"; readonly secs: number | undefined; readonly pose: Float32Array };

const isRecord = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const isNumber = (value: unknown): value is number => typeof value === "number" && Number.isFinite(value);
const isListOf = <T>(value: unknown, is: (one: unknown) => one is T): value is T[] =>
  Array.isArray(value) && value.every(is);

/**
 * JSON: `{"t":secs,"p":[x,y,z],"q":[[x,y,z,w]…]}`, on the canonical humanoid, or on the joints of an earlier
 * `{"strut":1,"names":[…],"parents":[…],"offsets":[[x,y,z]…],"unit":metres}`.
 */
export function readJson(text: string): Message | undefined {
  let said: unknown;
  try {
    said = JSON.parse(text);
  } catch {
    return undefined;
  }
  if (!isRecord(said)) return undefined;
  if ("strut" in said) return readSkeleton(said);
  const { t, p, q } = said;
  if (!isNumber(t) || !isVector(p, 3) || !Array.isArray(q) || q.length > MAX_JOINTS) return undefined;
  const pose = new Float32Array(3 + 4 * q.length);
  pose.set(p);
  for (const [joint, rotation] of q.entries()) {
    if (!isVector(rotation, 4)) return undefined;
    pose.set(rotation, 3 + 4 * joint);
  }
  return { kind: "frame", secs: t, pose };
}

function isVector(value: unknown, length: number): value is number[] {
  return isListOf(value, isNumber) && value.length === length;
}

function readSkeleton({ strut, names, parents, offsets, unit }: Record<string, unknown>): Message | undefined {
  if (strut !== 1 || !isListOf(names, isName) || !isListOf(parents, isParent) || !Array.isArray(offsets))
    return undefined;
  const isUnit = unit === undefined || (isNumber(unit) && unit > 0);
  const isWhole = names.length > 0 && names.length <= MAX_JOINTS && parents.length === names.length;
  // A list of vectors, or of their numbers.
  const flat: unknown = offsets.flat();
  if (!isUnit || !isWhole || !isListOf(flat, isNumber) || flat.length !== 3 * names.length) return undefined;
  const joints: StreamJoints = { names, parents, offsets: flat, unit: unit as number | undefined };
  return { kind: "skeleton", skeleton: { kind: "joints", ...joints } };
}

const isName = (value: unknown): value is string => typeof value === "string";
const isParent = (value: unknown): value is number => Number.isInteger(value) && (value as number) < MAX_JOINTS;

/** Binary: f64 t, then the 87 f32 of a pose, little-endian. */
export function readBinary(bytes: ArrayBuffer): Message | undefined {
  if (bytes.byteLength !== BINARY_FRAME_BYTES) return undefined;
  const view = new DataView(bytes);
  const secs = view.getFloat64(0, true);
  if (!Number.isFinite(secs)) return undefined;
  const pose = Float32Array.from({ length: POSE_FLOATS }, (_, i) => view.getFloat32(8 + 4 * i, true));
  return { kind: "frame", secs, pose };
}

/**
 * BVH: first the part of the file before its frames, then the channels of one frame per message. Motion capture
 * programs write an index and a name before them, and `||` after them: those are skipped.
 */
export function readBvh(text: string): Message | undefined {
  if (/^\s*HIERARCHY\b/i.test(text)) return { kind: "skeleton", skeleton: { kind: "bvh", header: text } };
  const words = text
    .replace(/\|\|\s*$/, "")
    .trim()
    .split(/\s+/);
  // A name is not a number; the word before it is the index.
  const name = words.slice(0, 2).findIndex((word) => !NUMBER.test(word));
  const channels = words.slice(name + 1);
  if (channels.length === 0 || !channels.every((word) => NUMBER.test(word))) return undefined;
  return { kind: "frame", secs: undefined, pose: Float32Array.from(channels, Number) };
}

const NUMBER = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;
