/** The calls between `connection.ts` and `server/`; callers see only `protocol.ts` and the handles. */
import type { AtlasFacts, AtlasView, NearestInAtlas, PackedWindows } from "../engine/atlas";
import type { BuiltInSet } from "../engine/built_in";
import type { Styled, WasmMemory } from "../engine/types";
import type { DriveControl, DriveFrame, DriveInfo, Driven, Root } from "./drive/protocol";
import type {
  Analysis,
  CurveSubject,
  DatabaseClip,
  DatabaseInfo,
  DatabaseSource,
  Examples,
  FrameRange,
  InputInfo,
  InputSource,
  LiveFrame,
  MotionFacts,
  Performed,
  RecordedMotion,
  SearchFigures,
  ShownFrame,
  StyledClip,
  StylizeOptions,
} from "./protocol";
import type { ArgumentsOf, ResultOf } from "./rpc";

/** Id of an open object. The client chooses it, so that an object keeps its id when it is reopened. */
export type Id = number;

/** Settings of a session. */
export interface SessionSetup {
  database: Id;
  motion: Id;
  options: StylizeOptions;
  loop: boolean;
  range: FrameRange | undefined;
  /** Playback position; `undefined` before the first frame. */
  inputFrame: number | undefined;
}

/** The worker's calls. The first argument of a call that opens an object is the object's id. */
export interface WorkerCalls {
  openDatabase(database: Id, source: DatabaseSource): DatabaseInfo;
  /** Names of the motions of a built-in set, the default first. */
  builtInInputs(set: BuiltInSet): string[];
  /** Indices and names of the neutral clips of a database. */
  neutralClips(database: Id): { clip: number; name: string }[];
  clipOfDatabase(database: Id, clip: number): DatabaseClip;
  /** Opens a motion, which is read when it is first used with a database. */
  openMotion(motion: Id, source: InputSource): undefined;
  /** Facts of a motion's file. */
  readMotion(motion: Id): MotionFacts;
  /** A motion on the humanoid of a database and at its frame rate. */
  motionOn(motion: Id, database: Id): InputInfo;
  stylize(motion: Id, database: Id, options: StylizeOptions, bvh: boolean): StyledClip;
  counterpart(motion: Id, style: string): Performed | undefined;
  compareSearch(motion: Id, database: Id, neighbours: number, candidates: number): SearchFigures | undefined;
  createSession(session: Id, setup: SessionSetup): undefined;
  configure(session: Id, options: StylizeOptions): undefined;
  setLoop(session: Id, loop: boolean, range: FrameRange | undefined): undefined;
  step(session: Id, dtSecs: number): LiveFrame;
  seek(session: Id, inputFrame: number): LiveFrame;
  continueFrom(session: Id, shown: ShownFrame): LiveFrame;
  analyse(session: Id): Analysis;
  examples(session: Id, subject: CurveSubject): Examples;
  exportBvh(session: Id): string;
  /** Opens an atlas: the motion on a database as a picture of at most `columns` columns. */
  openAtlas(atlas: Id, motion: Id, database: Id, columns: number): AtlasFacts;
  drawAtlas(atlas: Id, view: AtlasView, columns: Uint32Array): { distances: Float32Array };
  nearestInAtlas(atlas: Id, view: AtlasView, column: number, line: number): NearestInAtlas;
  atlasPose(atlas: Id, column: number, clip: number, frame: number): { pose: Float32Array };
  packAtlas(atlas: Id, view: AtlasView): PackedWindows;
  packAtlasColumns(atlas: Id, view: AtlasView): PackedWindows;
  atlasLines(atlas: Id, view: AtlasView): { lines: Uint32Array };
  /** Records a motion in every style of a database: the whole of it or a range, within the memory limit. */
  recordMotion(motion: Id, database: Id, options: StylizeOptions, range: FrameRange | undefined): RecordedMotion;
  createStylizer(stylizer: Id, database: Id, options: StylizeOptions, halfLifeSecs: number): undefined;
  restyle(stylizer: Id, options: StylizeOptions, halfLifeSecs: number): undefined;
  push(stylizer: Id, poses: Float32Array): Styled;
  reset(stylizer: Id): undefined;
  /** Opens a driven character at a position. */
  openDrive(drive: Id, database: Id, options: StylizeOptions, root: Root): DriveInfo;
  drive(drive: Id, dtSecs: number, control: DriveControl): DriveFrame;
  restyleDrive(drive: Id, options: StylizeOptions): undefined;
  resetDrive(drive: Id, root: Root): undefined;
  driven(drive: Id): Driven;
  /** Replaces a motion's file by these poses on a database, of its body and at its frame rate. */
  takePoses(motion: Id, database: Id, poses: Float32Array): undefined;
  memory(): WasmMemory;
  /** Closes an object and all objects made from it. Does nothing if it is not open. */
  close(id: Id): undefined;
}

export type Method = keyof WorkerCalls;
export type Arguments<M extends Method> = ArgumentsOf<WorkerCalls, M>;
/** Result type of a method. */
export type Result<M extends Method> = ResultOf<WorkerCalls, M>;
