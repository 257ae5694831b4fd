// Tests of the check for cycles between Rust modules, on crates of a few lines.
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { afterEach, expect, test } from "vitest";
import { moduleCircles } from "../../scripts/rust_modules.mjs";

const folders: string[] = [];

/** Returns the cycles of a crate with these files. */
function circles(files: Record<string, string>): string[] {
  const folder = mkdtempSync(join(tmpdir(), "strut-modules-"));
  folders.push(folder);
  for (const [path, text] of Object.entries(files)) {
    mkdirSync(dirname(join(folder, path)), { recursive: true });
    writeFileSync(join(folder, path), text);
  }
  return moduleCircles(join(folder, "lib.rs"));
}

afterEach(() => {
  for (const folder of folders.splice(0)) rmSync(folder, { recursive: true });
});

test("two modules that use each other are a circle", () => {
  const files = { "lib.rs": "mod a;\nmod b;", "a.rs": "use crate::b::B;\npub struct A(B);", "b.rs": "pub struct B;" };
  expect(circles(files)).toEqual([]);
  expect(circles({ ...files, "b.rs": "pub struct B;\nfn f() -> crate::a::A { todo!() }" })).toEqual([
    "circle in crate: a uses crate::b::B of b; b uses crate::a::A of a",
  ]);
});

test("a circle of three is found at any depth, and through a module that is imported as a name", () => {
  const files = {
    "lib.rs": "mod outer;",
    "outer/mod.rs": "mod a; mod b; mod c;",
    "outer/a.rs": "use super::b::{self, X as Y};\nfn f() -> b::Z { Y }",
    "outer/b.rs": "use super::{c};\npub struct X; pub struct Z(c::W);",
    "outer/c.rs": "pub struct W;\npub struct V(super::a::U);",
  };
  expect(circles(files)).toHaveLength(1);
  expect(circles({ ...files, "outer/c.rs": "pub struct W;" })).toEqual([]);
});

test("a parent that uses a child which uses the parent is a circle; one that only re-exports it is none", () => {
  const child = "use super::Options;\npub fn run(options: Options) {}";
  const reexporting = { "lib.rs": "mod job;", "job/mod.rs": "mod run;\npub use run::run;\npub struct Options;" };
  expect(circles({ ...reexporting, "job/run.rs": child })).toEqual([]);
  const using = { "lib.rs": "mod job;", "job/mod.rs": "mod run;\npub struct Options;\nfn all() { run::run(Options) }" };
  expect(circles({ ...using, "job/run.rs": child })).toHaveLength(1);
});

test("folders that use each other are a circle even where their files are not", () => {
  const files = {
    "lib.rs": "mod left; mod right;",
    "left/mod.rs": "mod one; mod two;\npub use one::One;",
    "left/one.rs": "pub struct One;",
    "left/two.rs": "use crate::right::Right;",
    "right.rs": "use crate::left::One;\npub struct Right;",
  };
  expect(circles(files)).toHaveLength(1);
  expect(circles({ ...files, "left/two.rs": "" })).toEqual([]);
});

test("an item is where it is defined, not where it is re-exported", () => {
  const files = {
    "lib.rs": "mod a; mod b; mod face;",
    "face.rs": "pub use crate::b::B;",
    "a.rs": "use crate::face::B;\npub struct A(B);",
    "b.rs": "use crate::a::A;\npub struct B;",
  };
  expect(circles(files)).toEqual(["circle in crate: a uses crate::face::B of b; b uses crate::a::A of a"]);
});

test("tests, comments and literals use nothing", () => {
  const b =
    'pub struct B;\n// crate::a::A\nconst TEXT: &str = "crate::a::A";\n#[cfg(test)]\nmod tests { use crate::a::A; }';
  const a = "use crate::b::B;\npub struct A(B);";
  expect(circles({ "lib.rs": "mod a; mod b;", "a.rs": a, "b.rs": b })).toEqual([]);
  const shipped = b.replace("#[cfg(test)]\nmod tests", "mod shipped");
  expect(circles({ "lib.rs": "mod a; mod b;", "a.rs": a, "b.rs": shipped })).toHaveLength(1);
});
