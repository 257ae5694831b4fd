import { describe, expect, it } from "vitest";
import { Redraw } from "./redraw";

describe("a picture", () => {
  it("is settled when nothing has changed for a while since it was drawn", () => {
    const redraw = new Redraw();
    expect(redraw.settled(10)).toBe(false);
    redraw.drawn();
    expect(redraw.pending).toBe(false);
    expect(redraw.settled(10.5)).toBe(false);
    expect(redraw.settled(11)).toBe(true);
    redraw.request();
    expect(redraw.settled(11.1)).toBe(false);
  });

  it("that cannot be drawn for seconds still is drawn as it changed, not left as it was", () => {
    const redraw = new Redraw();
    redraw.drawn();
    expect(redraw.settled(5)).toBe(true);
    redraw.request();
    for (const secs of [6, 7, 8]) expect(redraw.settled(secs), "the graphics processor is busy").toBe(false);
    redraw.drawn();
    expect(redraw.settled(8.5)).toBe(false);
    expect(redraw.settled(9)).toBe(true);
  });
});
