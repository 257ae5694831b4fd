/**
 * The dropped files of a tab, kept by the browser in IndexedDB so that they are there after a reload. They are told apart by a
 * name of the tab, which its `sessionStorage` has; files of tabs that were closed long ago are deleted.
 */
import { IndexedDbStore } from "../../client/indexed_db_store";
import type { ExactPoses } from "../../client/protocol";
import type { Role } from "../../humanoid";

const files = new IndexedDbStore("strut files", "files", "key");

/** What was not opened for so long goes, milliseconds: a week. */
export const KEPT_MS = 7 * 24 * 3600 * 1000;

/** A dropped file. */
export interface SessionFile {
  kind: "motion" | "database" | "character";
  name: string;
  file: Blob;
  /** What was said of how a motion is read, as in a link. */
  reading?: string;
  exact?: ExactPoses;
  /** Whether the state names the database. */
  named?: boolean;
  /** Joint of each role of a character, where a person said so. */
  roles?: Partial<Record<Role, string>>;
}

/** A file with the tab that it was dropped on, and when it was kept. */
export interface KeptFile extends SessionFile {
  key: string;
  session: string;
  at: number;
}

const keyOf = (session: string, { kind, name }: Pick<SessionFile, "kind" | "name">): string =>
  `${session}/${kind}/${name}`;

/** Keeps a file, in the place of the one of the same kind and name. @throws DOMException as `IndexedDbStore.transact` */
export async function keepFile(session: string, file: SessionFile, now = Date.now()): Promise<void> {
  const kept: KeptFile = { ...file, key: keyOf(session, file), session, at: now };
  await files.transact("readwrite", (store) => store.put(kept));
}

/** Deletes a file. @throws DOMException as `IndexedDbStore.transact` */
export async function dropFile(session: string, file: Pick<SessionFile, "kind" | "name">): Promise<void> {
  await files.transact("readwrite", (store) => store.delete(keyOf(session, file)));
}

/** The files of a tab, in the order in which they were kept. @throws DOMException as `IndexedDbStore.transact` */
export async function filesOf(session: string): Promise<KeptFile[]> {
  const all = await files.transact("readonly", (store) => store.getAll() as IDBRequest<KeptFile[]>);
  return all.filter((file) => file.session === session).sort((a, b) => a.at - b.at);
}

/** Deletes the files of other tabs that were kept too long ago. @throws DOMException as `IndexedDbStore.transact` */
export async function dropOld(session: string, now = Date.now()): Promise<void> {
  const all = await files.transact("readonly", (store) => store.getAll() as IDBRequest<KeptFile[]>);
  for (const { key, at, session: of } of all)
    if (of !== session && !(now - at < KEPT_MS)) await files.transact("readwrite", (store) => store.delete(key));
}
