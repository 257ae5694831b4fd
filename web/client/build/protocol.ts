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
import type { CallOptions } from "../../engine/types";

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

/** What {@link BuildClient.readAll} reports while it runs. */
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

/**
 * Database building as the page sees it. One set of files is open at a time. Rejections are `StrutError`s whose
 * messages are sentences for the user. Cancelling a call ends the worker, whatever it is doing, and a new one replaces
 * it. Only a build is paused instead: until other files are opened, the same build continues from there.
 */
export interface BuildClient {
  /** Lists the clips among these files, which replace the previous ones. Nothing is unpacked yet. */
  open(files: DroppedFile[], options?: CallOptions): Promise<Found>;
  /** Labels of every clip, in order, from the table or, without one, from the pattern. */
  label(pattern: string | undefined, table: File | undefined): Promise<Labelled[]>;
  /** Reads every clip once to find its length, frame rate and skeleton. */
  readAll(onRead: (event: ReadEvent) => void, options?: CallOptions): Promise<void>;
  preview(index: number, roles: Roles | undefined): Promise<Preview>;
  /** Builds a database. Without `neutral`, the neutral style is found by its name. */
  build(files: ChosenFile[], neutral: string | undefined, options?: CallOptions): Promise<BuiltDatabase>;
  /** Adds a clip as a new style to a database, or to the built-in one. Without `action`, the action that fits best is used. */
  addStyle(
    database: Blob | undefined,
    clip: File,
    style: string,
    options?: CallOptions & { action?: string | undefined },
  ): Promise<BuiltDatabase>;
  /** Trains a walk model on a database, or on the built-in one. */
  trainWalk(database: Blob | undefined, options?: CallOptions): Promise<TrainedWalk>;
  /** Trains a key-style model on clips of the files; without files on a database, or on the built-in one. */
  trainKeyStyle(
    database: Blob | undefined,
    files: readonly DroppedFile[],
    order: KeyStyleOrder,
    options?: CallOptions,
  ): Promise<TrainedKeyStyle>;
  dispose(): void;
}

export type { BuildFile, Labelled, Preview, RefusedFile, Roles };
