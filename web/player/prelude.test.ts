import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { LiveFrame, ShownFrame } from "../client/protocol";
import { loadBuiltIn } from "../engine/built_in";
import { Engine } from "../engine/engine";
import { DEFAULT_OPTIONS } from "../engine/types";
import { JOINTS, POSE_FLOATS, restPose } from "../humanoid";
import { FirstSteps } from "./first_steps";
import { Playback } from "./playback";
import { Prelude } from "./prelude";

describe("the first steps", () => {
  it("are the first built-in input, to a fifth of a degree and to two millimetres", async () => {
    const [engine, motions, steps] = await Promise.all([Engine.load(), loadBuiltIn(), FirstSteps.load()]);
    const database = engine.openDatabase({ kind: "demo", motions });
    const { info } = engine.openInput(database, { kind: "built-in", name: engine.inputsOf(motions)[0]!, motions });
    expect([steps.frames, steps.rateHz]).toEqual([info.frames, info.rateHz]);
    for (let frame = 0; frame < steps.frames; frame++) {
      const pose = steps.poseAt(frame);
      const input = info.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
      expect(Math.hypot(...[0, 1, 2].map((i) => pose[i]! - input[i]!))).toBeLessThan(0.002);
      for (let joint = 0; joint < JOINTS; joint++) {
        const at = 3 + 4 * joint;
        const dot = [0, 1, 2, 3].reduce((sum, i) => sum + pose[at + i]! * input[at + i]!, 0);
        expect((360 / Math.PI) * Math.acos(Math.min(1, Math.abs(dot)))).toBeLessThan(0.2);
      }
    }
    database.dispose();
  });
});

describe("the start of playback", () => {
  /** Runs the callbacks that were asked for before the next repaint. */
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

  /** A clip whose poses say by their first number which frame they are of. */
  const CLIP = {
    frames: 600,
    rateHz: 60,
    poseAt(frame: number) {
      const pose = restPose();
      pose[0] = frame;
      return pose;
    },
  };

  /** An engine that goes on from where it is told to, and answers when it is let. */
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
    expect(engine.asked).toEqual([]);
    playback.options = { ...DEFAULT_OPTIONS, styles: { proud: 1 } };
    // The engine takes 12 repaints to begin, longer than a step may be otherwise.
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
    // The styles are eased from those of the clip.
    const first = engine.styles[1] as { neutral: number };
    expect(first.neutral).toBeGreaterThan(0);
    expect(first.neutral).toBeLessThan(1);
  });
});
