/** The built-in motions: databases, each with its inputs in one file. */
import { type Asset, assetOf } from "./assets";
import { download, incomplete, readAsset } from "./download";

const WHAT = "built-in motions";

/** `built-in` is all of them, as the playground has them; `walk` is walks in eight styles and one input. */
export type BuiltInSet = "built-in" | "walk";

/** Packed motions, as `rust/strut-formats/src/strutdb/packed.rs` says. */
export type PackedMotions = Uint8Array<ArrayBuffer>;

/** Where each set lies. */
const ASSETS: Record<BuiltInSet, () => Asset> = {
  "built-in": () => assetOf("built_in.bin", () => new URL("./motions/built_in.bin", import.meta.url)),
  // The playground has all motions and no use for these; whoever serves them says where they lie.
  walk: () =>
    assetOf("walk.bin", () => {
      throw incomplete(WHAT, "walk.bin has no place on this site");
    }),
};

/**
 * Loads a set of built-in motions.
 * @param onProgress is called with the received share, 0–1, if the server sends the length
 * @throws StrutError if they cannot be had
 */
export async function loadBuiltIn(
  onProgress: (fraction: number) => void = () => {},
  set: BuiltInSet = "built-in",
): Promise<PackedMotions> {
  const asset = ASSETS[set]();
  if (!(asset instanceof URL)) return inflate(new Blob([asset]).stream());
  if (asset.protocol === "file:") return inflate(new Blob([await readAsset(asset, WHAT)]).stream());
  const response = await download(asset, WHAT);
  if (!response.body) throw incomplete(WHAT, "the answer is empty");
  // If the server compresses the compressed file again, its Content-Length is not that of the received bytes.
  const total = response.headers.has("Content-Encoding") ? 0 : Number(response.headers.get("Content-Length"));
  return inflate(response.body.pipeThrough(counted((bytes) => total > 0 && onProgress(Math.min(bytes / total, 1)))));
}

/** Passes all chunks on and counts their bytes. */
function counted(tell: (bytes: number) => void): TransformStream<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>> {
  let bytes = 0;
  return new TransformStream({
    transform(chunk, controller) {
      bytes += chunk.length;
      tell(bytes);
      controller.enqueue(chunk);
    },
  });
}

async function inflate(stream: ReadableStream<Uint8Array<ArrayBuffer>>): Promise<PackedMotions> {
  try {
    const inflated = stream.pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(inflated).arrayBuffer());
  } catch {
    throw incomplete(WHAT, "the file arrived cut short or damaged");
  }
}
