/**
 * Key-style models: trained in the build worker, opened on the calling thread. A pose takes microseconds and follows
 * the pointer within the same display frame.
 */
import { KeyStyleModel } from "../../engine/key_style/model";
import { BuildClient } from "../build/client";
import type { DroppedFile, KeyStyleOrder, TrainedKeyStyle } from "../build/protocol";
import type { CallOptions } from "../protocol";
import type { WorkerPort } from "../rpc";

export {
  type Between,
  type CheckedAxis,
  type Curve,
  checkAxis,
  type KeyStyleFrame,
  KeyStyleModel,
  type PoseMode,
  Poser,
  type Span,
  type StyleKey,
  Styling,
  type TrainingClip,
} from "../../engine/key_style/model";
export type { Somn, SomnOptions, SomnState } from "../../engine/key_style/somn";

/** Motions to train a model on: BVH files or archives of them, a `.strutdb` file, or the built-in database. */
type TrainingMotions = { files: readonly DroppedFile[] } | { database: Blob | undefined };

/** A `.strutkeys` file, or motions and the settings of the training. */
export type KeyStyleModelSource = { file: Uint8Array } | { motions: TrainingMotions; order: KeyStyleOrder };

/**
 * Opens a key-style model, which the caller disposes of.
 * @param spawn starts the build worker; tests replace it
 * @throws StrutError if the source is invalid, or `cancelled`
 */
export async function openKeyStyle(
  source: KeyStyleModelSource,
  options?: CallOptions,
  spawn?: () => WorkerPort,
): Promise<KeyStyleModel> {
  const { file } = "file" in source ? source : await trainKeyStyle(source.motions, source.order, options, spawn);
  return KeyStyleModel.open(file);
}

/** Trains a key-style model in a worker of its own, which ends with the training. */
export async function trainKeyStyle(
  motions: TrainingMotions,
  order: KeyStyleOrder,
  options?: CallOptions,
  spawn?: () => WorkerPort,
): Promise<TrainedKeyStyle> {
  const [database, files] = "files" in motions ? [undefined, motions.files] : [motions.database, []];
  const client = new BuildClient(spawn);
  try {
    return await client.trainKeyStyle(database, files, order, options);
  } finally {
    client.dispose();
  }
}
