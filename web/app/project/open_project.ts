/** Opens project files. Loaded on first use. */
import { isCancellation } from "../../client/protocol";
import type { Prepared } from "../character/characters";
import { stateOfLink } from "../shell/links";
import { errorText } from "../ui/words";
import { checkProject } from "./check_project";
import { offerUntilEdit } from "./offer";
import type { ProjectPlace } from "./place";
import { isFileOf, type Project, type ProjectCharacter, ProjectError, readProject } from "./project_file";
import { projectWords as words } from "./strings.en";

/** Opens a project instead of the current state. If any part of it cannot be opened, nothing changes and the error is shown. */
export async function openProject(file: File, place: ProjectPlace): Promise<void> {
  const { toasts, progress, session } = place;
  try {
    await progress.run(words.reading, async (call) => {
      const project = await readProject(file, call);
      await checkProject(project, session.remembered(), call);
      const character = project.character && (await prepared(project.character, place));
      if (call.signal?.aborted) {
        character?.dispose();
        call.signal.throwIfAborted();
      }
      await show(project, character, file.name, place);
    });
  } catch (thrown) {
    if (isCancellation(thrown)) return;
    if (thrown instanceof ProjectError) toasts.error(words.refused(file.name, thrown.message));
    else toasts.failure(thrown);
  }
}

/** The character of a project, ready to perform; `undefined` if it is not available. */
async function prepared(character: ProjectCharacter, { characters }: ProjectPlace): Promise<Prepared | undefined> {
  const { name, file, roles } = character;
  const present = characters.file;
  const own = file && new File([file], name);
  const found = own ?? (present && (await isFileOf(character, present)) ? present : undefined);
  if (!found) return undefined;
  try {
    return await characters.prepare(found, roles, found === present);
  } catch (thrown) {
    // If the user does not accept the terms, the mannequin performs.
    if ((thrown as { code?: unknown }).code === "licence") return undefined;
    if (isCancellation(thrown)) throw thrown;
    throw new ProjectError(words.characterRefused(name, errorText(thrown)));
  }
}

async function show(
  project: Project,
  character: Prepared | undefined,
  fileName: string,
  place: ProjectPlace,
): Promise<void> {
  const { store, session, databases, characters, toasts, arrive } = place;
  await databases.nameUnnamed();
  const before = { state: store.state, file: characters.file, roles: characters.roles };
  const names = new Map<string, string>();
  for (const { name, file, exact, reading } of project.inputs) {
    const added = await session.library.add(name, file, exact);
    session.library.say(added, reading ?? {});
    names.set(name, added);
  }
  const { database } = project;
  const state = stateOfLink(project.state);
  await arrive({
    ...state,
    theme: store.state.theme,
    input: names.get(state.input) ?? state.input,
    database: database ? await databases.hold(database.name, database.file) : "",
  });
  if (character) character.take();
  else characters.leave();
  const missing = project.character && !project.character.file && !character;
  if (missing) toasts.note(words.characterMissing(project.character!.name));
  const goBack = async (): Promise<void> => {
    await arrive(before.state);
    const back = before.file && (await characters.prepare(before.file, before.roles, true).catch(() => undefined));
    if (back) back.take();
    else characters.leave();
  };
  offerUntilEdit(words.opened(fileName), words.back, () => void goBack(), place);
}
