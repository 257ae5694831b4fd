/** Progress lines of the engine's tasks: one each for databases and files, inputs, the character, and the analysis. */
import type { CallOptions } from "../../client/protocol";
import type { SessionProgress, SessionTask } from "../../player/session";
import { strings } from "../strings/strings";
import { ProgressLine } from "../ui/progress";
import type { ProgressLines } from "../view";

/** Labels of the tasks. */
const LABELS: Readonly<Record<SessionTask, (subject: string) => string>> = {
  database: (name) => (name === "" ? strings.page.engine.preparing : strings.page.engine.reading(name)),
  input: (name) => strings.page.engine.reading(name),
  analysis: () => strings.page.engine.styling,
  styling: () => strings.page.engine.styling,
  export: () => strings.page.engine.exporting,
};

export class SessionProgressLines implements SessionProgress, ProgressLines {
  readonly database = new ProgressLine();
  readonly input = new ProgressLine();
  readonly character = new ProgressLine();
  readonly analysis = new ProgressLine();

  run<T>(task: SessionTask, subject: string, work: (options: CallOptions) => Promise<T>): Promise<T> {
    return this.#lineOf(task).run(LABELS[task](subject), work);
  }

  cancel(task: SessionTask): void {
    this.#lineOf(task).cancel();
  }

  #lineOf(task: SessionTask): ProgressLine {
    return task === "input" || task === "analysis" ? this[task] : this.database;
  }
}
