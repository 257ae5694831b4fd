/** How a thread of the package begins: it is told where the engine's files lie. */
import { type Asset, placeAssets } from "../engine/assets";
import type { EngineAsset } from "./assets";

/** Page → worker, once, before any call. URLs are absolute. */
export interface Boot {
  assets: Readonly<Record<EngineAsset, string | Uint8Array<ArrayBuffer>>>;
}

/** Worker → page, once, when its script runs. */
export const STARTED = "strut-motion started";

/** Places the files on this thread. */
export function placeBooted({ assets }: Boot): void {
  const placed = Object.entries(assets).map(([name, asset]): [string, Asset] => [
    name,
    typeof asset === "string" ? new URL(asset) : asset,
  ]);
  placeAssets(Object.fromEntries(placed));
}
