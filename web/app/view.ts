/** What a view is to the page, and what the page is to a view. */

import type { DroppedFile } from "../client/build/protocol";
import type { ExactPoses, FileReading } from "../client/protocol";
import type { Role } from "../humanoid";
import type { Session } from "../player/session";
import type { Performer, Viewer } from "../viewer";
import type { UndoRedo } from "./state/history";
import type { Playhead } from "./state/playhead";
import type { Store } from "./state/store";
import type { Film } from "./ui/film";
import type { ProgressLine } from "./ui/progress";
import type { Toasts } from "./ui/toasts";

/** What a view may ask of the page. */
export interface ViewHost {
  readonly store: Store;
  readonly toasts: Toasts;
  /** What is open in the engine. */
  readonly session: Session;
  /** Where the motion stands. */
  readonly playhead: Playhead;
  /** The lines that show what the session is busy with. */
  readonly progress: ProgressLines;
  /** Aborts when the view is disposed of: listeners that it made with the signal end then. */
  readonly signal: AbortSignal;
  /** Makes a database the app's and shows it in Play, by its name in the URL if it is kept here; whether that worked. */
  openDatabase(name: string, file: Blob, kept: boolean): Promise<boolean>;
  /** Goes back to the built-in database. */
  openBuiltIn(): Promise<boolean>;
  /** The database that is open: its name for people, and its file unless it is the built-in one. */
  databaseFile(): { name: string; file: Blob | undefined };
  /** Moves the 3-D viewer into a container of the view's, until another view borrows it. */
  borrowViewer(container: HTMLElement): ViewerLease;
  /** Whether letters and digits act as keys. */
  singleKeys(): boolean;
  /** Says that {@link View.history} has other things to undo or redo. */
  historyChanged(): void;
  /** Says that {@link View.holdsUnkept} may be another. */
  workChanged(): void;
  /** The character that performs; undefined where the mannequin does. */
  performing(): Performing | undefined;
  /** Has the mannequin perform again. */
  leaveCharacter(): void;
  /** Asks which joint of the character is which. */
  checkJoints(): void;
  /** Opens an input by its name in the library; whether it is open now. */
  chooseInput(name: string): Promise<boolean>;
  /** Takes the dropped file that is open out of the inputs. */
  removeInput(): Promise<void>;
  /** Opens a clip of the open database as the input, by its number; whether it is open now. */
  chooseClip(clip: number): Promise<boolean>;
  /**
   * Opens a database that was built without leaving this view, by its name in the URL if it is kept here; whether that worked.
   * `renamed` are new names of styles by their former ones.
   */
  openBuilt(
    database: { name: string; file: Blob },
    kept: boolean,
    renamed: ReadonlyMap<string, string>,
  ): Promise<boolean>;
  /** Goes to the view Play. */
  showPlay(): void;
  /** Reads the open file as a person says; whether it could be read so. */
  readAs(reading: FileReading): Promise<boolean>;
  /** Opens the browser's file dialog for a motion or a database. */
  chooseFile(): void;
  /** Makes a motion the input of Play, and goes there; `exact` are the poses that its file was written from. */
  playMotion(name: string, bytes: ArrayBuffer, exact?: ExactPoses): Promise<void>;
}

/** A character that performs. */
export interface Performing {
  /** Its title, or its file's. */
  readonly name: string;
  /** Who is to be named with it; empty where nobody is. */
  readonly credit: string;
  /** Where its terms stand. */
  readonly url: string | undefined;
  /** Whether it is not certain which of its joints is which. */
  readonly unsure: boolean;
  readonly performer: Performer;
}

/** A line each for databases and files, for inputs, and for the analysis of the present one. */
export interface ProgressLines {
  readonly database: ProgressLine;
  readonly input: ProgressLine;
  readonly character: ProgressLine;
  readonly analysis: ProgressLine;
}

/** The 3-D viewer while a view has it: after every change the view asks for drawing. */
export interface ViewerLease {
  readonly viewer: Viewer;
  /** What the viewer draws in. */
  readonly element: HTMLElement;
  invalidate(): void;
  /** Stops drawing while something else needs the processor. */
  freeze(frozen: boolean): void;
  readonly film: Film;
  /** Marks the parts of the body that joints turn; exported pictures do not show it. */
  tint(joints: readonly Role[]): void;
}

/**
 * What keys do, by `KeyboardEvent.key`, letters in lower case. The page listens; it leaves keys to controls that need
 * them, and those of a single character can be switched off.
 */
export type KeyTable = Readonly<Record<string, () => void>>;

/** A view of the page. */
export interface View {
  /** Fills the page below the top bar. */
  readonly element: HTMLElement;
  /** What undo and redo act upon while the view is shown. */
  readonly history: UndoRedo;
  readonly keys?: KeyTable;
  /** Where a clip is dropped that is to be a style; undefined where none can be. */
  readonly styleTarget?: Element | undefined;
  /** Whether disposing of the view would lose what a person made; other views are disposed of after a while out of sight. */
  readonly holdsWork?: boolean;
  /** Whether leaving the page would lose what a person made: the browser does not keep it. */
  readonly holdsUnkept?: boolean;
  show(): void;
  /** Another database or input is open, or another body performs. */
  refresh?(): void;
  hide(): void;
  /** Makes an input of what cannot be exported as it is shown; false where that cannot be done. */
  keep?(): Promise<boolean>;
  /** Takes files that were dropped while the view is shown, or that the view takes by its kind. */
  takeFiles?(files: DroppedFile[]): void;
  dispose(): void;
}
