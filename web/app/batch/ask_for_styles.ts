/** Asks in which styles motions are to be made. */
import { button } from "../../ui/controls/buttons";
import { html, setText } from "../../ui/dom";
import { askInDialog, dialogActions } from "../ui/dialog";
import { manner, spoken } from "../ui/words";
import type { BatchPlace } from "./batch_card";
import { batchWords as words } from "./strings.en";
import { presentVariant, singleVariants, type Variant } from "./variants";

/** The styles that the user chooses for `count` motions; `undefined` if the user cancels. */
export async function askForStyles(count: number, { store, session }: BatchPlace): Promise<Variant[] | undefined> {
  const database = session.database ?? (await opened(session));
  const { neutral, styles } = database;
  const { state } = store;
  const present = radio("styles", "present", true);
  const single = radio("styles", "single", false);
  const boxes = styles.map((style) => {
    const box = html("input", { type: "checkbox", checked: style !== neutral });
    return { style, box, label: html("label", { class: "batch-style" }, box, spoken(style)) };
  });
  const result = html("p", { class: "caption", role: "status" });
  const variants = (): Variant[] => {
    if (present.checked) return [presentVariant(state, neutral)];
    const chosen = boxes.filter(({ box }) => box.checked).map(({ style }) => style);
    return singleVariants(state, neutral, chosen);
  };
  return askInDialog<Variant[]>("restyle", words.setup(count), (choose, cancel) => {
    const start = button(words.start, () => form.requestSubmit(), { label: true, class: "outlined" });
    const form = html(
      "form",
      { method: "dialog" },
      html(
        "fieldset",
        {},
        html("legend", { class: "visually-hidden" }, words.styles),
        html(
          "label",
          { class: "batch-choice" },
          present,
          words.present(manner(state.styles, state.intensity, neutral)),
        ),
        html("label", { class: "batch-choice" }, single, words.single),
        html("div", { class: "batch-styles" }, ...boxes.map(({ label }) => label)),
      ),
      result,
      dialogActions(button(words.cancel, cancel, { label: true }), start),
    );
    const check = () => {
      const folders = variants().length;
      start.disabled = folders === 0;
      setText(result, folders === 0 ? words.none : words.result(folders * count, folders));
    };
    for (const { box } of boxes)
      box.addEventListener("change", () => {
        single.checked = true;
        check();
      });
    for (const choice of [present, single]) choice.addEventListener("change", check);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      if (!start.disabled) choose(variants());
    });
    check();
    return [form];
  });
}

const radio = (name: string, value: string, checked: boolean): HTMLInputElement =>
  html("input", { type: "radio", name, value, checked });

/** The database, as soon as one is open. */
function opened(session: BatchPlace["session"]): Promise<NonNullable<BatchPlace["session"]["database"]>> {
  return new Promise((resolve) => {
    const once = new AbortController();
    session.listen(
      {
        onDatabase: (database) => {
          once.abort();
          resolve(database);
        },
      },
      once.signal,
    );
  });
}
