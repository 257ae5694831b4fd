/** A second engine with the trained methods, kd-trees and the real counterparts, which the engine of Play does not have. */

import type { StrutClient } from "../../../client/client";
import { createCompareClient } from "../../../client/compare/client";
import {
  type CallOptions,
  type DatabaseSource,
  isFault,
  type Performed,
  type SearchFigures,
  type StyleWeights,
  type StylizeOptions,
} from "../../../client/protocol";
import type { Session } from "../../../player/session";
import { mixed, shares } from "./counterpart";

/** The objects open in Play that this engine opens, too. */
export type OpenSources = Pick<Session, "database" | "databaseSource" | "inputName"> & {
  library: Pick<Session["library"], "source">;
};

export class BaselineClient {
  readonly #start: () => Promise<StrutClient>;
  #starting: Promise<StrutClient> | undefined;
  /** The objects open in the engine; empty after it failed, because it may have closed everything. */
  #database: DatabaseSource | undefined;
  #input = "";
  /** Open requests run one after another: the second one finds what the first has opened. */
  #opening: Promise<unknown> = Promise.resolve();
  /** Performances of the input by style; `undefined` for a style in which it was not performed. */
  readonly #counterparts = new Map<string, Performed | undefined>();

  /** @param start starts the engine on first use */
  constructor(start: () => Promise<StrutClient> = createCompareClient) {
    this.#start = start;
  }

  /** The whole input with options whose method only this engine has. */
  style(session: OpenSources, options: StylizeOptions, call: CallOptions) {
    return this.#ask(session, call, (client) => client.style(options, call));
  }

  /** The input as performed in a mixture of styles; `undefined` if it was not performed in one of them. */
  counterpart(session: OpenSources, weights: StyleWeights, call: CallOptions): Promise<Performed | undefined> {
    return this.#ask(session, call, async (client) => {
      const { styles, neutral } = session.database!;
      const performances: (Performed & { weight: number })[] = [];
      for (const { style, weight } of shares(weights, styles, neutral)) {
        if (!this.#counterparts.has(style)) this.#counterparts.set(style, await client.counterpart(style));
        const performed = this.#counterparts.get(style);
        if (!performed) return undefined;
        performances.push({ ...performed, weight });
      }
      return mixed(performances);
    });
  }

  /** Compares the search by kd-trees with the exact one over the whole input. */
  compareSearch(
    session: OpenSources,
    neighbours: number,
    candidates: number,
    call: CallOptions,
  ): Promise<SearchFigures | undefined> {
    return this.#ask(session, call, (client) => client.compareSearch(neighbours, candidates, call));
  }

  dispose(): void {
    this.#starting?.then(
      (client) => client.dispose(),
      () => {},
    );
    this.#starting = undefined;
    this.#forgetOpen();
  }

  /** Calls the engine after opening what the session has open. After a fault the next call opens everything again. */
  async #ask<T>(session: OpenSources, call: CallOptions, ask: (client: StrutClient) => Promise<T>): Promise<T> {
    try {
      return await ask(await this.#opened(session, call));
    } catch (error) {
      if (isFault(error)) this.#forgetOpen();
      throw error;
    }
  }

  #forgetOpen(): void {
    this.#database = undefined;
    this.#input = "";
    this.#counterparts.clear();
  }

  /** The engine with the database and the input of the session. */
  #opened(session: OpenSources, call: CallOptions): Promise<StrutClient> {
    const turn = this.#opening.then(() => this.#open(session, call));
    this.#opening = turn.catch(() => {});
    return turn;
  }

  async #open(session: OpenSources, call: CallOptions): Promise<StrutClient> {
    this.#starting ??= this.#start().catch((error) => {
      this.#starting = undefined;
      throw error;
    });
    const client = await this.#starting;
    const database = session.databaseSource!;
    const input = session.library.source(session.inputName)!;
    if (this.#database !== database) {
      this.#forgetOpen();
      await client.openDatabase(database, call);
      this.#database = database;
    }
    if (this.#input !== session.inputName) {
      this.#input = "";
      this.#counterparts.clear();
      await client.openInput(input, call);
      this.#input = session.inputName;
    }
    return client;
  }
}
