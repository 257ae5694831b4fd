/** The user's readings of skeletons, stored by the browser for the next file with the same skeleton. */
import type { FileReading, RememberedReadings } from "../../client/protocol";
import { decodeReading, encodeReading } from "../../link/reading";
import { askToPersist } from "../ui/storage";

/** Key in localStorage. */
const KEY = "strut readings";
/** Maximum number of skeletons; the one that was used least recently is removed first. */
const MOST = 100;

/** The part of `localStorage` that is needed. */
type Memory = Pick<Storage, "getItem" | "setItem">;

export class ReadingMemory {
  readonly #memory: () => Memory;
  /** Entries that the storage refused; they are kept as long as the page is open. */
  #unkept: Record<string, string> | undefined;

  constructor(memory: () => Memory = () => localStorage) {
    this.#memory = memory;
  }

  /** All readings, by the identities of skeletons. */
  all(): RememberedReadings {
    const entries = Object.entries(this.#texts()).map(([skeleton, text]) => [skeleton, decodeReading(text)] as const);
    return Object.fromEntries(entries.filter((entry): entry is [string, FileReading] => entry[1] !== undefined));
  }

  /** Stores the reading of a skeleton, without the floor and the exchange of sides, which differ from file to file. */
  keep(skeleton: string, { floor: _, swapSides: __, ...reading }: FileReading): void {
    const { [skeleton]: ___, ...others } = this.#texts();
    const text = encodeReading(reading);
    const known = Object.entries(text === "" ? others : { ...others, [skeleton]: text });
    this.#write(Object.fromEntries(known.slice(-MOST)));
  }

  #texts(): Record<string, string> {
    if (this.#unkept) return this.#unkept;
    try {
      const kept: unknown = JSON.parse(this.#memory().getItem(KEY) ?? "{}");
      const entries = typeof kept === "object" && kept !== null ? Object.entries(kept) : [];
      return Object.fromEntries(entries.filter((entry): entry is [string, string] => typeof entry[1] === "string"));
    } catch {
      return {};
    }
  }

  #write(texts: Record<string, string>): void {
    try {
      this.#memory().setItem(KEY, JSON.stringify(texts));
      this.#unkept = undefined;
      void askToPersist();
    } catch {
      this.#unkept = texts;
    }
  }
}
