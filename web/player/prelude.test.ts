import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { LiveFrame, ShownFrame } from "../client/protocol";
import { DEFAULT_OPTIONS } from "../engine/types";
import { restPose } from "../humanoid";
import { Playback } from "./playback";
import { Prelude } from "./prelude";

describe("the start of playback", () => {
  /** Runs the callbacks requested before the next repaint. */
  let repaint: (now: number) => void;
  beforeEach(() => {
    let waiting: FrameRequestCallback[] = [];
    vi.stubGlobal("requestAnimationFrame", (callback: FrameRequestCallback) => waiting.push(callback));
    vi.stubGlobal("cancelAnimationFrame", () => {});
    repaint = (now) => {
      vi.setSystemTime(now);
      const callbacks = waiting;
      waiting = [];
      for (const callback of callbacks) callback(now);
    };
    vi.useFakeTimers({ toFake: ["performance", "Date"], now: 0 });
  });
  afterEach(() => {
    vi.useRealTimers();
    vi.unstubAllGlobals();
  });

  /** A clip whose poses contain their frame index as the first number. */
  const CLIP = {
    frames: 600,
    rateHz: 60,
    poseAt(frame: number) {
      const pose = restPose();
      pose[0] = frame;
      return pose;
    },
  };

  /** An engine that continues from the requested frame, and answers only when the test releases it. */
  class SlowEngine {
    frame = 0;
    styles: object[] = [];
    readonly asked: string[] = [];
    private answers: (() => void)[] = [];

    async configure({ styles }: { styles: object }): Promise<void> {
      this.styles.push(styles);
    }

    seek(): Promise<LiveFrame> {
      throw new Error("nothing is sought");
    }

    step(secs: number): Promise<LiveFrame> {
      this.frame += 60 * secs;
      return this.answered("step");
    }

    continueFrom({ inputFrame }: ShownFrame): Promise<LiveFrame> {
      this.frame = inputFrame;
      return this.answered("continueFrom");
    }

    private answered(name: string): Promise<LiveFrame> {
      this.asked.push(name);
      const frame = { inputFrame: this.frame, ended: false, looped: false } as LiveFrame;
      return new Promise((resolve) => this.answers.push(() => resolve(frame)));
    }

    async answer(): Promise<void> {
      for (const resolve of this.answers.splice(0)) resolve();
      await new Promise((resolve) => setImmediate(resolve));
    }
  }

  it("goes from the clip to the engine's frames without going back or ahead", async () => {
    const engine = new SlowEngine();
    const shown: [by: string, frame: number][] = [];
    const playback = new Playback(engine, {
      onFrame: ({ inputFrame }) => shown.push(["engine", inputFrame]),
      onTick: () => {},
      onError: (error) => {
        throw error;
      },
      onSettled: () => {},
    });
    playback.playing = true;
    playback.startWith({
      prelude: new Prelude(CLIP, { neutral: 1 }),
      onFrame: ({ inputFrame }) => shown.push(["clip", inputFrame]),
      continueFrom: (frame) => engine.continueFrom(frame),
    });
    let now = 0;
    const wait = (frames: number) => {
      for (let i = 0; i < frames; i++) {
        now += 1000 / 60;
        repaint(now);
      }
    };
    wait(30);
    // Nothing can be drawn yet: the clip waits for its first image.
    expect(shown).toEqual([["clip", 0]]);
    playback.drawn();
    wait(30);
    expect(shown.at(-1)![1]).toBeCloseTo(30);
    expect(engine.asked).toEqual([]);
    playback.options = { ...DEFAULT_OPTIONS, styles: { proud: 1 } };
    // The engine takes 12 repaints to start, longer than a normal step may take.
    wait(12);
    expect(engine.asked).toEqual(["continueFrom"]);
    expect(engine.styles).toEqual([{ neutral: 1, proud: 0 }]);
    await engine.answer();
    wait(3);
    await engine.answer();
    for (let i = 0; i < 5; i++) {
      wait(1);
      await engine.answer();
    }
    expect(engine.asked.slice(1).every((name) => name === "step")).toBe(true);
    const steps = shown.slice(1).map(([, frame], i) => frame - shown[i]![1]);
    expect(Math.min(...steps)).toBeGreaterThan(-1e-6);
    expect(Math.max(...steps)).toBeLessThan(3.1);
    expect(shown.map(([by]) => by).lastIndexOf("clip")).toBe(shown.map(([by]) => by).indexOf("engine") - 1);
    // The engine eases the styles from those of the clip.
    expect(engine.styles.slice(1)).toEqual([{ proud: 1 }]);
  });
});
