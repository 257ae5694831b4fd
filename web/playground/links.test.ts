import { describe, expect, it } from "vitest";
import { linkedFile, pack, unpack } from "./links";

const text = "HIERARCHY\nROOT Hips\n".repeat(200);
const bytes = new TextEncoder().encode(text).buffer;

describe("a file in a link", () => {
  it("comes back as it was, and much smaller on the way", async () => {
    const packed = await pack(bytes);
    expect(packed).toMatch(/^[\w-]+$/);
    expect(packed.length).toBeLessThan(text.length / 10);
    expect(new TextDecoder().decode(await unpack(packed))).toBe(text);
  });

  it("is found beside the state, with its name", async () => {
    const hash = `#styles=old:1&file=${encodeURIComponent("my ~ walk")}~${await pack(bytes)}`;
    const file = await linkedFile(hash);
    expect(file?.name).toBe("my ~ walk");
    expect(file?.bytes.byteLength).toBe(bytes.byteLength);
  });

  it("is passed over where it is damaged or not there", async () => {
    expect(await linkedFile("#styles=old:1")).toBeUndefined();
    expect(await linkedFile("#file=walk~!!!")).toBeUndefined();
    const bomb = await pack(new ArrayBuffer(30_000_000));
    expect(await linkedFile(`#file=walk~${bomb.slice(0, 20_000)}`)).toBeUndefined();
    expect(bomb.length).toBeGreaterThan(24_000);
    expect(await linkedFile(`#file=walk~${bomb}`)).toBeUndefined();
  });
});
