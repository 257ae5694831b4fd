/**
 * Converts the text of a BVH file to bytes: UTF-8, except for names that the engine read in another encoding. The
 * engine represents each of their bytes from 0x80 on as a character from U+10FE80 on (`write_text` in
 * `rust/strut-formats/src/bvh/write.rs`).
 */
const ESCAPED = /[\u{10FE80}-\u{10FEFF}]/u;

/** The bytes to save. */
export function bvhBytes(text: string): Uint8Array<ArrayBuffer> {
  const bytes = new TextEncoder().encode(text);
  if (!ESCAPED.test(text)) return bytes;
  let length = 0;
  for (let at = 0; at < bytes.length; length++) {
    // Those characters are F4 8F BA 80 to F4 8F BB BF.
    const third = bytes[at + 2]!;
    const isEscaped = bytes[at] === 0xf4 && bytes[at + 1] === 0x8f && (third & 0xfe) === 0xba;
    bytes[length] = isEscaped ? 0x80 | ((third & 1) << 6) | (bytes[at + 3]! & 0x3f) : bytes[at]!;
    at += isEscaped ? 4 : 1;
  }
  return bytes.slice(0, length);
}
