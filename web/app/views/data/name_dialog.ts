/** Asks for the name of a new style and the action of its clip. */

import { button } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { formatNumber, html, setText } from "../../../ui/dom";
import { strings } from "../../strings/strings";
import { askInDialog, dialogActions } from "../../ui/dialog";
import { spoken } from "../../ui/words";
import type { ClipStyle } from "./style_of_clip";

const words = strings.data.style;

/** Longest name of a style, characters. */
const LONGEST = 40;
/** The engine refuses shorter clips, seconds. */
const SHORTEST = 1;
/** Shorter clips, seconds, contain about one cycle of a walk, which may also fit a part of another action. */
const BRIEF = 2;

/** Data known before the user answers. */
interface StyleQuestion {
  /** The suggested name and action. */
  suggested: ClipStyle;
  /** Names of other styles. */
  taken: readonly string[];
  /** Actions of the database. */
  actions: readonly string[];
  /** Duration of the clip; `undefined` if it is not known. */
  seconds: number | undefined;
}

/** Asks for the style of a clip; `undefined` if the user cancels. */
export function askForStyle({ suggested, taken, actions, seconds }: StyleQuestion): Promise<ClipStyle | undefined> {
  const input = html("input", { type: "text", class: "text", "aria-label": words.name, maxlength: LONGEST });
  const action = html(
    "select",
    { "aria-label": words.action },
    html("option", { value: "" }, words.found),
    ...actions.map((name) => html("option", { value: name }, spoken(name))),
  );
  action.value = suggested.action ?? "";
  const fault = html("p", { class: "caption", role: "status" });
  const length = html("p", { class: "caption", hidden: lengthText(seconds) === "" }, lengthText(seconds));
  const field = (label: string, control: HTMLElement) =>
    html("label", { class: "style-field" }, html("span", { class: "label", "aria-hidden": "true" }, label), control);
  const asked = askInDialog<ClipStyle>("style-name", words.heading, (choose, cancel) => {
    const make = button(words.make, () => form.requestSubmit(), { label: true, class: "outlined" });
    const form = html(
      "form",
      { method: "dialog" },
      field(words.nameLabel, input),
      field(words.actionLabel, html("span", { class: "select outlined" }, action, icon("chevron"))),
      length,
      fault,
      dialogActions(button(strings.data.cancel, cancel, { label: true }), make),
    );
    const check = () => {
      const name = input.value.trim();
      setText(fault, taken.includes(name) ? words.taken(name) : "");
      make.disabled = name === "" || taken.includes(name);
    };
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      if (!make.disabled) choose({ style: input.value.trim(), action: action.value || undefined });
    });
    input.addEventListener("input", check);
    input.value = suggested.style;
    check();
    return [form];
  });
  input.select();
  return asked;
}

/** A note about a clip that is too short, or nearly. */
function lengthText(seconds: number | undefined): string {
  if (seconds === undefined || seconds >= BRIEF) return "";
  const secs = formatNumber(seconds, 1);
  return seconds < SHORTEST ? words.tooShort(secs) : words.brief(secs);
}
