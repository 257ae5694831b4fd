/** Trains key-style models on clips on the calling thread. The build worker runs it. */

import type { RefusedFile } from "./builder";
import { buildPackage } from "./wasm";

/** Clips and settings of a training run. */
export interface KeyStyleOrder {
  /** Names of clips; if empty, the clips of `action`, in the neutral style if there is one. */
  clips: readonly string[];
  /** Action of the clips; if empty, all files, or the first action of the database. */
  action: string;
  /** Style variables: names of measures, or expressions. */
  axes: readonly string[];
  /** Components of the mixture; 0 lets the training choose. */
  components: number;
  /** Whether the model is trained with expectation maximisation, for comparison. */
  em: boolean;
}

/** A clip that a model can be trained on. */
export interface KeyStyleClip {
  name: string;
  action: string;
  style: string;
  secs: number;
}

/** A trained model. */
export interface TrainedKeyStyle {
  /** The `.strutkeys` file. */
  file: Uint8Array<ArrayBuffer>;
  /** All available clips, and the names of those that the model was trained on. */
  clips: KeyStyleClip[];
  trainedOn: string[];
  refused: RefusedFile[];
  /** Share of the variance of the poses that the style variables do not explain, if it is too large; else 0. */
  unexplainedShare: number;
  /** Duration of the training, without reading the clips, seconds. */
  secs: number;
}

/** Receives the number of passes done and their total. */
type OnTrainProgress = (done: number, total: number) => void;

/** BVH files to train on instead of a database. */
type KeyStyleFiles = readonly { name: string; bytes: Uint8Array }[];

/** Clips that models are trained on. */
export class KeyStyleClips {
  readonly clips: KeyStyleClip[];
  readonly refused: RefusedFile[] = [];

  private constructor(
    private readonly raw: InstanceType<Awaited<ReturnType<typeof buildPackage.load>>["KeyStyleClips"]>,
  ) {
    const [names, actions, styles, secs] = [raw.names(), raw.actions(), raw.styles(), raw.secs()];
    this.clips = names.map((name, i) => ({ name, action: actions[i]!, style: styles[i]!, secs: secs[i]! }));
  }

  /**
   * Reads the clips of a `.strutdb` file or packed motions.
   * @throws StrutError if the file is invalid; the message says why
   */
  static async ofDatabase(database: Uint8Array): Promise<KeyStyleClips> {
    const glue = await buildPackage.load();
    return new KeyStyleClips(buildPackage.guarded(() => glue.KeyStyleClips.ofDatabase(database)));
  }

  /** Reads the clips of BVH files. Files that cannot be read are refused. */
  static async ofFiles(files: KeyStyleFiles): Promise<KeyStyleClips> {
    const glue = await buildPackage.load();
    const raw = new glue.KeyStyleClips();
    const refused: RefusedFile[] = [];
    for (const { name, bytes } of files)
      try {
        buildPackage.guarded(() => raw.addFile(name, bytes));
      } catch (thrown) {
        refused.push({ path: name, reason: (thrown as Error).message });
      }
    const clips = new KeyStyleClips(raw);
    clips.refused.push(...refused);
    return clips;
  }

  /**
   * Trains a model.
   * @throws StrutError if nothing can be trained; the message says why
   */
  train(order: KeyStyleOrder, onProgress: OnTrainProgress): TrainedKeyStyle {
    const chosen = chosenClips(this.clips, order);
    const begin = performance.now();
    const training = buildPackage.guarded(() =>
      this.raw.train(Uint32Array.from(chosen), [...order.axes], order.components, order.em),
    );
    const listener = { progress: (_: string, done: number, total: number) => onProgress(done, total) };
    while (buildPackage.guarded(() => training.step(listener)));
    const trained = buildPackage.guarded(() => training.finish());
    const secs = (performance.now() - begin) / 1000;
    try {
      return buildPackage.guarded(() => ({
        file: trained.file() as Uint8Array<ArrayBuffer>,
        clips: this.clips,
        trainedOn: chosen.map((clip) => this.clips[clip]!.name),
        refused: this.refused,
        unexplainedShare: trained.unexplainedShare(),
        secs,
      }));
    } finally {
      trained.free();
    }
  }

  dispose(): void {
    this.raw.free();
  }
}

/** Names of the neutral style. */
const NEUTRAL = ["neutral", "normal"];

/** Indices of the clips that a training request selects. */
export function chosenClips(clips: readonly KeyStyleClip[], order: Pick<KeyStyleOrder, "clips" | "action">): number[] {
  const all = [...clips.keys()];
  const named = all.filter((i) => order.clips.includes(clips[i]!.name));
  if (named.length > 0) return named;
  const action = order.action || (clips[0]?.action ?? "");
  const acting = all.filter((i) => clips[i]!.action === action);
  const style = NEUTRAL.find((name) => acting.some((i) => clips[i]!.style === name)) ?? clips[acting[0] ?? 0]?.style;
  return acting.filter((i) => clips[i]!.style === style);
}
