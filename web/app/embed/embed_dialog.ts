/** The dialog that makes the code to embed this figure in another page, with a live preview. */
import "./embed_dialog.css";
import { button, Segment, Toggle } from "../../ui/controls/buttons";
import { icon } from "../../ui/controls/icons";
import { html } from "../../ui/dom";
import { strings } from "../strings/strings";
import { type EmbedChoice, type Embedded, elementCode, frameAddress, frameCode } from "./embed_code";

const words = strings.embed;

const SIZES: Readonly<Record<keyof typeof words.sizes, EmbedChoice["size"]>> = {
  article: { width: 688, height: 342 },
  wide: { width: 960, height: 582 },
  small: { width: 360, height: 438 },
};
type SizeName = keyof typeof SIZES;

/** Kind of code. */
type Kind = "frame" | "element" | "link";

interface EmbedRequest {
  embedded: Embedded;
  /** URL of the playground with the same state. */
  link: string;
  ghost: EmbedChoice["ghost"];
  /** Parts of the state that the code cannot contain, as sentences. */
  notes: readonly string[];
  onPoster: () => void;
  onClose: () => void;
}

/** Shows the dialog until it is closed. */
export function openEmbedDialog({ embedded, link, ghost, notes, onPoster, onClose }: EmbedRequest): void {
  let choice: EmbedChoice = { size: SIZES.article, controls: true, autoplay: true, theme: "auto", ghost };
  let kind: Kind = "frame";
  const stage = html("div", { class: "embed-preview" });
  const preview = html("iframe", { title: words.preview });
  const code = html("textarea", { class: "text code", readonly: true, rows: 4, "aria-label": words.code });
  const said = html("p", { class: "caption", role: "status" });
  // At its actual size, and scaled if that is wider than the dialog.
  const scaleToFit = () => {
    const { width, height } = choice.size;
    const scale = Math.min(1, stage.clientWidth / width || 1);
    preview.style.cssText = `width:${width}px;height:${height}px;transform:scale(${scale})`;
    stage.style.height = `${height * scale}px`;
  };
  const show = () => {
    const address = frameAddress(embedded, choice);
    if (preview.getAttribute("src") !== address) preview.src = address;
    scaleToFit();
    code.value =
      kind === "frame" ? frameCode(embedded, choice) : kind === "element" ? elementCode(embedded, choice) : link;
    said.textContent = "";
  };
  const change = (changed: Partial<EmbedChoice>) => {
    choice = { ...choice, ...changed };
    show();
  };
  const copy = async () => {
    code.select();
    const copied = await navigator.clipboard.writeText(code.value).then(
      () => true,
      () => false,
    );
    said.textContent = copied ? words.copied : words.copyByHand;
  };

  const size = html("select", { "aria-label": words.size });
  for (const [name, label] of Object.entries(words.sizes)) size.append(html("option", { value: name }, label));
  size.addEventListener("change", () => change({ size: SIZES[size.value as SizeName] }));
  const controls = new Toggle(words.controls, (on) => {
    controls.on = on;
    change({ controls: on });
  });
  controls.on = choice.controls;
  const autoplay = new Toggle(words.autoplay, (on) => {
    autoplay.on = on;
    change({ autoplay: on });
  });
  autoplay.on = choice.autoplay;
  const ghosts = segment(words.ghost, ["beside", "overlay", "off"], (value) => change({ ghost: value }));
  ghosts.value = choice.ghost;
  const themes = segment(words.theme, ["auto", "light", "dark"], (value) => change({ theme: value }));
  themes.value = choice.theme;
  const kinds = segment(words.as, ["frame", "element", "link"], (value) => {
    kind = value;
    show();
  });
  kinds.value = kind;

  const row = (name: string, control: Node) =>
    html("div", { class: "row" }, html("span", { class: "label", "aria-hidden": "true" }, name), control);
  const close = button(words.close, () => dialog.close(), { icon: "close", class: "plain" });
  const dialog = html(
    "dialog",
    { class: "help embed", closedby: "any", "aria-labelledby": "embed-heading" },
    html("div", { class: "embed-heading" }, html("h2", { id: "embed-heading" }, words.heading), close),
    stage,
    html(
      "div",
      { class: "embed-choices" },
      row(words.size, html("div", { class: "select" }, size, icon("chevron"))),
      row(words.theme.name, themes.element),
      row(words.ghost.name, ghosts.element),
      html("div", { class: "row toggles" }, controls.element, autoplay.element),
      row(words.as.name, kinds.element),
    ),
    code,
    ...notes.map((note) => html("p", { class: "caption" }, note)),
    html(
      "div",
      { class: "embed-actions" },
      said,
      button(words.poster, onPoster, { label: true }),
      button(words.copy, () => void copy(), { label: true, class: "outlined" }),
    ),
  );
  stage.append(preview);
  dialog.addEventListener("close", () => {
    dialog.remove();
    onClose();
  });
  document.body.append(dialog);
  dialog.showModal();
  show();
}

function segment<T extends string>(
  labels: Readonly<Record<T | "name", string>>,
  values: readonly T[],
  onChange: (value: T) => void,
): Segment<T> {
  return new Segment(
    labels.name,
    values.map((value) => ({ value, label: labels[value] })),
    onChange,
  );
}
