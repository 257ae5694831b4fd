/** The dialog with the code to embed one figure of a lesson in another page. */
import type { LearnText } from "../../../lessons/text/text";
import { button, Segment } from "../../../ui/controls/buttons";
import { icon } from "../../../ui/controls/icons";
import { html } from "../../../ui/dom";
import { askInDialog, dialogActions } from "../../ui/dialog";
import { type EmbeddedFigure, figureElementCode, figureFrameCode } from "./figure_code";

/** Shows the code of one of several figures until the dialog is closed. */
export async function showFigureCode(figures: readonly EmbeddedFigure[], learn: LearnText): Promise<void> {
  let [codeOf, chosen] = [figureFrameCode, figures[0]!];
  const code = html("textarea", { class: "text code", readonly: true, rows: 5, "aria-label": learn.code });
  const said = html("p", { class: "caption", role: "status" });
  const show = () => {
    code.value = codeOf(chosen);
    said.textContent = "";
  };
  const choice = html("select", { "aria-label": learn.figure });
  for (const [i, { heading }] of figures.entries()) choice.append(html("option", { value: String(i) }, heading));
  choice.addEventListener("change", () => {
    chosen = figures[Number(choice.value)]!;
    show();
  });
  const as = new Segment(
    learn.embed,
    [
      { value: "frame", label: learn.frame },
      { value: "element", label: learn.element },
    ],
    (value) => {
      codeOf = value === "frame" ? figureFrameCode : figureElementCode;
      as.value = value;
      show();
    },
  );
  as.value = "frame";
  const copy = async () => {
    code.select();
    said.textContent = await navigator.clipboard.writeText(code.value).then(
      () => learn.codeCopied,
      () => learn.copyByHand,
    );
  };
  show();
  await askInDialog<never>("learn-embed", learn.embed, (_, close) => [
    html(
      "div",
      { class: "learn-embed-choices" },
      html("div", { class: "select" }, choice, icon("chevron")),
      as.element,
    ),
    code,
    said,
    dialogActions(
      button(learn.close, close, { label: true }),
      button(learn.copy, () => void copy(), { label: true, class: "outlined" }),
    ),
  ]);
}
