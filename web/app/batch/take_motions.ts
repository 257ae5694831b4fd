/** Asks what to do with several dropped motions, and does it. Loaded on first use. */
import "./batch.css";
import type { DroppedFile } from "../../client/build/protocol";
import { findSources, reasonOf, type Source } from "../../client/build/sources";
import { isCancellation } from "../../client/protocol";
import { button } from "../../ui/controls/buttons";
import { html } from "../../ui/dom";
import { askInDialog, dialogActions } from "../ui/dialog";
import { cancelled } from "../ui/words";
import { askForStyles } from "./ask_for_styles";
import { BatchCard, type BatchPlace } from "./batch_card";
import { batchWords as words } from "./strings.en";

/** Maximum number of motions that become inputs, and maximum number of bytes of them: all of them are in memory. */
const MOST_INPUTS = 500;
const MOST_BYTES = 2 ** 30;

/** Uses of motions. */
type Use = "inputs" | "restyle" | "database";

/** The page's interface for them. */
interface MotionsPlace extends BatchPlace {
  /** Makes them inputs, and opens the first. */
  asInputs(motions: readonly { name: string; bytes: ArrayBuffer }[]): Promise<void>;
  /** Passes the files to the Data view. */
  asDatabase(files: DroppedFile[]): Promise<void>;
}

export class Motions {
  readonly #place: MotionsPlace;
  #card: BatchCard | undefined;

  constructor(place: MotionsPlace) {
    this.#place = place;
  }

  /** Asks what several files, folders and archives are for, and processes them. */
  async take(files: DroppedFile[]): Promise<void> {
    const { asDatabase } = this.#place;
    const { clips, notes } = await findSources(files);
    // The Data view reports what is wrong with them.
    if (clips.length === 0) return asDatabase(files);
    for (const note of notes) this.#place.toasts.error(note);
    const use = clips.length === 1 ? "inputs" : await askForUse(clips.length);
    if (use === "inputs") await this.#asInputs(clips);
    else if (use === "database") await asDatabase(files);
    else if (use === "restyle") await this.#restyle(clips);
  }

  dispose(): void {
    this.#card?.dispose();
  }

  async #restyle(clips: readonly Source[]): Promise<void> {
    const { toasts } = this.#place;
    if (this.#card?.busy) {
      toasts.error(words.busy);
      return;
    }
    const variants = await askForStyles(clips.length, this.#place);
    if (!variants) return;
    this.#card?.dispose();
    this.#card = new BatchCard(clips, variants, this.#place);
    await this.#card.run();
  }

  async #asInputs(clips: readonly Source[]): Promise<void> {
    const { toasts, input: progress, asInputs } = this.#place;
    if (clips.length > MOST_INPUTS) {
      toasts.error(words.tooMany(clips.length, MOST_INPUTS));
      return;
    }
    try {
      const motions = await progress.run(words.reading(clips.length), async ({ signal, onProgress }) => {
        const read: { name: string; bytes: ArrayBuffer }[] = [];
        let size = 0;
        for (const [i, clip] of clips.entries()) {
          if (signal?.aborted) throw cancelled();
          onProgress?.({ label: words.reading(clips.length), fraction: i / clips.length });
          try {
            const bytes = (await clip.read()).slice().buffer;
            size += bytes.byteLength;
            read.push({ name: clip.path.slice(clip.path.lastIndexOf("/") + 1), bytes });
          } catch (thrown) {
            toasts.error(words.notRead(clip.path, reasonOf(thrown)));
          }
          if (size > MOST_BYTES) return undefined;
        }
        return read;
      });
      if (!motions) {
        toasts.error(words.tooMany(clips.length, MOST_INPUTS));
        return;
      }
      await asInputs(motions);
      if (motions.length > 1) toasts.note(words.added(motions.length));
    } catch (thrown) {
      if (!isCancellation(thrown)) toasts.failure(thrown);
    }
  }
}

function askForUse(count: number): Promise<Use | undefined> {
  return askInDialog<Use>("motions", words.heading(count), (choose, cancel) => {
    const choice = (use: Use, name: string, what: string) => {
      const made = html("button", { type: "button", class: "button motions-use" }, html("span", {}, name));
      made.append(html("span", { class: "caption" }, what));
      made.addEventListener("click", () => choose(use));
      return made;
    };
    return [
      html(
        "div",
        { class: "motions-uses" },
        choice("inputs", words.inputs, words.inputsWhat),
        choice("restyle", words.restyle, words.restyleWhat),
        choice("database", words.database, words.databaseWhat),
      ),
      dialogActions(button(words.cancel, cancel, { label: true })),
    ];
  });
}
