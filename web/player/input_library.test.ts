import { describe, expect, it } from "vitest";
import { InputLibrary } from "./input_library";

const bytes = (text: string) => new TextEncoder().encode(text).buffer as ArrayBuffer;

describe("the inputs", () => {
  it("are built in or dropped, and each knows what the engine opens for it", async () => {
    const library = new InputLibrary();
    library.builtIn = ["neutral-walk", "run"];
    const name = await library.add("my walk_01.bvh", bytes("a"));
    expect(name).toBe("my walk_01");
    expect(library.source("run")).toEqual({ kind: "built-in", name: "run" });
    expect(library.source(name)).toEqual({ kind: "bvh", name, bytes: expect.any(Blob) });
    expect(await library.file(name)!.file.text()).toBe("a");
    expect(library.source("gone")).toBeUndefined();
  });

  it("tell files of one name apart, and know a file again", async () => {
    const library = new InputLibrary();
    expect(await library.add("walk.bvh", bytes("a"))).toBe("walk");
    expect(await library.add("walk.bvh", bytes("b"))).toBe("walk (2)");
    expect(await library.add("walk.bvh", bytes("a"))).toBe("walk");
    expect(await library.add("walk.BVH", bytes("b"))).toBe("walk (2)");
    expect(library.dropped).toEqual(["walk", "walk (2)"]);
  });

  it("are held once, by reference, and come back as they were removed", async () => {
    const library = new InputLibrary();
    const file = new Blob(["a"]);
    const name = await library.add("walk.bvh", file);
    library.say(name, { up: "z" });
    expect(library.source(name)).toEqual({ kind: "bvh", name, bytes: file, reading: { up: "z" } });
    expect((library.source(name) as { bytes: unknown }).bytes).toBe(file);
    const removed = library.file(name)!;
    library.remove(name);
    expect([library.has(name), library.dropped, library.file(name)]).toEqual([false, [], undefined]);
    await library.bringBack(removed);
    expect(library.file(name)).toEqual({ name, file, reading: { up: "z" } });
  });
});
