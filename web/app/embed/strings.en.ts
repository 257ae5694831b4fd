/** Texts of the Embed dialog. */
export const embed = {
  heading: "Embed",
  preview: "Preview",
  size: "Size",
  sizes: { article: "Article, 688 × 342", wide: "Wide, 960 × 582", small: "Narrow, 360 × 438" },
  controls: "Controls",
  autoplay: "Plays when seen",
  ghost: { name: "Input", beside: "Beside", overlay: "Same place", off: "Off" },
  theme: { name: "Theme", auto: "The page's", light: "Light", dark: "Dark" },
  as: { name: "Copy as", frame: "Frame", element: "Element", link: "Link" },
  code: "Code to copy",
  copy: "Copy",
  copied: "Copied.",
  copyByHand: "The browser does not let this page copy. Press Ctrl+C.",
  poster: "Save poster",
  close: "Close",
  motionLeftOut:
    "The dropped motion is too large to travel in the code. Host the file, and give its address as the attribute src of the element.",
  databaseLeftOut:
    "The database is on this device alone. Save it, host the file, and give its address as the attribute db of the element.",
  characterLeftOut:
    "The character is not part of the code. Put its file on the web and add its address as the attribute character.",
  title: (manner: string) => `A figure that walks, ${manner}`,
};
