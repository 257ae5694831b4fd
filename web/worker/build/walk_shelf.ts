/** Walk models that were trained on this device: a database that has not changed has the same model. */
import { Kept } from "../kept";
import type { TrainedWalk } from "./protocol";

const models = new Kept("strut-walks", "models");
/** Names of built files end with a hash of their content. */
const HASHED = /-([\w-]{8})\.wasm$/;

/**
 * The model of a database, trained only if this device has not done so before by the same module. Where the browser keeps
 * nothing, as in a private window, it is trained every time.
 * @param module URL of the module that trains
 */
export async function trainedOnce(
  module: URL,
  database: Uint8Array,
  train: () => Promise<TrainedWalk>,
): Promise<TrainedWalk> {
  const version = HASHED.exec(module.pathname)?.[1];
  // A module whose name does not tell its content may change.
  if (version === undefined || typeof indexedDB === "undefined" || !globalThis.crypto?.subtle) return train();
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", database as Uint8Array<ArrayBuffer>));
  const key = `${version} ${Array.from(digest, (byte) => byte.toString(16).padStart(2, "0")).join("")}`;
  const known = await models
    .transact("readonly", (store) => store.get(key) as IDBRequest<TrainedWalk | undefined>)
    .catch(() => undefined);
  if (known) return known;
  const trained = await train();
  await keep(version, key, trained).catch(() => {});
  return trained;
}

/** Keeps a model, and forgets those of other modules. */
async function keep(version: string, key: string, trained: TrainedWalk): Promise<void> {
  const keys = await models.transact("readonly", (store) => store.getAllKeys());
  const outdated = keys.filter((known) => !String(known).startsWith(version));
  await models.transact("readwrite", (store) => {
    for (const known of outdated) store.delete(known);
    return store.put(trained, key);
  });
}
