/** From what the state asks for to a model at work: progress meanwhile, and a sentence where there is none. */
import type { DroppedFile, KeyStyleOrder, TrainedKeyStyle } from "../../worker/build/protocol";
import { KeyStyleModel } from "../../worker/key_style/key_style";
import { button } from "../controls/buttons";
import { html } from "../dom";
import { ProgressLine } from "../progress";
import type { PlayState } from "../state";
import { strings } from "../strings/strings";
import type { ViewHost } from "../views";
import { errorText, isCancellation } from "../words";
import { titleOf, usualAxes } from "./axes";
import { Performance } from "./performance";
import { type ClipSource, KeyStyleModels, parseSet } from "./sets";

const words = strings.keyStyle;

/** Fields that another model is trained for. */
export const MODEL_FIELDS = ["keySet", "keyClips", "keyAxes", "keyComponents", "keyLearning"] as const;

/** A model at work, and how it came about. */
export interface Learned {
  performance: Performance;
  trained: TrainedKeyStyle;
  axes: readonly string[];
}

export class Learner {
  readonly progress = new ProgressLine();
  /** What is shown instead of the picture where nothing could be learned. */
  readonly empty = html("div", { class: "maker-empty", hidden: true });
  files: readonly DroppedFile[] = [];
  readonly #host: ViewHost;
  readonly #onLearned: (learned: Learned) => void;
  readonly #onChange: () => void;
  readonly #models = new KeyStyleModels();
  /** What was asked for last. */
  #asked = "";
  #round = 0;
  #busy = false;

  /** `onChange` hears when it begins to learn, and when that has failed. */
  constructor(host: ViewHost, onLearned: (learned: Learned) => void, onChange: () => void) {
    this.#host = host;
    this.#onLearned = onLearned;
    this.#onChange = onChange;
  }

  /** Whether what was asked for last could not be learned. */
  get refused(): boolean {
    return this.empty.hidden === false;
  }

  /** The variables that the state asks for, or those that fit its motions. */
  axesOf(state: Readonly<PlayState>): readonly string[] {
    if (state.keyAxes.length > 0) return state.keyAxes;
    const { source, action } = parseSet(state.keySet);
    return usualAxes(source === "files" ? (this.files[0]?.path.toLowerCase() ?? "") : action);
  }

  /** Whether what the state asks for is what was learned last. */
  has(state: Readonly<PlayState>): boolean {
    const { source, order } = this.#orderOf(state);
    return this.#keyOf(source, order) === this.#asked;
  }

  /** Whether what the state asks for is still to come. */
  learning(state: Readonly<PlayState>): boolean {
    return !this.refused && (this.#busy || !this.has(state));
  }

  /** Learns what the state asks for, unless that is what was learned last. */
  async learn(state: Readonly<PlayState>, again = false): Promise<void> {
    const { source, order } = this.#orderOf(state);
    const asked = this.#keyOf(source, order);
    if (asked === this.#asked && !again) return;
    this.#asked = asked;
    this.#round += 1;
    const round = this.#round;
    this.empty.hidden = true;
    this.#busy = true;
    this.#onChange();
    try {
      const learned = await this.progress.run(words.reading, async (call): Promise<Learned> => {
        const trained = await this.#models.of(source, order, call);
        const model = await KeyStyleModel.open(trained.file);
        return { performance: new Performance(model, titleOf), trained, axes: order.axes };
      });
      if (round !== this.#round) {
        learned.performance.dispose();
        return;
      }
      this.#busy = false;
      this.#onLearned(learned);
    } catch (error) {
      if (round !== this.#round) return;
      this.#busy = false;
      this.#asked = "";
      this.#refuse(isCancellation(error) ? "" : errorText(error));
    }
  }

  #keyOf({ database, files }: ClipSource, order: KeyStyleOrder): string {
    return JSON.stringify([database ? this.#host.databaseFile().name : "", files?.map((f) => f.path), order]);
  }

  #orderOf(state: Readonly<PlayState>): { source: ClipSource; order: KeyStyleOrder } {
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

  /** Says why there is nothing, and what can be done. */
  #refuse(why: string): void {
    const { store } = this.#host;
    const outlined = { label: true, class: "outlined" };
    const again = button(words.tryAgain, () => void this.learn(store.state, true), outlined);
    const undo = button(strings.page.bar.undo, () => store.undo(), outlined);
    const builtIn = button(words.useBuiltIn, () => store.edit(anotherSet("walk")), outlined);
    const choices = why === "" ? [again] : store.canUndo ? [undo, builtIn] : [builtIn];
    this.empty.replaceChildren(
      html("p", {}, why === "" ? words.nothing : `${words.noModel} ${why}`),
      html("div", {}, ...choices),
    );
    this.empty.hidden = false;
    this.#onChange();
  }
}

/** What changes with other style variables: values of the former ones mean nothing. */
export function otherAxes(keyAxes: readonly string[]): Partial<PlayState> {
  return { keyAxes, keys: [], keyLength: 0, keyChosen: -1, keyTime: 0, keyTrail: [], keyHandle: [] };
}

/** What changes with other motions. */
export function anotherSet(keySet: string): Partial<PlayState> {
  return { ...otherAxes([]), keySet, keyClips: [] };
}
