/** Trains walk models on databases on the calling thread. The build worker runs it. */

import type { RefusedFile } from "./builder";
import { buildPackage } from "./wasm";

/** A stage of {@link trainWalk}: clips are read, then styles trained. */
type TrainStage = "reading" | "training";

/** A trained walk model. */
export interface TrainedWalk {
  /** The `.strutwalk` file. */
  file: Uint8Array<ArrayBuffer>;
  styles: string[];
  /** Number of clips that it was trained on. */
  clips: number;
  /** Names of the clips that were left out, and the reasons. */
  refused: RefusedFile[];
}

/**
 * Trains a walk model on the walks of a database.
 * @param database a `.strutdb` file or packed motions
 * @throws StrutError if the database has no walks to train on
 */
export async function trainWalk(
  database: Uint8Array,
  onProgress: (stage: TrainStage, done: number, total: number) => void,
): Promise<TrainedWalk> {
  const glue = await buildPackage.load();
  const training = buildPackage.guarded(() => new glue.WalkTraining(database));
  const listener = { progress: onProgress };
  while (buildPackage.guarded(() => training.step(listener)));
  const trained = buildPackage.guarded(() => training.finish());
  try {
    return buildPackage.guarded(() => {
      const refused = trained.refused();
      return {
        file: trained.file() as Uint8Array<ArrayBuffer>,
        styles: trained.styles(),
        clips: trained.clips(),
        refused: Array.from({ length: refused.length / 2 }, (_, i) => ({
          path: refused[2 * i]!,
          reason: refused[2 * i + 1]!,
        })),
      };
    });
  } finally {
    trained.free();
  }
}
