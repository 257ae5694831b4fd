/** Texts of the player in English. */
export const element = {
  description: (manner: string) => `A character walking, ${manner}, beside its input motion.`,
  /** Styles and their weights, the heaviest first. */
  mix: (styles: readonly (readonly [name: string, weight: string])[]) =>
    styles.map(([name, weight]) => `${name} ${weight}`).join(", "),
  instructions:
    "Space plays or pauses. Arrow keys turn the view. Home and End go to the first and last frame. Keys 1 to 8 select one style alone. L loops, G moves or hides the input, F is full screen.",
  credit: (title: string, authors: readonly string[]) =>
    `${title === "" ? "Character" : title} by ${authors.join(", ")}`,
  seek: "Time",
  seekValue: (now: string, duration: string) => `${now} of ${duration} seconds`,
  ghost: { name: "Input", beside: "Input beside", overlay: "Input overlaid", off: "Input hidden" },
  loop: { on: "Loops", off: "Stops at the end" },
  fullscreen: "Full screen",
  link: "Open in Strut",
  brand: "Strut",
  play: "Play",
  loading: "Loading",
  ready: "Ready",
  retry: "Try again",
  noWebGl: "WebGL 2 is not available in this browser. Turn on hardware acceleration, or use another browser.",
};
