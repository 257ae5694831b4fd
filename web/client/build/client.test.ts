import { afterEach, beforeAll, describe, expect, test } from "vitest";
import { everyNth, playedAt, walksIn } from "../../../tests/clips";
import { InlineBuildWorker } from "../../../tests/inline_build_worker";
import { zipOf } from "../../../tests/zip";
import { BuildClient } from "./client";
import type { BuiltDatabase, ChosenFile, DroppedFile, ReadClip, ReadEvent, Skeleton } from "./protocol";

let walks: Record<"neutral" | "old" | "proud", string>;
beforeAll(async () => {
  walks = await walksIn(["neutral", "old", "proud"]);
});

let workers: InlineBuildWorker[] = [];
let client: BuildClient;
afterEach(() => {
  client?.dispose();
  workers = [];
});

function connect(): BuildClient {
  client = new BuildClient(() => {
    workers.push(new InlineBuildWorker());
    return workers.at(-1)!;
  });
  return client;
}

const file = (path: string, content: string | Uint8Array<ArrayBuffer>): DroppedFile => ({
  path,
  file: new File([content], path.split("/").at(-1)!),
});

/** Reads all clips. */
async function readAll(): Promise<{ clips: ReadClip[]; skeletons: Skeleton[] }> {
  const all: ReadEvent = { clips: [], skeletons: [] };
  await client.readAll((event) => {
    all.clips.push(...event.clips);
    all.skeletons.push(...event.skeletons);
  });
  return all;
}

/** Opens, labels and builds. */
async function build(files: DroppedFile[], neutral = "neutral"): Promise<BuiltDatabase> {
  connect();
  const { clips, pattern } = await client.open(files);
  const labels = await client.label(pattern, undefined);
  const chosen = clips.flatMap(({ path, licence }, index): ChosenFile[] => {
    const label = labels[index]!;
    return "reason" in label ? [] : [{ ...label, index, path, licence, roles: undefined }];
  });
  return client.build(chosen, neutral);
}

test("a worker that stays silent is replaced, and its calls are rejected", async () => {
  const client = new BuildClient(() => {
    const worker = new InlineBuildWorker();
    // As after the system has terminated it: no message, no error.
    if (workers.length === 0) worker.postMessage = () => {};
    workers.push(worker);
    return worker;
  }, 20);
  const dropped = [file("walk_old_1.bvh", walks.old)];
  await expect(client.open(dropped)).rejects.toMatchObject({
    code: "fault",
    message: expect.stringContaining("its worker does not answer"),
  });
  expect((await client.open(dropped)).clips).toHaveLength(1);
  expect(workers).toHaveLength(2);
  client.dispose();
});

describe("clips", () => {
  test("are found in folders and archives, with their licence and pattern", async () => {
    connect();
    const zip = zipOf([
      { name: "in/walk_old_1.bvh", content: walks.old },
      { name: "in/LICENSE", content: "CC BY 4.0\nwords" },
      { name: "__MACOSX/in/walk_old_1.bvh", content: "junk" },
      { name: "../../walk_evil_1.bvh", content: walks.old },
    ]);
    const found = await client.open([
      file("set.zip", zip),
      file("a/walk_neutral_1.bvh", walks.neutral),
      file("a/x.txt", ""),
    ]);
    expect(found.clips).toEqual([
      { path: "a/walk_neutral_1.bvh", licence: "" },
      { path: "set.zip/in/walk_old_1.bvh", licence: "CC BY 4.0" },
    ]);
    expect(found.pattern).toBe("{action}_{style}_{take}.bvh");
    expect(found.notes).toEqual(["“set.zip”: one file has a name that leads out of the archive and was left out."]);
  });

  test("are read once for their length, rate and skeleton", async () => {
    connect();
    const other = walks.old.replaceAll("Hips", "Pelvis");
    await client.open([file("a.bvh", walks.neutral), file("b.bvh", playedAt(other, 24)), file("c.bvh", "no motion")]);
    const { clips, skeletons } = await readAll();
    expect(clips[0]).toMatchObject({ frames: 150, skeleton: 0 });
    expect(clips[1]).toMatchObject({ frames: 150, skeleton: 1, rateHz: expect.closeTo(24, 2) });
    expect(clips[2]).toMatchObject({ fault: expect.stringMatching(/\.$/) });
    expect(skeletons.map(({ confidence }) => confidence)).toEqual([1, 1]);
  });

  test("that are empty, ten thousand of them, get a sentence each", async () => {
    connect();
    await client.open([
      file("many.zip", zipOf(Array.from({ length: 10_000 }, (_, i) => ({ name: `a_b_${i}.bvh`, content: "" })))),
    ]);
    const { clips } = await readAll();
    expect(clips.length).toBe(10_000);
    expect(clips.every((clip) => "fault" in clip && clip.fault.endsWith("."))).toBe(true);
  });

  test("can be previewed, and a wrong role is a sentence", async () => {
    connect();
    await client.open([file("a.bvh", walks.neutral)]);
    const preview = await client.preview(0, undefined);
    expect(preview.poses.length).toBe(150 * 87);
    const roles = preview.roles.slice();
    [roles[0], roles[14]] = [roles[14]!, roles[0]!];
    const misled = await client.preview(0, roles);
    expect(misled.poses.length).toBe(0);
    expect(misled.fault).toMatch(/cannot be the/);
  });
});

describe("a build", () => {
  test("takes clips of 24, 30, 60 and 120 Hz and of two skeletons", async () => {
    const renamed = walks.old.replaceAll("Hips", "Pelvis");
    const built = await build([
      file("walk_neutral_1.bvh", walks.neutral),
      file("walk_neutral_2.bvh", playedAt(walks.neutral, 120)),
      file("walk_old_1.bvh", everyNth(renamed, 2)),
      file("walk_old_2.bvh", playedAt(walks.old, 24)),
    ]);
    expect(built).toMatchObject({
      clips: 4,
      styles: ["neutral", "old"],
      neutral: "neutral",
      refused: [],
      twoManners: [],
    });
    // 150 frames at 60 Hz, half of them at 120, the same length at 30, and 6.2 s at 24.
    expect(built.frames).toBe(150 + 75 + 149 + 373);
  });

  test("goes on without what cannot be used, and with a style of one clip and an action that is not in all", async () => {
    const built = await build([
      file("walk_neutral_1.bvh", walks.neutral),
      file("walk_neutral_2.bvh", walks.neutral),
      file("walk_old_1.bvh", walks.old),
      file("stroll_proud_1.bvh", walks.proud),
      file("walk_proud_1.bvh", "HIERARCHY"),
      file("walk_proud_2.bvh", everyNth(walks.proud, 1, 5)),
    ]);
    expect(built).toMatchObject({ clips: 4, actions: ["stroll", "walk"], styles: ["neutral", "old", "proud"] });
    expect(built.refused.map(({ path }) => path)).toEqual(["walk_proud_1.bvh", "walk_proud_2.bvh"]);
    expect(built.refused.every(({ reason }) => /^[A-Z].*\.$/.test(reason))).toBe(true);
  });

  test("names a style of two manners, with the clips of each", async () => {
    const alike = (style: string, first: number, bvh: string) =>
      [bvh, everyNth(bvh, 2)].map((text, i) => file(`in/walk_${style}_${first + i}.bvh`, text));
    const built = await build([
      ...alike("neutral", 1, walks.neutral),
      ...alike("neutral", 3, everyNth(walks.neutral, 1, 120)),
      ...alike("old", 1, walks.old),
      ...alike("old", 3, walks.proud),
    ]);
    const paths = [
      ["in/walk_old_1.bvh", "in/walk_old_2.bvh"],
      ["in/walk_old_3.bvh", "in/walk_old_4.bvh"],
    ];
    expect(built.twoManners).toEqual([{ action: "walk", style: "old", paths }]);
  });

  test("keeps names in any script as they are", async () => {
    const style = `<img src=x>"it's" & 怒り`;
    const built = await build([file(`歩く_普通_1.bvh`, walks.neutral), file(`歩く_${style}_1.bvh`, walks.old)], "普通");
    expect(built).toMatchObject({ actions: ["歩く"], styles: [style, "普通"].sort(), neutral: "普通" });
  });

  test("of nothing usable is refused with a sentence", async () => {
    await expect(build([file("walk_neutral_1.bvh", "x"), file("walk_old_1.bvh", "y")])).rejects.toThrow(
      /^No clips were given; at least one is needed\.$/,
    );
  });

  /** Twelve walks in two styles. */
  const TWELVE = Array.from({ length: 12 }, (_, index): ChosenFile => {
    const style = index < 6 ? "neutral" : "old";
    const path = `walk_${style}_${index % 6}.bvh`;
    return { index, path, licence: "", action: "walk", style, take: undefined, roles: undefined };
  });
  const openTwelve = () => client.open(TWELVE.map(({ path, style }) => file(path, walks[style as "neutral" | "old"])));

  /** Builds the twelve until a progress label matches, then cancels. */
  async function cancelAt(place: RegExp): Promise<void> {
    const controller = new AbortController();
    const cancelled = client.build(TWELVE, "neutral", {
      signal: controller.signal,
      onProgress: ({ label }) => place.test(label) && controller.abort(),
    });
    await expect(cancelled).rejects.toMatchObject({ code: "cancelled" });
  }

  test("tells how far it is, can be cancelled, and goes on with what was read", async () => {
    connect();
    await openTwelve();
    await cancelAt(/ 3 done\.$/);
    const fractions: number[] = [];
    const labels: string[] = [];
    const built = await client.build(TWELVE, "neutral", {
      onProgress: ({ label, fraction }) => {
        labels.push(label);
        fractions.push(fraction);
      },
    });
    expect(built.clips).toBe(12);
    expect(labels[0]).toMatch(/^Reading 12 clips, ([3-9]|1\d) done\.$/);
    expect(fractions).toEqual(fractions.toSorted((a, b) => a - b));
    // A module's memory never shrinks, so the worker is terminated when the build is done.
    expect(workers.map(({ terminated }) => terminated)).toEqual([true]);
    const received = workers[0]!.received.map((message) => (message.kind === "call" ? message.method : message.kind));
    expect(received).toEqual(["open", "build", "cancel", "build"]);

    // Another build has other clips.
    const other = client.build(TWELVE.slice(0, 1), "neutral");
    expect((await other).clips).toBe(1);
  });

  test("goes on with what was registered, and comes to the same", async () => {
    connect();
    await openTwelve();
    const whole = await client.build(TWELVE, "neutral");
    await openTwelve();
    await cancelAt(/^Registering 12 clips, 8 done/);
    const labels: string[] = [];
    const built = await client.build(TWELVE, "neutral", { onProgress: ({ label }) => labels.push(label) });
    expect(labels[0]).toMatch(/^Registering 12 clips, 12 done|^Sorting/);
    const [a, b] = await Promise.all([whole, built].map(({ file }) => file.arrayBuffer()));
    expect(Buffer.from(b!).equals(Buffer.from(a!))).toBe(true);
  });

  test("that was cancelled at its very end is there at once", async () => {
    connect();
    await openTwelve();
    await cancelAt(/^Sorting/);
    const labels: string[] = [];
    const built = await client.build(TWELVE, "neutral", { onProgress: ({ label }) => labels.push(label) });
    expect(built.clips).toBe(12);
    expect(labels).toEqual([]);
  });
});

test("files are opened after it was disposed of", async () => {
  connect();
  await client.open([file("a.bvh", walks.neutral)]);
  client.dispose();
  expect((await client.open([file("b.bvh", walks.neutral)])).clips).toEqual([{ path: "b.bvh", licence: "" }]);
});
