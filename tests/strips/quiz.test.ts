// The quiz of film strips: the shuffling, the key, the answer sheet and the scoring.
import fc from "fast-check";
import { expect, test } from "vitest";
import { answerSheet, keyOf, mark } from "../../scripts/quiz.mjs";
import { generator, shuffled } from "../../scripts/random.mjs";

const STYLES = ["neutral", "proud", "angry"];
const ACTIONS = ["walk", "run", "jump", "kick"];
const seeds = fc.nat(2 ** 32 - 1);

test("shuffling is a permutation, the same for the same seed, and leaves its input", () => {
  fc.assert(
    fc.property(fc.array(fc.nat()), seeds, (items, seed) => {
      const before = [...items];
      const order = shuffled(items, generator(seed));
      expect([...order].sort()).toEqual([...items].sort());
      expect(shuffled(items, generator(seed))).toEqual(order);
      expect(items).toEqual(before);
    }),
  );
});

test("every item comes to every place about as often", () => {
  const rounds = 6000;
  const times = [0, 1, 2, 3].map(() => [0, 0, 0, 0]);
  for (let seed = 0; seed < rounds; seed++)
    for (const [place, item] of shuffled([0, 1, 2, 3], generator(seed)).entries()) times[item]![place]!++;
  for (const count of times.flat()) expect(Math.abs(count / rounds - 1 / 4)).toBeLessThan(0.03);
});

test("the order that a seed gives stays as it is, so that a quiz can be repeated", () => {
  expect(shuffled([0, 1, 2, 3, 4, 5, 6, 7], generator(7))).toEqual([4, 6, 1, 2, 3, 5, 7, 0]);
});

test("the key has every style of every action once, names without meaning in their order, and the seed", () => {
  fc.assert(
    fc.property(seeds, (seed) => {
      const key = keyOf(STYLES, ACTIONS, seed);
      expect(key.seed).toBe(seed);
      expect(key.strips.map(({ name }) => name)).toEqual([
        "01",
        "02",
        "03",
        "04",
        "05",
        "06",
        "07",
        "08",
        "09",
        "10",
        "11",
        "12",
      ]);
      const motions = key.strips.map(({ style, action }) => `${action} ${style}`);
      expect(motions.sort()).toEqual(ACTIONS.flatMap((action) => STYLES.map((style) => `${action} ${style}`)).sort());
    }),
  );
});

test("another seed gives another order", () => {
  expect(keyOf(STYLES, ACTIONS, 1).strips).not.toEqual(keyOf(STYLES, ACTIONS, 2).strips);
});

test("the answer sheet is the same whatever is right, and asks for the style of every strip", () => {
  const sheetOf = (seed: number) =>
    answerSheet(
      keyOf(STYLES, ACTIONS, seed).strips.map(({ name }) => name),
      STYLES,
    );
  const sheet = sheetOf(1);
  expect(sheetOf(2)).toBe(sheet);
  for (const action of ACTIONS) expect(sheet).not.toContain(action);
  expect(sheet.match(/<img src="\d\d\.png"/g)).toHaveLength(12);
  for (const style of STYLES) expect(sheet.split(`<option>${style}</option>`)).toHaveLength(13);
  // No answer is preselected.
  expect(sheet).not.toContain("selected");
});

const STRIPS = [
  { name: "1", style: "proud", action: "walk" },
  { name: "2", style: "angry", action: "jump" },
  { name: "3", style: "proud", action: "run" },
  { name: "4", style: "neutral", action: "run" },
  { name: "5", style: "angry", action: "kick" },
];

test("marks count what was answered, and say what was taken for what, most often first", () => {
  expect(mark({ 1: "neutral", 2: "proud", 3: "neutral", 4: "neutral", 5: "" }, STRIPS)).toEqual([
    "1 of 4 are right.",
    "proud taken for neutral: 1 (walk), 3 (run)",
    "angry taken for proud: 2 (jump)",
  ]);
  expect(mark({}, STRIPS)).toEqual(["0 of 0 are right."]);
});

test("the sheet marks by a function that needs nothing around it", () => {
  const copy = new Function(`return ${mark}`)() as typeof mark;
  expect(copy({ 1: "angry", 4: "neutral" }, STRIPS)).toEqual(mark({ 1: "angry", 4: "neutral" }, STRIPS));
  expect(answerSheet(["1"], STYLES)).toContain(String(mark));
});
