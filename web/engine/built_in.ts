/** The built-in motions: a database and inputs in one file, which the site serves. */
import { download, incomplete, readFile } from "./download";

const WHAT = "built-in motions";

/** Packed motions, as `rust/strut-formats/src/strutdb/packed.rs` says. */
export type PackedMotions = Uint8Array<ArrayBuffer>;

/**
 * Loads the built-in motions.
 * @param onProgress is called with the received share, 0–1, if the server sends the length
 * @throws StrutError if they cannot be had
 */
export async function loadBuiltIn(onProgress: (fraction: number) => void = () => {}): Promise<PackedMotions> {
  const url = new URL("./motions/built_in.bin", import.meta.url);
  if (url.protocol === "file:") return inflate(new Blob([await readFile(url)]).stream());
  const response = await download(url, WHAT);
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
