import { describe, expect, it } from "vitest";
import { isOfThisSite } from "./shared_files";

const sent = (site?: string) =>
  ({ headers: new Headers(site === undefined ? {} : { "Sec-Fetch-Site": site }) }) as Request;

describe("files that are shared with the page", () => {
  it("come from the browser or from the page's own site, not from any page", () => {
    expect([sent("none"), sent("same-origin"), sent()].map(isOfThisSite)).toEqual([true, true, true]);
    expect([sent("cross-site"), sent("same-site")].map(isOfThisSite)).toEqual([false, false]);
  });
});
