/** Shipped third-party parts: each has an allowed licence, its text, and an entry in the bill of materials. */
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, test } from "vitest";
import { isAllowed } from "../../scripts/notices.mjs";

const read = (path: string) => readFileSync(join(import.meta.dirname, "../../dist", path), "utf8");

interface Component {
  name: string;
  version: string;
  purl: string;
  licenses: [{ expression: string }];
}

describe.each(["", "package/"])("the files in dist/%s", (folder) => {
  const notices = read(`${folder}notices.txt`);
  const bill = JSON.parse(read(`${folder}sbom.cdx.json`)) as Record<string, unknown> & { components: Component[] };

  test("name the libraries that draw, compute, keep and write", () => {
    const names = bill.components.map(({ name }) => name);
    for (const name of [
      "three",
      "glam",
      "safetensors",
      "wgpu",
      "workbox-precaching",
      "mediabunny",
      "katex",
      "draco3dgltf",
    ])
      expect(names).toContain(name);
    // Dependencies of only tests and builds are not shipped.
    for (const name of ["vitest", "vite", "proptest", "criterion", "libfuzzer-sys", "syn"])
      expect(names).not.toContain(name);
  });

  test("are a bill of materials as CycloneDX has it, the same at every build", () => {
    expect(bill).toMatchObject({ bomFormat: "CycloneDX", specVersion: "1.6", version: 1 });
    expect(bill).not.toHaveProperty("serialNumber");
    expect(bill).not.toHaveProperty("metadata.timestamp");
    const urls = bill.components.map(({ purl }) => purl);
    expect(new Set(urls).size).toBe(urls.length);
    for (const url of urls) expect(url).toMatch(/^pkg:(npm|cargo)\/(%40[\w.-]+\/)?[\w.-]+@\d[\w.+-]*$/);
  });

  test("hold the licence of every part", () => {
    for (const { name, version, licenses } of bill.components) {
      expect(isAllowed(licenses[0].expression), name).toBe(true);
      expect(notices).toContain(`${name} ${version} (${licenses[0].expression})`);
    }
  });
});

test("a licence is allowed by one of its alternatives, and by all that hold together", () => {
  expect(isAllowed("MIT")).toBe(true);
  expect(isAllowed("GPL-3.0-only OR MIT")).toBe(true);
  expect(isAllowed("(MIT OR Apache-2.0) AND Unicode-3.0")).toBe(true);
  expect(isAllowed("(MIT OR Apache-2.0) AND GPL-3.0-only")).toBe(false);
  expect(isAllowed("MIT AND GPL-3.0-only")).toBe(false);
  expect(isAllowed("")).toBe(false);
});
