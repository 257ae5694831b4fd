/** Texts of the Embed dialog. */
export const embed = {
  heading: "Embed",
  preview: "Preview",
  size: "Size",
  sizes: { article: "Article, 688 × 342", wide: "Wide, 960 × 582", small: "Narrow, 360 × 438" },
  controls: "Controls",
  autoplay: "Plays when visible",
  ghost: { name: "Input", beside: "Beside", overlay: "Overlaid", off: "Off" },
  theme: { name: "Theme", auto: "As the page", light: "Light", dark: "Dark" },
  as: { name: "Copy as", frame: "Frame", element: "Element", link: "Link" },
  code: "Code to copy",
  copy: "Copy",
  copied: "Copied.",
  copyByHand: "The browser does not allow this page to copy. Press Ctrl+C.",
  poster: "Save poster",
  close: "Close",
  motionLeftOut:
    "The dropped motion is too large for the code. Host the file, and set the attribute src of the element to its URL.",
  databaseLeftOut:
    "The database is only on this device. Save it, host the file, and set the attribute db of the element to its URL.",
  characterLeftOut:
    "The code does not contain the character. Host its file, and set the attribute character of the element to its URL.",
  title: (manner: string) => `A character walking, ${manner}`,
};
