/** How a worker of the package begins: the page tells it where the engine's files lie, then it serves calls. */
import { type ServerPort, serve } from "../client/server/serve";
import { type Asset, placeAssets } from "../engine/assets";
import type { EngineAsset } from "./assets";

/** Page → worker, once, before any call. URLs are absolute. */
export interface Boot {
  assets: Readonly<Record<EngineAsset, string | Uint8Array<ArrayBuffer>>>;
}

/** Worker → page, once, when its script runs. */
export const STARTED = "strut-motion started";

/** Serves calls at a port with the files of a {@link Boot}. */
export function serveBooted(port: ServerPort, { assets }: Boot): void {
  placeAssets(
    Object.fromEntries(
      Object.entries(assets).map(([name, asset]): [string, Asset] => [
        name,
        typeof asset === "string" ? new URL(asset) : asset,
      ]),
    ),
  );
  void serve(port);
}
