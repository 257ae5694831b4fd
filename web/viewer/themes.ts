/** Colours and light levels of the two themes, from the project's visual tokens. */

import { TONE_COLOURS } from "../mannequin/colours";

/** Name of a theme. */
export type ThemeName = "dark" | "light";

/** Everything on the stage that depends on the theme; colours are sRGB hex. */
export interface Theme {
  /** Radial background: middle and edge. */
  background: { inner: string; outer: string };
  /** The mannequin's two tones. */
  shell: string;
  joint: string;
  /** The colour of what is selected and produced: planted footprints. */
  signal: string;
  /** Labels. */
  ink: string;
  input: string;
  /** Examples and their weights. */
  weight: string;
  /** Ghost: body and rim colour, and opacity facing the viewer. */
  ghost: { body: string; rim: string; opacity: number };
  /** Lines of the ground; opacities of the 1 m and the 0.25 m lines. */
  grid: { colour: string; major: number; minor: number };
  /** Footprints and path. */
  mark: string;
  /** Darkness of the key light's shadow and of the occlusion under the body, 0–1. */
  shadow: { key: number; occlusion: number };
  /** Light levels. */
  light: {
    key: number;
    rim: number;
    rimColour: string;
    fill: number;
    sky: string;
    ground: string;
    hemisphere: number;
    environment: number;
  };
}

/** Colours that a page may set. */
export type ThemeColours = Pick<Theme, "background" | "signal" | "ink" | "input">;

/** The themes by name. */
export const THEMES: Readonly<Record<ThemeName, Theme>> = {
  dark: {
    background: { inner: "#26282c", outer: "#141517" },
    ...TONE_COLOURS.dark,
    signal: "#ff5a36",
    ink: "#edeeec",
    input: "#8fa9cf",
    weight: "#f0bf4c",
    ghost: { body: "#7f97b8", rim: "#cfe0ff", opacity: 0.42 },
    grid: { colour: "#ffffff", major: 0.13, minor: 0.045 },
    mark: "#ffffff",
    shadow: { key: 0.72, occlusion: 0.9 },
    light: {
      key: 1.75,
      rim: 2.2,
      rimColour: "#bcd2ff",
      fill: 0.28,
      sky: "#aab4c4",
      ground: "#1b1c1f",
      hemisphere: 0.5,
      environment: 0.2,
    },
  },
  light: {
    background: { inner: "#fbfbfa", outer: "#e6e7e6" },
    ...TONE_COLOURS.light,
    signal: "#d23c14",
    ink: "#17181a",
    input: "#43628e",
    weight: "#dfa51f",
    ghost: { body: "#7f97ba", rim: "#46648f", opacity: 0.5 },
    grid: { colour: "#1a1c20", major: 0.15, minor: 0.055 },
    mark: "#1a1c20",
    shadow: { key: 0.3, occlusion: 0.42 },
    light: {
      key: 1.65,
      rim: 0.6,
      rimColour: "#ffffff",
      fill: 0.25,
      sky: "#ffffff",
      ground: "#8f8d88",
      hemisphere: 0.8,
      environment: 0.22,
    },
  },
};
