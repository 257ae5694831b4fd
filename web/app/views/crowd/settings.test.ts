import { expect, test } from "vitest";
import { fromHash } from "../../state/state";
import { Store } from "../../state/store";
import { Settings } from "./settings";

const STYLES = { all: ["childlike", "neutral", "old", "proud"], neutral: "neutral" };

function opened(link: string) {
  const store = new Store(fromHash(link));
  const said: string[] = [];
  return { store, said, settings: new Settings(store, (sentence) => said.push(sentence)) };
}

test("without a field there is a first one, once the model is there", () => {
  const { settings, store, said } = opened("view=crowd");
  expect(settings.read(undefined).field).toEqual([]);
  expect(store.state.field).toBeUndefined();
  const { field } = settings.read(STYLES);
  expect(field.map(({ style }) => style)).toEqual(["proud", "old", "childlike"]);
  expect([store.state.field, store.canUndo, said]).toEqual([field, false, []]);
});

test("what a link says that cannot be is told, and what there was stays", () => {
  const { settings, store, said } = opened("people=performers&crowd=50_3&field=old_1_1_2_1&route=0_0;3_0");
  const before = settings.read(STYLES);
  const bad = fromHash(`people=dancers&crowd=0_1&field=old_NaN_1_2_1&route=1_1`);
  store.edit({ crowdKind: bad.crowdKind, crowd: bad.crowd, field: bad.field, route: bad.route });
  expect(settings.read(STYLES)).toEqual(before);
  expect(said.length).toBe(4);
  expect(said.slice(0, 2)).toEqual([
    expect.stringMatching(/“dancers” is invalid. Expected walkers or performers/),
    expect.stringMatching(/“0_1” is invalid. Expected 1 to 1,000 people/),
  ]);
  expect(store.state.field).toEqual(before.field);
  settings.read(STYLES);
  expect(said.length, "it is said once").toBe(4);
});

test("a first link that cannot be gives the defaults", () => {
  const { settings, said } = opened(`crowd=1001_1&field=${Array(13).fill("old_1_1_2_1").join(";")}`);
  const { people, field } = settings.read(STYLES);
  expect([people, field.length, said.length]).toEqual([{ count: 200, seed: 1 }, 3, 2]);
});

test("a style that the model lacks is told", () => {
  const { settings, store, said } = opened("field=mother_1_1_2_1");
  expect(settings.read(STYLES).field.length).toBe(3);
  expect(said).toEqual([expect.stringMatching(/no style “mother”; it has childlike, neutral, old, proud/)]);
  const kept = settings.read(STYLES).field;
  store.edit({ field: [{ style: "father", x: 0, z: 0, reach: 1, intensity: 1 }] });
  expect(settings.read(STYLES).field).toEqual(kept);
});

test("a field without a vertex stays one", () => {
  const { settings, said } = opened("field=none");
  expect([settings.read(STYLES).field, said]).toEqual([[], []]);
});
