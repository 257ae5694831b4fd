/** Assembles a binary glTF file. */

/** Returns the file of a document, which is written unchanged, and its buffer. */
export function glbOf(document: object, binary: Uint8Array): Uint8Array<ArrayBuffer> {
  const text = Buffer.from(JSON.stringify(document));
  const padded = Buffer.concat([text, Buffer.alloc(-text.length & 3, " ")]);
  const words = (...values: number[]) => Buffer.from(Uint32Array.from(values).buffer);
  const body = Buffer.concat([words(padded.length, 0x4e4f534a), padded, words(binary.length, 0x004e4942), binary]);
  return Uint8Array.from(Buffer.concat([words(0x46546c67, 2, 12 + body.length), body]));
}
