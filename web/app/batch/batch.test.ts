import fc from "fast-check";
import { describe, expect, it } from "vitest";
import { Archive, readDirectory, readEntry } from "../../client/build/zip";
import { ZipWriter } from "../../client/build/zip_writer";
import { StrutError } from "../../client/protocol";
import { initialOf } from "../../link/hash";
import { PLAY_FIELDS, type PlayState } from "../../link/play";
import { Batch, type BatchClip, type Lane, outputNames } from "./batch";
import { presentVariant, singleVariants, type Variant } from "./variants";

const state: PlayState = initialOf(PLAY_FIELDS);
const variants = (...styles: string[]): Variant[] => singleVariants(state, "neutral", styles);
const clip = (path: string): BatchClip => ({ path, read: async () => new TextEncoder().encode(path) });

/** A fake lane that records its calls, and fails as its file names tell. */
function lane({ onStyle = (_file: string) => {} } = {}): Lane & { open: Lane["open"]; opened: string[] } {
  const opened: string[] = [];
  return {
    opened,
    async open(name, bytes) {
      opened.push(name);
      if (name.includes("bad")) throw new StrutError({ code: "bad-file", message: "Line 3 is empty.", hint: "" });
      return {
        async style({ name: style }, { signal }) {
          onStyle(`${style}/${name}`);
          signal?.throwIfAborted();
          return new TextEncoder().encode(`${style} ${new TextDecoder().decode(bytes)}`);
        },
        dispose() {},
      };
    },
    dispose() {},
  };
}

async function textsOf(blob: Blob): Promise<Record<string, string>> {
  const archive = new Archive(blob);
  const texts: Record<string, string> = {};
  for (const entry of await readDirectory(archive))
    texts[entry.name] = new TextDecoder().decode(await readEntry(archive, entry, 1 << 20));
  return texts;
}

describe("a batch", () => {
  it("makes every clip in every style, and a report", async () => {
    const batch = new Batch([clip("a.bvh"), clip("set.zip/b.bvh")], variants("old", "proud"));
    expect([batch.files, batch.done, batch.fraction]).toEqual([4, 0, 0]);
    await batch.run([lane(), lane()], () => {});
    expect([batch.done, batch.fraction, batch.ended, batch.leftOut]).toEqual([4, 1, true, []]);
    const { "report.csv": report, ...texts } = await textsOf(batch.archive());
    expect(texts).toEqual({
      "old/a.bvh": "old a.bvh",
      "old/set/b.bvh": "old set.zip/b.bvh",
      "proud/a.bvh": "proud a.bvh",
      "proud/set/b.bvh": "proud set.zip/b.bvh",
    });
    expect(report).toContain("old/set/b.bvh,set.zip/b.bvh,old,done,\n");
  });

  it("names the clip that cannot be used, and does the others", async () => {
    const unreadable = { path: "gone.bvh", read: () => Promise.reject(new Error("It was moved. Drop it again.")) };
    const batch = new Batch([clip("bad, or so.bvh"), clip("a.bvh"), unreadable, clip("b.bvh")], variants("old"));
    await batch.run([lane()], () => {});
    expect(batch.leftOut).toEqual([
      { path: "bad, or so.bvh", why: "Line 3 is empty." },
      { path: "gone.bvh", why: "It was moved. Drop it again." },
    ]);
    expect([batch.done, batch.ended, batch.fraction]).toEqual([2, true, 1]);
    const { "report.csv": report } = await textsOf(batch.archive());
    expect(report).toContain('"old/bad, or so.bvh","bad, or so.bvh",old,left out,Line 3 is empty.');
  });

  it("keeps what is done when it is stopped, wherever that is, and goes on from there", async () => {
    const clips = ["a", "bad", "b", "c"].map((name) => clip(`${name}.bvh`));
    await fc.assert(
      fc.asyncProperty(fc.nat(7), fc.integer({ min: 1, max: 3 }), async (stopAt, lanes) => {
        const batch = new Batch(clips, variants("old", "proud"));
        const stop = new AbortController();
        const made: string[] = [];
        const onStyle = (file: string) => {
          if (made.length >= stopAt) stop.abort();
          if (!stop.signal.aborted) made.push(file);
        };
        const all = Array.from({ length: lanes }, () => lane({ onStyle }));
        await batch.run(all, () => {}, { signal: stop.signal }).catch(() => {});
        const before = batch.done;
        expect(Object.keys(await textsOf(batch.archive())).length).toBe(before + 1);
        const rest: string[] = [];
        await batch.run([lane({ onStyle: (file) => rest.push(file) })], () => {});
        expect([batch.done, batch.ended, batch.leftOut.length]).toEqual([6, true, 1]);
        // No file is made twice.
        expect(rest.length).toBe(6 - before);
        expect(Object.keys(await textsOf(batch.archive())).length).toBe(7);
      }),
      { numRuns: 40 },
    );
  });

  it("tries once more after a fault of the engine, and not for ever", async () => {
    const faulty = (faults: number): Lane => ({
      ...lane(),
      async open(name) {
        if (faults-- > 0) throw new StrutError({ code: "fault", message: `It stopped at ${name}.`, hint: "" });
        return { style: async () => new Uint8Array(1), dispose() {} };
      },
    });
    const once = new Batch([clip("a.bvh")], variants("old"));
    await once.run([faulty(1)], () => {});
    expect([once.done, once.leftOut]).toEqual([1, []]);
    const ever = new Batch([clip("a.bvh")], variants("old"));
    await ever.run([faulty(2)], () => {});
    expect(ever.leftOut).toEqual([{ path: "a.bvh", why: "It stopped at a.bvh." }]);
  });

  it("leaves out what the zip has no room for", async () => {
    const batch = new Batch([clip("a.bvh"), clip("b.bvh")], variants("old"), new ZipWriter(150));
    await batch.run([lane()], () => {});
    expect([batch.done, batch.leftOut.map(({ why }) => why)]).toEqual([
      1,
      ["The archive is full. Save it, then continue with another one."],
    ]);
  });
});

describe("names of outputs", () => {
  it("are those of the inputs, below the folder", () => {
    expect(outputNames(["a.bvh", "b/A.BVH", "b/a.bvh", "set.zip/in/c.bvh", "b\\d.bvh"])).toEqual([
      "a.bvh",
      "b/A.bvh",
      "b/a (2).bvh",
      "set/in/c.bvh",
      "b/d.bvh",
    ]);
  });

  it("never lead out of it, and are never there twice", () => {
    const path = fc.array(fc.oneof(fc.constantFrom("..", ".", "", "a.bvh", "C:", "b.zip"), fc.string()), {
      maxLength: 4,
    });
    fc.assert(
      fc.property(fc.array(path, { maxLength: 6 }), (paths) => {
        const names = outputNames(paths.map((parts) => parts.join("/")));
        expect(new Set(names.map((name) => name.toLowerCase())).size).toBe(names.length);
        for (const name of names) {
          expect(name).toMatch(/\.bvh$/);
          for (const part of name.split("/")) expect(part).not.toMatch(/^\.*$|[\\:*?"<>|]/);
        }
      }),
    );
  });
});

describe("the styles of a batch", () => {
  it("have the names of the command's", () => {
    const styles = [
      { name: "proud", weight: 0.61249 },
      { name: "old", weight: 0.12 },
      { name: "neutral", weight: 0.2 },
    ];
    const present = presentVariant({ ...state, styles }, "neutral");
    expect([present.name, present.options.styles]).toEqual(["proud=0.612+old=0.12", { proud: 0.612, old: 0.12 }]);
    const named = (weight: number, intensity = 1) =>
      presentVariant({ ...state, intensity, styles: [{ name: "old", weight }] }, "neutral").name;
    expect([named(1), named(0), named(0.5), named(1, -0.5)]).toEqual(["old", "neutral", "old=0.5", "old=-0.5"]);
    const parts = { left_arm: [{ name: "old", weight: 1 }] };
    expect(presentVariant({ ...state, styles, parts }, "neutral").name).toBe("proud=0.612+old=0.12 left-arm-old");
  });

  it("say nothing that is true of one clip alone", () => {
    const track = [{ frame: 3, styles: [{ name: "old", weight: 1 }] }];
    const one = { ...state, styles: [{ name: "old", weight: 1 }], track, action: "walk", inputStyle: "old", k: 20 };
    for (const { options } of [presentVariant(one, "neutral"), ...singleVariants(one, "neutral", ["old"])])
      expect(options).toMatchObject({ track: [], action: "", inputStyle: "", k: 20, styles: { old: 1 } });
    expect(singleVariants(one, "neutral", ["neutral"])[0]!.options.styles).toEqual({});
  });
});
