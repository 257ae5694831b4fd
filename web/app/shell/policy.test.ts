import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { expect, test } from "vitest";

const read = (path: string) => readFileSync(join(import.meta.dirname, path), "utf8");

const policyOf = (page: string) => /content="(default-src [^"]*)"/.exec(read(page))![1]!;

test("the page may fetch from its own host and those of the catalogue, and listen to performers", () => {
  const [, allowed] = /connect-src 'self' ([^;]*);/.exec(policyOf("../index.html"))!;
  const { sets } = JSON.parse(read("../../../public/catalog.json")) as { sets: { base: string }[] };
  const hosts = new Set(sets.map(({ base }) => new URL(base).origin));
  // Unencrypted connections must stay on this computer.
  const performers = ["ws://localhost:*", "ws://127.0.0.1:*", "wss:"];
  // Textures inside a character's file, which three.js fetches by URLs that it creates.
  const textures = ["blob:", "data:"];
  expect(allowed!.split(" ").sort()).toEqual([...hosts, ...performers, ...textures].sort());
});

test("the page runs the one script that stands in it", () => {
  const scripts = [...read("../index.html").matchAll(/<script>(.*?)<\/script>/gs)].map(([, text]) => text!);
  const hashes = scripts.map((text) => `sha256-${createHash("sha256").update(text).digest("base64")}`);
  const allowed = [...policyOf("../index.html").matchAll(/'(sha256-[^']*)'/g)].map(([, hash]) => hash);
  expect(allowed).toEqual(hashes);
  expect(hashes).toHaveLength(1);
});

test("the benchmark has the policy of the page, but fetches from its own host alone and has no script in it", () => {
  const policy = policyOf("../index.html")
    .replace(/connect-src 'self' [^;]*;/, "connect-src 'self';")
    .replace(/ 'sha256-[^']*'/, "");
  expect(policyOf("../bench.html")).toBe(policy);
});
