/** Interface of a page for the tasks, in browsers that Playwright does not control. */

/** A point on the page, CSS pixels. */
export interface Place {
  x: number;
  y: number;
}

/** A pointer movement, pressed at `from` and released at `to`. */
export interface Drag {
  from: Place;
  to: Place;
}

/** A value that can be passed to and from a page. */
export type Plain = string | number | boolean | null | undefined | Plain[] | { [name: string]: Plain };

export interface BrowserPage {
  /** Name and version of the browser. */
  readonly browser: string;
  open(url: string): Promise<void>;
  /** Runs a function in the page. It may use only its arguments and the page. */
  evaluate<T, A extends Plain[]>(work: (...args: A) => T | Promise<T>, ...args: A): Promise<T>;
  click(at: Place, times?: 1 | 2): Promise<void>;
  drag(movement: Drag): Promise<void>;
  /** Presses a key, named as in `KeyboardEvent.key`. */
  press(key: string): Promise<void>;
  /** Takes a picture of the page, PNG. */
  picture(): Promise<Uint8Array>;
  close(): Promise<void>;
}

/** Number of movements of a drag. */
export const DRAG_STEPS = 10;

/** Window size of the pages. */
export const SIZE = { width: 1280, height: 800 };

/** Drops a file on a page. */
export const dropOn = (page: BrowserPage, name: string, content: string | Uint8Array): Promise<void> =>
  page.evaluate(
    (name, content) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([Uint8Array.from(atob(content), (c) => c.charCodeAt(0))], name));
      for (const type of ["dragenter", "dragover", "drop"]) {
        const at = { clientX: 5, clientY: 5, bubbles: true, cancelable: true };
        document.body.dispatchEvent(new DragEvent(type, { ...at, dataTransfer: transfer }));
      }
    },
    name,
    Buffer.from(content).toString("base64"),
  );
