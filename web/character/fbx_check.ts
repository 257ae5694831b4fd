/**
 * Checks the keys of an FBX file before three.js reads it: its loader inserts a key for every half turn between two
 * keys, and never ends if they are beyond all numbers (`shared/spec/embedding.md` section 6).
 */
import { StrutError } from "../engine/errors";

/** Maximum number of half turns between neighbouring keys of all curves; a minute with a hundred joints has thousands. */
const MAX_HALF_TURNS = 2_000_000;

/** Bytes of an array element, by its type. */
const ELEMENT_BYTES: Readonly<Record<string, number>> = { b: 1, c: 1, i: 4, f: 4, d: 8, l: 8 };
/** Bytes of a single value, by its type. */
const VALUE_BYTES: Readonly<Record<string, number>> = { C: 1, Y: 2, I: 4, F: 4, D: 8, L: 8 };

/** Decompresses zlib data. */
type Inflate = (packed: Uint8Array) => Uint8Array;

/** @throws StrutError `bad-file` if times do not increase, or values jump beyond all bounds */
export function checkFbx(file: Uint8Array, inflate: Inflate): void {
  let halfTurns = 0;
  for (const { name, values } of file[0] === "K".charCodeAt(0) ? binaryArrays(file, inflate) : textArrays(file)) {
    for (let i = 1; i < values.length; i++) {
      const step = values[i]! - values[i - 1]!;
      if (name === "KeyTime" && !(step >= 0)) throw broken();
      if (name === "KeyValueFloat") halfTurns += Math.abs(step) / 180;
    }
    if (!(halfTurns <= MAX_HALF_TURNS)) throw broken();
  }
}

/** Times and values of keys. */
interface Keys {
  readonly name: string;
  readonly values: ArrayLike<number>;
}

const NAMES = ["KeyTime", "KeyValueFloat"];

/**
 * The records of a binary file are consecutive; nested records come after their parent's values. Damaged records end
 * the sequence.
 */
function* binaryArrays(file: Uint8Array, inflate: Inflate): Generator<Keys> {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  const isLong = view.getUint32(23, true) >= 7500;
  const head = isLong ? 25 : 13;
  for (let at = 27; at + head <= file.length; ) {
    const count = view.getUint32(at + (isLong ? 8 : 4), true);
    const nameLength = file[at + head - 1]!;
    const isEnd = view.getUint32(at, true) === 0;
    const name = new TextDecoder("latin1").decode(file.subarray(at + head, at + head + nameLength));
    at += head + nameLength;
    for (let i = 0; i < (isEnd ? 0 : count); i++) {
      const type = String.fromCharCode(file[at] ?? 0);
      const element = ELEMENT_BYTES[type];
      const lengthAt = at + 1;
      if (element === undefined) {
        if (type !== "S" && type !== "R" && VALUE_BYTES[type] === undefined) return;
        if (lengthAt + 4 > file.length) return;
        at = lengthAt + (VALUE_BYTES[type] ?? 4 + view.getUint32(lengthAt, true));
        continue;
      }
      if (lengthAt + 12 > file.length) return;
      const [length, encoding, packed] = [0, 4, 8].map((k) => view.getUint32(lengthAt + k, true)) as [
        number,
        number,
        number,
      ];
      const bytes = file.subarray(lengthAt + 12, lengthAt + 12 + (encoding === 0 ? length * element : packed));
      at = lengthAt + 12 + (encoding === 0 ? length * element : packed);
      if (NAMES.includes(name)) yield { name, values: numbersOf(type, encoding === 0 ? bytes : inflate(bytes)) };
    }
  }
}

function numbersOf(type: string, bytes: Uint8Array): ArrayLike<number> {
  const size = ELEMENT_BYTES[type]!;
  const { buffer } = bytes.slice(0, bytes.length - (bytes.length % size));
  if (type === "f") return new Float32Array(buffer);
  if (type === "d") return new Float64Array(buffer);
  if (type === "i") return new Int32Array(buffer);
  return type === "l" ? Array.from(new BigInt64Array(buffer), Number) : new Uint8Array(buffer);
}

/** In a text file the values come after the name, up to the next brace. */
function* textArrays(file: Uint8Array): Generator<Keys> {
  const text = new TextDecoder().decode(file);
  for (const [, name, list] of text.matchAll(/(KeyTime|KeyValueFloat):[^{}]*\{\s*a:([^}]*)/g))
    yield { name: name!, values: list!.split(",").map(Number.parseFloat) };
}

function broken(): StrutError {
  const message = "The motion in this file has keyframes out of order, or out of range.";
  return new StrutError({ code: "bad-file", message, hint: "Export it again." });
}
