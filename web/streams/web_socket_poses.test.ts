/** Connections to senders, with a socket that the tests control. */
import { afterEach, beforeEach, describe, expect, test, vi } from "vitest";
import type { PoseSink } from "./pose_source";
import { addressOf, type SocketState, type StreamFormat, webSocketPoses } from "./web_socket_poses";

class FakeSocket {
  static opened: FakeSocket[] = [];
  onopen: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  onclose: (() => void) | null = null;
  closed = false;

  constructor(readonly url: URL) {
    FakeSocket.opened.push(this);
  }

  close(): void {
    this.closed = true;
  }
}

beforeEach(() => {
  FakeSocket.opened = [];
  vi.useFakeTimers();
  vi.stubGlobal("WebSocket", FakeSocket);
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

const socket = () => FakeSocket.opened.at(-1)!;

function started(format: StreamFormat = "json") {
  const said: unknown[] = [];
  const states: SocketState[] = [];
  const sink: PoseSink = {
    skeleton: (skeleton) => said.push(skeleton.kind),
    frame: (secs, pose) => said.push([secs, ...pose]),
    lost: (why) => said.push(why),
  };
  const ending = new AbortController();
  let refused = 0;
  const source = webSocketPoses("ws://127.0.0.1:39541", {
    format,
    onState: (state) => states.push(state),
    onRefused: (count) => {
      refused = count;
    },
  });
  const ended = source.start(sink, ending.signal);
  return { said, states, ending, ended, refused: () => refused };
}

describe("an address", () => {
  test.each([
    "ws://127.0.0.1:39541",
    "ws://127.4.5.6",
    "ws://localhost:1/path",
    "ws://pose.localhost",
    "ws://[::1]:8080",
    "wss://mocap.example",
  ])("%s may be connected to", (url) => {
    expect(addressOf(url).href).toContain(url);
  });

  test.each([
    ["ws://192.168.0.7", /works only for this computer/],
    ["ws://127.0.0.1.example", /works only for this computer/],
    ["ws://localhost.example", /works only for this computer/],
    ["http://127.0.0.1", /not the URL of a WebSocket/],
    ["127.0.0.1:39541", /not/],
    ["", /not a URL/],
  ])("%s may not", (url, why) => {
    expect(() => addressOf(url)).toThrow(why);
  });

  test("and a format must be known", () => {
    expect(() => webSocketPoses("wss://a.example", { format: "osc" as "json" })).toThrow("There is no format 'osc'.");
  });
});

describe("a connection", () => {
  test("gives what is sent, counts what cannot be read, and ends with the signal", async () => {
    const { said, states, ending, ended, refused } = started();
    socket().onopen!();
    socket().onmessage!({ data: '{"t":2,"p":[1,2,3],"q":[]}' });
    socket().onmessage!({ data: '{"strut":1,"names":["a"],"parents":[-1],"offsets":[[0,0,0]]}' });
    for (const data of ["?", new ArrayBuffer(8), " ".repeat(65_508)]) socket().onmessage!({ data });
    expect(said).toEqual(["humanoid", [2, 1, 2, 3], "joints"]);
    expect(states.map(({ kind }) => kind)).toEqual(["connecting", "open"]);
    expect(refused()).toBe(3);
    ending.abort();
    await ended;
    expect(socket().closed).toBe(true);
    expect(socket().onmessage).toBeNull();
    expect(FakeSocket.opened).toHaveLength(1);
  });

  test("is tried again after 1, 2, 4 … 30 s, and after 1 s where there was one", async () => {
    const { said, states, ending, ended } = started();
    const waits: number[] = [];
    const fail = async () => {
      socket().onclose!();
      await vi.advanceTimersByTimeAsync(0);
      const state = states.at(-1)!;
      if (state.kind !== "waiting") throw new Error(state.kind);
      waits.push(state.secs);
      const before = FakeSocket.opened.length;
      await vi.advanceTimersByTimeAsync(1000 * state.secs - 1);
      expect(FakeSocket.opened).toHaveLength(before);
      await vi.advanceTimersByTimeAsync(1);
      expect(FakeSocket.opened).toHaveLength(before + 1);
    };
    for (let i = 0; i < 7; i++) await fail();
    expect(waits).toEqual([1, 2, 4, 8, 16, 30, 30]);
    expect(said.at(-1)).toBe("No sender answers at 127.0.0.1:39541; trying again in 30 s.");
    socket().onopen!();
    await fail();
    expect(waits.at(-1)).toBe(1);
    expect(said.at(-1)).toBe("The connection to 127.0.0.1:39541 has ended; trying again in 1 s.");
    ending.abort();
    await ended;
  });

  test("is not tried again once the signal has aborted, not even while it waits", async () => {
    const { ending, ended } = started();
    socket().onclose!();
    await vi.advanceTimersByTimeAsync(500);
    ending.abort();
    await ended;
    await vi.advanceTimersByTimeAsync(60_000);
    expect(FakeSocket.opened).toHaveLength(1);
  });

  test("of channels gives them at the time of their arrival", () => {
    const { said } = started("bvh");
    vi.setSystemTime(0);
    socket().onopen!();
    socket().onmessage!({ data: "HIERARCHY" });
    socket().onmessage!({ data: "0 Avatar 7 8 ||" });
    expect(said[0]).toBe("bvh");
    expect(said[1]).toEqual([expect.any(Number), 7, 8]);
  });
});
