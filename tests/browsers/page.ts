/** A page in a browser that Playwright does not drive, as the tasks use it. */

/** A place on the page, CSS pixels. */
export interface Place {
  x: number;
  y: number;
}

/** One movement of a pointer that is pressed at `from` and let go at `to`. */
export interface Drag {
  from: Place;
  to: Place;
}

/** A value that a page can take and give. */
export type Plain = string | number | boolean | null | undefined | Plain[] | { [name: string]: Plain };

export interface BrowserPage {
  /** Name and version of the browser. */
  readonly browser: string;
  open(url: string): Promise<void>;
  /** Runs a function in the page; it may use nothing but its arguments and the page. */
  evaluate<T, A extends Plain[]>(work: (...args: A) => T | Promise<T>, ...args: A): Promise<T>;
  click(at: Place, times?: 1 | 2): Promise<void>;
  drag(movement: Drag): Promise<void>;
  /** Presses a key by its name, as `KeyboardEvent.key` has it. */
  press(key: string): Promise<void>;
  /** A picture of the page, PNG. */
  picture(): Promise<Uint8Array>;
  close(): Promise<void>;
}

/** How many movements a drag is made of. */
export const DRAG_STEPS = 10;

/** The size of the window that the pages have. */
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
