import { afterEach, beforeEach, expect, it, vi } from "vitest";
import { Keyboard } from "./keyboard";

let window: EventTarget;
let life: AbortController;
let keyboard: Keyboard;

/** Presses or releases a key. */
function key(type: "keydown" | "keyup", code: string, held: { metaKey?: boolean } = {}): void {
  const event = new Event(type, { cancelable: true });
  const name = code.startsWith("Meta") ? "Meta" : code;
  window.dispatchEvent(Object.assign(event, { code, key: name, ...held }));
}

beforeEach(() => {
  window = new EventTarget();
  life = new AbortController();
  vi.stubGlobal("addEventListener", window.addEventListener.bind(window));
  vi.stubGlobal("document", Object.assign(new EventTarget(), { hidden: false, querySelector: () => null }));
  vi.stubGlobal("Element", class {});
  keyboard = new Keyboard(
    () => ({}),
    () => true,
    () => {},
    life.signal,
  );
});
afterEach(() => {
  life.abort();
  vi.unstubAllGlobals();
});

it("a direction lasts as long as its key is held", () => {
  key("keydown", "KeyW");
  expect(keyboard.wish).toEqual({ right: 0, ahead: 1, gait: 1 });
  key("keyup", "KeyW");
  expect(keyboard.wish).toBeUndefined();
});

it("Command releases held keys, as macOS sends no keyup for them while it is held", () => {
  key("keydown", "KeyW");
  key("keydown", "MetaLeft", { metaKey: true });
  expect(keyboard.wish).toBeUndefined();
});

it("keys are released when the window loses the focus or is hidden", () => {
  key("keydown", "KeyW");
  window.dispatchEvent(new Event("blur"));
  expect(keyboard.wish).toBeUndefined();
  key("keydown", "KeyA");
  Object.assign(document, { hidden: true });
  document.dispatchEvent(new Event("visibilitychange"));
  expect(keyboard.wish).toBeUndefined();
});
