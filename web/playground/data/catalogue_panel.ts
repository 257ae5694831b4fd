/** Public data sets: what there is, its licence, and the way to get it. */
import type { CallOptions } from "../../worker/protocol";
import { button } from "../controls/buttons";
import { html, setText } from "../dom";
import { ProgressLine } from "../progress";
import { counted, errorText, isCancellation, megabytes } from "../words";
import { type FileCache, fetchSet, filesKept, forgetSet, loadCatalogue, openCache, type PublicSet } from "./catalogue";

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
      html("div", { class: "section-heading" }, html("h2", { id: "catalogue-heading" }, "Public data sets")),
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
    setText(this.#note, "Others made these. Each has a licence of its own, which is shown before anything is fetched.");
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
    const word = whole ? "Use" : kept > 0 ? "Go on" : "Get";
    const get = button(word, () => void this.#get(entry), { label: true, class: "outlined" });
    get.setAttribute("aria-label", `${word} ${set.name}`);
    get.disabled = this.#busy;
    const size = set.bytes > 0 ? megabytes(set.bytes) : counted(set.files.length, "file");
    const state = whole ? "on this device" : kept > 0 ? `${kept} of ${counted(set.files.length, "file")}` : size;
    const buttons = [get];
    if (kept > 0) {
      const remove = button("Delete", () => void this.#forget(entry), { icon: "remove" });
      remove.setAttribute("aria-label", `Delete ${set.name}`);
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
        html("p", { class: "caption" }, `${set.licence.name} · ${state}`),
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
      this.#onFiles(set, await this.#progress.run(`Fetching ${set.name}.`, fetching));
      setText(this.#note, `Cite it as: ${set.citation}.`);
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
    const size = bytes > 0 ? `, ${megabytes(bytes)}` : "";
    const dialog = html(
      "dialog",
      { class: "help licence", "aria-labelledby": "licence-heading" },
      html("h2", { id: "licence-heading" }, name),
      html("p", {}, `${about.charAt(0).toUpperCase()}${about.slice(1)}.`),
      html("p", {}, "Licence: ", link(licence.url, licence.name), `. ${licence.note}`),
      html("p", { class: "caption" }, `Cite it as: ${citation}. `, link(page, "More about it")),
      html("p", { class: "caption" }, `It is fetched from ${new URL(base, location.href).host}${size}, and kept here.`),
      html(
        "div",
        { class: "dialog-actions" },
        button("Cancel", () => dialog.close(), { label: true }),
        button("Download", get, { label: true, class: "outlined" }),
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
