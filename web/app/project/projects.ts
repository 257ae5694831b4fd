/** Projects and dropped files of the page: opens, saves, removes. Loaded on first use. */
import { ProgressLine } from "../ui/progress";
import { taskCard } from "../ui/task_card";
import { offerUntilEdit } from "./offer";
import { openProject } from "./open_project";
import type { ProjectPlace } from "./place";
import { saveProject } from "./save_project";
import { projectWords as words } from "./strings.en";

export class Projects {
  readonly #place: ProjectPlace;

  /** @param root element in which the progress is shown */
  constructor(place: Omit<ProjectPlace, "progress">, root: HTMLElement) {
    const progress = new ProgressLine();
    root.append(taskCard(words.task, progress.element));
    this.#place = { ...place, progress };
  }

  /** Opens a project file; an opening in progress is cancelled. */
  open(file: File): Promise<void> {
    return openProject(file, this.#place);
  }

  /** Asks for the settings of saving the project, and saves it. */
  save(): Promise<void> {
    return saveProject(this.#place);
  }

  /** Removes all dropped files from the page and from the browser's storage; offers to restore them. */
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
