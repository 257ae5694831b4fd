/** The loop between the browser's repaints and the engine, and the easing of style changes. */
import { afterEach, beforeEach, expect, test, vi } from "vitest";
import type { LiveFrame, StylizeOptions } from "../client/protocol";
import { EasedStyles, type StyledStream } from "../client/server/eased_styles";
import { DEFAULT_OPTIONS } from "../engine/types";
import { Playback } from "./playback";

const FRAME_MS = 1000 / 60;

/** Repaints, one at a time. */
let repaint: (() => void) | undefined;
let nowMs: number;
let settled: boolean;
/** The weights of each `configure`, and the engine's current weight of the style. */
let told: number[];
let weight: number;
let playback: Playback;

const wanted = (proud: number): StylizeOptions => ({ ...DEFAULT_OPTIONS, styles: { proud } });

beforeEach(() => {
  [repaint, nowMs, settled, told, weight] = [undefined, 0, false, [], 0];
  vi.spyOn(performance, "now").mockImplementation(() => nowMs);
  vi.stubGlobal("requestAnimationFrame", (act: FrameRequestCallback) => {
    repaint = () => act(nowMs);
    return 1;
  });
  vi.stubGlobal("cancelAnimationFrame", () => {});
  // A fake engine that eases as a session does: frame by frame while it plays, and at once while paused.
  const stream = {
    weightsOf: ({ proud = 0 }) => Float32Array.of(proud),
    setWeights: ([proud]: Float32Array) => {
      weight = proud!;
    },
    setPartWeights: () => {},
  } as unknown as StyledStream;
  const eased = new EasedStyles(stream, wanted(0));
  const step = async (dtSecs: number) => {
    if (dtSecs > 0) eased.ease(0, dtSecs);
    else eased.arrive(0);
    return {} as LiveFrame;
  };
  playback = new Playback(
    {
      step,
      seek: () => step(0),
      configure: async (options) => {
        told.push(options.styles.proud!);
        eased.targets = eased.targetsOf(options);
      },
    },
    {
      onFrame: () => {},
      onTick: () => {},
      onError: (error) => {
        throw error;
      },
      onSettled: () => {
        settled = true;
      },
    },
  );
  playback.options = wanted(0);
  playback.start();
});
afterEach(() => {
  vi.unstubAllGlobals();
  vi.restoreAllMocks();
});

/** Repaints until a condition is true. Returns the time this took, seconds. */
async function until(holds: () => boolean): Promise<number> {
  const from = nowMs;
  while (!holds() && nowMs - from < 3000) {
    nowMs += FRAME_MS;
    repaint!();
    await new Promise((resolve) => setTimeout(resolve, 0));
  }
  return (nowMs - from) / 1000;
}

test("a change of style is half there after its half-life while it plays, and is told once", async () => {
  playback.playing = true;
  await until(() => settled);
  [told, settled] = [[], false];
  playback.options = wanted(1);
  expect(await until(() => weight >= 0.5)).toBeCloseTo(0.1, 1);
  expect(await until(() => weight >= 0.95)).toBeLessThan(0.4);
  expect(playback.settled).toBe(false);
  await until(() => settled);
  expect(weight).toBe(1);
  expect(told).toEqual([1]);
});

test("it takes as long while it stands", async () => {
  await until(() => settled);
  [told, settled] = [[], false];
  playback.options = wanted(1);
  expect(await until(() => weight >= 0.5)).toBeCloseTo(0.1, 1);
  await until(() => settled);
  expect([weight, told.at(-1)]).toEqual([1, 1]);
});

test("what stops on the way arrives, so that a link to it has the same pose", async () => {
  playback.playing = true;
  await until(() => settled);
  settled = false;
  playback.options = wanted(1);
  await until(() => weight >= 0.5);
  playback.playing = false;
  await until(() => playback.upToDate);
  expect(weight).toBe(1);
});
