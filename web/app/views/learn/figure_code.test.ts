import { expect, it } from "vitest";
import { type EmbeddedFigure, figureAddress, figureElementCode, figureFrameCode } from "./figure_code";

const figure: EmbeddedFigure = {
  site: "https://strut.example/a/",
  kind: "scatter",
  language: "de",
  state: "K=12&motion=neutral%20run",
  heading: 'A "line"',
};

it("has the state of a link in its address, character for character", () => {
  expect(figureAddress(figure)).toBe(
    "https://strut.example/a/figure.html?kind=scatter&lang=de#K=12&motion=neutral%20run",
  );
});

it("escapes what stands in attributes", () => {
  expect(figureFrameCode(figure)).toContain('title="A &quot;line&quot;"');
  expect(figureFrameCode(figure)).not.toMatch(/&(?!amp;|quot;)/);
  expect(figureElementCode(figure)).toBe(
    '<script type="module" src="https://strut.example/a/strut-figure.js"></script>\n' +
      '<strut-figure kind="scatter" lang="de" state="K=12&amp;motion=neutral%20run"></strut-figure>',
  );
});
