/** The API of `<strut-player>` other than attributes: for `custom-elements.json`, the types for JSX, and the documentation. */

/** Something with a name and a sentence about it. */
interface Described {
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
  { name: "error", detail: "{ error: unknown }", doc: "An operation failed; the displayed character stays." },
];

export const PARTS: readonly Described[] = [
  { name: "stage", doc: "The picture and everything drawn over it." },
  { name: "poster", doc: "The button that is shown until the character is drawn." },
  { name: "styles", doc: "The style polygon." },
  { name: "bar", doc: "The bar under the stage." },
  { name: "play", doc: "The play button." },
  { name: "seek", doc: "The time slider." },
  { name: "clock", doc: "The time." },
  { name: "ghost", doc: "The button that places or hides the input." },
  { name: "fullscreen", doc: "The full-screen button." },
  { name: "link", doc: "The link to Strut." },
  { name: "vertex", doc: "A corner of the polygon." },
  { name: "handle", doc: "The point in the polygon." },
  { name: "credit", doc: "The credit of the character's author, if its licence requires one." },
  { name: "message", doc: "The error message." },
];

export const PROPERTIES: readonly Described[] = [
  { name: "--strut-signal", doc: "Colour of the polygon and of planted feet." },
  { name: "--strut-input", doc: "Colour of the input's name." },
  { name: "--strut-weight", doc: "Colour of the loading progress." },
  { name: "--strut-ink", doc: "Colour of text and handles." },
  { name: "--strut-panel", doc: "Background of the bar." },
  { name: "--strut-stage", doc: "Background of the stage." },
  { name: "--strut-radius", doc: "Radius of the corners." },
  { name: "--strut-font", doc: "Fonts." },
];

export const SLOTS: readonly Described[] = [
  { name: "poster", doc: "Your own picture, shown until the character is drawn." },
  { name: "controls", doc: "Your own controls at the end of the bar." },
  { name: "fallback", doc: "Content shown if the character cannot be drawn." },
];

export const METHODS: readonly Described[] = [
  { name: "play", doc: "Starts playback; loads first if necessary." },
  { name: "pause", doc: "Pauses playback." },
  { name: "seek", doc: "Seeks to a time of the input, seconds." },
  { name: "load", doc: "Loads at once; resolves when the character is on the screen." },
  { name: "toBlob", doc: "Returns the picture as a file." },
  { name: "exportFile", doc: "Returns the whole motion in the current styles as a file: bvh, glb or vrma." },
];
