/** Texts of the controls shared by page and element, in English. */
export const ui = {
  polygon: { handle: "Style", styles: "Styles", weights: "Style weights" },
  playButton: { play: "Play", pause: "Pause" },
};
