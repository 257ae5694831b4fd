import { Vector3 } from "three";
import { describe, expect, it } from "vitest";
import { ease, OrbitCamera } from "./orbit_camera";

describe("the glide's easing", () => {
  it("begins and ends still, and never turns back", () => {
    expect(ease(0)).toBeCloseTo(0, 5);
    expect(ease(1)).toBeCloseTo(1, 5);
    let last = 0;
    for (let t = 0.01; t <= 1; t += 0.01) {
      expect(ease(t)).toBeGreaterThanOrEqual(last);
      last = ease(t);
    }
  });

  it("is cubic-bezier(.2, 0, 0, 1): most of the way in the first half", () => {
    // At parameter s = 0.5 the curve is at time 0.2, value 0.5.
    expect(ease(0.2)).toBeCloseTo(0.5, 3);
  });
});

describe("a camera that does not follow", () => {
  const HOME = { azimuth: 0, elevation: 0.2, distance: 4 };
  const made = () => new OrbitCamera(new EventTarget() as HTMLElement, { home: HOME, distances: [1, 10], far: 100 });
  const at = (x: number) => new Vector3(x, 0, 0);
  /** The target after updates in which the followed point is at these positions. */
  const targetAfter = (camera: OrbitCamera, ...places: number[]) => {
    for (const x of places) camera.update(0.1, at(x), false);
    return camera.target.x;
  };

  it("looks at what it is settled on, and stays there", () => {
    const camera = made();
    camera.settle();
    expect(targetAfter(camera, 1, 2, 3)).toBe(1);
  });

  it("keeps looking at it until a glide is over, as it may move during the glide", () => {
    const camera = made();
    camera.settle();
    camera.orbitAt({ ...HOME, azimuth: 3 }, true);
    expect(targetAfter(camera, 1, 2, 3)).toBe(3);
    for (let i = 0; i < 100; i++) camera.update(0.1, at(4), false);
    expect(targetAfter(camera, 5)).toBe(4);
    camera.dispose();
  });
});
