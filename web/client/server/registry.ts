/** The open objects of the worker, by key. */
import { cancelled, StrutError } from "../../engine/errors";

/** An id that the client chose, or the key of an object that the server made itself. */
export type Key = number | string;

/** An open object that is freed by `dispose()`. */
export interface OpenThing {
  /** Keys of the objects it was made from, without which it cannot be used. */
  readonly uses: readonly Key[];
  dispose(): void;
}

/** A class of open objects, and its name in messages. */
interface Kind<T extends OpenThing> {
  readonly noun: string;
  new (...args: never[]): T;
}

export class Registry {
  readonly #things = new Map<Key, OpenThing>();

  /**
   * Takes ownership of an opened object.
   * @throws StrutError `cancelled` if an object it uses was closed meanwhile, `bad-input` if its key is in use; the
   * object is then disposed of
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

  /** Whether an object is still open. */
  has(thing: OpenThing): boolean {
    return [...this.#things.values()].includes(thing);
  }

  /** Closes an object, after all objects that use it. */
  close(key: Key): void {
    const thing = this.#things.get(key);
    if (!thing) return;
    this.#things.delete(key);
    for (const [user, { uses }] of [...this.#things]) if (uses.includes(key)) this.close(user);
    thing.dispose();
  }
}
