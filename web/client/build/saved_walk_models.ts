/** Walk models that were trained on this device. An unchanged database has the same model. */
import type { Asset } from "../../engine/assets";
import { IndexedDbStore } from "../indexed_db_store";
import type { TrainedWalk } from "./protocol";

const models = new IndexedDbStore("strut-walks", "models");
/** Maximum number of models that are kept; the least recently used one is removed first. */
export const MAX_MODELS = 8;
/** Names of built files end with a hash of their content. */
const HASHED = /-([\w-]{8})\.wasm$/;

/** A stored model. */
interface SavedModel {
  trained: TrainedWalk;
  /** Time of its last use, milliseconds since 1970. */
  usedAt: number;
}

/**
 * The model of a database. It is trained only if the same module has not trained it on this device before. If the
 * browser stores nothing, as in a private window, it is trained every time.
 * @param module location of the training module; if given as bytes, its version is unknown and every model is trained
 * @param now the current time, milliseconds since 1970
 */
export async function trainedOnce(
  module: Asset,
  database: Uint8Array,
  train: () => Promise<TrainedWalk>,
  now: number = Date.now(),
): Promise<TrainedWalk> {
  const version = module instanceof URL ? HASHED.exec(module.pathname)?.[1] : undefined;
  // A module whose name has no hash may change under the same name.
  if (version === undefined || typeof indexedDB === "undefined" || !globalThis.crypto?.subtle) return train();
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", database as Uint8Array<ArrayBuffer>));
  const key = `${version} ${Array.from(digest, (byte) => byte.toString(16).padStart(2, "0")).join("")}`;
  const known = await models
    .transact("readonly", (store) => store.get(key) as IDBRequest<SavedModel | undefined>)
    .catch(() => undefined);
  const trained = known?.trained ?? (await train());
  // If storage is full the model is trained again next time.
  await keep(version, key, { trained, usedAt: now }).catch(() => {});
  return trained;
}

/** Stores a model, and removes those of other modules and those beyond {@link MAX_MODELS}. */
async function keep(version: string, key: string, model: SavedModel): Promise<void> {
  const keys = await models.transact("readonly", (store) => store.getAllKeys());
  const values = await models.transact("readonly", (store) => store.getAll() as IDBRequest<SavedModel[]>);
  const others = keys.map((known, i) => ({ key: String(known), usedAt: values[i]?.usedAt ?? 0 }));
  const usable = others.filter((other) => other.key.startsWith(version) && other.key !== key);
  usable.sort((a, b) => b.usedAt - a.usedAt);
  const kept = new Set(usable.slice(0, MAX_MODELS - 1).map((other) => other.key));
  await models.transact("readwrite", (store) => {
    for (const known of keys) if (!kept.has(String(known))) store.delete(known);
    return store.put(model, key);
  });
}
