/** Synthesised walks of the lessons, by the built-in walk model, which is loaded at the first call. */
import { StrutError } from "../../engine/errors";
import { loadedOnce } from "../../engine/loaded_once";
import type { StyleWeights } from "../../engine/types";
import { WalkModel, type Weights } from "../../engine/walk/walker";
import { POSE_FLOATS } from "../../humanoid";
import type { LearnEngine } from "./protocol";

/** The functions behind the walk calls. */
export function createWalks(): Pick<LearnEngine, "walkPath" | "walk"> {
  const opened = loadedOnce(() => WalkModel.builtIn());
  return {
    walkPath: async (styles, { joint, axis }, options) => {
      const model = await opened();
      return model.path(weightsOf(model, styles), joint, axis, options);
    },
    walk: async (styles, frames) => {
      const model = await opened();
      const walker = model.walker();
      try {
        walker.plan(weightsOf(model, styles), []);
        walker.reset();
        const poses = new Float32Array(frames * POSE_FLOATS);
        for (let i = 0; i < frames; i++) poses.set((i === 0 ? walker.frame : walker.next()).pose, i * POSE_FLOATS);
        // The answer's arrays are transferred; the model keeps its own.
        return { poses, rateHz: model.rateHz, proportions: Float32Array.from(model.proportions) };
      } finally {
        walker.dispose();
      }
    },
  };
}

/** One weight per style of the model for the steps of each side. @throws StrutError `bad-input` for an unknown style */
function weightsOf({ styles }: WalkModel, wanted: StyleWeights): Weights {
  const unknown = Object.keys(wanted).find((style) => !styles.includes(style));
  if (unknown !== undefined)
    throw new StrutError({ code: "bad-input", message: `The walk model has no style '${unknown}'.`, hint: "" });
  const weights = Float32Array.from(styles, (style) => wanted[style] ?? 0);
  return [weights, weights];
}
