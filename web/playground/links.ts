/** The state in the address bar, links that are followed, and links to share; a small input travels in its link. */
import type { Notices } from "./notices";
import type { Session } from "./session";
import { fromHash, toHash } from "./state";
import type { Store } from "./store";
import { strings } from "./strings/strings";

/** The URL is written when nothing has changed for so long: browsers limit how often it may change. */
const WRITE_MS = 200;
/** Key of an input in a link; not part of the state, so that the address bar stays short. */
const FILE_KEY = "file";
/** Most characters of an input in a link: what messengers and mail still carry. */
const MOST_CHARACTERS = 24_000;

/** A file that came in a link. */
export interface LinkedFile {
  name: string;
  bytes: ArrayBuffer;
}

export class Links {
  readonly #store: Store;
  readonly #notices: Notices;
  #timer: ReturnType<typeof setTimeout> | undefined;

  constructor(store: Store, notices: Notices) {
    this.#store = store;
    this.#notices = notices;
  }

  /** Writes the state into the address bar once it has settled. */
  writeSoon(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      const hash = toHash(this.#store.state);
      history.replaceState(null, "", hash ? `#${hash}` : location.pathname + location.search);
    }, WRITE_MS);
  }

  /** Goes to the state of a link that was put into the address bar. */
  follow(hash: string): void {
    this.#store.edit(fromHash(hash));
    this.writeSoon();
  }

  /** Copies a link to what is shown. */
  async share(session: Session | undefined): Promise<void> {
    const { state } = this.#store;
    const url = new URL(location.href);
    url.hash = toHash(state);
    const source = session?.library.source(state.input);
    const packed = source?.kind === "bvh" ? await pack(source.bytes) : undefined;
    const carried = packed !== undefined && packed.length <= MOST_CHARACTERS;
    if (carried) url.hash += `&${FILE_KEY}=${encodeURIComponent(state.input)}~${packed}`;
    try {
      await navigator.clipboard.writeText(url.href);
    } catch {
      this.#notices.error(strings.page.links.cannotCopy);
      return;
    }
    if (packed === undefined) this.#notices.note(strings.page.links.copied);
    else if (carried) this.#notices.note(strings.page.links.copiedWithMotion);
    else this.#notices.note(strings.page.links.copiedWithoutMotion);
  }

  dispose(): void {
    clearTimeout(this.#timer);
  }
}

/**
 * The file in a link; `undefined` where there is none that can be read, or a longer one than {@link Links} makes, which
 * might inflate without end.
 */
export async function linkedFile(hash: string): Promise<LinkedFile | undefined> {
  const value = new URLSearchParams(hash.replace(/^#/, "")).get(FILE_KEY);
  const at = value?.lastIndexOf("~") ?? -1;
  if (!value || at < 1 || value.length - at > 1 + MOST_CHARACTERS) return undefined;
  try {
    return { name: value.slice(0, at), bytes: await unpack(value.slice(at + 1)) };
  } catch {
    return undefined;
  }
}

/** Bytes as text of a URL: deflated, in the base64 of URLs. */
export async function pack(bytes: ArrayBuffer): Promise<string> {
  const deflated = await through(bytes, new CompressionStream("deflate-raw"));
  let binary = "";
  for (const byte of new Uint8Array(deflated)) binary += String.fromCharCode(byte);
  return btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** What {@link pack} packed. */
export function unpack(text: string): Promise<ArrayBuffer> {
  const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  return through(bytes.buffer, new DecompressionStream("deflate-raw"));
}

function through(bytes: ArrayBuffer, stream: CompressionStream | DecompressionStream): Promise<ArrayBuffer> {
  return new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer();
}
