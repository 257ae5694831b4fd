import { describe, expect, it } from "vitest";
import { engineOptions } from "../../link/engine_options";
import { type AppState, fromHash, initialState, toHash } from "./state";
import {
  addKey,
  chooseKey,
  moveKey,
  otherSide,
  partOf,
  plausibleIntensity,
  randomStyles,
  removeKey,
  shownStyles,
  stylesAt,
  withKnownLabels,
  withKnownStyles,
  withoutPart,
  withStyles,
} from "./style_settings";

const PROUD = [{ name: "proud", weight: 1 }];
const OLD = [{ name: "old", weight: 1 }];
const state = (patch: Partial<AppState> = {}): AppState => ({ ...initialState(), styles: PROUD, ...patch });
const patched = (before: AppState, patch: Partial<AppState>): AppState => ({ ...before, ...patch });

describe("a part of the body", () => {
  it("shows the whole body's styles until it has its own, and again when it gives them up", () => {
    const legs = state({ part: "legs" });
    expect(shownStyles(legs)).toBe(PROUD);
    const own = patched(legs, withStyles(legs, OLD, 0));
    expect([shownStyles(own), own.styles]).toEqual([OLD, PROUD]);
    expect(engineOptions(own, "neutral")).toMatchObject({ styles: { proud: 1 }, parts: { legs: { old: 1 } } });
    expect(shownStyles(patched(own, withoutPart(own, "legs")))).toBe(PROUD);
  });

  it("is found by any of its joints", () => {
    expect((["left_hand", "right_upper_arm", "left_toes", "right_upper_leg", "hips"] as const).map(partOf)).toEqual([
      "left_arm",
      "right_arm",
      "legs",
      "legs",
      "legs",
    ]);
    expect([partOf("neck"), partOf("spine")]).toEqual(["head", "torso"]);
  });
});

describe("the labels of the input", () => {
  const classes = [
    { action: "walk", style: "neutral", frames: 9 },
    { action: "run", style: "proud", frames: 9 },
  ];

  it("stay where the database has such a class, and go where it has none", () => {
    expect(withKnownLabels(state(), classes)).toBeUndefined();
    expect(withKnownLabels(state({ action: "run" }), classes)).toBeUndefined();
    expect(withKnownLabels(state({ action: "run", inputStyle: "neutral" }), classes)).toEqual({
      action: "",
      inputStyle: "",
    });
  });

  it("reach the engine", () => {
    expect(engineOptions(state({ action: "run" }), "neutral")).toMatchObject({ action: "run", inputStyle: "" });
  });
});

describe("the style track", () => {
  const one = patched(state(), addKey(state(), 30.4));
  const two = patched(patched(one, addKey(one, 90)), {});

  it("gets keys in the present styles, in the order of frames", () => {
    expect(one.track).toEqual([{ frame: 30, styles: PROUD }]);
    const earlier = patched(two, addKey(two, 10));
    expect(earlier.track.map((key) => key.frame)).toEqual([10, 30, 90]);
    expect(earlier.key).toBe(0);
    expect(addKey(two, 30)).toMatchObject({ key: 0 });
  });

  it("mixes what it has reached between its keys, and holds the first and the last", () => {
    const turning = state({
      track: [
        { frame: 10, styles: PROUD },
        { frame: 50, styles: OLD },
      ],
    });
    const at = (frame: number) => Object.fromEntries(stylesAt(turning, frame).map((s) => [s.name, s.weight]));
    expect([at(0), at(20), at(99)]).toEqual([{ proud: 1 }, { proud: 0.75, old: 0.25 }, { old: 1 }]);
    expect(stylesAt(state(), 20)).toBe(PROUD);
  });

  it("gives the key under the playhead the styles of the polygon", () => {
    const edited = patched(two, withStyles(two, OLD, 90));
    expect(edited.track.map((key) => key.styles)).toEqual([PROUD, OLD]);
    expect(chooseKey(edited, 0)).toMatchObject({ key: 0, styles: PROUD });
    // The last key was selected, but the playhead is at the first.
    const first = patched(two, withStyles(two, OLD, 31.5));
    expect([first.track.map((key) => key.styles), first.key]).toEqual([[OLD, PROUD], 0]);
  });

  it("makes a key where the polygon is moved between keys, and leaves the others as they are", () => {
    const proud = patched(state(), addKey(state(), 60));
    // Away from the key, old is selected; K then finds its key there.
    const old = patched(proud, withStyles(proud, OLD, 462));
    expect(old.track).toEqual([
      { frame: 60, styles: PROUD },
      { frame: 462, styles: OLD },
    ]);
    expect([old.key, old.styles]).toEqual([1, OLD]);
    expect(patched(old, addKey(old, 462)).track).toEqual(old.track);
  });

  it("gets keys in the styles that it has reached there", () => {
    const proud = patched(state(), addKey(state(), 0));
    const old = patched(proud, withStyles(proud, OLD, 100));
    const between = patched(old, addKey(old, 25));
    expect(between.track[1]!.styles).toEqual([
      { name: "proud", weight: 0.75 },
      { name: "old", weight: 0.25 },
    ]);
  });

  it("is not edited where there is no time line", () => {
    expect(withStyles(two, OLD, undefined)).toEqual({ styles: OLD });
  });

  it("moves a key only between its neighbours, and can be emptied", () => {
    expect(moveKey(two, 0, 200).track?.map((key) => key.frame)).toEqual([89, 90]);
    expect(moveKey(two, 1, -5).track?.map((key) => key.frame)).toEqual([30, 31]);
    const left = patched(two, removeKey(two, 1));
    expect([left.track.length, left.key]).toEqual([1, 0]);
    expect(patched(left, removeKey(left, 0))).toMatchObject({ track: [], styles: PROUD });
  });
});

describe("A and B", () => {
  it("begin alike and then each keep their own settings", () => {
    const b = patched(state(), otherSide(state()));
    expect([b.side, b.styles]).toEqual(["b", PROUD]);
    const edited = patched(b, { styles: OLD, k: 80, camera: "side" });
    const a = patched(edited, otherSide(edited));
    expect([a.side, a.styles, a.k, a.camera]).toEqual(["a", PROUD, 40, "side"]);
    expect(patched(a, otherSide(a))).toMatchObject({ side: "b", styles: OLD, k: 80 });
  });

  it("are both in the link", () => {
    const b = patched(state({ parts: { legs: OLD } }), otherSide(state()));
    expect(fromHash(toHash(b))).toEqual(b);
  });
});

it("chance takes different styles whose weights sum to 1", () => {
  for (let i = 0; i < 50; i++) {
    const mixed = randomStyles(["neutral", "proud", "old", "angry"]);
    expect(new Set(mixed.map((s) => s.name)).size).toBe(3);
    expect(mixed.reduce((sum, s) => sum + s.weight, 0)).toBeCloseTo(1, 2);
  }
  expect(randomStyles(["only"])).toEqual([{ name: "only", weight: 1 }]);
});

it("the plausible intensity ends where the heaviest weight is 1", () => {
  expect(plausibleIntensity([{ name: "old", weight: 0.5 }])).toEqual({ min: 0, max: 2 });
  expect(plausibleIntensity(PROUD)).toEqual({ min: 0, max: 1 });
});

it("another database drops what it does not know, everywhere", () => {
  const full = state({ parts: { legs: OLD }, track: [{ frame: 3, styles: OLD }] });
  expect(withKnownStyles(full, ["proud", "old"], PROUD)).toBeUndefined();
  expect(withKnownStyles(full, ["proud"], PROUD)).toMatchObject({
    styles: PROUD,
    parts: {},
    track: [{ frame: 3, styles: PROUD }],
  });
});
