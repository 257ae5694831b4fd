/** Projects and dropped files as the page has them: opens, saves, forgets. Loaded with the first of these. */
import { ProgressLine } from "../ui/progress";
import { taskCard } from "../ui/task_card";
import { offerUntilEdit } from "./offer";
import { openProject } from "./open_project";
import type { ProjectPlace } from "./place";
import { saveProject } from "./save_project";
import { projectWords as words } from "./strings.en";

export class Projects {
  readonly #place: ProjectPlace;

  /** @param root what the progress is shown in */
  constructor(place: Omit<ProjectPlace, "progress">, root: HTMLElement) {
    const progress = new ProgressLine();
    root.append(taskCard(words.task, progress.element));
    this.#place = { ...place, progress };
  }

  /** Opens a project file; the one that is being opened is given up. */
  open(file: File): Promise<void> {
    return openProject(file, this.#place);
  }

  /** Asks how the project is to be saved, and saves it. */
  save(): Promise<void> {
    return saveProject(this.#place);
  }

  /** Takes all dropped files away, from the page and from what the browser keeps; offers to bring them back. */
  async forget(): Promise<void> {
    const { session, databases, characters, toasts, store, arrive } = this.#place;
    const { library } = session;
    await databases.nameUnnamed();
    const before = store.state;
    const held = [...databases.held];
    const character = characters.file && { file: characters.file, roles: characters.roles };
    const motions = library.dropped.map((name) => library.file(name)!);
    const isOpen = library.isDropped(session.chosen);
    const isHeld = databases.held.has(before.database);
    if (isOpen || isHeld)
      await arrive({ ...before, ...(isOpen && { input: "", reading: {} }), ...(isHeld && { database: "" }) });
    for (const { name } of motions) library.remove(name);
    for (const [name] of held) databases.release(name);
    characters.leave();
    const bringBack = async (): Promise<void> => {
      for (const motion of motions) await library.bringBack(motion);
      for (const [name, file] of held) databases.keep(name, file);
      await arrive(before);
      if (character)
        await characters.prepare(character.file, character.roles, true).then(
          (prepared) => prepared.take(),
          (error) => toasts.failure(error),
        );
    };
    offerUntilEdit(words.forgotten, words.undo, () => void bringBack(), this.#place);
  }
}
