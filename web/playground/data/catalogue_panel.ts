/** Public data sets: what there is, its licence, and the way to get it. */
import type { CallOptions } from "../../worker/protocol";
import { button } from "../controls/buttons";
import { html, setText } from "../dom";
import { megabytes } from "../numerals";
import { ProgressLine } from "../progress";
import { strings } from "../strings/strings";
import { capitalised, errorText, isCancellation } from "../words";
import { type FileCache, fetchSet, filesKept, forgetSet, loadCatalogue, openCache, type PublicSet } from "./catalogue";

const words = strings.data.sets;

/** What the browser has of a set. */
interface Entry {
  set: PublicSet;
  kept: number;
}

export class CataloguePanel {
  readonly element: HTMLElement;
  readonly #progress = new ProgressLine();
  readonly #list = html("ul", { class: "shelf" });
  readonly #note = html("p", { class: "caption", role: "status" });
  readonly #onFiles: (set: PublicSet, files: Awaited<ReturnType<typeof fetchSet>>) => void;
  #entries: Entry[] = [];
  #cache: FileCache | undefined;
  #loading: Promise<void> | undefined;
  #busy = false;

  /** @param onFiles takes a set that is there */
  constructor(onFiles: (set: PublicSet, files: Awaited<ReturnType<typeof fetchSet>>) => void) {
    this.#onFiles = onFiles;
    this.element = html(
      "section",
      { class: "section catalogue", "aria-labelledby": "catalogue-heading" },
      this.#progress.element,
      html("div", { class: "section-heading" }, html("h2", { id: "catalogue-heading" }, words.heading)),
      this.#list,
      this.#note,
    );
  }

  /** Loads the list, once. */
  show(): void {
    this.#loading ??= this.#load().catch((error) => {
      this.#loading = undefined;
      setText(this.#note, errorText(error));
    });
  }

  async #load(): Promise<void> {
    const sets = await loadCatalogue();
    setText(this.#note, words.note);
    this.#entries = sets.map((set) => ({ set, kept: 0 }));
    this.#draw();
    this.#cache = await openCache();
    for (const entry of this.#entries) entry.kept = await filesKept(entry.set, this.#cache);
    this.#draw();
  }

  #draw(): void {
    this.#list.replaceChildren(...this.#entries.map((entry) => this.#item(entry)));
  }

  #item(entry: Entry): HTMLElement {
    const { set, kept } = entry;
    const whole = kept === set.files.length;
    const word = whole ? words.use : kept > 0 ? words.goOn : words.get;
    const get = button(word, () => void this.#get(entry), { label: true, class: "outlined" });
    get.setAttribute("aria-label", strings.data.shelf.does(word, set.name));
    get.disabled = this.#busy;
    const size = set.bytes > 0 ? megabytes(set.bytes) : words.files(set.files.length);
    const state = whole ? words.here : kept > 0 ? words.some(kept, set.files.length) : size;
    const buttons = [get];
    if (kept > 0) {
      const remove = button(strings.data.shelf.delete, () => void this.#forget(entry), { icon: "remove" });
      remove.setAttribute("aria-label", strings.data.shelf.does(strings.data.shelf.delete, set.name));
      remove.disabled = this.#busy;
      buttons.unshift(remove);
    }
    return html(
      "li",
      {},
      html(
        "div",
        { class: "shelf-words" },
        html("p", { class: "shelf-name", title: set.about }, set.name),
        html("p", { class: "caption" }, words.state(set.licence.name, state)),
      ),
      ...buttons,
    );
  }

  async #get(entry: Entry): Promise<void> {
    const { set } = entry;
    const cache = this.#cache;
    if (this.#busy || !cache) return;
    if (entry.kept < set.files.length && !(await agrees(set))) return;
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

/** Shows the licence; whether the set is to be fetched. */
function agrees({ name, about, licence, citation, page, bytes, base }: PublicSet): Promise<boolean> {
  return new Promise((resolve) => {
    let agreed = false;
    const get = () => {
      agreed = true;
      dialog.close();
    };
    const link = (href: string, text: string) => html("a", { href, target: "_blank", rel: "noreferrer" }, text);
    const { host } = new URL(base, location.href);
    const dialog = html(
      "dialog",
      { class: "help licence", "aria-labelledby": "licence-heading" },
      html("h2", { id: "licence-heading" }, name),
      html("p", {}, words.about(capitalised(about))),
      html("p", {}, words.licence, link(licence.url, licence.name), words.licenceNote(licence.note)),
      html("p", { class: "caption" }, `${words.cite(citation)} `, link(page, words.more)),
      html("p", { class: "caption" }, bytes > 0 ? words.fromSized(host, megabytes(bytes)) : words.from(host)),
      html(
        "div",
        { class: "dialog-actions" },
        button(strings.data.cancel, () => dialog.close(), { label: true }),
        button(words.download, get, { label: true, class: "outlined" }),
      ),
    );
    dialog.addEventListener("close", () => {
      dialog.remove();
      resolve(agreed);
    });
    document.body.append(dialog);
    dialog.showModal();
  });
}
