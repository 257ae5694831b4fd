import { describe, expect, it } from "vitest";
import { type EmbedChoice, elementCode, frameAddress, frameCode } from "./embed_code";

const embedded = { site: "https://strut.example/a/", state: "styles=proud:0.5,old:0.5&input=run", title: 'A "run"' };
const choice: EmbedChoice = {
  size: { width: 688, height: 342 },
  controls: true,
  autoplay: true,
  theme: "auto",
  ghost: "off",
};

describe("the code of a figure", () => {
  it("is a frame with its state in the query, which comes back as it was", () => {
    const url = new URL(frameAddress(embedded, choice));
    expect(url.pathname).toBe("/a/embed.html");
    expect(Object.fromEntries(url.searchParams)).toEqual({
      state: embedded.state,
      controls: "",
      autoplay: "",
      ghost: "off",
    });
  });

  it("escapes what stands in attributes", () => {
    expect(frameCode(embedded, choice)).toContain('title="A &quot;run&quot;"');
    expect(frameCode(embedded, choice)).not.toMatch(/&(?!amp;|quot;)/);
  });

  it("is the element with its script", () => {
    expect(elementCode(embedded, { ...choice, ghost: "beside", autoplay: false })).toBe(
      '<script src="https://strut.example/a/package/strut-player.js"></script>\n' +
        '<strut-player state="styles=proud:0.5,old:0.5&amp;input=run" controls></strut-player>',
    );
  });
});
