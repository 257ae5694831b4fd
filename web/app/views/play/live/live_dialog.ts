/** Asks for the address of a live performer, before any connection is made. */
import { addressOf, STREAM_FORMATS, type StreamFormat } from "../../../../streams/web_socket_poses";
import { button } from "../../../../ui/controls/buttons";
import { icon } from "../../../../ui/controls/icons";
import { html, setText } from "../../../../ui/dom";
import { askInDialog, dialogActions } from "../../../ui/dialog";
import type { LiveAddress } from "./live_name";
import { liveWords } from "./strings.en";

const words = liveWords.dialog;

/** The chosen sender; `undefined` if the user cancels. */
export function askForSource(usual: LiveAddress): Promise<LiveAddress | undefined> {
  const url = html("input", {
    type: "text",
    class: "text",
    inputmode: "url",
    spellcheck: "false",
    autocomplete: "off",
    "aria-label": words.address,
  });
  const format = html(
    "select",
    { "aria-label": words.format },
    ...STREAM_FORMATS.map((value) => html("option", { value }, words.formats[value])),
  );
  const fault = html("p", { class: "caption live-fault", role: "status" });
  const asked = askInDialog<LiveAddress>("live-source", words.heading, (choose, cancel) => {
    const connect = button(words.connect, () => form.requestSubmit(), { label: true, class: "outlined" });
    const row = (name: string, control: HTMLElement) =>
      html("div", { class: "live-row" }, html("span", { "aria-hidden": "true" }, name), control);
    const form = html(
      "form",
      { method: "dialog" },
      row(words.address, url),
      row(words.format, html("div", { class: "select outlined" }, format, icon("chevron"))),
      fault,
      dialogActions(button(words.cancel, cancel, { label: true }), connect),
    );
    const check = () => {
      const why = refusalOf(url.value.trim());
      setText(fault, why);
      connect.disabled = why !== "";
    };
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      if (!connect.disabled) choose({ url: url.value.trim(), format: format.value as StreamFormat });
    });
    url.addEventListener("input", check);
    [url.value, format.value] = [usual.url, usual.format];
    check();
    return [html("p", { class: "live-why" }, words.why), form];
  });
  url.select();
  return asked;
}

/** Why an address is refused; empty if it is valid. */
function refusalOf(url: string): string {
  try {
    addressOf(url);
    return "";
  } catch (thrown) {
    const { message, hint } = thrown as { message: string; hint: string };
    return `${message} ${hint}`;
  }
}
