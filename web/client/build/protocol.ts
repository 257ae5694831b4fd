/** What the page and the build worker say to each other. */
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

/** A file that was dropped, with the path that it has in its folder. */
export interface DroppedFile {
  path: string;
  file: File;
}

/** A BVH file among what was dropped, in an archive or not. */
export interface FoundClip {
  path: string;
  /** Title of the licence beside it, empty if there is none. */
  licence: string;
}

/** What there is among the files that were dropped. */
export interface Found {
  /** Sorted by path. */
  clips: FoundClip[];
  /** The pattern that their names seem to follow. */
  pattern: string | undefined;
  /** Sentences about what was left out. */
  notes: string[];
}

/** What is known of a clip once it was read: its index among the clips found, and its skeleton among those met. */
export type ReadClip =
  | { index: number; fault: string }
  | { index: number; frames: number; rateHz: number; skeleton: number };

/** A skeleton that clips have. */
export interface Skeleton extends Pick<ClipInfo, "joints" | "parents" | "roles" | "confidence" | "fault" | "note"> {}

/** What {@link BuildClient.readAll} reports while it runs. */
export interface ReadEvent {
  clips: ReadClip[];
  /** Skeletons met for the first time, with the numbers that follow those known. */
  skeletons: Skeleton[];
}

/** A file of a build, with the roles of its skeleton where a person chose them. */
export interface ChosenFile extends BuildFile {
  index: number;
  roles: Roles | undefined;
}

/**
 * Database building as the page sees it. One set of files is open at a time. Rejections are `StrutError`s whose messages
 * are sentences for people. Cancelling ends the worker, whatever it is doing, and another takes its place; only a build
 * is left where it is until other files are opened, and the same build goes on from there.
 */
export interface BuildClient {
  /** Lists the clips among these files, which take the place of those before; nothing is unpacked yet. */
  open(files: DroppedFile[], options?: CallOptions): Promise<Found>;
  /** Labels of every clip, in their order, from a table or else a pattern. */
  label(pattern: string | undefined, table: File | undefined): Promise<Labelled[]>;
  /** Reads every clip once, to know its length, rate and skeleton. */
  readAll(onRead: (event: ReadEvent) => void, options?: CallOptions): Promise<void>;
  preview(index: number, roles: Roles | undefined): Promise<Preview>;
  /** Builds a database; without `neutral` that style is found by its name. */
  build(files: ChosenFile[], neutral: string | undefined, options?: CallOptions): Promise<BuiltDatabase>;
  /** A database, or the built-in one, with a clip as one more style; without `action` the one that it fits best is taken. */
  addStyle(
    database: Blob | undefined,
    clip: File,
    style: string,
    options?: CallOptions & { action?: string | undefined },
  ): Promise<BuiltDatabase>;
  /** A walk model of a database, or of the built-in one. */
  trainWalk(database: Blob | undefined, options?: CallOptions): Promise<TrainedWalk>;
  /** A key-style model of clips of the files, or where there are none of a database, or of the built-in one. */
  trainKeyStyle(
    database: Blob | undefined,
    files: readonly DroppedFile[],
    order: KeyStyleOrder,
    options?: CallOptions,
  ): Promise<TrainedKeyStyle>;
  dispose(): void;
}

export type { BuildFile, Labelled, Preview, RefusedFile, Roles };
