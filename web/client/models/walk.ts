/**
 * Walk models: trained in the build worker, opened on the calling thread. A frame takes microseconds and a control acts
 * on the next frame.
 */
import { WalkModel } from "../../engine/walk/walker";
import { BuildClient } from "../build/client";
import type { TrainedWalk } from "../build/protocol";
import type { CallOptions } from "../protocol";
import type { WorkerPort } from "../rpc";

export {
  type JointCurve,
  type JointPath,
  MAX_TURN,
  type PathOptions,
  type Side,
  STATES,
  type Tempo,
  Walker,
  type WalkFrame,
  WalkModel,
  type WalkTransition,
  type Weights,
} from "../../engine/walk/walker";

/** A `.strutwalk` file, or a database to train a model on: a `.strutdb` file, or the built-in one. */
export type WalkModelSource = { file: Uint8Array } | { database: Blob | undefined };

/**
 * Opens a walk model, which the caller disposes of.
 * @param spawn starts the build worker; tests replace it
 * @throws StrutError if the source is invalid, or `cancelled`
 */
export async function openWalk(
  source: WalkModelSource,
  options?: CallOptions,
  spawn?: () => WorkerPort,
): Promise<WalkModel> {
  const { file } = "file" in source ? source : await trainWalk(source.database, options, spawn);
  return WalkModel.open(file);
}

/** Trains a walk model in a worker of its own, which ends with the training. */
export async function trainWalk(
  database: Blob | undefined,
  options?: CallOptions,
  spawn?: () => WorkerPort,
): Promise<TrainedWalk> {
  const client = new BuildClient(spawn);
  try {
    return await client.trainWalk(database, options);
  } finally {
    client.dispose();
  }
}
