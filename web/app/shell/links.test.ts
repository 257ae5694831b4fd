import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { linkedFile, pack, unpack } from "../../link/linked_file";
import { InputLibrary } from "../../player/input_library";
import { initialState } from "../state/state";
import { Store } from "../state/store";
import { AddressBar, linkTo, stateOfLink } from "./links";

const text = "HIERARCHY\nROOT Hips\n".repeat(200);
const bytes = new TextEncoder().encode(text).buffer;

describe("a file in a link", () => {
  it("comes back as it was, and much smaller on the way", async () => {
    const packed = await pack(bytes);
    expect(packed).toMatch(/^[\w-]+$/);
    expect(packed.length).toBeLessThan(text.length / 10);
    expect(new TextDecoder().decode(await unpack(packed))).toBe(text);
  });

  it("is found beside the state, with its name", async () => {
    const hash = `#styles=old:1&file=${encodeURIComponent("my ~ walk")}~${await pack(bytes)}`;
    const file = await linkedFile(hash);
    expect(file?.name).toBe("my ~ walk");
    expect(file?.bytes.byteLength).toBe(bytes.byteLength);
  });

  it("is passed over where it is damaged or not there", async () => {
    expect(await linkedFile("#styles=old:1")).toBeUndefined();
    expect(await linkedFile("#file=walk~!!!")).toBeUndefined();
    const bomb = await pack(new ArrayBuffer(30_000_000));
    expect(await linkedFile(`#file=walk~${bomb.slice(0, 20_000)}`)).toBeUndefined();
    expect(bomb.length).toBeGreaterThan(24_000);
    expect(await linkedFile(`#file=walk~${bomb}`)).toBeUndefined();
  });
});

describe("a link", () => {
  it("carries a small file, says that a large one is missing, and needs none for a built-in input", async () => {
    const library = new InputLibrary();
    const noise = Uint8Array.from({ length: 40_000 }, (_, i) => (i * i * 2_654_435_761) >>> 13).buffer;
    const [small, large] = [await library.add("small.bvh", bytes), await library.add("large.bvh", noise)];
    const link = (input: string) => linkTo({ ...initialState(), input }, library, "https://strut.example/#old");
    const carrying = await link(small);
    expect(carrying.carried).toBe(true);
    expect((await linkedFile(new URL(carrying.href).hash))?.name).toBe("small");
    expect(await link(large)).toEqual({ href: "https://strut.example/#input=large", carried: false });
    expect(await link("run")).toEqual({ href: "https://strut.example/#input=run", carried: undefined });
  });

  it("plays by itself, but not for people who asked for less motion", () => {
    expect(stateOfLink("#k=50", false)).toMatchObject({ playing: true, k: 50 });
    expect(stateOfLink("#k=50", true)).toMatchObject({ playing: false, k: 50 });
  });
});

/** A fake of the browser's history. */
class FakeHistory {
  entries: { state: unknown; hash: string }[] = [{ state: null, hash: "" }];
  at = 0;

  get state(): unknown {
    return this.entries[this.at]!.state;
  }

  pushState(state: unknown, _: string, url?: string | URL | null): void {
    this.entries.splice(++this.at, Number.POSITIVE_INFINITY, { state, hash: String(url) });
  }

  replaceState(state: unknown, _: string, url?: string | URL | null): void {
    this.entries[this.at] = { state, hash: url === undefined ? this.entries[this.at]!.hash : String(url) };
  }
}

describe("the address bar", () => {
  beforeEach(() => {
    vi.useFakeTimers();
    vi.stubGlobal("location", { pathname: "/", search: "" });
    vi.stubGlobal("matchMedia", () => ({ matches: false }));
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  function opened() {
    const history = new FakeHistory();
    const store = new Store(initialState());
    const bar = new AddressBar(store, history);
    store.subscribe(() => bar.write());
    /** Moves to another entry, as the browser's buttons do. */
    const go = (by: number) => {
      history.at += by;
      store.edit(bar.arrive(history.entries[history.at]!.hash.replace("/", "")));
    };
    /** Follows a link that was entered in the address bar. */
    const follow = (hash: string) => {
      history.pushState(null, "", hash);
      store.edit(bar.arrive(hash));
    };
    return { history, store, bar, go, follow, hashes: () => history.entries.map(({ hash }) => hash) };
  }

  it("has an entry a view, and one for all else that is done there", () => {
    const { store, hashes } = opened();
    store.edit({ k: 50 });
    vi.runAllTimers();
    store.edit({ view: "walk" });
    store.edit({ walkStride: 70 });
    vi.runAllTimers();
    expect(hashes()).toEqual(["#k=50", "#k=50&view=walk&stride=70"]);
  });

  it("has at once what is done after a rest, and soon what follows it", () => {
    const { store, bar, hashes } = opened();
    store.edit({ k: 50 });
    expect(hashes()).toEqual(["#k=50"]);
    store.edit({ k: 51 });
    store.edit({ k: 52 });
    expect(hashes()).toEqual(["#k=50"]);
    vi.advanceTimersByTime(200);
    expect(hashes()).toEqual(["#k=52"]);
    store.edit({ k: 53 });
    bar.flush();
    expect(hashes(), "the page is left").toEqual(["#k=53"]);
    vi.runAllTimers();
    store.edit({ k: 54 });
    expect(hashes()).toEqual(["#k=54"]);
  });

  it("goes back to the view before and keeps what was done since", () => {
    const { store, go, history } = opened();
    store.edit({ view: "walk" });
    store.edit({ walkStride: 70 });
    go(-1);
    vi.runAllTimers();
    expect([store.state.view, store.state.walkStride]).toEqual(["play", 70]);
    expect(history.entries.length).toBe(2);
    go(1);
    expect([store.state.view, history.entries.length]).toEqual(["walk", 2]);
  });

  it("has an entry a lesson, and goes back to the one before", () => {
    const { store, go, history } = opened();
    store.edit({ view: "learn", lesson: "near" });
    store.edit({ beat: 2 });
    vi.runAllTimers();
    store.edit({ lesson: "mix", beat: 0 });
    store.edit({ walkStride: 70 });
    go(-1);
    vi.runAllTimers();
    expect(store.state).toMatchObject({ view: "learn", lesson: "near", beat: 2, walkStride: 70 });
    expect(history.entries.length).toBe(3);
  });

  it("can be left by Back where it was redirected", () => {
    const { store, bar, go, hashes, history } = opened();
    store.edit({ view: "walk" });
    bar.redirect({ view: "learn" });
    vi.runAllTimers();
    expect(hashes()).toEqual(["/", "#view=learn"]);
    go(-1);
    vi.runAllTimers();
    expect([store.state.view, history.entries.length]).toEqual(["play", 2]);
  });

  it("leaves a link alone that is followed while the address waits to be written", () => {
    const { store, history, hashes } = opened();
    store.edit({ k: 50 });
    history.pushState(null, "", "#k=9");
    vi.runAllTimers();
    expect(hashes().at(-1)).toBe("#k=9");
    expect(history.state, "its event is still to come").toBeNull();
  });

  it("leaves the entry alone that was gone to while the address waits to be written", () => {
    const { store, history, bar, hashes } = opened();
    store.edit({ view: "walk" });
    store.edit({ walkStride: 70 });
    history.at = 0;
    bar.leave();
    vi.runAllTimers();
    expect(hashes()[0], "its event is still to come").toBe("/");
  });

  it("takes all of a link that is followed, and all of what was before it on the way back", () => {
    const { store, go, follow } = opened();
    store.edit({ k: 50 });
    vi.runAllTimers();
    follow("#k=9&view=walk");
    vi.runAllTimers();
    expect([store.state.k, store.state.view]).toEqual([9, "walk"]);
    go(-1);
    expect([store.state.k, store.state.view]).toEqual([50, "play"]);
  });
});
