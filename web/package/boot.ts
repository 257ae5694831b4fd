/** Start of a thread of the package: it receives the locations of the engine's files. */
import { type Asset, placeAssets } from "../engine/assets";
import { setFetchElsewhere } from "../engine/download";
import type { PlacedAsset } from "./assets";

/** Page → worker, once, before any call. URLs are absolute. */
export interface Boot {
  assets: Readonly<Record<PlacedAsset, string | Uint8Array<ArrayBuffer>>>;
  /** Fetches files for a worker that may not, for example because of a content security policy of its own. */
  files?: MessagePort;
}

/** Worker → page, at {@link Boot.files}: the URL of a file, and a port for its bytes, or `null` if it cannot be loaded. */
export type FileRequest = [address: string, answer: MessagePort];

/** Worker → page, once, when its script starts. */
export const STARTED = "strut-motion started";

/** Sets the locations of the files on this thread. */
export function placeBooted({ assets, files }: Boot): void {
  const placed = Object.entries(assets).map(([name, asset]): [string, Asset] => [
    name,
    typeof asset === "string" ? new URL(asset) : asset,
  ]);
  placeAssets(Object.fromEntries(placed));
  if (files) setFetchElsewhere(async ({ href }) => new Response(await ask(files, href)));
}

/** A file's bytes from the page. */
function ask(files: MessagePort, address: string): Promise<ArrayBuffer> {
  return new Promise((resolve, reject) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = ({ data }: MessageEvent<ArrayBuffer | null>) => {
      port1.close();
      if (data) resolve(data);
      else reject();
    };
    files.postMessage([address, port2] satisfies FileRequest, [port2]);
  });
}
