/** A small input file in a link. It is not part of the state, so the address bar stays short. */

/** Key of the file in a link. */
const FILE_KEY = "file";
/** Maximum number of characters of a file in a link: the limit of messengers and mail programs. */
const MAX_CHARACTERS = 24_000;

/** A file in a link. */
interface LinkedFile {
  name: string;
  bytes: ArrayBuffer;
}

/** The file as a part of a link, `file=…`; `undefined` if it is too long. */
export async function linkFile({ name, bytes }: LinkedFile): Promise<string | undefined> {
  const packed = await pack(bytes);
  return packed.length <= MAX_CHARACTERS ? `${FILE_KEY}=${encodeURIComponent(name)}~${packed}` : undefined;
}

/**
 * The file in a link; `undefined` if there is none that can be read, or it is longer than those of {@link linkFile},
 * which might inflate without end.
 */
export async function linkedFile(hash: string): Promise<LinkedFile | undefined> {
  const value = new URLSearchParams(hash.replace(/^#/, "")).get(FILE_KEY);
  const at = value?.lastIndexOf("~") ?? -1;
  if (!value || at < 1 || value.length - at > 1 + MAX_CHARACTERS) return undefined;
  try {
    return { name: value.slice(0, at), bytes: await unpack(value.slice(at + 1)) };
  } catch {
    return undefined;
  }
}

/** Bytes as URL-safe text: deflate-raw, then base64url. */
export async function pack(bytes: ArrayBuffer): Promise<string> {
  const deflated = await through(bytes, new CompressionStream("deflate-raw"));
  let binary = "";
  for (const byte of new Uint8Array(deflated)) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** Inverse of {@link pack}. */
export function unpack(text: string): Promise<ArrayBuffer> {
  const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  return through(bytes.buffer, new DecompressionStream("deflate-raw"));
}

function through(bytes: ArrayBuffer, stream: CompressionStream | DecompressionStream): Promise<ArrayBuffer> {
  return new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer();
}
