/** The colours that the mannequin wears. */

import type { Tone } from "./part";

/** Colours of the two tones before a dark and before a light background, sRGB hex. */
export const TONE_COLOURS: Readonly<Record<"dark" | "light", Readonly<Record<Tone, string>>>> = {
  dark: { shell: "#dcdbd6", joint: "#4b4e54" },
  light: { shell: "#f1f0ec", joint: "#3a3d42" },
};
