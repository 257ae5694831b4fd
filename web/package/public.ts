/** The types of the package, the same in all entries. */
export type { StyleChange } from "../client/handles";
export type {
  Analysis,
  BodyPart,
  CallOptions,
  DatabaseInfo,
  FileRead,
  FileReading,
  FrameRange,
  JointNames,
  LiveFrame,
  MemoryInfo,
  ModelOptions,
  Note,
  OpenMemory,
  Progress,
  Reading,
  Styled,
  StyleKey,
  StyleWeights,
  StylizeOptions,
  UpAxis,
} from "../client/protocol";
export type { ClipOptions, RigNode, ThreeLike } from "../formats/animation_clip";
export type { TraceFrame } from "../formats/trace";
export type * from "./types";
