/** The page in a frame: one player with the attributes of the URL's query, and messages to the embedding page. */
import type { FrameDetail, StrutPlayer } from "../element";
import { answer, attributesOf, readRequest, SETTINGS, type Setting } from "./messages";

const player = document.createElement("strut-player") as StrutPlayer;
for (const [name, value] of attributesOf(location.search)) player.setAttribute(name, value);
document.body.append(player);

/** The displayed input frame; the attribute only has the initial one. */
let frame = 0;
player.addEventListener("frame", (event) => {
  frame = (event as CustomEvent<FrameDetail>).detail.inputFrame;
});
const tell = (names: readonly Setting[], type?: string) => answer(player, frame, names, type);

addEventListener("message", ({ data, source }) => {
  const request = readRequest(data);
  if (!request) return;
  for (const [name, value] of Object.entries(request.set)) {
    if (value === null || value === undefined) player.removeAttribute(name);
    else player.setAttribute(name, value);
  }
  if (request.playing === true) player.play();
  if (request.playing === false) player.pause();
  // The message contains only what the page's visitor sees: any page may know it.
  if (request.get.length > 0) source?.postMessage(tell(request.get), { targetOrigin: "*" });
});

if (parent !== window)
  for (const type of ["ready", "stylechange", "play", "pause"])
    player.addEventListener(type, () => parent.postMessage(tell(SETTINGS, type), "*"));
