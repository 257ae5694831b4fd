/** Copies a link to the displayed state, or offers it to be copied by hand. */
import type { InputLibrary } from "../../player/input_library";
import { button } from "../../ui/controls/buttons";
import { html } from "../../ui/dom";
import type { AppState } from "../state/state";
import { strings } from "../strings/strings";
import type { Toasts } from "../ui/toasts";
import { linkTo } from "./links";

/**
 * Shares the state. It must be called in the event of the click: later the browser does not allow copying.
 * @param saveProject saves a state that is too large for a link
 */
export async function shareLink(
  state: AppState,
  library: InputLibrary,
  toasts: Toasts,
  saveProject: () => void,
): Promise<void> {
  const link = linkTo(state, library, location.href);
  try {
    await copy(link.then(({ href }) => href));
  } catch {
    offer((await link).href);
    return;
  }
  const { carried } = await link;
  const words = strings.page.links;
  if (carried === false) toasts.offer(words.copiedWithoutMotion, words.saveProject, saveProject);
  else toasts.note(carried ? words.copiedWithMotion : words.copied);
}

/** Safari copies only what is passed in the event itself: a promise of the text, not the text later. */
async function copy(text: Promise<string>): Promise<void> {
  if (typeof ClipboardItem === "undefined") return navigator.clipboard.writeText(await text);
  const blob = text.then((plain) => new Blob([plain], { type: "text/plain" }));
  await navigator.clipboard.write([new ClipboardItem({ "text/plain": blob })]);
}

/** Shows a link in a dialog, selected. */
function offer(href: string): void {
  const field = html("input", {
    type: "text",
    class: "text",
    readonly: true,
    value: href,
    "aria-label": strings.page.links.link,
  });
  const dialog = html(
    "dialog",
    { class: "help link-dialog", "aria-labelledby": "link-heading" },
    html("p", { id: "link-heading" }, strings.page.links.copyThis),
    field,
    button(strings.play.help.close, () => dialog.close(), { label: true, class: "outlined" }),
  );
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
  field.select();
}
