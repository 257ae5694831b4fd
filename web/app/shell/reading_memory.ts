/** What a person said of how skeletons are read, kept by the browser for the next file with the same one. */
import type { FileReading, RememberedReadings } from "../../client/protocol";
import { decodeReading, encodeReading } from "../../link/reading";
import { askToPersist } from "../ui/storage";

/** Key in localStorage. */
const KEY = "strut readings";
/** Maximum number of skeletons; the one that was not spoken of for longest is forgotten first. */
const MOST = 100;

/** As much of `localStorage` as is needed. */
type Memory = Pick<Storage, "getItem" | "setItem">;

export class ReadingMemory {
  readonly #memory: () => Memory;
  /** What storage did not take lasts as long as the page. */
  #unkept: Record<string, string> | undefined;

  constructor(memory: () => Memory = () => localStorage) {
    this.#memory = memory;
  }

  /** What is known, by the identities of skeletons. */
  all(): RememberedReadings {
    const entries = Object.entries(this.#texts()).map(([skeleton, text]) => [skeleton, decodeReading(text)] as const);
    return Object.fromEntries(entries.filter((entry): entry is [string, FileReading] => entry[1] !== undefined));
  }

  /** Keeps what is said of a skeleton: neither where the floor is nor what is said against a guess, which differ from file to file. */
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
