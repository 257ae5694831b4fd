/** Interface between the page and the build worker. */
import type {
  BuildFile,
  BuiltDatabase,
  ClipInfo,
  Labelled,
  Preview,
  RefusedFile,
  Roles,
} from "../../engine/build/builder";
import type { KeyStyleOrder, TrainedKeyStyle } from "../../engine/build/key_style_training";
import type { TrainedWalk } from "../../engine/build/walk_training";

export type * from "../../engine/build/builder";
export type { KeyStyleClip, KeyStyleOrder, TrainedKeyStyle } from "../../engine/build/key_style_training";
export type { TrainedWalk } from "../../engine/build/walk_training";
export { StrutError } from "../../engine/errors";

/** A dropped file, with its path in the dropped folder. */
export interface DroppedFile {
  path: string;
  file: File;
}

/** A BVH file among the dropped files, in an archive or not. */
export interface FoundClip {
  path: string;
  /** Title of the licence next to it, empty if there is none. */
  licence: string;
}

/** Contents of the dropped files. */
export interface Found {
  /** Sorted by path. */
  clips: FoundClip[];
  /** The pattern that the file names seem to follow. */
  pattern: string | undefined;
  /** Sentences about what was left out. */
  notes: string[];
}

/** Properties of a clip after it was read: its index among the clips found, and its skeleton among the known ones. */
export type ReadClip =
  | { index: number; fault: string }
  | { index: number; frames: number; rateHz: number; skeleton: number };

/** A skeleton that is shared by clips. */
export interface Skeleton extends Pick<ClipInfo, "joints" | "parents" | "roles" | "confidence" | "fault" | "note"> {}

/** What `readAll` reports while it runs. */
export interface ReadEvent {
  clips: ReadClip[];
  /** Skeletons met for the first time; their indices follow those of the known ones. */
  skeletons: Skeleton[];
}

/** A file to build from, with the roles of its skeleton if the user chose them. */
export interface ChosenFile extends BuildFile {
  index: number;
  roles: Roles | undefined;
}

export type { BuildFile, Labelled, Preview, RefusedFile, Roles };

/** The worker's calls. Cancelling a `build` pauses it. */
export interface BuildCalls {
  open(files: DroppedFile[]): Found;
  label(pattern: string | undefined, table: File | undefined): Labelled[];
  /** Its progress is a {@link ReadEvent}, too. */
  readAll(): undefined;
  preview(index: number, roles: Roles | undefined): Preview;
  build(files: ChosenFile[], neutral: string | undefined): BuiltDatabase;
  addStyle(database: Blob | undefined, clip: File, style: string, action: string | undefined): BuiltDatabase;
  trainWalk(database: Blob | undefined): TrainedWalk;
  trainKeyStyle(database: Blob | undefined, files: DroppedFile[], order: KeyStyleOrder): TrainedKeyStyle;
}
