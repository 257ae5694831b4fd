/** Texts of the controls shared by page and element, in English. */
export const ui = {
  polygon: { handle: "Style", styles: "Styles", weights: "Weights of the styles" },
  playButton: { play: "Play", pause: "Pause" },
};
