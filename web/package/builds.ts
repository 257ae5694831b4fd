/** Builds databases: from clips, or from a database and an additional style. */
import type { BuildClient } from "../client/build/client";
import type { ChosenFile, DroppedFile } from "../client/build/protocol";
import type { ClientDatabase, ClientMotion } from "../client/handles";
import { type BuiltInSet, type CallOptions, StrutError } from "../client/protocol";
import { loadBuiltIn } from "../engine/built_in";

/** Whether these are the bytes of an archive. */
export function isZip(bytes: ArrayBuffer): boolean {
  const [p, k, three, four] = new Uint8Array(bytes.slice(0, 4));
  return p === 0x50 && k === 0x4b && three === 3 && four === 4;
}

/**
 * Builds a database from BVH files, or archives of them, whose names contain action and style. The neutral style is
 * found by its name.
 * @throws StrutError `bad-file` with what is missing
 */
export async function buildDatabase(builds: BuildClient, files: readonly File[], call: CallOptions): Promise<Blob> {
  const dropped = files.map((file): DroppedFile => ({ path: file.webkitRelativePath || file.name, file }));
  const { clips, pattern, notes } = await builds.open(dropped, call.signal && { signal: call.signal });
  const labels = await builds.label(pattern, undefined);
  const chosen = clips.flatMap(({ path, licence }, index): ChosenFile[] => {
    const label = labels[index]!;
    return "reason" in label ? [] : [{ ...label, index, path, licence, roles: undefined }];
  });
  if (chosen.length > 0) return (await builds.build(chosen, undefined, call)).file;
  const message =
    clips.length === 0
      ? `There is no BVH file to build a database from. ${notes.join(" ")}`.trimEnd()
      : "The file names do not contain an action and a style.";
  throw new StrutError({ code: "bad-file", message, hint: "Name them like walk_old_1.bvh, or open a .strutdb file." });
}

/**
 * Adds a motion to a database as a style; returns the new database's file.
 * @throws StrutError `bad-input` if the motion is a built-in one, `bad-file` if it does not fit
 */
export async function addedStyle(
  builds: BuildClient,
  database: ClientDatabase,
  { source }: ClientMotion,
  style: string,
  call: CallOptions,
): Promise<Blob> {
  if (source.kind !== "bvh") {
    const message = "A built-in motion cannot be added as a style.";
    throw new StrutError({ code: "bad-input", message, hint: "Open a BVH file as a motion." });
  }
  const clip = new File([source.bytes], `${source.name}.bvh`);
  return (await builds.addStyle(await fileOf(database), clip, style, call)).file;
}

/**
 * The file from which a database was opened: a `.strutdb` file, or packed built-in motions, which the builders read as
 * well.
 */
export async function fileOf({ source }: ClientDatabase): Promise<Blob> {
  return source.kind === "strutdb" ? source.file : packedFile(source.set);
}

/** A set of built-in motions in the form that the builders and trainers read. */
export async function packedFile(set?: BuiltInSet): Promise<Blob> {
  return new Blob([await loadBuiltIn(undefined, set)]);
}
