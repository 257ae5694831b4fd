/**
 * Stores the dropped files of this tab in the browser, so that a reload restores them, and deletes them on request. Its
 * code is loaded with the first dropped file.
 */
import { decodeReading, encodeReading, saysNothing } from "../../link/reading";
import type { InputLibrary } from "../../player/input_library";
import type { Characters } from "../character/characters";
import type { SessionFile } from "../project/kept_files";
import type { Toasts } from "../ui/toasts";
import type { Databases } from "./databases";

/** Key of this tab's name in `sessionStorage`, while it has files. */
const SESSION = "strut session";
/** Key of the time in `localStorage` at which any tab last stored a file, while there may be some. */
const LAST = "strut files kept";
/** Files are stored when nothing has changed for this time; those that cannot be opened are removed by then. */
const SETTLE_MS = 250;

/** The sources of the stored files. */
interface Sources {
  readonly library: InputLibrary;
  readonly databases: Pick<Databases, "held" | "keep" | "unnamed">;
  readonly characters: Pick<Characters, "file" | "roles" | "prepare">;
}

/** A file to be stored, and a key that tells whether it is unchanged. */
interface Kept extends Pick<SessionFile, "kind" | "name"> {
  bytes: number;
  same: readonly unknown[];
  make: () => SessionFile;
}

/** A tab's files are stored again after this time, milliseconds: they expire a certain time after the tab was last loaded. */
const RENEWED_MS = 24 * 3600 * 1000;

export class SessionFiles {
  /** Called when the files have changed, and when the browser has stored them or refused to. */
  onChange = () => {};
  readonly #sources: Sources;
  readonly #toasts: Toasts;
  #kept = new Map<string, Kept>();
  #timer: ReturnType<typeof setTimeout> | undefined;
  #writing: Promise<void> = Promise.resolve();
  /** Whether the user was told that the browser does not store files. */
  #told = false;

  constructor(sources: Sources, toasts: Toasts) {
    this.#sources = sources;
    this.#toasts = toasts;
  }

  /** Number of dropped files, and their bytes. */
  get size(): { files: number; bytes: number } {
    const wanted = [...this.#wanted().values()];
    return { files: wanted.length, bytes: wanted.reduce((sum, { bytes }) => sum + bytes, 0) };
  }

  /** Whether the browser does not store all of them, or not yet. */
  get unkept(): boolean {
    return [...this.#wanted()].some(([key, file]) => !this.#isKept(key, file));
  }

  /** To be called when the files may have changed. */
  changed(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#settle(), SETTLE_MS);
  }

  /** Restores the files dropped before this tab was reloaded; a character when `character` is called. */
  async restore(): Promise<{ character: () => Promise<void> }> {
    const session = stored("session", SESSION);
    const last = Number(stored("local", LAST) ?? Number.NaN);
    const nothing = { character: async () => {} };
    if (session === undefined && Number.isNaN(last)) return nothing;
    const { dropOld, filesOf, KEPT_MS } = await import("../project/kept_files");
    if (session === undefined) {
      if (Date.now() - last < KEPT_MS) return nothing;
      await dropOld("").catch(() => {});
      store("local", LAST, undefined);
      return nothing;
    }
    const { library, databases, characters } = this.#sources;
    let ofCharacter: SessionFile | undefined;
    try {
      const files = await filesOf(session);
      for (const file of files) {
        if (file.kind === "character") ofCharacter = file;
        else if (file.kind === "motion") {
          const { reading: text = "" } = file;
          const name = await library.add(file.name, await file.file.arrayBuffer(), file.exact);
          library.say(name, decodeReading(text) ?? {});
        } else if (file.named) databases.keep(file.name, file.file);
        else databases.unnamed = { name: file.name, file: file.file };
      }
      const renewed = Date.now() - RENEWED_MS;
      const young = new Set(files.filter(({ at }) => at > renewed).map(({ kind, name }) => `${kind}/${name}`));
      for (const [key, kept] of this.#wanted()) if (young.has(key)) this.#kept.set(key, kept);
    } catch {
      const { projectWords } = await import("../project/strings.en");
      this.#toasts.note(projectWords.gone);
    }
    const character = async () => {
      if (!ofCharacter) return;
      const { name, file, roles } = ofCharacter;
      const prepared = await characters.prepare(new File([file], name), roles, true).catch(() => undefined);
      prepared?.take();
    };
    return { character };
  }

  dispose(): void {
    clearTimeout(this.#timer);
  }

  #settle(): void {
    this.#writing = this.#writing
      .then(() => this.#write())
      .catch((error: unknown) => this.#refused(error))
      .then(() => this.onChange());
    this.onChange();
  }

  /** Stores new files and deletes removed ones. */
  async #write(): Promise<void> {
    const wanted = this.#wanted();
    if (wanted.size === 0 && this.#kept.size === 0) return;
    const { dropFile, dropOld, keepFile } = await import("../project/kept_files");
    const session = sessionName();
    for (const [key, gone] of this.#kept) {
      if (wanted.has(key)) continue;
      await dropFile(session, gone);
      this.#kept.delete(key);
    }
    for (const [key, next] of wanted) {
      if (this.#isKept(key, next)) continue;
      await keepFile(session, next.make());
      this.#kept.set(key, next);
    }
    if (wanted.size > 0) store("local", LAST, String(Date.now()));
    else store("session", SESSION, undefined);
    await dropOld(session);
  }

  #isKept(key: string, file: Kept): boolean {
    return this.#kept.get(key)?.same.every((value, i) => value === file.same[i]) ?? false;
  }

  async #refused(error: unknown): Promise<void> {
    if (this.#told) return;
    this.#told = true;
    const { projectWords: words } = await import("../project/strings.en");
    const isFull = (error as DOMException | null)?.name === "QuotaExceededError";
    this.#toasts.note(words.notKept(isFull ? words.full : words.noStorage));
  }

  /** All files to be restored after a reload, by kind and name. */
  #wanted(): Map<string, Kept> {
    const { library, databases, characters } = this.#sources;
    const wanted = new Map<string, Kept>();
    const want = (kept: Kept) => wanted.set(`${kept.kind}/${kept.name}`, kept);
    for (const name of library.dropped) {
      const { file, exact, reading: said = {} } = library.file(name)!;
      const reading = saysNothing(said) ? "" : encodeReading(said);
      const size = file.size + (exact?.poses.byteLength ?? 0);
      const make = () => ({ kind: "motion" as const, name, file, reading, ...(exact && { exact }) });
      want({ kind: "motion", name, bytes: size, same: [file, exact, reading], make });
    }
    const wantFile = (file: SessionFile, ...same: unknown[]) =>
      want({ kind: file.kind, name: file.name, bytes: file.file.size, same: [file.file, ...same], make: () => file });
    for (const [name, file] of databases.held) wantFile({ kind: "database", name, file, named: true });
    const { unnamed } = databases;
    if (unnamed) wantFile({ kind: "database", name: unnamed.name, file: unnamed.file });
    const { file, roles } = characters;
    if (file) wantFile({ kind: "character", name: file.name, file, ...(roles && { roles }) }, roles);
    return wanted;
  }
}

/** The name of this tab, created on first use. */
function sessionName(): string {
  const known = stored("session", SESSION);
  if (known !== undefined) return known;
  const name = [...crypto.getRandomValues(new Uint32Array(4))].map((part) => part.toString(36)).join("");
  store("session", SESSION, name);
  return name;
}

type Place = "session" | "local";
const storageOf = (place: Place): Storage => (place === "session" ? sessionStorage : localStorage);

/** The stored value of a key; `undefined` if there is none, or the browser stores nothing for this page. */
function stored(place: Place, key: string): string | undefined {
  try {
    return storageOf(place).getItem(key) ?? undefined;
  } catch {
    return undefined;
  }
}

function store(place: Place, key: string, value: string | undefined): void {
  try {
    if (value === undefined) storageOf(place).removeItem(key);
    else storageOf(place).setItem(key, value);
  } catch {}
}
