/** Opens the contents of a project in an engine of its own, so that the page is unchanged if something cannot be opened. */
import { EngineClient } from "../../client/engine_client";
import { type CallOptions, isCancellation, type RememberedReadings } from "../../client/protocol";
import { errorText } from "../ui/words";
import { type Project, ProjectError } from "./project_file";
import { projectWords as words } from "./strings.en";

/**
 * Opens the database and every motion of a project, and closes them again.
 * @throws ProjectError with what cannot be opened and why; `cancelled`
 */
export async function checkProject(
  { inputs, database: own }: Project,
  remembered: RememberedReadings,
  { signal, onProgress }: CallOptions = {},
): Promise<void> {
  if (inputs.length === 0 && !own) return;
  const call = signal ? { signal } : {};
  const engine = new EngineClient(own ? {} : { preload: "first" });
  try {
    onProgress?.({ label: words.checking(own?.name ?? inputs[0]!.name), fraction: 0 });
    // The first strides of the built-in database have the same body as the whole.
    const source = own ? ({ kind: "strutdb", ...own } as const) : ({ kind: "demo", set: "first" } as const);
    const refused = own && ((why: string) => words.databaseRefused(own.name, why));
    const database = await said(engine.openDatabase(source, call), refused);
    for (const [i, { name, file, exact, reading }] of inputs.entries()) {
      onProgress?.({ label: words.checking(name), fraction: (i + 1) / (inputs.length + 1) });
      const read = { ...(exact && { exact }), reading: reading ?? {}, remembered };
      const motion = await engine.openMotion({ kind: "bvh", name, bytes: file, ...read }, call);
      await said(motion.on(database, call), (why) => words.motionRefused(name, why));
      motion.dispose();
    }
  } finally {
    engine.dispose();
  }
}

/** Adds the subject to the message of a refusal. */
async function said<T>(work: Promise<T>, about: ((why: string) => string) | undefined): Promise<T> {
  try {
    return await work;
  } catch (thrown) {
    if (!about || isCancellation(thrown)) throw thrown;
    throw new ProjectError(about(errorText(thrown)));
  }
}
