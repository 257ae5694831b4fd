/** The API of `<strut-player>` other than attributes: for `custom-elements.json`, the types for JSX, and the documentation. */

/** Something with a name and a sentence about it. */
export interface Described {
  name: string;
  doc: string;
}

export const EVENTS: readonly (Described & { detail: string })[] = [
  { name: "ready", detail: "", doc: "The character is on the screen." },
  { name: "progress", detail: "{ label: string; fraction: number }", doc: "Progress of loading, 0 to 1." },
  {
    name: "stylechange",
    detail: "{ styles: Record<string, number> }",
    doc: "A visitor changed the styles. The event bubbles.",
  },
  {
    name: "frame",
    detail:
      "{ inputFrame: number; timeOut: number; planted: [boolean, boolean]; reads: { action: string; style: string; weight: number }[] }",
    doc: "A new frame of the motion.",
  },
  { name: "play", detail: "", doc: "Playback started." },
  { name: "pause", detail: "", doc: "Playback was paused." },
  { name: "error", detail: "{ error: unknown }", doc: "Something failed; what was on the stage stays." },
];

export const PARTS: readonly Described[] = [
  { name: "stage", doc: "The picture and everything drawn over it." },
  { name: "poster", doc: "The button that is shown until the character is drawn." },
  { name: "styles", doc: "The polygon of styles." },
  { name: "bar", doc: "The bar under the stage." },
  { name: "play", doc: "The button that plays and pauses." },
  { name: "seek", doc: "The slider of time." },
  { name: "clock", doc: "The time." },
  { name: "ghost", doc: "The button that moves the input." },
  { name: "fullscreen", doc: "The button that fills the screen." },
  { name: "link", doc: "The link to Strut." },
  { name: "vertex", doc: "A corner of the polygon." },
  { name: "handle", doc: "The point in the polygon." },
  { name: "credit", doc: "Who made the character, where that is to be said." },
  { name: "message", doc: "The sentence that says what went wrong." },
];

export const PROPERTIES: readonly Described[] = [
  { name: "--strut-signal", doc: "Colour of the polygon and of planted feet." },
  { name: "--strut-input", doc: "Colour of the input's name." },
  { name: "--strut-weight", doc: "Colour of what loads." },
  { name: "--strut-ink", doc: "Colour of text and handles." },
  { name: "--strut-panel", doc: "Background of the bar." },
  { name: "--strut-stage", doc: "Background of the stage." },
  { name: "--strut-radius", doc: "Radius of the corners." },
  { name: "--strut-font", doc: "Fonts." },
];

export const SLOTS: readonly Described[] = [
  { name: "poster", doc: "A picture of your own that is shown until the figure is drawn." },
  { name: "controls", doc: "Controls of your own at the end of the bar." },
  { name: "fallback", doc: "What is shown where nothing can be drawn." },
];

export const METHODS: readonly Described[] = [
  { name: "play", doc: "Starts playback; loads first if necessary." },
  { name: "pause", doc: "Pauses playback." },
  { name: "seek", doc: "Seeks to a time of the input, seconds." },
  { name: "load", doc: "Loads at once; resolves when the character is on the screen." },
  { name: "toBlob", doc: "Returns the picture as a file." },
  { name: "exportFile", doc: "Returns the whole motion in the current styles as a file: bvh, glb or vrma." },
];
