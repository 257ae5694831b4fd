/** What the controls that page and element share say, in English. */
export const ui = {
  polygon: { handle: "Style", styles: "Styles", weights: "Weights of the styles" },
  playButton: { play: "Play", pause: "Pause" },
};
