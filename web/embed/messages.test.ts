import { describe, expect, it } from "vitest";
import { attributesOf, figureAttributesOf, readRequest } from "./messages";

describe("a message to a frame", () => {
  it("sets and asks for settings, and nothing that loads", () => {
    expect(
      readRequest({
        strut: 1,
        set: { styles: "old", src: "https://evil.example/", ghost: null },
        get: ["frame", "db"],
      }),
    ).toEqual({ set: { styles: "old", ghost: null }, get: ["frame"], playing: undefined });
  });

  it("is passed over where it is none of ours", () => {
    for (const data of [null, 1, "strut", {}, { strut: 2, set: {} }, [1]]) expect(readRequest(data)).toBeUndefined();
    expect(readRequest({ strut: 1, set: "styles", get: "frame", playing: 1 })).toEqual({
      set: {},
      get: [],
      playing: undefined,
    });
  });
});

describe("the query of an address", () => {
  it("has attributes, beside what content management systems add", () => {
    expect(attributesOf("?styles=old:1&controls&utm_source=mail&onload=alert(1)")).toEqual([
      ["styles", "old:1"],
      ["controls", ""],
    ]);
  });
});

describe("the address of a figure", () => {
  it("has attributes in its query, and the state of a link behind #, character for character", () => {
    const url = new URL("https://strut.example/figure.html?kind=scatter&lang=de&onload=x#K=12&motion=neutral%20run");
    expect(figureAttributesOf(url)).toEqual([
      ["kind", "scatter"],
      ["lang", "de"],
      ["state", "K=12&motion=neutral%20run"],
    ]);
  });
});
