/** Binary glTF 2.0: the buffer, collected array by array, and the file. */

const [FLOAT, UINT8, UINT16] = [5126, 5121, 5123];
const MAGIC = 0x46546c67;
const [JSON_CHUNK, BINARY_CHUNK] = [0x4e4f534a, 0x004e4942];

/** Numbers per element of each type. */
const WIDTHS = { SCALAR: 1, VEC3: 3, VEC4: 4, MAT4: 16 } as const;

type Values = Float32Array | Uint16Array | Uint8Array;

/** Collects the buffer, with the views and accessors of its arrays. */
export class BufferBuilder {
  /** glTF's `bufferViews`, one per array. */
  readonly views: object[] = [];
  /** glTF's `accessors`, one per array. */
  readonly accessors: object[] = [];
  readonly #parts: Uint8Array[] = [];
  #length = 0;

  /** Bytes so far, a multiple of 4. */
  get length(): number {
    return this.#length;
  }

  /**
   * Adds an array; it is not copied.
   *
   * @param type - glTF's type of an element.
   * @param bounds - Whether its minimum and maximum are written too; positions and key times need them.
   * @returns The index of its accessor.
   */
  add(values: Values, type: keyof typeof WIDTHS, bounds = false): number {
    const width = WIDTHS[type];
    const bytes = new Uint8Array(values.buffer, values.byteOffset, values.byteLength);
    this.views.push({ buffer: 0, byteOffset: this.#length, byteLength: bytes.length });
    const padding = new Uint8Array(-bytes.length & 3);
    this.#parts.push(bytes, padding);
    this.#length += bytes.length + padding.length;
    const componentType = values instanceof Float32Array ? FLOAT : values instanceof Uint16Array ? UINT16 : UINT8;
    const accessor = { bufferView: this.views.length - 1, componentType, count: values.length / width, type };
    this.accessors.push(bounds ? { ...accessor, ...boundsOf(values, width) } : accessor);
    return this.accessors.length - 1;
  }

  /** Copies the buffer to `out`, from `offset` on. */
  write(out: Uint8Array, offset: number): void {
    let at = offset;
    for (const part of this.#parts) {
      out.set(part, at);
      at += part.length;
    }
  }
}

function boundsOf(values: Values, width: number): { min: number[]; max: number[] } {
  const [min, max] = [new Array<number>(width).fill(Infinity), new Array<number>(width).fill(-Infinity)];
  values.forEach((value, i) => {
    min[i % width] = Math.min(min[i % width]!, value);
    max[i % width] = Math.max(max[i % width]!, value);
  });
  return { min, max };
}

/**
 * The bytes of a GLB file.
 *
 * @param content - The document without its asset, buffers, views and accessors.
 * @param buffer - The buffer to which the document's accessors refer.
 */
export function glbFile(content: object, buffer: BufferBuilder): Uint8Array<ArrayBuffer> {
  const document = {
    asset: { version: "2.0", generator: "Strut" },
    ...content,
    bufferViews: buffer.views,
    accessors: buffer.accessors,
    buffers: [{ byteLength: buffer.length }],
  };
  const text = new TextEncoder().encode(JSON.stringify(document));
  const textLength = text.length + (-text.length & 3);
  const total = 12 + 8 + textLength + 8 + buffer.length;
  const out = new Uint8Array(total);
  const view = new DataView(out.buffer);
  [MAGIC, 2, total, textLength, JSON_CHUNK].forEach((word, i) => {
    view.setUint32(4 * i, word, true);
  });
  out.fill(0x20, 20, 20 + textLength);
  out.set(text, 20);
  view.setUint32(20 + textLength, buffer.length, true);
  view.setUint32(24 + textLength, BINARY_CHUNK, true);
  buffer.write(out, 28 + textLength);
  return out;
}
