import { describe, expect, it } from "vitest";
import { onePass, type PassFrame } from "./one_pass";

/** The frames of one pass over a range of five frames; playback loops from call `loops` on. */
async function recorded(loops: number): Promise<number[]> {
  let [calls, frame] = [0, 0];
  const advance = async (): Promise<PassFrame> => {
    if (calls > 50) throw new Error("it never ends");
    const isLooping = calls++ >= loops;
    const looped = isLooping && frame === 4;
    frame = looped ? 0 : Math.min(4, frame + 1);
    return { inputFrame: frame, looped, ended: !isLooping && frame === 4 };
  };
  const frames = [];
  for await (const { inputFrame } of onePass(advance)) frames.push(inputFrame);
  return frames;
}

describe("a pass", () => {
  it("ends with the range", async () => {
    expect(await recorded(Number.POSITIVE_INFINITY)).toEqual([1, 2, 3, 4]);
  });

  it("ends with the range where the loop is switched on meanwhile", async () => {
    expect(await recorded(2)).toEqual([1, 2, 3, 4]);
  });
});
