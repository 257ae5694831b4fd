/** The page that draws film strips: instants of a clip side by side, performed by the playground's mannequin. */
import { JOINT, POSE_FLOATS, createWorldPose, headingOf, worldFromLocal } from "../../web/humanoid";
import { DatabaseBuilder, type Preview } from "../../web/engine/build/builder";
import { type CameraView } from "../../web/viewer";
import { SideBySideViewer } from "../../web/viewer/side_by_side_viewer";

/** A strip of a clip. */
export interface Strip {
  /** Caption of the strip, before its duration; without it there is no caption. */
  title?: string;
  /** The BVH file. */
  bvh: string;
  /** Action, which determines the displayed part: a stride, or the time around the action's key moment. */
  action: string;
  view: CameraView;
}

declare global {
  interface Window {
    /** Appends strips to the page. */
    drawStrips: (strips: Strip[]) => Promise<void>;
  }
}

const COLUMNS = 9;
const COLUMN_PX = { width: 112, height: 190 };
/** Height of a column for figures that jump with raised arms. A taller column needs a greater camera distance. */
const TALL_PX = 290;
/** Seconds before and after an action's key moment. */
const AROUND = { before: 0.9, after: 0.9 };
/** Time between two renderings, seconds. */
const STEP = 0.2;

const root = document.getElementById("stage")!;
root.style.width = `${COLUMNS * COLUMN_PX.width}px`;
const viewer = new SideBySideViewer(root, "light", "");
const builder = DatabaseBuilder.load();
let time = 0;

window.drawStrips = async (strips) => {
  for (const strip of strips) await draw(strip);
};

async function draw({ title, bvh, action, view }: Strip): Promise<void> {
  const clip = (await builder).preview(new TextEncoder().encode(bvh));
  const [from, to] = stretchOf(clip, action);
  root.style.height = `${action === "jump" ? TALL_PX : COLUMN_PX.height}px`;
  const pose = (i: number) => {
    const frame = Math.round(from + ((to - from) * i) / (COLUMNS - 1));
    return clip.poses.subarray(frame * POSE_FLOATS, (frame + 1) * POSE_FLOATS);
  };
  viewer.setProportions(clip.proportions);
  viewer.setFigures(Array.from({ length: COLUMNS }, (_, i) => ({ pose: pose(i), reference: null })));
  viewer.camera(view);
  viewer.settle();
  // Until transitions have ended and the refined picture is drawn, which can be read in the same task.
  do {
    await new Promise(requestAnimationFrame);
    time += STEP;
    viewer.render(time);
  } while (!viewer.still);
  const picture = new Image();
  picture.src = viewer.copy().toDataURL();
  picture.width = COLUMNS * COLUMN_PX.width;
  await picture.decode();
  const caption = document.createElement("figcaption");
  if (title !== undefined) caption.textContent = `${title} ${((to - from) / clip.rateHz).toFixed(2)} s`;
  const figure = document.createElement("figure");
  figure.append(caption, picture);
  document.querySelector("main")!.append(figure);
}

/** Returns the first and the last frame of the displayed part. */
function stretchOf(clip: Preview, action: string): [number, number] {
  const measures = measuresOf(clip);
  if (action === "walk" || action === "run") return strideOf(measures, clip);
  const of = { jump: (m: Measure) => m.hips, kick: (m: Measure) => m.foot, punch: (m: Measure) => m.reach }[action];
  const values = measures.map(of ?? (() => 0));
  // The first moment that is close to the maximum.
  const [least, most] = [Math.min(...values), Math.max(...values)];
  const near = values.findIndex((v) => v > least + 0.9 * (most - least));
  const peak = values.findIndex((v, i) => i >= near && !(values[i + 1]! > v));
  const frame = (secs: number) => Math.min(Math.max(0, Math.round(peak + secs * clip.rateHz)), clip.frames - 1);
  return [frame(-AROUND.before), frame(AROUND.after)];
}

/** Values that identify the moments of an action, metres. */
interface Measure {
  hips: number;
  foot: number;
  /** Distance of the more advanced hand in front of the hips. */
  reach: number;
  /** Distance of the left ankle in front of the hips. */
  left: number;
}

function measuresOf({ poses, proportions, frames }: Preview): Measure[] {
  const world = createWorldPose();
  return Array.from({ length: frames }, (_, f) => {
    worldFromLocal(proportions, poses.subarray(f * POSE_FLOATS, (f + 1) * POSE_FLOATS), world);
    const p = world.positions;
    const heading = headingOf(world, 0);
    const ahead = (joint: number) =>
      (p[3 * joint]! - p[0]!) * Math.sin(heading) + (p[3 * joint + 2]! - p[2]!) * Math.cos(heading);
    return {
      hips: p[1]!,
      foot: Math.max(p[3 * JOINT.left_foot + 1]!, p[3 * JOINT.right_foot + 1]!),
      reach: Math.max(ahead(JOINT.left_hand), ahead(JOINT.right_hand)),
      left: ahead(JOINT.left_foot),
    };
  });
}

/**
 * Returns a stride from one strike of the left foot to the next, in the middle of the clip. At a strike the ankle is
 * farthest in front.
 */
function strideOf(measures: readonly Measure[], { frames, rateHz }: Preview): [number, number] {
  const reach = Math.round(0.25 * rateHz);
  const strikes = measures.flatMap(({ left }, f) => {
    const around = measures.slice(Math.max(0, f - reach), f + reach + 1);
    return f > 0 && left > 0.08 && around.every((m) => m.left <= left) ? [f] : [];
  });
  const pairs = strikes.slice(1).map((to, i): [number, number] => [strikes[i]!, to]);
  return pairs[pairs.length >> 1] ?? [0, frames - 1];
}
