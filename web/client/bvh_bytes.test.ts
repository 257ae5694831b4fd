import { expect, it } from "vitest";
import { bvhBytes } from "./bvh_bytes";

it("leaves UTF-8 as it is", () => {
  for (const text of ["", "ROOT Hips\n", "JOINT 左足\n", "JOINT \u{10FE7F}\u{10FF00}\u{FFE80}\n"])
    expect(bvhBytes(text)).toEqual(new TextEncoder().encode(text));
});

it("writes names in another encoding with the bytes that they came with", () => {
  const bytes = Array.from({ length: 256 }, (_, byte) => byte);
  const escaped = bytes.map((byte) => String.fromCodePoint(byte < 0x80 ? byte : 0x10fe00 + byte)).join("");
  expect([...bvhBytes(`${escaped}左`)]).toEqual([...bytes, 0xe5, 0xb7, 0xa6]);
});
