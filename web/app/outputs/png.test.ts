import { expect, test } from "vitest";
import { pngOf } from "./png";

/** A canvas whose picture the browser encodes as this file, or cannot encode. */
const canvas = (blob: Blob | null) => ({ toBlob: (take: BlobCallback) => take(blob) }) as HTMLCanvasElement;

test("a picture is a file", async () => {
  const blob = new Blob(["picture"]);
  expect(await pngOf(canvas(blob))).toBe(blob);
});

test("a picture that the browser cannot make is an error with a next step", async () => {
  await expect(pngOf(canvas(null))).rejects.toThrow("Choose a smaller size");
});
