/** Chooses the training motions: a built-in set, clips of the open database, or dropped files. */
import type { KeyStyleClip } from "../../../client/build/protocol";
import { button } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { formatNumber, html } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import { askInDialog, dialogActions } from "../../ui/dialog";
import { capitalised, spoken } from "../../ui/words";
import { BUILT_IN_SETS, parseSet } from "./sets";

const CLIPS = "…";

export interface SetModel {
  set: string;
  /** Name and actions of the open database, if it is not the built-in one. */
  open: { name: string; actions: readonly string[] } | undefined;
  /** Number of dropped files. */
  files: number;
  /** Available clips of the set, and those on which the model is trained. */
  clips: readonly KeyStyleClip[];
  trainedOn: readonly string[];
  /** Whether the user selected the clips. */
  chosen: boolean;
}

export class SetChooser {
  readonly element: HTMLElement;
  readonly #onSet: (set: string) => void;
  readonly #onClips: (clips: string[]) => void;
  readonly #select = html("select", { "aria-label": strings.keyStyle.set });
  #model: SetModel | undefined;

  constructor(onSet: (set: string) => void, onClips: (clips: string[]) => void) {
    this.#onSet = onSet;
    this.#onClips = onClips;
    this.element = html("div", { class: "select set-select" }, this.#select, icon("chevron"));
    this.#select.addEventListener("change", () => {
      const { value } = this.#select;
      if (value === CLIPS) {
        this.#select.value = this.#model?.set ?? "";
        void this.#chooseClips();
      } else this.#onSet(value);
    });
  }

  show(model: SetModel): void {
    // An open list is not changed.
    const same = JSON.stringify(model) === JSON.stringify(this.#model);
    this.#model = model;
    if (same) return;
    const { set, open, files, trainedOn, chosen } = model;
    const option = (value: string, words: string) =>
      html(
        "option",
        { value },
        value === set && chosen ? `${words}, ${strings.keyStyle.chosenClips(trainedOn.length)}` : words,
      );
    const group = (label: string, ...options: HTMLOptionElement[]) => html("optgroup", { label }, ...options);
    const builtIn = BUILT_IN_SETS.map((name) => option(name, strings.keyStyle.sets[name]));
    const { source, action } = parseSet(set);
    // Another action of the built-in database, from a link.
    if (source === "built-in" && !BUILT_IN_SETS.some((name) => name === action))
      builtIn.push(option(set, capitalised(spoken(action))));
    const opened = open?.actions.map((name) => option(`open/${name}`, capitalised(spoken(name)))) ?? [];
    this.#select.replaceChildren(
      group(strings.keyStyle.builtIn, ...builtIn),
      ...(open ? [group(open.name || strings.keyStyle.openDatabase, ...opened)] : []),
      ...(files > 0 ? [option("files", `${strings.keyStyle.openFiles}, ${strings.keyStyle.chosenClips(files)}`)] : []),
      option(CLIPS, strings.keyStyle.chooseClips),
    );
    this.#select.value = set;
  }

  async #chooseClips(): Promise<void> {
    const model = this.#model;
    if (!model) return;
    const boxes = model.clips.map((clip) => {
      const box = html("input", { type: "checkbox", value: clip.name });
      box.checked = model.trainedOn.includes(clip.name);
      const secs = html("span", { class: "caption" }, strings.keyStyle.clipSecs(formatNumber(clip.secs, 1)));
      return { box, row: html("label", { class: "dialog-clip" }, box, html("span", {}, spoken(clip.name)), secs) };
    });
    const asked = askInDialog<string[]>("clip-dialog", strings.keyStyle.clips, (choose, cancel) => {
      const chosen = () => boxes.flatMap(({ box }) => (box.checked ? [box.value] : []));
      const take = button(strings.keyStyle.take, () => choose(chosen()), { label: true, class: "outlined" });
      const list = html("div", { class: "dialog-clips" }, ...boxes.map(({ row }) => row));
      list.addEventListener("change", () => {
        take.disabled = chosen().length === 0;
      });
      take.disabled = chosen().length === 0;
      return [
        html("p", { class: "caption" }, strings.keyStyle.clipsWhy),
        list,
        dialogActions(button(strings.keyStyle.cancel, cancel, { label: true }), take),
      ];
    });
    boxes.find(({ box }) => box.checked)?.row.scrollIntoView({ block: "center" });
    const clips = await asked;
    if (clips) this.#onClips(clips);
  }
}
