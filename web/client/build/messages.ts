/** The wire format between the build worker and its client. The page uses only `protocol.ts`. */
import type { ErrorParts } from "../../engine/errors";
import type { Progress } from "../../engine/types";
import type {
  BuiltDatabase,
  ChosenFile,
  DroppedFile,
  Found,
  KeyStyleOrder,
  Labelled,
  Preview,
  ReadEvent,
  Roles,
  TrainedKeyStyle,
  TrainedWalk,
} from "./protocol";

/** A call with its arguments; the client numbers its calls. */
export type BuildCall =
  | { method: "open"; files: DroppedFile[] }
  | { method: "label"; pattern: string | undefined; table: File | undefined }
  | { method: "readAll" }
  | { method: "preview"; index: number; roles: Roles | undefined }
  | { method: "build"; files: ChosenFile[]; neutral: string | undefined }
  /** Pauses the current build so that it can continue later. */
  | { method: "pause" }
  | { method: "addStyle"; database: Blob | undefined; clip: File; style: string; action: string | undefined }
  | { method: "trainWalk"; database: Blob | undefined }
  | { method: "trainKeyStyle"; database: Blob | undefined; files: DroppedFile[]; order: KeyStyleOrder };

/** Result of each call. */
export interface BuildResults {
  open: Found;
  label: Labelled[];
  readAll: undefined;
  preview: Preview;
  build: BuiltDatabase;
  pause: undefined;
  addStyle: BuiltDatabase;
  trainWalk: TrainedWalk;
  trainKeyStyle: TrainedKeyStyle;
}

export type BuildRequest = BuildCall & { id: number };

/** Every call is answered by one `result` or `failure`, after any number of `progress` and `read`. */
export type BuildReply =
  | { kind: "progress"; id: number; progress: Progress }
  | { kind: "read"; id: number; event: ReadEvent }
  | { kind: "result"; id: number; value: BuildResults[BuildCall["method"]] }
  | { kind: "failure"; id: number; error: ErrorParts };
