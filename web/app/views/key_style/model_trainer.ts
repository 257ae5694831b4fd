/** Opens the model that the state asks for. Shows the progress, and a sentence if there is no model. */

import type { DroppedFile, TrainedKeyStyle } from "../../../client/build/protocol";
import { KeyStyleModel } from "../../../client/models/key_style";
import { type CallOptions, isCancellation, isFault, isUnloaded } from "../../../client/protocol";
import type { AppState } from "../../state/state";
import { strings } from "../../strings/strings";
import { ProgressLine } from "../../ui/progress";
import { errorText } from "../../ui/words";
import type { ViewHost } from "../../view";
import { EmptyPanel } from "../synthesis/empty_panel";
import { ModelLoader } from "../synthesis/model_loader";
import { titleOf, usualAxes } from "./axes";
import { KeyMotion } from "./key_motion";
import { type ClipSource, isSameRequest, KeyStyleModels, type ModelRequest, parseSet } from "./sets";

const words = strings.keyStyle;

/** Fields whose change requires another model. */
export const MODEL_FIELDS = ["keySet", "keyClips", "keyAxes", "keyComponents", "keyLearning"] as const;

/** An open model, and its training request. */
export interface OpenModel {
  motion: KeyMotion;
  trained: TrainedKeyStyle;
  axes: readonly string[];
  dispose(): void;
}

export class ModelTrainer {
  readonly progress = new ProgressLine();
  /** Shown instead of the picture if nothing could be trained. */
  readonly empty = new EmptyPanel();
  files: readonly DroppedFile[] = [];
  readonly #host: ViewHost;
  readonly #onChange: () => void;
  readonly #models = new KeyStyleModels();
  readonly #loader: ModelLoader<ModelRequest, OpenModel>;

  /** `onChange` is called when training begins, and when it has failed. */
  constructor(host: ViewHost, onOpen: (model: OpenModel) => void, onChange: () => void) {
    this.#host = host;
    this.#onChange = onChange;
    this.#loader = new ModelLoader<ModelRequest, OpenModel>({
      isSame: isSameRequest,
      load: (request) => this.progress.run(words.reading, (call) => this.#load(request, call)),
      cancel: () => this.progress.cancel(),
      onReady: (model) => {
        this.empty.hide();
        onOpen(model);
      },
      onFailed: (error) => this.#refuse(error),
    });
  }

  /** The last opened model; while {@link isTraining} it may be one of other motions. */
  get open(): OpenModel | undefined {
    return this.#loader.model;
  }

  /** Whether the last training failed. */
  get refused(): boolean {
    return this.#loader.failed;
  }

  /** The variables that the state asks for, or those that fit its motions. */
  axesOf(state: Readonly<AppState>): readonly string[] {
    if (state.keyAxes.length > 0) return state.keyAxes;
    const { source, action } = parseSet(state.keySet);
    return usualAxes(source === "files" ? (this.files[0]?.path.toLowerCase() ?? "") : action);
  }

  /** Whether the model that the state asks for is open. */
  has(state: Readonly<AppState>): boolean {
    return this.#loader.isReady(this.#requestOf(state));
  }

  /** Whether the model that the state asks for is still being trained. */
  isTraining(state: Readonly<AppState>): boolean {
    return !this.refused && !this.has(state);
  }

  /** Opens the model that the state asks for. */
  request(state: Readonly<AppState>): void {
    // A database stored on this device is opened first; the page calls again when it is open.
    if (state.database !== "" && !this.#host.session.database) return;
    const request = this.#requestOf(state);
    if (this.has(state)) return;
    this.empty.hide();
    void this.#loader.request(request);
    this.#onChange();
  }

  /** Cancels the training. */
  cancel(): void {
    this.#loader.cancel();
  }

  dispose(): void {
    this.#loader.dispose();
  }

  async #load({ source, order }: ModelRequest, call: CallOptions): Promise<OpenModel> {
    const trained = await this.#models.of({ source, order }, call);
    const motion = new KeyMotion(await KeyStyleModel.open(trained.file), titleOf);
    return { motion, trained, axes: order.axes, dispose: () => motion.dispose() };
  }

  #requestOf(state: Readonly<AppState>): ModelRequest {
    const { source: from, action } = parseSet(state.keySet);
    const { file } = this.#host.databaseFile();
    const source: ClipSource =
      from === "files" ? { files: this.files } : from === "open" && file ? { database: file } : {};
    const order = {
      clips: [...state.keyClips],
      action: from === "files" ? "" : action,
      axes: [...this.axesOf(state)],
      components: state.keyComponents,
      em: state.keyLearning === "em",
    };
    return { source, order };
  }

  /** Shows why there is no model, and what can be done. */
  #refuse(error: unknown): void {
    const { store } = this.#host;
    const again = { label: words.tryAgain, onChoose: () => this.request(store.state) };
    const undo = { label: strings.page.bar.undo, onChoose: () => store.undo() };
    const builtIn = { label: words.useBuiltIn, onChoose: () => store.edit(anotherSet("walk")) };
    const why = isCancellation(error) ? words.nothing : `${words.noModel} ${errorText(error)}`;
    // Errors that are not caused by the motions or the settings.
    const mayWork = isCancellation(error) || isFault(error) || isUnloaded(error);
    this.empty.show(why, mayWork ? [again] : store.canUndo ? [undo, builtIn] : [builtIn]);
    this.#onChange();
  }
}

/** The changes for other style variables: values of the former ones have no meaning. */
export function otherAxes(keyAxes: readonly string[]): Partial<AppState> {
  return { keyAxes, keys: [], keyLength: 0, keyChosen: -1, keyTime: 0, keyTrail: [], keyHandle: [] };
}

/** The changes for other motions. */
export function anotherSet(keySet: string): Partial<AppState> {
  return { ...otherAxes([]), keySet, keyClips: [] };
}
