/** Calls about the clips of a database. */
import { bvhOfPoses } from "../../engine/drive/driver";
import { guarded } from "../../engine/wasm";
import type { DatabaseClip } from "../protocol";
import type { Caller } from "../rpc_server";
import { OpenDatabase } from "./databases";
import type { Host } from "./host";

/** Indices and names of the clips in the neutral style. */
export function neutralClips({ open }: Host, _: Caller, id: number): { clip: number; name: string }[] {
  const { raw } = open.get(OpenDatabase, id).database;
  return guarded(() => [...raw.neutralClips()].map((clip) => ({ clip, name: raw.clipName(clip) })));
}

/** A clip as a file on the database's body. */
export function clipOfDatabase({ open }: Host, _: Caller, id: number, clip: number): DatabaseClip {
  const { database } = open.get(OpenDatabase, id);
  const poses = guarded(() => database.raw.clipPoses(clip));
  return { bvh: bvhOfPoses(database, poses), poses };
}
