/** Saves the current state as a project file. Loaded on first use. */
import "./project.css";
import { isCancellation } from "../../client/protocol";
import type { DroppedInput } from "../../player/input_library";
import { button } from "../../ui/controls/buttons";
import { html, saveFile } from "../../ui/dom";
import { toHash } from "../state/state";
import { askInDialog, dialogActions } from "../ui/dialog";
import { exportName } from "../ui/words";
import type { ProjectPlace } from "./place";
import { type Project, sha256Of, writeProject } from "./project_file";
import { projectWords as words } from "./strings.en";

/** The user's settings of saving a project. */
interface Wish {
  name: string;
  /** Whether the character's file is included. */
  inside: boolean;
  by: "download" | "share";
}

/** Asks for the name and the contents of a project, and saves or shares it. */
export async function saveProject(place: ProjectPlace): Promise<void> {
  const { toasts, progress } = place;
  const wish = await askHow(place);
  if (!wish) return;
  try {
    const file = await progress.run(words.saving, async (call) => {
      const blob = await writeProject(await projectOf(place, wish.inside), call);
      return new File([blob], `${wish.name}.strut`, { type: blob.type });
    });
    if (wish.by === "share" && (await shared(file))) return;
    saveFile(file.name, file);
    const saved = words.saved(file.name, words.size(file.size));
    toasts.note(wish.by === "share" ? `${words.notShared} ${saved}` : saved);
  } catch (thrown) {
    if (!isCancellation(thrown)) toasts.failure(thrown);
  }
}

/** The dropped motions. */
function inputsOf({ session: { library } }: ProjectPlace): DroppedInput[] {
  return library.dropped.map((name) => library.file(name)!);
}

/** The current state as a project. */
async function projectOf(place: ProjectPlace, inside: boolean): Promise<Project> {
  const { store, databases, characters, session } = place;
  const { name, file } = databases.file;
  const { file: character, roles } = characters;
  return {
    // The theme is not part of the work; a playing motion starts at its beginning.
    state: toHash({
      ...store.state,
      theme: "auto",
      input: session.chosen === session.library.first ? "" : session.chosen,
    }),
    inputs: inputsOf(place),
    ...(file && { database: { name: name.replace(/\.strutdb$/i, ""), file } }),
    ...(character && {
      character: {
        name: character.name,
        size: character.size,
        sha256: await sha256Of(character),
        ...(roles && { roles }),
        ...(inside && { file: character }),
      },
    }),
  };
}

/** Shares the file with another app. Returns whether that is settled, also if the user cancelled. */
async function shared(file: File): Promise<boolean> {
  try {
    await navigator.share({ files: [file], title: file.name });
    return true;
  } catch (thrown) {
    return isCancellation(thrown);
  }
}

/** Whether the browser can share such files. */
function canShare(): boolean {
  try {
    return navigator.canShare?.({ files: [new File([""], "project.strut")] }) ?? false;
  } catch {
    return false;
  }
}

/** The dialog: name, contents of the file, and whether to save or share it. */
function askHow(place: ProjectPlace): Promise<Wish | undefined> {
  const { store, session, databases, characters } = place;
  const inputs = inputsOf(place);
  const { name: database, file } = databases.file;
  const character = characters.file;
  const guess = exportName(session.chosen, store.state.styles, "strut").replace(/\.strut$/, "");
  const name = html("input", { type: "text", class: "text", maxlength: 100, value: guess, id: "project-name" });
  const inside = html("input", { type: "checkbox", checked: characters.mayHandOn });
  const asked = askInDialog<Wish>("project", words.heading, (choose, cancel) => {
    const wish = (by: Wish["by"]) => choose({ name: fileName(name.value) || guess, inside: inside.checked, by });
    const save = button(words.save, () => form.requestSubmit(), { label: true, class: "outlined primary" });
    const share = button(words.share, () => wish("share"), { label: true, class: "outlined" });
    const form = html(
      "form",
      { method: "dialog" },
      html("label", { class: "caption", for: name.id }, words.name),
      html("div", { class: "project-name" }, name, html("span", { class: "caption" }, ".strut")),
      html("h3", {}, words.inside),
      html(
        "ul",
        { class: "project-content" },
        item(words.settings),
        ...(inputs.length > 0 ? [item(words.motions(inputs.length), sizeOf(inputs))] : []),
        file ? item(words.database(database.replace(/\.strutdb$/i, "")), file.size) : item(words.builtIn),
        ...(character ? [item(words.character(character.name), character.size)] : []),
      ),
      ...(character
        ? [
            html("label", { class: "project-inside" }, inside, words.characterInside),
            html("p", { class: "caption" }, characters.mayHandOn ? words.characterLeft : words.characterLicence),
          ]
        : []),
      dialogActions(button(words.cancel, cancel, { label: true }), ...(canShare() ? [share] : []), save),
    );
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      wish("download");
    });
    return [form];
  });
  name.select();
  return asked;
}

function item(what: string, bytes?: number): HTMLElement {
  const size = bytes === undefined ? [] : [html("span", { class: "caption" }, words.size(bytes))];
  return html("li", {}, html("span", {}, what), ...size);
}

const sizeOf = (inputs: readonly DroppedInput[]): number =>
  inputs.reduce((sum, { file, exact }) => sum + file.size + (exact?.poses.byteLength ?? 0), 0);

/** A name that is valid as a file name on every system. */
function fileName(text: string): string {
  return text
    .replace(/\.strut$/i, "")
    .replace(/[\\/:*?"<>|\p{Cc}]+/gu, "-")
    .replace(/^[.\s-]+|[.\s]+$/g, "");
}
