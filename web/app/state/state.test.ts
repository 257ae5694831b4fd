import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { engineOptions } from "../../link/engine_options";
import { PLAY_RANGES } from "../../link/play";
import { LENGTH_RANGE } from "./key_style";
import { type AppState, fromHash, initialState, toHash } from "./state";
import { Store } from "./store";

import { INTENSITY_RANGE } from "./walk";

const state = (patch: Partial<AppState>): AppState => ({ ...initialState(), ...patch });

describe("state ↔ URL", () => {
  it("writes nothing for the defaults and reads nothing as the defaults", () => {
    expect(toHash(initialState())).toBe("");
    expect(fromHash("")).toEqual(initialState());
  });

  it("stays readable", () => {
    const styles = [
      { name: "proud", weight: 0.62 },
      { name: "not confident", weight: 0.38 },
    ];
    expect(toHash(state({ styles, loop: false }))).toBe("styles=proud:0.62,not%20confident:0.38&loop=0");
  });

  it("comes back from the URL whatever is chosen", () => {
    const digits = (n: number, d: number) => Number(n.toFixed(d));
    const name = fc.stringMatching(/^[^:,;~]+$/);
    const styles = fc.uniqueArray(
      fc.record({ name, weight: fc.double({ min: -1, max: 2, noNaN: true }).map((w) => digits(w, 3) + 0) }),
      { minLength: 1, maxLength: 9, selector: (s) => s.name },
    );
    const track = fc
      .uniqueArray(fc.record({ frame: fc.nat(9999), styles }), { maxLength: 4, selector: (key) => key.frame })
      .map((keys) => keys.sort((a, b) => a.frame - b.frame));
    const inRange = ({ min, max, digits: d }: { min: number; max: number; digits: number }) =>
      fc.double({ min, max, noNaN: true }).map((n) => digits(n, d) + 0);
    const patch = fc.record({
      styles,
      parts: fc.dictionary(fc.constantFrom("head", "legs"), styles, { noNullPrototype: true }),
      track,
      range: fc.option(
        fc.tuple(fc.nat(500), fc.integer({ min: 1, max: 500 })).map(([first, n]) => ({ first, last: first + n })),
        { nil: undefined },
      ),
      atlasWindows: fc.option(
        fc.tuple(fc.nat(99_999), fc.integer({ min: 1, max: 99_999 })).map(([first, n]) => ({ first, last: first + n })),
        { nil: undefined },
      ),
      walk: fc.array(
        fc.record({
          styles,
          intensity: inRange(INTENSITY_RANGE),
          steps: fc.integer({ min: 1, max: 16 }),
          transition: fc.integer({ min: 0, max: 8 }),
        }),
        { maxLength: 12 },
      ),
      walkTempo: fc.constantFrom("model", "sampled", "fixed"),
      walkStride: fc.integer({ min: 60, max: 130 }),
      walkTurn: fc.integer({ min: -10, max: 10 }),
      keySet: fc.constantFrom("walk", "open/run", "files"),
      keyClips: fc.array(fc.stringMatching(/^[^;]+$/), { maxLength: 4 }),
      keyAxes: fc.uniqueArray(fc.constantFrom("hips_height", "hand_l.y - hips.y", "max(speed, 1)"), { maxLength: 3 }),
      keyHandle: fc.array(inRange({ min: -200, max: 200, digits: 2 }), { maxLength: 3 }),
      keyLength: inRange(LENGTH_RANGE),
      keyMethod: fc.constantFrom("style" as const, "all" as const),
      other: fc.string(),
      input: fc.string(),
      intensity: inRange(PLAY_RANGES.intensity),
      lambda: inRange(PLAY_RANGES.lambda),
      k: fc.integer({ min: 5, max: 160 }),
      timing: fc.boolean(),
      wholePolygon: fc.boolean(),
      camera: fc.constantFrom("orbit" as const, "top" as const),
    });
    fc.assert(
      fc.property(patch, (p) => {
        expect(fromHash(`#${toHash(state(p))}`)).toEqual(state(p));
      }),
    );
  });

  it("passes over what it does not know and keeps numbers in range", () => {
    expect(fromHash("#nonsense&camera=sideways&k=many&styles=x")).toEqual(initialState());
    expect(fromHash("#k=9999&rho=-3")).toEqual(state({ k: 160, rho: 0 }));
  });
});

describe("a list in a link", () => {
  it("has an end: longer ones are passed over", () => {
    const track = (keys: number) => Array.from({ length: keys }, (_, i) => `${i}~old:1`).join(";");
    expect(fromHash(`#track=${track(1000)}`).track.length).toBe(1000);
    expect(fromHash(`#track=${track(1001)}`).track).toEqual([]);
    const clips = (count: number) => Array.from({ length: count }, (_, i) => `clip ${i}`).join(";");
    expect(fromHash(`#clips=${clips(1000)}`).keyClips.length).toBe(1000);
    expect(fromHash(`#clips=${clips(1001)}`).keyClips).toEqual([]);
  });
});

describe("what the engine is asked for", () => {
  it("has the specification's defaults", () => {
    expect(engineOptions(state({ styles: [{ name: "old", weight: 1 }], intensity: 0.5 }), "neutral")).toEqual({
      styles: { old: 0.5 },
      parts: {},
      track: [],
      k: 40,
      lambda: 0.1,
      rho: 0.7,
      kappa: 3,
      delta: 0.35,
      tempo: 0.5,
      coherence: true,
      timing: true,
      footplant: true,
      method: "mar",
      action: "",
      inputStyle: "",
    });
  });
});

describe("undo", () => {
  it("takes edits back and brings them again, one at a time", () => {
    const store = new Store(initialState());
    store.edit({ k: 50 });
    store.edit({ rho: 0.2 });
    store.undo();
    expect([store.state.k, store.state.rho]).toEqual([50, 0.7]);
    store.undo();
    expect([store.state.k, store.canUndo]).toEqual([40, false]);
    store.redo();
    store.redo();
    expect([store.state.k, store.state.rho, store.canRedo]).toEqual([50, 0.2, false]);
  });

  it("takes a whole gesture back at once, and leaves the view alone", () => {
    const store = new Store(initialState());
    for (const intensity of [1.1, 1.2, 1.3]) store.edit({ intensity }, "drag");
    store.edit({ ghost: "off" });
    store.endGesture();
    store.edit({ intensity: 1.4 }, "drag");
    store.undo();
    expect(store.state.intensity).toBe(1.3);
    store.undo();
    expect(store.state.intensity).toBe(1);
    expect(store.state.ghost).toBe("off");
  });

  it("knows nothing of a gesture that was cancelled", () => {
    const store = new Store(initialState());
    store.edit({ k: 50 });
    store.edit({ k: 60 });
    store.undo();
    for (const intensity of [1.1, 1.2]) store.edit({ intensity }, "drag");
    store.cancelGesture();
    expect(store.state).toEqual(state({ k: 50 }));
    expect([store.canUndo, store.canRedo]).toEqual([true, true]);
    store.redo();
    expect(store.state.k).toBe(60);
    store.cancelGesture();
    expect(store.state.k, "no gesture is under way").toBe(60);
  });

  it("knows nothing of a gesture that ended where it began", () => {
    const store = new Store(initialState());
    let said = false;
    store.subscribe(() => {
      said = store.canUndo;
    });
    for (const intensity of [1.2, 1]) store.edit({ intensity }, "drag");
    expect(said).toBe(true);
    store.endGesture();
    expect(said).toBe(false);
    for (const intensity of [1.2, 1.1]) store.edit({ intensity }, "drag");
    store.endGesture();
    store.endGesture();
    expect(store.canUndo).toBe(true);
  });

  it("forgets what was undone at the next edit, and an edit that changes nothing", () => {
    const store = new Store(initialState());
    store.edit({ k: 50 });
    store.undo();
    store.edit({ k: 40 });
    expect(store.canRedo).toBe(true);
    store.edit({ k: 60 });
    expect(store.canRedo).toBe(false);
  });

  it("tells listeners which fields changed", () => {
    const store = new Store(initialState());
    const seen: string[][] = [];
    const listening = new AbortController();
    store.subscribe((_, changed) => seen.push([...changed]), listening.signal);
    store.edit({ k: 50, rho: 0.7, ghost: "off" });
    store.undo();
    listening.abort();
    store.edit({ k: 7 });
    expect(seen).toEqual([["k", "ghost"], ["k"]]);
  });
});
