/** The built-in motions: databases, each with its inputs in one file. */
import { type Asset, assetOf } from "./assets";
import { download, incomplete, readAsset } from "./download";

const WHAT = "built-in motions";

/**
 * `built-in` is the complete set, as in the playground. `walk` has walks in eight styles and one input, for sites that
 * host only that. `first` has the first strides of these walks and the same input; the playground starts with it.
 */
export type BuiltInSet = "built-in" | "walk" | "first";

/** Packed motions; `rust/strut-formats/src/strutdb/packed.rs` describes the format. */
export type PackedMotions = Uint8Array<ArrayBuffer>;

/** A file of motions; `share` is its share of the total bytes. */
interface MotionFile {
  asset: () => Asset;
  share: number;
}

const FIRST: MotionFile = {
  asset: () => assetOf("first.bin", () => new URL("./motions/first.bin", import.meta.url)),
  share: 0.1,
};
const OTHERS: MotionFile = {
  asset: () => assetOf("built_in.bin", () => new URL("./motions/built_in.bin", import.meta.url)),
  share: 0.9,
};
const WALK: MotionFile = {
  asset: () =>
    assetOf("walk.bin", () => {
      throw incomplete(WHAT, "walk.bin has no place on this site");
    }),
  share: 1,
};

/** The files of each set, read one after the other. The later file does not repeat the contents of the first. */
const FILES: Record<BuiltInSet, readonly MotionFile[]> = {
  "built-in": [FIRST, OTHERS],
  walk: [WALK],
  first: [FIRST],
};

/**
 * Loads a set of built-in motions.
 * @param onProgress is called with the received share, 0–1, if the server sends the length
 * @throws StrutError if they cannot be loaded
 */
export async function loadBuiltIn(
  onProgress?: (fraction: number) => void,
  set: BuiltInSet = "built-in",
): Promise<PackedMotions> {
  const files = FILES[set];
  const all = files.reduce((sum, { share }) => sum + share, 0);
  const received = files.map(() => 0);
  const parts = await Promise.all(
    files.map(({ asset, share }, i) =>
      inflatedAsset(asset(), WHAT, (fraction) => {
        received[i] = (fraction * share) / all;
        onProgress?.(received.reduce((sum, part) => sum + part, 0));
      }),
    ),
  );
  return joined(parts);
}

function joined(parts: readonly PackedMotions[]): PackedMotions {
  if (parts.length === 1) return parts[0]!;
  const whole = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

/**
 * Loads a packed file.
 * @param what the part of Strut that the file is, for messages
 * @param onProgress is called with the received share, 0–1, if the server sends the length
 * @throws StrutError if it cannot be loaded
 */
export async function inflatedAsset(
  asset: Asset,
  what: string,
  onProgress?: (fraction: number) => void,
): Promise<Uint8Array<ArrayBuffer>> {
  const packed = await streamOf(asset, what, onProgress);
  try {
    const bytes = packed.pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(bytes).arrayBuffer());
  } catch {
    throw incomplete(what, "the file arrived cut short or damaged");
  }
}

type Bytes = Uint8Array<ArrayBuffer>;

async function streamOf(
  asset: Asset,
  what: string,
  onProgress: ((fraction: number) => void) | undefined,
): Promise<ReadableStream<Bytes>> {
  if (!(asset instanceof URL)) return new Blob([asset]).stream();
  if (asset.protocol === "file:") return new Blob([await readAsset(asset, what)]).stream();
  const { body, headers } = await download(asset, what);
  if (!body) throw incomplete(what, "the answer is empty");
  // If the server compresses the compressed file again, Content-Length is not the number of received bytes.
  const total = headers.has("Content-Encoding") ? 0 : Number(headers.get("Content-Length"));
  let received = 0;
  return body.pipeThrough(
    new TransformStream<Bytes, Bytes>({
      transform(chunk, controller) {
        received += chunk.length;
        if (total > 0) onProgress?.(Math.min(received / total, 1));
        controller.enqueue(chunk);
      },
    }),
  );
}
