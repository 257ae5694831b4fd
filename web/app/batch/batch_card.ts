/** The card of a batch: its progress, left-out clips, and the zip. The page remains usable. */
import type { Source } from "../../client/build/sources";
import { type DatabaseSource, isCancellation } from "../../client/protocol";
import type { Session } from "../../player/session";
import { button } from "../../ui/controls/buttons";
import { html, saveFile, setAttributes, setText } from "../../ui/dom";
import type { Store } from "../state/store";
import { announce } from "../ui/announce";
import { LeaveGuard } from "../ui/leave_guard";
import type { ProgressLine } from "../ui/progress";
import { taskCard } from "../ui/task_card";
import type { Toasts } from "../ui/toasts";
import { Batch } from "./batch";
import { EngineLane, laneCount } from "./engine_lane";
import { batchWords as words } from "./strings.en";
import type { Variant } from "./variants";

/** The page's interface for a batch. */
export interface BatchPlace {
  readonly store: Store;
  readonly session: Session;
  readonly toasts: Toasts;
  /** The progress line of inputs. */
  readonly input: ProgressLine;
  /** The element in which cards are shown. */
  readonly root: HTMLElement;
}

/** The remaining time is estimated after this time, milliseconds. */
const GUESS_MS = 5000;

export class BatchCard {
  readonly #batch: Batch;
  readonly #place: BatchPlace;
  readonly #source: DatabaseSource;
  readonly #heading = html("h2");
  readonly #figures = html("p", { class: "caption" });
  readonly #bar = html("div", { class: "progress-bar", role: "progressbar", "aria-valuemin": 0, "aria-valuemax": 100 });
  readonly #left = html("ul");
  readonly #reasons: HTMLDetailsElement;
  readonly #actions = html("div", { class: "dialog-actions" });
  readonly #element: HTMLElement;
  readonly #guard = new LeaveGuard();
  #running: AbortController | undefined;
  #began = 0;
  #doneBefore = 0;
  #saved = 0;

  constructor(clips: readonly Source[], variants: readonly Variant[], place: BatchPlace) {
    this.#batch = new Batch(clips, variants);
    this.#place = place;
    const { databaseSource: source } = place.session;
    // All built-in motions, even if only the first ones are loaded so far.
    this.#source = source?.kind === "strutdb" ? source : { kind: "demo" };
    this.#reasons = html("details", { hidden: true }, html("summary", {}), this.#left);
    this.#element = taskCard(words.name, this.#bar, this.#heading, this.#figures, this.#reasons, this.#actions);
    this.#element.classList.add("batch-card");
    place.root.append(this.#element);
  }

  /** Whether closing it would lose something. */
  get busy(): boolean {
    return this.#running !== undefined || this.#unsaved > 0;
  }

  /** Makes the remaining files until all are done or the user stops it. */
  async run(): Promise<void> {
    if (this.#running) return;
    const { toasts, session } = this.#place;
    const running = new AbortController();
    this.#running = running;
    this.#began = performance.now();
    this.#doneBefore = this.#batch.done;
    const call = { signal: running.signal };
    const lanes: EngineLane[] = [];
    const batch = this.#batch;
    this.#show();
    announce(words.running(batch.clips.length));
    try {
      const count = Math.min(laneCount(), batch.clips.length);
      const starting = Array.from({ length: count }, async () => {
        lanes.push(await EngineLane.start(this.#source, session.remembered(), call));
      });
      const started = await Promise.allSettled(starting);
      const refused = started.find((start) => start.status === "rejected");
      // One lane is enough.
      if (refused && lanes.length === 0) throw refused.reason;
      this.#began = performance.now();
      await batch.run(lanes, () => this.#show(), call);
    } catch (thrown) {
      if (!isCancellation(thrown)) toasts.failure(thrown);
    } finally {
      for (const lane of lanes) lane.dispose();
      this.#running = undefined;
      this.#show();
      announce(this.#heading.textContent ?? "");
    }
  }

  dispose(): void {
    this.#running?.abort();
    this.#guard.needed = false;
    this.#element.remove();
  }

  get #unsaved(): number {
    return this.#batch.done - this.#saved;
  }

  #show(): void {
    const { done, files, clips, leftOut, fraction, ended } = this.#batch;
    const running = this.#running !== undefined;
    // Unsaved files would be lost with the page.
    this.#guard.needed = this.busy;
    const heading = running ? words.running(clips.length) : ended ? words.done(done) : words.stopped(done, files);
    setText(this.#heading, heading);
    setAttributes(this.#bar, { "aria-label": heading, "aria-valuenow": Math.round(100 * fraction) });
    this.#bar.style.transform = `scaleX(${fraction})`;
    this.#bar.hidden = !running;
    setText(this.#figures, running ? this.#said() : "");
    this.#figures.hidden = !running;
    this.#showReasons(leftOut.length);
    this.#showActions(running);
  }

  /** Text of the progress. */
  #said(): string {
    const { done, files, leftOut } = this.#batch;
    const passed = performance.now() - this.#began;
    const made = done - this.#doneBefore;
    if (made === 0 && leftOut.length === 0) return words.preparing;
    const secs = (((files - done - leftOut.length * this.#batch.variants.length) / Math.max(1, made)) * passed) / 1000;
    return [
      words.progress(done, files),
      ...(leftOut.length > 0 ? [words.leftOut(leftOut.length)] : []),
      ...(passed > GUESS_MS && made > 0 && secs > 5 ? [words.left(secs)] : []),
    ].join(" · ");
  }

  #showReasons(count: number): void {
    this.#reasons.hidden = count === 0;
    if (this.#left.childElementCount === count) return;
    setText(this.#reasons.querySelector("summary")!, words.why(count));
    for (const { path, why } of this.#batch.leftOut.slice(this.#left.childElementCount))
      this.#left.append(html("li", {}, words.because(path, why)));
  }

  #showActions(running: boolean): void {
    const state = running ? "running" : `${this.#batch.ended} ${this.#batch.done} ${this.#saved}`;
    if (this.#actions.dataset.state === state) return;
    this.#actions.dataset.state = state;
    const labelled = (name: string, act: () => void, outlined = true) =>
      button(name, act, { label: true, ...(outlined && { class: "outlined" }) });
    if (running) {
      this.#actions.replaceChildren(labelled(words.stop, () => this.#running?.abort()));
      return;
    }
    const { done, bytes, ended } = this.#batch;
    this.#actions.replaceChildren(
      labelled(words.close, () => this.#close(), false),
      ...(ended ? [] : [labelled(words.resume, () => void this.run())]),
      ...(done > 0 ? [labelled(this.#unsaved > 0 ? words.save(bytes) : words.again, () => this.#save())] : []),
    );
  }

  #save(): void {
    const { variants, done } = this.#batch;
    const zip = this.#batch.archive();
    const [first] = variants;
    const name = `restyled-${variants.length === 1 ? first!.name.replace(/[^\p{L}\p{N}]+/gu, "-") : `${variants.length}-styles`}.zip`;
    saveFile(name, zip);
    this.#saved = done;
    this.#place.toasts.note(words.saved(name, zip.size));
    this.#show();
  }

  /** Removes the card. Unsaved files can be restored while the offer is shown. */
  #close(): void {
    const unsaved = this.#unsaved;
    this.#element.remove();
    if (unsaved === 0) {
      this.dispose();
      return;
    }
    this.#place.toasts.offer(words.discarded(unsaved), words.undo, () => this.#place.root.append(this.#element));
    // No warning about files of a batch that the user has closed.
    this.#saved = this.#batch.done;
    this.#guard.needed = false;
  }
}
