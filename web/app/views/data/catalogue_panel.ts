/** Public data sets: the list, licences, and downloads. */

import { type CallOptions, isCancellation } from "../../../client/protocol";
import { button } from "../../../ui/controls/buttons";
import { html, setText } from "../../../ui/dom";
import { megabytes } from "../../strings/numerals";
import { strings } from "../../strings/strings";
import { ProgressLine } from "../../ui/progress";
import { errorText } from "../../ui/words";
import { loadCatalogue, type PublicSet } from "./catalogue";
import { askToFetch } from "./licence_dialog";
import { type FileCache, fetchSet, filesKept, forgetSet, forgetUnlisted, openCache } from "./set_download";

const words = strings.data.sets;

/** A set, and the number of its files in the browser's cache. */
interface Entry {
  set: PublicSet;
  kept: number;
}

export class CataloguePanel {
  readonly element: HTMLElement;
  readonly #progress = new ProgressLine();
  readonly #list = html("ul", { class: "stored" });
  readonly #note = html("p", { class: "caption", role: "status" });
  /** Loads the list again if loading failed. */
  readonly #again = button(strings.page.tryAgain, () => this.show(), { label: true, class: "outlined" });
  readonly #onFiles: (set: PublicSet, files: Awaited<ReturnType<typeof fetchSet>>) => void;
  #entries: Entry[] = [];
  #cache: FileCache | undefined;
  #loading: Promise<void> | undefined;
  #busy = false;

  /** @param onFiles called with the files of a set when all have arrived */
  constructor(onFiles: (set: PublicSet, files: Awaited<ReturnType<typeof fetchSet>>) => void) {
    this.#onFiles = onFiles;
    this.element = html(
      "section",
      { class: "section catalogue", "aria-labelledby": "catalogue-heading" },
      this.#progress.element,
      html("div", { class: "section-heading" }, html("h2", { id: "catalogue-heading" }, words.heading)),
      this.#list,
      this.#note,
      this.#again,
    );
    this.#again.hidden = true;
  }

  dispose(): void {
    this.#progress.cancel();
  }

  /** Loads the list, once. */
  show(): void {
    if (this.#loading) return;
    this.#again.hidden = true;
    this.#loading = this.#load().catch((error) => {
      this.#loading = undefined;
      this.#again.hidden = this.#entries.length > 0;
      setText(this.#note, errorText(error));
    });
  }

  async #load(): Promise<void> {
    const sets = await loadCatalogue();
    setText(this.#note, words.note);
    this.#entries = sets.map((set) => ({ set, kept: 0 }));
    this.#draw();
    this.#cache = await openCache();
    await forgetUnlisted(sets, this.#cache);
    for (const entry of this.#entries) entry.kept = await filesKept(entry.set, this.#cache);
    this.#draw();
  }

  #draw(): void {
    this.#list.replaceChildren(...this.#entries.map((entry) => this.#item(entry)));
  }

  #item(entry: Entry): HTMLElement {
    const { set, kept } = entry;
    const whole = kept === set.files.length;
    const word = whole ? words.use : kept > 0 ? words.resume : words.get;
    const get = button(word, () => void this.#get(entry), { label: true, class: "outlined" });
    get.setAttribute("aria-label", strings.data.saved.does(word, set.name));
    // The state of the cache is known a moment after the list.
    get.disabled = this.#busy || !this.#cache;
    const size = set.bytes > 0 ? megabytes(set.bytes) : words.files(set.files.length);
    const state = whole ? words.here : kept > 0 ? words.some(kept, set.files.length) : size;
    const buttons = [get];
    if (kept > 0) {
      const remove = button(strings.data.saved.delete, () => void this.#forget(entry), { icon: "remove" });
      remove.setAttribute("aria-label", strings.data.saved.does(strings.data.saved.delete, set.name));
      remove.disabled = this.#busy;
      buttons.unshift(remove);
    }
    return html(
      "li",
      {},
      html(
        "div",
        { class: "stored-words" },
        html("p", { class: "stored-name", title: set.about }, set.name),
        html("p", { class: "caption" }, words.state(set.licence.name, state)),
      ),
      ...buttons,
    );
  }

  async #get(entry: Entry): Promise<void> {
    const { set } = entry;
    const cache = this.#cache;
    if (this.#busy || !cache) return;
    if (entry.kept < set.files.length && !(await askToFetch(set))) return;
    setText(this.#note, "");
    this.#setBusy(true);
    try {
      const fetching = (options: CallOptions) => fetchSet(set, cache, options);
      this.#onFiles(set, await this.#progress.run(words.fetching(set.name), fetching));
      setText(this.#note, words.cite(set.citation));
    } catch (error) {
      if (!isCancellation(error)) setText(this.#note, errorText(error));
    }
    entry.kept = await filesKept(set, cache).catch(() => 0);
    this.#setBusy(false);
  }

  async #forget(entry: Entry): Promise<void> {
    if (!this.#cache) return;
    await forgetSet(entry.set, this.#cache);
    entry.kept = 0;
    this.#draw();
  }

  #setBusy(busy: boolean): void {
    this.#busy = busy;
    this.#draw();
  }
}
