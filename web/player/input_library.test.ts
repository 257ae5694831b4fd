import { describe, expect, it } from "vitest";
import { InputLibrary } from "./input_library";

const bytes = (text: string) => new TextEncoder().encode(text).buffer as ArrayBuffer;

describe("the inputs", () => {
  it("are built in or dropped, and each knows what the engine opens for it", () => {
    const library = new InputLibrary();
    library.builtIn = ["neutral-walk", "run"];
    const name = library.add("my walk_01.bvh", bytes("a"));
    expect(name).toBe("my walk_01");
    expect(library.source("run")).toEqual({ kind: "built-in", name: "run" });
    expect(library.source(name)).toEqual({ kind: "bvh", name, bytes: bytes("a") });
    expect(library.source("gone")).toBeUndefined();
  });

  it("tell files of one name apart, and know a file again", () => {
    const library = new InputLibrary();
    expect(library.add("walk.bvh", bytes("a"))).toBe("walk");
    expect(library.add("walk.bvh", bytes("b"))).toBe("walk (2)");
    expect(library.add("walk.bvh", bytes("a"))).toBe("walk");
    expect(library.add("walk.BVH", bytes("b"))).toBe("walk (2)");
    expect(library.dropped).toEqual(["walk", "walk (2)"]);
  });
});
