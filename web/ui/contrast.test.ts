import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { describe, expect, it } from "vitest";

const SHEET = readFileSync(resolve(import.meta.dirname, "tokens.css"), "utf8");

/** A token's colour in a theme, `#rrggbb`. */
function colour(token: string, theme: "light" | "dark"): string {
  const found = new RegExp(`--${token}: light-dark\\((#[0-9a-f]{6}), (#[0-9a-f]{6})\\)`).exec(SHEET);
  if (!found) throw new Error(`tokens.css has no pair of colours called ${token}.`);
  return found[theme === "light" ? 1 : 2]!;
}

/** Relative luminance, WCAG 2.2. */
function luminance(hex: string): number {
  const [r, g, b] = [1, 3, 5]
    .map((at) => Number.parseInt(hex.slice(at, at + 2), 16) / 255)
    .map((v) => (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4));
  return 0.2126 * r! + 0.7152 * g! + 0.0722 * b!;
}

function contrast(a: string, b: string): number {
  const [dark, light] = [luminance(a), luminance(b)].sort((x, y) => x - y);
  return (light! + 0.05) / (dark! + 0.05);
}

const SURFACES = ["bg", "stage-inner", "stage-outer", "panel", "raised", "pressed"];

for (const theme of ["light", "dark"] as const)
  describe(`the ${theme} theme`, () => {
    for (const surface of SURFACES) {
      for (const text of ["ink", "ink2", "ink3"])
        it(`has ${text} to be read on ${surface}`, () => {
          expect(contrast(colour(text, theme), colour(surface, theme))).toBeGreaterThanOrEqual(4.5);
        });
      it(`has outlines of controls to be seen on ${surface}`, () => {
        expect(contrast(colour("outline", theme), colour(surface, theme))).toBeGreaterThanOrEqual(3);
      });
    }
    // Text in the signal colour appears on panels and on hovered surfaces, never on a pressed one in the dark theme.
    for (const surface of theme === "light" ? SURFACES : SURFACES.filter((s) => s !== "pressed"))
      it(`has signal to be read on ${surface}`, () => {
        expect(contrast(colour("signal", theme), colour(surface, theme))).toBeGreaterThanOrEqual(4.5);
      });
  });
