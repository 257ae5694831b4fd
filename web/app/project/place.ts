/** What projects need of the page. */
import type { Session } from "../../player/session";
import type { Characters } from "../character/characters";
import type { Databases } from "../shell/databases";
import type { AppState } from "../state/state";
import type { Store } from "../state/store";
import type { ProgressLine } from "../ui/progress";
import type { Toasts } from "../ui/toasts";

/** The databases of the page, as far as projects are concerned. */
type ProjectDatabases = Pick<Databases, "file" | "held" | "hold" | "keep" | "release" | "nameUnnamed">;

export interface ProjectPlace {
  readonly store: Store;
  readonly session: Session;
  readonly databases: ProjectDatabases;
  readonly characters: Characters;
  readonly toasts: Toasts;
  /** Shows how far reading and saving are, in any view. */
  readonly progress: ProgressLine;
  /** Goes to a state. */
  arrive(state: AppState): Promise<void>;
}
