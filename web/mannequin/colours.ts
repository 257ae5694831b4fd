/** The colours of the mannequin. */

import type { Tone } from "./part";

/** Colours of the two tones on a dark and on a light background, sRGB hex. */
export const TONE_COLOURS: Readonly<Record<"dark" | "light", Readonly<Record<Tone, string>>>> = {
  dark: { shell: "#dcdbd6", joint: "#4b4e54" },
  light: { shell: "#f1f0ec", joint: "#3a3d42" },
};
