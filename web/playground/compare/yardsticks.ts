/** What the engine that plays does not have: a second one with trained methods and counterparts, started when needed. */

import { createCompareClient } from "../../worker/compare/client";
import type {
  CallOptions,
  DatabaseSource,
  Performed,
  StrutClient,
  StyleWeights,
  StylizeOptions,
} from "../../worker/protocol";
import type { Session } from "../session";
import { mixed, shares } from "./counterpart";

export class Yardsticks {
  #starting: Promise<StrutClient> | undefined;
  /** What it has open. */
  #database: DatabaseSource | undefined;
  #input = "";
  readonly #counterparts = new Map<string, Performed | undefined>();

  /** The whole input in options whose method only this engine has. */
  async style(session: Session, options: StylizeOptions, call: CallOptions) {
    return (await this.#opened(session, call)).style(options, call);
  }

  /** The input as it really is in a mixture of styles; `undefined` where a style of it was never performed. */
  async counterpart(session: Session, weights: StyleWeights, call: CallOptions): Promise<Performed | undefined> {
    const { styles, neutral } = session.database!;
    const client = await this.#opened(session, call);
    const performances: (Performed & { weight: number })[] = [];
    for (const { style, weight } of shares(weights, styles, neutral)) {
      if (!this.#counterparts.has(style)) this.#counterparts.set(style, await client.counterpart(style));
      const performed = this.#counterparts.get(style);
      if (!performed) return undefined;
      performances.push({ ...performed, weight });
    }
    return mixed(performances);
  }

  dispose(): void {
    this.#starting?.then(
      (client) => client.dispose(),
      () => {},
    );
    this.#starting = undefined;
  }

  /** The engine with the database and the input of the session. */
  async #opened(session: Session, call: CallOptions): Promise<StrutClient> {
    this.#starting ??= createCompareClient().catch((error) => {
      this.#starting = undefined;
      throw error;
    });
    const client = await this.#starting;
    const database = session.databaseSource!;
    const input = session.library.source(session.inputName)!;
    if (this.#database !== database) {
      this.#input = "";
      await client.openDatabase(database, call);
      this.#database = database;
    }
    if (this.#input !== session.inputName) {
      this.#counterparts.clear();
      await client.openInput(input, call);
      this.#input = session.inputName;
    }
    return client;
  }
}
