import { beforeEach, describe, expect, test } from "vitest";
import type { BuildClient } from "../../../client/build/client";
import type { DroppedFile, Labelled, ReadEvent, Roles, Skeleton, TwoManners } from "../../../client/build/protocol";
import { ClipCollection } from "./clip_collection";
import { skeletonKey } from "./corpus";

const CHOSEN = [0, 1] as unknown as Roles;

/** The arguments of the client's labelling calls. */
let labelled: { pattern: string | undefined; table: string | undefined }[];
let opened: string[];
/** The result of a build. */
let twoManners: TwoManners[];
let clips: ClipCollection;
let changes: number;
beforeEach(() => {
  [labelled, opened, twoManners, changes] = [[], [], [], 0];
  // Splits “action_style.bvh”; a table labels everything “tabled”, unless it is invalid.
  const client = {
    open: async (files: DroppedFile[]) => {
      opened = files.map(({ path }) => path).sort();
      return { clips: opened.map((path) => ({ path, licence: "" })), pattern: "{action}_{style}.bvh", notes: [] };
    },
    label: async (pattern: string | undefined, table: File | undefined): Promise<Labelled[]> => {
      labelled.push({ pattern, table: table?.name });
      if (table?.name === "broken.csv") throw new Error("Line 1 is wrong.");
      return opened.map((path) => {
        const [action = "", style = ""] = path.replace(".bvh", "").split("_");
        if (style === "") return { reason: "Its name does not match." };
        return { action, style: table ? "tabled" : style, take: undefined };
      });
    },
    readAll: async (onRead: (event: ReadEvent) => void) => {
      const skeleton = { joints: ["Hips", "Odd"], fault: "It has no knees." } as Skeleton;
      const read = { frames: 10, rateHz: 60, skeleton: 0 };
      onRead({ clips: opened.map((_, index) => ({ index, ...read })), skeletons: [skeleton] });
    },
    build: async () => ({ refused: [], twoManners }),
    dispose: () => {},
  } as unknown as BuildClient;
  clips = new ClipCollection(client, () => {
    changes += 1;
  });
});

const files = (...paths: string[]): DroppedFile[] => paths.map((path) => ({ path, file: new File([], path) }));
const styles = () => Object.fromEntries(clips.rows.map(({ path, style }) => [path, style]));

describe("clips that are opened", () => {
  test("are labelled by the pattern of their names, and the neutral style is found", async () => {
    expect(await clips.open(files("walk_old.bvh", "walk_neutral.bvh", "odd.bvh"), {}, {})).toEqual([]);
    expect(styles()).toEqual({ "odd.bvh": "", "walk_neutral.bvh": "neutral", "walk_old.bvh": "old" });
    expect([clips.usable.length, clips.neutral, clips.labelNote]).toEqual([2, "neutral", "2 of 3 match"]);
    expect(changes).toBeGreaterThan(0);
  });

  test("join those that are open, with labels that a person typed and the pattern as they were", async () => {
    await clips.open(files("walk_old.bvh", "walk_neutral.bvh"), {}, {});
    await clips.label({ pattern: "{style}_{action}.bvh" });
    clips.edit(clips.rows.find(({ path }) => path === "walk_old.bvh")!, "style", " ancient ");
    await clips.open(files("walk_proud.bvh", "walk_old.bvh"), {}, {});
    expect(styles()).toEqual({ "walk_neutral.bvh": "neutral", "walk_old.bvh": "ancient", "walk_proud.bvh": "proud" });
    expect(labelled.at(-1)).toEqual({ pattern: "{style}_{action}.bvh", table: undefined });
    clips.edits.undo();
    expect(styles()["walk_old.bvh"]).toBe("old");
    clips.edits.redo();
    expect(styles()["walk_old.bvh"]).toBe("ancient");
  });

  test("keep the joints that a person chose for their skeleton, which can be taken back", async () => {
    const chosen = () => clips.skeletons.map((skeleton) => skeleton.chosen);
    await clips.open(files("walk_old.bvh"), {}, {});
    await clips.read({});
    clips.edits.choose(skeletonKey(clips.skeletons[0]!), CHOSEN);
    await clips.open(files("walk_proud.bvh"), {}, {});
    expect(chosen(), "not read yet").toEqual([]);
    await clips.read({});
    expect(chosen()).toEqual([CHOSEN]);
    clips.edits.undo();
    expect(chosen()).toEqual([undefined]);
  });

  test("among which there is none are said so", async () => {
    expect(await clips.open([], {}, {})).toEqual([
      "There is no BVH among these files. Drop BVH files, a folder or a zip of them.",
    ]);
  });

  test("are forgotten altogether", async () => {
    await clips.open(files("walk_old.bvh"), { table: new File([], "labels.csv") }, {});
    clips.clear();
    expect([clips.rows, clips.neutral]).toEqual([[], ""]);
    await clips.open(files("run_sad.bvh"), {}, {});
    expect(styles()).toEqual({ "run_sad.bvh": "sad" });
    expect(labelled.at(-1)!.table, "its table too").toBeUndefined();
  });

  test("come back with all that a person edited", async () => {
    await clips.open(files("walk_old.bvh", "walk_calm.bvh"), {}, {});
    clips.edit(clips.rows[1]!, "style", "ancient");
    clips.edits.setNeutral("calm");
    const openAgain = clips.clear();
    await clips.open(files("run_sad.bvh"), {}, {});
    await openAgain({});
    expect(styles()).toEqual({ "walk_calm.bvh": "calm", "walk_old.bvh": "ancient" });
    expect(clips.neutral).toBe("calm");
  });
});

test("a table goes before the pattern until it turns out to be wrong", async () => {
  await clips.open(files("walk_old.bvh"), {}, {});
  await clips.label({ table: new File([], "labels.csv") });
  expect(styles()).toEqual({ "walk_old.bvh": "tabled" });
  expect(clips.labelNote).toBe("all match; labels.csv takes precedence");
  await clips.label({ table: new File([], "broken.csv") });
  expect([clips.labelNote, styles()]).toEqual(["Line 1 is wrong.", { "walk_old.bvh": "tabled" }]);
  await clips.label();
  expect(styles()).toEqual({ "walk_old.bvh": "old" });
});

test("a style is renamed wherever it is, with its being neutral, and back", async () => {
  await clips.open(files("walk_neutral.bvh", "run_neutral.bvh", "walk_old.bvh"), {}, {});
  clips.rename("style", "neutral", "calm");
  expect([styles()["run_neutral.bvh"], clips.neutral]).toEqual(["calm", "calm"]);
  clips.edits.undo();
  expect([styles()["run_neutral.bvh"], clips.neutral]).toEqual(["neutral", "neutral"]);
});

test("a style that was chosen as the neutral one is so after a rename is taken back", async () => {
  await clips.open(files("walk_neutral.bvh", "walk_old.bvh"), {}, {});
  clips.edits.setNeutral("old");
  clips.rename("style", "old", "aged");
  expect(clips.neutral).toBe("aged");
  clips.edits.undo();
  expect(clips.neutral).toBe("old");
  clips.edits.undo();
  expect(clips.neutral).toBe("neutral");
});

test("a style of two manners becomes two styles, of the same name in every action, and one again", async () => {
  const of = (action: string) => ["a", "b", "c", "d"].map((take) => `${action}_old_${take}.bvh`);
  await clips.open(files(...of("turn"), ...of("walk")), {}, {});
  twoManners = ["turn", "walk"].map((action) => {
    const [a, b, c, d] = of(action) as [string, string, string, string];
    return {
      action,
      style: "old",
      paths: [
        [a, b],
        [c, d],
      ],
    };
  });
  expect(clips.manners, "before a build").toEqual([]);
  await clips.build({});
  expect(clips.manners.map(({ action }) => action)).toEqual(["turn", "walk"]);
  for (const found of clips.manners) clips.divide(found);
  expect(clips.manners).toEqual([]);
  const second = Object.entries(styles()).filter(([, style]) => style === "old 2");
  expect(second.map(([path]) => path)).toEqual([...of("turn").slice(2), ...of("walk").slice(2)]);
  clips.edits.undo();
  expect(clips.manners.map(({ action }) => action)).toEqual(["walk"]);
  clips.clear();
  expect(clips.manners).toEqual([]);
});

test("clips and labels that no database was built of are known", async () => {
  expect(clips.isUnbuilt).toBe(false);
  await clips.open(files("walk_old.bvh", "walk_neutral.bvh"), {}, {});
  expect(clips.isUnbuilt).toBe(true);
  await clips.build({});
  expect(clips.isUnbuilt).toBe(false);
  clips.rename("style", "old", "aged");
  expect(clips.isUnbuilt).toBe(true);
  clips.edits.undo();
  expect(clips.isUnbuilt).toBe(false);
  clips.edits.setNeutral("old");
  expect(clips.isUnbuilt).toBe(true);
  clips.clear();
  expect(clips.isUnbuilt).toBe(false);
});
