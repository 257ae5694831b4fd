/**
 * Invalid input of the page's own parsers: links, archives, the catalogue. Each returns a valid value, or an error with
 * a message. `npm run fuzz` runs more of them than `npm test` (STRUT_FUZZ_RUNS). Files for the engine are fuzzed by
 * `rust/fuzz`, characters by tests/character/fuzz.test.ts.
 */
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import fc from "fast-check";
import { expect, test } from "vitest";
import { fromHash, initialState, toHash } from "../../web/app/state/state";
import { filesOf, parseCatalogue } from "../../web/app/views/data/catalogue";
import { Archive, readDirectory, readEntry, ZipError } from "../../web/client/build/zip";
import { StrutError } from "../../web/client/protocol";
import { zipOf } from "../zip";

const numRuns = Number(process.env.STRUT_FUZZ_RUNS ?? 300);
const MOST_BYTES = 1 << 20;

/** Unexpected words in a link. */
const ODD_WORDS = [
  "",
  "NaN",
  "Infinity",
  "-1",
  "1e309",
  "0x10",
  "null",
  "__proto__",
  "%00",
  "%F0",
  "🙂",
  "~:~",
  ";;;",
  ",,:",
];

/** All keys of a link, with a valid value. */
const KEYS = (() => {
  const source = readFileSync(
    fileURLToPath(new URL("../../web/app/state/links_of_2191801.json", import.meta.url)),
    "utf8",
  );
  const links = Array.from(source.matchAll(/[\w-]+=[^&"\\#]+/g), ([pair]) => pair.split("="));
  return [...new Map(links as [string, string][])];
})();

/** A link with valid, changed and invalid values. */
const link = fc
  .array(
    fc.constantFrom(...KEYS).chain(([key, value]) =>
      fc
        .oneof(
          fc.constant(value),
          fc.constantFrom(...ODD_WORDS),
          fc.string(),
          fc.tuple(fc.nat(value.length), fc.constantFrom(...ODD_WORDS)).map(([at, word]) => value.slice(0, at) + word),
          fc.nat(200).map((times) => `${value},`.repeat(times)),
        )
        .map((changed) => `${key}=${changed}`),
    ),
    { maxLength: 12 },
  )
  .map((pairs) => `#${pairs.join("&")}`);

test("the links that tests know have keys to change", () => {
  expect(KEYS.length).toBeGreaterThan(20);
});

test("whatever a link says, the page has a state that it can write and read again", () => {
  const names = Object.keys(initialState()).sort();
  fc.assert(
    fc.property(link, (hash) => {
      const state = fromHash(hash);
      expect(Object.keys(state).sort()).toEqual(names);
      for (const value of Object.values(state)) if (typeof value === "number") expect(value).toSatisfy(Number.isFinite);
      expect(fromHash(`#${toHash(state)}`)).toEqual(state);
    }),
    { numRuns },
  );
});

/** A change of a file: it is truncated, a byte is changed, a part is repeated or removed. */
interface Edit {
  at: number;
  kind: "set" | "flip" | "cut" | "remove" | "repeat";
  byte: number;
  length: number;
}

const edits: fc.Arbitrary<Edit[]> = fc.array(
  fc.record({
    at: fc.nat(),
    kind: fc.constantFrom("set", "flip", "cut", "remove", "repeat"),
    byte: fc.nat(255),
    length: fc.integer({ min: 1, max: 64 }),
  }),
  { minLength: 1, maxLength: 6 },
);

function edited(file: Uint8Array, changes: readonly Edit[]): Uint8Array<ArrayBuffer> {
  let bytes = Array.from(file);
  for (const { at, kind, byte, length } of changes) {
    if (bytes.length === 0) break;
    const place = at % bytes.length;
    if (kind === "set") bytes[place] = byte;
    if (kind === "flip") bytes[place] = bytes[place]! ^ (1 << (byte % 8));
    if (kind === "cut") bytes = bytes.slice(0, place);
    if (kind === "remove") bytes.splice(place, length);
    if (kind === "repeat") bytes.splice(place, 0, ...bytes.slice(place, place + length));
  }
  return Uint8Array.from(bytes);
}

test("an archive that was changed gives whole files, or a sentence", async () => {
  const content = "HIERARCHY ".repeat(40);
  const files = [
    { name: "a.bvh", content },
    { name: "b/c.bvh", content, stored: true },
  ];
  const archives = [zipOf(files), zipOf(files, true)];
  const outcomes = { read: 0, refused: 0 };
  await fc.assert(
    fc.asyncProperty(fc.constantFrom(...archives), edits, async (whole, changes) => {
      const archive = new Archive(new Blob([edited(whole, changes)]));
      try {
        for (const entry of await readDirectory(archive)) {
          const bytes = await readEntry(archive, entry, MOST_BYTES);
          // Only data with the right checksum are returned.
          expect(bytes.length === 0 || new TextDecoder().decode(bytes) === content).toBe(true);
        }
        outcomes.read += 1;
      } catch (thrown) {
        expect(thrown).toBeInstanceOf(ZipError);
        expect((thrown as Error).message).toMatch(/^[A-Z].{8,200}\.$/);
        outcomes.refused += 1;
      }
    }),
    { numRuns },
  );
  expect(outcomes.read).toBeGreaterThan(0);
  expect(outcomes.refused).toBeGreaterThan(0);
});

/** Returns a JSON value with one of its values replaced or removed, at the position that `way` gives. */
function changed(value: unknown, way: readonly number[], by: unknown): unknown {
  const [step, ...rest] = way;
  if (step === undefined || typeof value !== "object" || value === null) return by;
  if (Array.isArray(value)) {
    if (value.length === 0) return by;
    return value.with(step % value.length, changed(value[step % value.length], rest, by));
  }
  const names = Object.keys(value);
  if (names.length === 0) return by;
  const name = names[step % names.length]!;
  return { ...value, [name]: changed((value as Record<string, unknown>)[name], rest, by) };
}

test("a catalogue that was changed leads only to https addresses below its base, or is refused in a sentence", () => {
  const whole: unknown = JSON.parse(
    readFileSync(fileURLToPath(new URL("../../public/catalog.json", import.meta.url)), "utf8"),
  );
  const value = fc.oneof(
    fc.constantFrom(
      null,
      true,
      0,
      -1,
      1e300,
      "",
      "..",
      "../x",
      "/x",
      "//evil.example/",
      "javascript:alert(1)",
      "http://x/",
    ),
    fc.constantFrom("https://other.example/", "data:text/html,x", "\\..\\x", "a/../../b", "%2e%2e/x", "x?y#z", [], {}, [
      [],
    ]),
    fc.string(),
  );
  fc.assert(
    fc.property(fc.array(fc.nat(1e6), { maxLength: 6 }), value, (way, by) => {
      try {
        for (const set of parseCatalogue(changed(whole, way, by)))
          for (const { url, path } of filesOf(set)) {
            expect(new URL(url).protocol).toBe("https:");
            expect(new URL(url).href.startsWith(set.base)).toBe(true);
            expect(path.split(/[/\\]/)).not.toContain("..");
          }
      } catch (thrown) {
        if (!(thrown instanceof StrutError)) throw thrown;
        expect(thrown.message).toMatch(/^[A-Z].{8,300}\.$/);
      }
    }),
    { numRuns },
  );
});
