/** Offers single clips of the public data sets, with their licences, as inputs of Play. */
import "./recorded_dialog.css";
import { isCancellation } from "../../../../client/protocol";
import { button } from "../../../../ui/controls/buttons";
import { icon } from "../../../../ui/controls/icons";
import { html, setText } from "../../../../ui/dom";
import { megabytes } from "../../../strings/numerals";
import { strings } from "../../../strings/strings";
import { askInDialog, dialogActions } from "../../../ui/dialog";
import { ProgressLine } from "../../../ui/progress";
import { capitalised, errorText, spoken } from "../../../ui/words";
import { loadCatalogue, type PublicSet } from "../catalogue";
import { fetchSet, openCache } from "../set_download";
import { clipsOf, firstClip, type LabelledClip } from "./set_labels";
import { recordedWords as words } from "./strings.en";

/** A downloaded clip, and how its set is to be cited; or the wish to get a whole set in Data. */
type Recorded = { file: File; citation: string } | "data";

/** Shows the sets until a clip has been downloaded; `undefined` if the user wants none. */
export async function askForRecorded(): Promise<Recorded | undefined> {
  const progress = new ProgressLine();
  const chosen = await askInDialog<Recorded>("recorded", words.heading, (choose, cancel) => {
    const list = new RecordedList(progress, choose);
    void list.load();
    const close = button(words.close, cancel, { label: true });
    return [html("p", { class: "caption" }, words.what), list.element, dialogActions(close)];
  });
  progress.cancel();
  return chosen;
}

class RecordedList {
  readonly element: HTMLElement;
  readonly #progress: ProgressLine;
  readonly #choose: (recorded: Recorded) => void;
  readonly #sets = html("ul", { class: "recorded-sets" });
  readonly #status = html("p", { class: "recorded-status", role: "status" });
  readonly #again = button(strings.page.tryAgain, () => void this.load(), { label: true, class: "outlined" });

  constructor(progress: ProgressLine, choose: (recorded: Recorded) => void) {
    this.#progress = progress;
    this.#choose = choose;
    this.#again.hidden = true;
    const place = html("div", { class: "recorded-progress" }, progress.element);
    this.element = html("div", {}, this.#sets, place, this.#status, this.#again);
  }

  /** Loads the list of the sets. */
  async load(): Promise<void> {
    setText(this.#status, "");
    this.#again.hidden = true;
    try {
      const sets = await loadCatalogue();
      this.#sets.replaceChildren(...sets.map((set) => this.#item(set)));
      if (!navigator.onLine) setText(this.#status, words.offline);
    } catch (error) {
      setText(this.#status, navigator.onLine ? errorText(error) : words.offline);
      this.#again.hidden = false;
    }
  }

  #item(set: PublicSet): HTMLElement {
    const { name, about, licence } = set;
    const link = html("a", { href: licence.url, target: "_blank", rel: "noreferrer" }, licence.name);
    return html(
      "li",
      {},
      html("p", { class: "recorded-name" }, name),
      html("p", { class: "caption" }, `${capitalised(about)}.`),
      html("p", { class: "recorded-licence" }, link, `. ${licence.note}`),
      this.#choice(set),
    );
  }

  /** The choice of a clip and the button that downloads it; for an archive, the way to Data. */
  #choice(set: PublicSet): HTMLElement {
    const clips = clipsOf(set);
    if (clips.length === 0) {
      const open = button(words.inData, () => this.#choose("data"), { label: true, class: "outlined" });
      open.setAttribute("aria-label", words.does(words.inData, set.name));
      return html("div", { class: "recorded-choice" }, html("span", {}, words.archive(megabytes(set.bytes))), open);
    }
    const select = html("select", { "aria-label": words.clipOf(set.name) }, ...optionsOf(clips));
    select.value = firstClip(clips)!.file.path;
    const get = button(words.get, () => void this.#get(set, clips[select.selectedIndex]!), {
      label: true,
      class: "outlined",
    });
    get.setAttribute("aria-label", words.does(words.get, set.name));
    return html(
      "div",
      { class: "recorded-choice" },
      html("div", { class: "select outlined" }, select, icon("chevron")),
      get,
    );
  }

  async #get(set: PublicSet, { file }: LabelledClip): Promise<void> {
    setText(this.#status, "");
    const label = words.fetching(file.path.split("/").at(-1)!);
    try {
      const [clip] = await this.#progress.run(label, async ({ signal, onProgress }) =>
        fetchSet({ ...set, files: [file], bytes: 0 }, await openCache(), {
          ...(signal && { signal }),
          onProgress: ({ fraction }) => onProgress?.({ label, fraction }),
        }),
      );
      if (clip) this.#choose({ file: clip.file, citation: set.citation });
    } catch (error) {
      if (!isCancellation(error)) setText(this.#status, errorText(error));
    }
  }
}

/** Options in the order of the clips, grouped by action. */
function optionsOf(clips: readonly LabelledClip[]): HTMLElement[] {
  const groups: { action: string; element: HTMLElement }[] = [];
  for (const { file, action, style, take } of clips) {
    const title = style ? words.clip(spoken(action), spoken(style), Number(take)) : file.path;
    const option = html("option", { value: file.path }, title);
    const group = groups.at(-1);
    if (group?.action === action) group.element.append(option);
    else groups.push({ action, element: html("optgroup", { label: spoken(action) || words.clips }, option) });
  }
  return groups.map(({ element }) => element);
}
