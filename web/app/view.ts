/** The interfaces between the page and its views. */

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

/** The page's interface for a view. */
export interface ViewHost {
  readonly store: Store;
  readonly toasts: Toasts;
  /** The open objects of the engine. */
  readonly session: Session;
  /** The playhead of the motion. */
  readonly playhead: Playhead;
  /** The lines that show the session's progress. */
  readonly progress: ProgressLines;
  /** Aborts when the view is disposed of: listeners added with the signal are then removed. */
  readonly signal: AbortSignal;
  /**
   * Opens a database in the app and shows it in Play, with its name in the URL if it is stored here. Returns whether
   * that succeeded.
   */
  openDatabase(name: string, file: Blob, kept: boolean): Promise<boolean>;
  /** Returns to the built-in database. */
  openBuiltIn(): Promise<boolean>;
  /** The open database: its display name, and its file unless it is the built-in one. */
  databaseFile(): { name: string; file: Blob | undefined };
  /** Moves the 3-D viewer into a container of the view, until another view borrows it. */
  borrowViewer(container: HTMLElement): ViewerLease;
  /** Whether single-character shortcuts are on. */
  singleKeys(): boolean;
  /** To be called when {@link View.history} has changed. */
  historyChanged(): void;
  /** To be called when {@link View.holdsUnkept} may have changed. */
  workChanged(): void;
  /** The rigged character in use; `undefined` for the mannequin. */
  performing(): Performing | undefined;
  /** Returns to the mannequin. */
  leaveCharacter(): void;
  /** Opens the joint mapping of the character. */
  checkJoints(): void;
  /** Opens an input by its name in the library. Returns whether it is open. */
  chooseInput(name: string): Promise<boolean>;
  /** Removes the open dropped file from the inputs. */
  removeInput(): Promise<void>;
  /** Opens a clip of the open database as the input, by its index. Returns whether it is open. */
  chooseClip(clip: number): Promise<boolean>;
  /**
   * Opens a database that was built without leaving this view, with its name in the URL if it is stored here. Returns
   * whether that succeeded. `renamed` are new names of styles by their former ones.
   */
  openBuilt(
    database: { name: string; file: Blob },
    kept: boolean,
    renamed: ReadonlyMap<string, string>,
  ): Promise<boolean>;
  /** Shows the view Play. */
  showPlay(): void;
  /** Reads the open file as the user specifies. Returns whether it could be read so. */
  readAs(reading: FileReading): Promise<boolean>;
  /** Opens the browser's file dialog for a motion or a database. */
  chooseFile(): void;
  /** Opens the browser's file dialog for a clip that becomes a style of the open database. */
  chooseStyle(): void;
  /** Offers clips of public data sets, and opens those that the user downloads as inputs. */
  tryRecorded(): Promise<void>;
  /** Makes a motion the input of Play, and shows Play; `exact` are the poses from which its file was written. */
  playMotion(name: string, bytes: ArrayBuffer, exact?: ExactPoses): Promise<void>;
}

/** A rigged character in use. */
export interface Performing {
  /** Its title, or its file's. */
  readonly name: string;
  /** Authors to be credited; empty if none. */
  readonly credit: string;
  /** Address of its terms. */
  readonly url: string | undefined;
  /** Whether its joint mapping is uncertain. */
  readonly unsure: boolean;
  readonly performer: Performer;
}

/** One line each for databases and files, for inputs, and for the analysis of the current one. */
export interface ProgressLines {
  readonly database: ProgressLine;
  readonly input: ProgressLine;
  readonly character: ProgressLine;
  readonly analysis: ProgressLine;
}

/** The 3-D viewer while a view has it. After every change the view requests a redraw. */
export interface ViewerLease {
  readonly viewer: Viewer;
  /** The element in which the viewer draws. */
  readonly element: HTMLElement;
  invalidate(): void;
  /** Stops drawing while other work needs the CPU. */
  freeze(frozen: boolean): void;
  readonly film: Film;
  /** Marks the parts of the body that joints rotate; exported pictures do not show it. */
  tint(joints: readonly Role[]): void;
}

/**
 * Actions of keys, by `KeyboardEvent.key`, letters in lower case. The page listens; it leaves keys to controls that
 * need them, and single-character ones can be turned off.
 */
export type KeyTable = Readonly<Record<string, () => void>>;

/** A view of the page. */
export interface View {
  /** Fills the page below the top bar. */
  readonly element: HTMLElement;
  /** Target of undo and redo while the view is shown. */
  readonly history: UndoRedo;
  readonly keys?: KeyTable;
  /** Element on which a clip becomes a style when dropped; `undefined` if there is none. */
  readonly styleTarget?: Element | undefined;
  /** Whether disposing of the view would lose the user's work; other views are disposed of after being hidden for a while. */
  readonly holdsWork?: boolean;
  /** Whether leaving the page would lose the user's work, because the browser does not store it. */
  readonly holdsUnkept?: boolean;
  show(): void;
  /** Called when another database or input is open, or another body performs. */
  refresh?(): void;
  hide(): void;
  /** Makes an input from a motion that cannot be exported directly; false if that is not possible. */
  keep?(): Promise<boolean>;
  /** Handles files that were dropped while the view is shown, or whose kind the view accepts. */
  takeFiles?(files: DroppedFile[]): void;
  dispose(): void;
}
