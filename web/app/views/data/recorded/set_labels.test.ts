import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { describe, expect, it } from "vitest";
import { type PublicSet, parseCatalogue } from "../catalogue";
import { clipsOf, firstClip } from "./set_labels";

const SET: PublicSet = {
  id: "a",
  name: "A",
  about: "walks",
  licence: { name: "free", url: "https://example.org", note: "Free." },
  citation: "Somebody",
  page: "https://example.org",
  bytes: 0,
  base: "https://example.org/",
  files: [{ path: "one/x_walk_not-confident_001.bvh" }, { path: "walk.bvh" }, { path: "all.zip" }],
};

describe("the clips of a public data set", () => {
  it("have the labels in their names", () => {
    const clips = clipsOf({ ...SET, pattern: "{any}_{action}_{style}_{take}.bvh" });
    const labels = clips.map(({ action, style, take }) => [action, style, take]);
    expect(labels).toEqual([
      ["walk", "not-confident", "001"],
      ["", "", ""],
    ]);
  });

  it("have the labels of a table", () => {
    const clips = clipsOf({ ...SET, labels: "file,action,style\nwalk.bvh,walk,cat\n" });
    expect(clips.map(({ action, style }) => [action, style])).toEqual([
      ["", ""],
      ["walk", "cat"],
    ]);
  });

  it("are those of the catalogue, all labelled, and begin with a walk; archives have none", () => {
    const catalogue = readFileSync(resolve(import.meta.dirname, "../../../../../public/catalog.json"), "utf8");
    const sets = parseCatalogue(JSON.parse(catalogue));
    const found = sets.map((set) => ({ id: set.id, clips: clipsOf(set) }));
    expect(found.filter(({ clips }) => clips.length === 0).map(({ id }) => id)).toEqual(["100style", "lafan1"]);
    for (const { clips } of found) {
      expect(clips.every(({ action, style }) => action !== "" && style !== "")).toBe(true);
      if (clips.length > 0) expect(firstClip(clips)?.action).toBe("walk");
    }
  });
});
