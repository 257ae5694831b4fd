/** Files of the picture: a poster, a video of the next seconds, and the motion of a walker. Loaded on first use. */

import type { Crowd } from "../../../client/crowd/crowd_client";
import type { CallOptions } from "../../../client/protocol";
import { saveFile } from "../../../ui/dom";
import { pngOf } from "../../outputs/png";
import { saveBvh } from "../../outputs/save_motion";
import { saveVideo, VIDEO_RATE } from "../../outputs/video";
import { strings } from "../../strings/strings";
import type { CrowdPicture } from "./picture";

const words = strings.crowd;

/** Length of a video, and of a walker's motion, seconds. */
const VIDEO_SECS = 10;
const BVH_SECS = 10;

type Output = (picture: CrowdPicture, crowd: Crowd, call: CallOptions) => Promise<string>;

const poster: Output = async (picture, _, { signal }) => {
  const blob = await pngOf(await picture.copyAt(performance.now(), 1, true, signal));
  const name = `${words.fileName}.png`;
  saveFile(name, blob);
  return name;
};

/** Advances tick by tick, however long a picture takes; pictures between two ticks are interpolated. */
const video: Output = async (picture, crowd, { signal, onProgress }) => {
  const [begin, perTick] = [performance.now(), VIDEO_RATE / crowd.rateHz];
  const pictures = VIDEO_SECS * VIDEO_RATE;
  async function* frames(): AsyncGenerator<HTMLCanvasElement> {
    for (let i = 0; i < pictures; i++) {
      if (i % perTick === 0) await crowd.step();
      onProgress?.({ label: words.filming, fraction: i / pictures });
      yield picture.copyAt(begin + (1000 * i) / VIDEO_RATE, (i % perTick) / perTick, false, signal);
    }
  }
  const name = await saveVideo(words.fileName, frames(), "as on screen");
  if (name === undefined) throw new Error(strings.page.outputs.noVideo);
  return name;
};

/** Saves an agent's next seconds as a BVH file; returns its name. @param one display name of the agent */
export async function saveWalker(crowd: Crowd, walker: number, one: string): Promise<string> {
  return saveBvh(words.bvhName(one), await crowd.exportBvh(walker, BVH_SECS));
}

export const outputsOf = { poster, video };
