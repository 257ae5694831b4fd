/**
 * Links of version 2191801, and the values other than defaults that it read from them. `tests/e2e/links.test.ts` opens
 * some of them.
 */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";
import { fromHash, initialState, toHash } from "./state";

const LINKS: { link: string; read: object }[] = JSON.parse(
  readFileSync(join(import.meta.dirname, "links_of_2191801.json"), "utf8"),
);

test.each(LINKS)("$link", ({ link, read }) => {
  const state = fromHash(`#${link}`);
  expect(state).toEqual({ ...initialState(), ...read });
  expect(fromHash(`#${toHash(state)}`)).toEqual(state);
});
