/** What is open in the worker, by number. */
import { cancelled, StrutError } from "../../engine/errors";

/** A number that the client chose, or the key of something that the server made by itself. */
export type Key = number | string;

/** Something open that is freed by `dispose()`. */
export interface OpenThing {
  /** Keys of what it was made of, without which it is of no use. */
  readonly uses: readonly Key[];
  dispose(): void;
}

/** A class of open things, and what it is called in messages. */
interface Kind<T extends OpenThing> {
  readonly noun: string;
  new (...args: never[]): T;
}

export class Registry {
  readonly #things = new Map<Key, OpenThing>();

  /**
   * Takes over something that was opened.
   * @throws StrutError `cancelled` if what it uses was closed meanwhile, `bad-input` if its key is taken; it is then disposed of
   */
  add<T extends OpenThing>(key: Key, thing: T): T {
    if (this.#things.has(key) || !thing.uses.every((used) => this.#things.has(used))) {
      thing.dispose();
      throw this.#things.has(key)
        ? new StrutError({ code: "bad-input", message: `Number ${key} is already open.`, hint: "" })
        : cancelled();
    }
    this.#things.set(key, thing);
    return thing;
  }

  /** @throws StrutError `not-open` */
  get<T extends OpenThing>(kind: Kind<T>, key: Key): T {
    const thing = this.find(kind, key);
    if (thing) return thing;
    const { noun } = kind;
    throw new StrutError({ code: "not-open", message: `This ${noun} is not open.`, hint: `Open the ${noun} first.` });
  }

  find<T extends OpenThing>(kind: Kind<T>, key: Key): T | undefined {
    const thing = this.#things.get(key);
    return thing instanceof kind ? thing : undefined;
  }

  /** Whether something is still open. */
  has(thing: OpenThing): boolean {
    return [...this.#things.values()].includes(thing);
  }

  /** Closes something, after all that uses it. */
  close(key: Key): void {
    const thing = this.#things.get(key);
    if (!thing) return;
    this.#things.delete(key);
    for (const [user, { uses }] of [...this.#things]) if (uses.includes(key)) this.close(user);
    thing.dispose();
  }
}
