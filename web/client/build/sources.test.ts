import { expect, test } from "vitest";
import { zipOf } from "../../../tests/zip";
import { findSources } from "./sources";

const MB = 1 << 20;
/** A licence of one megabyte, which is packed into a few kilobytes. */
const licence = (folder: string) => ({ name: `${folder}/LICENSE`, content: "x".repeat(MB) });
const archive = (files: Parameters<typeof zipOf>[0]) => [{ path: "a.zip", file: new File([zipOf(files)], "a.zip") }];

test("licences count to what an archive may unpack to, as clips do", async () => {
  const files = archive([licence("a"), licence("b"), licence("c"), { name: "d/walk.bvh", content: "HIERARCHY" }]);
  const { clips, licences } = await findSources(files, 2 * MB);
  await licences[0]!.read();
  await licences[1]!.read();
  const sentence = "The archive unpacks to more than 2 MB; this file is beyond the limit.";
  await expect(licences[2]!.read()).rejects.toThrow(sentence);
  await expect(clips[0]!.read()).rejects.toThrow(sentence);
  expect((await licences[0]!.read()).length, "what was read can be read again").toBe(MB);
});
