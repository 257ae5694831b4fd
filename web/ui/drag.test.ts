import { beforeEach, describe, expect, it } from "vitest";
import { listenToDrags } from "./drag";

/** A fake element and document with the properties that a drag uses. */
class FakeElement extends EventTarget {
  readonly ownerDocument = new EventTarget();
  readonly captured = new Set<number>();
  setPointerCapture(pointer: number): void {
    this.captured.add(pointer);
  }
  hasPointerCapture(pointer: number): boolean {
    return this.captured.has(pointer);
  }
  releasePointerCapture(pointer: number): void {
    this.captured.delete(pointer);
  }
}

let element: FakeElement;
let log: string[];
const pointer = (type: string, properties: { pointerId?: number; button?: number; clientX?: number } = {}) =>
  element.dispatchEvent(Object.assign(new Event(type), { pointerId: 1, button: 0, clientX: 0, ...properties }));
const key = (name: string) => {
  const event = Object.assign(new Event("keydown", { cancelable: true }), { key: name });
  element.ownerDocument.dispatchEvent(event);
  return event;
};
const listen = (signal?: AbortSignal) =>
  listenToDrags(
    element as unknown as HTMLElement,
    ({ clientX }) => {
      if (clientX < 0) return undefined;
      log.push(`begin ${clientX}`);
      return {
        move: (event) => log.push(`move ${event.clientX}`),
        cancel: () => log.push("cancel"),
        end: () => log.push("end"),
      };
    },
    signal,
  );

beforeEach(() => {
  element = new FakeElement();
  log = [];
});

describe("a drag", () => {
  it("lasts from the press to the release, with the pointer captured", () => {
    listen();
    pointer("pointermove", { clientX: 1 });
    pointer("pointerdown", { clientX: 2 });
    expect(element.captured).toEqual(new Set([1]));
    pointer("pointermove", { clientX: 3 });
    pointer("pointerup");
    pointer("lostpointercapture");
    pointer("pointermove", { clientX: 4 });
    expect(log).toEqual(["begin 2", "move 3", "end"]);
    pointer("pointerdown", { clientX: 5 });
    expect(log.at(-1)).toBe("begin 5");
  });

  it("belongs to one pointer and to the primary button", () => {
    listen();
    pointer("pointerdown", { button: 2 });
    pointer("pointerdown");
    pointer("pointerdown", { pointerId: 2, clientX: 9 });
    pointer("pointermove", { pointerId: 2, clientX: 9 });
    pointer("pointerup", { pointerId: 2 });
    pointer("pointermove", { clientX: 1 });
    expect(log).toEqual(["begin 0", "move 1"]);
  });

  it("captures nothing where there is nothing to drag", () => {
    listen();
    pointer("pointerdown", { clientX: -1 });
    pointer("pointermove", { clientX: 1 });
    expect(element.captured.size).toBe(0);
    expect(log).toEqual([]);
  });

  for (const type of ["pointercancel", "lostpointercapture"])
    it(`ends once with ${type}`, () => {
      listen();
      pointer("pointerdown");
      pointer(type);
      pointer("pointerup");
      expect(log).toEqual(["begin 0", "end"]);
    });

  it("is undone by Escape, which nobody else hears", () => {
    listen();
    let heard = 0;
    element.ownerDocument.addEventListener("keydown", () => heard++);
    pointer("pointerdown");
    pointer("pointermove", { clientX: 7 });
    expect(key("a").defaultPrevented).toBe(false);
    expect(key("Escape").defaultPrevented).toBe(true);
    expect(log).toEqual(["begin 0", "move 7", "cancel", "end"]);
    expect(element.captured.size).toBe(0);
    pointer("pointermove", { clientX: 8 });
    expect(key("Escape").defaultPrevented).toBe(false);
    expect(log).toHaveLength(4);
  });

  it("ends with the view that it is in", () => {
    const view = new AbortController();
    listen(view.signal);
    pointer("pointerdown");
    view.abort();
    expect(log).toEqual(["begin 0", "end"]);
    pointer("pointerdown", { clientX: 1 });
    expect(log).toHaveLength(2);
  });
});
