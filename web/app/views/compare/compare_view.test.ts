/** The Compare view releases its resources, a second engine and a viewer, when they are no longer needed. */

import { afterEach, beforeEach, expect, it, vi } from "vitest";
import type { StrutClient } from "../../../client/client";
import { JOINTS, POSE_FLOATS } from "../../../humanoid";
import type { Session } from "../../../player/session";
import { Views } from "../../shell/views";
import { initialState } from "../../state/state";
import { Store } from "../../state/store";
import type { View, ViewHost } from "../../view";

/** An entry for every engine and viewer that was made and not disposed of. */
const held = vi.hoisted(() => new Set<string>());

vi.mock("../../../viewer/side_by_side_viewer", () => ({
  SideBySideViewer: class {
    still = false;
    constructor() {
      held.add("viewer");
    }
    setProportions() {}
    setFigures() {}
    settle() {}
    render() {}
    dispose() {
      held.delete("viewer");
    }
  },
}));

vi.mock("../../../client/compare/client", () => ({
  createCompareClient: async () => {
    held.add("engine");
    const client: Partial<StrutClient> = {
      openDatabase: async () => ({}) as never,
      openInput: async () => ({}) as never,
      counterpart: async () => undefined,
      dispose: () => void held.delete("engine"),
    };
    return client;
  },
}));

/** A fake element with the properties that the view uses. */
class FakeElement {
  value = "";
  hidden = false;
  disabled = false;
  textContent = "";
  readonly options: FakeElement[] = [];
  readonly dataset = {};
  readonly style = { setProperty: () => {} };
  readonly classList = { toggle: () => {} };
  getAttribute() {
    return null;
  }
  setAttribute() {}
  removeAttribute() {}
  append() {}
  replaceChildren() {}
  addEventListener() {}
  remove() {}
}

/** The page's next display frame. */
let draw: FrameRequestCallback | undefined;

const input = {
  poses: new Float32Array(POSE_FLOATS),
  contacts: new Uint8Array(2),
  frames: 1,
  rateHz: 60,
  durationSecs: 1 / 60,
};
const session = {
  database: { proportions: new Float32Array(3 * JOINTS), styles: ["neutral", "old"], neutral: "neutral" },
  databaseSource: { kind: "demo" },
  input,
  inputName: "walk",
  library: { builtIn: ["walk"], dropped: [], clips: [], isDropped: () => false, source: () => ({}) },
} as unknown as Session;

/** The Compare view as a view of a page, after its engine and its viewer were made. */
async function shownView() {
  const store = new Store({ ...initialState(), columns: ["input"], behind: "real" });
  const takeOver = vi.fn();
  const host = { store, session, playhead: { at: 0, takeOver }, toasts: { error: () => {} } };
  const other = { element: new FakeElement(), show() {}, hide() {}, dispose() {} } as unknown as View;
  const views = new Views(
    () => {},
    { host: () => host as unknown as ViewHost, onShow: () => {}, onRefused: (_, error) => expect.fail(String(error)) },
    [
      { name: "compare", load: () => import("./compare_view") },
      { name: "play", load: async () => ({ createView: () => other }) },
    ],
  );
  const view = (await views.show("compare"))!;
  await vi.advanceTimersByTimeAsync(1000);
  draw!(1000);
  expect(held).toEqual(new Set(["engine", "viewer"]));
  return { views, view, store, takeOver };
}

beforeEach(() => {
  // Yielding to other tasks uses a timer, too, which must continue.
  vi.useFakeTimers({ shouldAdvanceTime: true });
  held.clear();
  const create = () => new FakeElement();
  vi.stubGlobal("document", { createElement: create, createElementNS: create, body: new FakeElement() });
  vi.stubGlobal("matchMedia", () => ({ matches: false, addEventListener: () => {} }));
  vi.stubGlobal("requestAnimationFrame", (callback: FrameRequestCallback) => {
    draw = callback;
  });
  vi.stubGlobal("cancelAnimationFrame", () => {});
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

it("keeps its engine and its viewer for a minute out of sight, then releases both", async () => {
  const { views } = await shownView();
  await views.show("play");
  await vi.advanceTimersByTimeAsync(59_000);
  expect(held).toEqual(new Set(["engine", "viewer"]));
  await vi.advanceTimersByTimeAsync(2000);
  expect(held).toEqual(new Set());
});

it("releases its engine and its viewer where it is disposed of", async () => {
  const { view } = await shownView();
  view.dispose();
  await vi.advanceTimersByTimeAsync(0);
  expect(held).toEqual(new Set());
});

it("leaves the playhead where a link to another view puts it", async () => {
  const { views, store, takeOver } = await shownView();
  expect(store.state.playing).toBe(true);
  store.edit({ view: "play", playing: false, frame: 60 });
  await views.show("play");
  expect(takeOver.mock.lastCall).toEqual([60]);
  expect(store.state.frame).toBe(60);
});

it("stays within a shorter input", async () => {
  const { views, store, takeOver } = await shownView();
  const longer = { poses: new Float32Array(10 * POSE_FLOATS), contacts: new Uint8Array(20), frames: 10 };
  Object.assign(session, { input: { ...input, ...longer } });
  store.edit({ playing: false, frame: 9 });
  Object.assign(session, { input });
  store.edit({ speed: 2 });
  await views.show("play");
  expect(takeOver.mock.lastCall).toEqual([0]);
});
