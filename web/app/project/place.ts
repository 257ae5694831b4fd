/** The page's interface for projects. */
import type { Session } from "../../player/session";
import type { Characters } from "../character/characters";
import type { Databases } from "../shell/databases";
import type { AppState } from "../state/state";
import type { Store } from "../state/store";
import type { ProgressLine } from "../ui/progress";
import type { Toasts } from "../ui/toasts";

/** The page's databases, as projects need them. */
type ProjectDatabases = Pick<Databases, "file" | "held" | "hold" | "keep" | "release" | "nameUnnamed">;

export interface ProjectPlace {
  readonly store: Store;
  readonly session: Session;
  readonly databases: ProjectDatabases;
  readonly characters: Characters;
  readonly toasts: Toasts;
  /** The progress of reading and saving, shown in every view. */
  readonly progress: ProgressLine;
  /** Applies a state. */
  arrive(state: AppState): Promise<void>;
}
