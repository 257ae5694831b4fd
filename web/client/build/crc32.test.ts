import { expect, test } from "vitest";
import { crc32 } from "./crc32";

test("gives the check value of the CRC-32 catalogue, and those of the shortest inputs", () => {
  const of = (text: string) => crc32(new TextEncoder().encode(text));
  expect(of("123456789")).toBe(0xcbf43926);
  expect(of("")).toBe(0);
  expect(of("a")).toBe(0xe8b7be43);
  expect(crc32(new Uint8Array(4))).toBe(0x2144df1c);
});
