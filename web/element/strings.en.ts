/** Texts of the player in English. */
export const element = {
  description: (manner: string) => `A figure walking, ${manner}, beside the motion that it performs.`,
  /** Styles and their weights, the heaviest first. */
  mix: (styles: readonly (readonly [name: string, weight: string])[]) =>
    styles.map(([name, weight]) => `${name} ${weight}`).join(", "),
  instructions:
    "Space plays and pauses. Arrow keys turn the view. Home and End go to the first and the last frame. Keys 1 to 8 give all of one style, L loops, G moves the input, F fills the screen.",
  credit: (title: string, authors: readonly string[]) =>
    `${title === "" ? "Character" : title} by ${authors.join(", ")}`,
  seek: "Time",
  seekValue: (now: string, duration: string) => `${now} of ${duration} seconds`,
  ghost: { name: "Input", beside: "Input beside", overlay: "Input in the same place", off: "Input hidden" },
  loop: { on: "Loops", off: "Stops at the end" },
  fullscreen: "Fill the screen",
  link: "Open in Strut",
  brand: "Strut",
  play: "Play",
  loading: "Loading",
  ready: "Ready",
  retry: "Try again",
  noWebGl: "This figure needs WebGL 2, which this browser does not have or does not allow.",
};
