/**
 * The dropped files of a tab, stored in IndexedDB so that a reload restores them. They are identified by a name of the
 * tab in its `sessionStorage`. Files of tabs that were closed long ago are deleted.
 */
import { IndexedDbStore } from "../../client/indexed_db_store";
import type { ExactPoses } from "../../client/protocol";
import type { Role } from "../../humanoid";

const files = new IndexedDbStore("strut files", "files", "key");

/** Files that were not opened for this time are deleted, milliseconds: a week. */
export const KEPT_MS = 7 * 24 * 3600 * 1000;

/** A dropped file. */
export interface SessionFile {
  kind: "motion" | "database" | "character";
  name: string;
  file: Blob;
  /** The user's reading of a motion, encoded as in a link. */
  reading?: string;
  exact?: ExactPoses;
  /** Whether the state names the database. */
  named?: boolean;
  /** Joint of each role of a character, if the user set it. */
  roles?: Partial<Record<Role, string>>;
}

/** A file with its tab, and the time when it was stored. */
interface KeptFile extends SessionFile {
  key: string;
  session: string;
  at: number;
}

const keyOf = (session: string, { kind, name }: Pick<SessionFile, "kind" | "name">): string =>
  `${session}/${kind}/${name}`;

/** Stores a file, replacing the one of the same kind and name. @throws DOMException as `IndexedDbStore.transact` */
export async function keepFile(session: string, file: SessionFile, now = Date.now()): Promise<void> {
  const kept: KeptFile = { ...file, key: keyOf(session, file), session, at: now };
  await files.transact("readwrite", (store) => store.put(kept));
}

/** Deletes a file. @throws DOMException as `IndexedDbStore.transact` */
export async function dropFile(session: string, file: Pick<SessionFile, "kind" | "name">): Promise<void> {
  await files.transact("readwrite", (store) => store.delete(keyOf(session, file)));
}

/** The files of a tab, in the order in which they were stored. @throws DOMException as `IndexedDbStore.transact` */
export async function filesOf(session: string): Promise<KeptFile[]> {
  const all = await files.transact("readonly", (store) => store.getAll() as IDBRequest<KeptFile[]>);
  return all.filter((file) => file.session === session).sort((a, b) => a.at - b.at);
}

/** Deletes the files of other tabs that were stored too long ago. @throws DOMException as `IndexedDbStore.transact` */
export async function dropOld(session: string, now = Date.now()): Promise<void> {
  const all = await files.transact("readonly", (store) => store.getAll() as IDBRequest<KeptFile[]>);
  for (const { key, at, session: of } of all)
    if (of !== session && !(now - at < KEPT_MS)) await files.transact("readwrite", (store) => store.delete(key));
}
