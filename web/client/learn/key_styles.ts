/**
 * Key-styling of the lessons: a model of the built-in walks, trained at the first call, and a second training run,
 * update by update.
 */
import { KeyStyleClips } from "../../engine/build/key_style_training";
import { loadBuiltIn } from "../../engine/built_in";
import { KeyStyleModel, type StyleKey } from "../../engine/key_style/model";
import type { Somn } from "../../engine/key_style/somn";
import { loadedOnce } from "../../engine/loaded_once";
import { DEGREES, POSE_FLOATS } from "../../humanoid";
import type { Keyed, LearnEngine, SamplePoses, SomnSnapshot, StyleSamples } from "./protocol";

/** Style variables of the lesson. */
const AXES = ["foot_separation", "foot_height_difference"];
/** Variables of the model. */
const VARIABLES = AXES.length;

/** Drags: their number, the number of recorded frames that each connects, and frames between two of these. */
const DRAGS = { count: 10, legs: 5, frames: 45, seed: 1 };
/** The cycle begins this many frames after its clip, and is as long as a walk cycle. */
const CYCLE = { skip: 10, shortest: 24, longest: 49, compared: 25 };

/** The functions behind the key-styling calls. */
export function createKeyStyles(): Pick<
  LearnEngine,
  "styleSamples" | "somn" | "somnPoses" | "somnErrors" | "dragged" | "stylePose" | "keyed"
> {
  const opened = loadedOnce(open);
  return {
    styleSamples: async () => structuredClone((await opened()).samples),
    somn: async (updates, asPrinted) => (await opened()).somn(updates, asPrinted),
    somnPoses: async (updates, asPrinted) => (await opened()).samplePoses(updates, asPrinted),
    somnErrors: async () => errorsOf((await opened()).model),
    dragged: async (sharing) => {
      const { model, samples } = await opened();
      return { change: greatestChange(model, samples, sharing), error: model.error(sharing) };
    },
    stylePose: async (values, sharing) => {
      const poser = (await opened()).model.poser();
      try {
        poser.mode = sharing;
        const { pose, weights } = poser.jump(values);
        return { pose: pose.slice(), weights: weights.slice() };
      } finally {
        poser.dispose();
      }
    },
    keyed: async (frames) => {
      const { model, samples } = await opened();
      return keyedCycle(model, samples, frames);
    },
  };
}

/** The trained model, and training runs that can be inspected. */
class Opened {
  readonly samples: StyleSamples;
  readonly #runs = new Map<boolean, Somn<KeyStyleModel>>();

  constructor(readonly model: KeyStyleModel) {
    const { values, units, rateHz, proportions } = model;
    this.samples = { values, units, rateHz, proportions, cycle: cycleOf(model) };
  }

  somn(updates: number, asPrinted: boolean): SomnSnapshot {
    const run = this.#runTo(updates, asPrinted);
    return structuredClone({ ...run.state, frames: run.frames, total: run.updates });
  }

  samplePoses(updates: number, asPrinted: boolean): SamplePoses | undefined {
    const run = this.#runTo(updates, asPrinted);
    const { sample: frame } = run.state;
    if (frame < 0) return undefined;
    const sample = this.model.recorded(frame)!;
    const soFar = run.model();
    const poser = soFar.poser();
    try {
      poser.mode = "hard";
      const predicted = poser.jump(valuesAt(this.model, frame)).pose.slice();
      return { sample, predicted, apart: meanOf(turns(sample, predicted)) };
    } finally {
      poser.dispose();
      soFar.dispose();
    }
  }

  /** Continues the training run, or restarts it if it is past `updates`. */
  #runTo(updates: number, asPrinted: boolean): Somn<KeyStyleModel> {
    const known = this.#runs.get(asPrinted);
    if (known && known.state.updates > updates) known.dispose();
    const run = known && known.state.updates <= updates ? known : this.model.learn({ asPrinted });
    this.#runs.set(asPrinted, run);
    run.step(updates - run.state.updates);
    return run;
  }
}

async function open(): Promise<Opened> {
  const clips = await KeyStyleClips.ofDatabase(await loadBuiltIn());
  try {
    const { file } = clips.train({ clips: [], action: "walk", axes: AXES, components: 0, em: false }, () => {});
    return new Opened(await KeyStyleModel.open(file));
  } finally {
    clips.dispose();
  }
}

/** The error after each pass. */
function errorsOf(model: KeyStyleModel): Float32Array {
  const run = model.learn();
  try {
    return Float32Array.from({ length: run.updates / run.frames }, () => {
      run.step(run.frames);
      const soFar = run.model();
      const error = soFar.error("hard");
      soFar.dispose();
      return error;
    });
  } finally {
    run.dispose();
  }
}

/** The variables of a training frame. */
const valuesAt = ({ values }: Pick<StyleSamples, "values">, frame: number) =>
  Array.from(values.subarray(VARIABLES * frame, VARIABLES * (frame + 1)));

/** Fixed drags between recorded frames: the variables of each frame. */
function drags(samples: StyleSamples): number[][][] {
  const frames = samples.values.length / VARIABLES;
  let seed = DRAGS.seed;
  const next = () => {
    seed = (seed * 1_103_515_245 + 12_345) % 2_147_483_648;
    return valuesAt(samples, Math.floor((seed / 2_147_483_648) * frames));
  };
  return Array.from({ length: DRAGS.count }, () => {
    const places = Array.from({ length: DRAGS.legs + 1 }, next);
    return places
      .slice(1)
      .flatMap((to, leg) =>
        Array.from({ length: DRAGS.frames }, (_, i) =>
          to.map((value, axis) => places[leg]![axis]! + (i / DRAGS.frames) * (value - places[leg]![axis]!)),
        ),
      );
  });
}

/** Largest rotation of a joint from frame to frame on the drags, degrees. */
function greatestChange(
  model: KeyStyleModel,
  samples: StyleSamples,
  mode: { temperature: number; blur: number },
): number {
  const poser = model.poser();
  try {
    poser.mode = mode;
    let greatest = 0;
    for (const drag of drags(samples)) {
      let before = poser.jump(drag[0]!).pose.slice();
      for (const values of drag) {
        const { pose } = poser.jump(values);
        greatest = Math.max(greatest, ...turns(before, pose));
        before = pose.slice();
      }
    }
    return greatest;
  } finally {
    poser.dispose();
  }
}

/** The angle of every joint between two poses, degrees. */
function turns(a: ArrayLike<number>, b: ArrayLike<number>): number[] {
  return Array.from({ length: (POSE_FLOATS - 3) / 4 }, (_, joint) => {
    let cosine = 0;
    for (let i = 3 + 4 * joint; i < 7 + 4 * joint; i++) cosine += a[i]! * b[i]!;
    return 2 * DEGREES * Math.acos(Math.min(1, Math.abs(cosine)));
  });
}

const meanOf = (values: readonly number[]) => values.reduce((sum, value) => sum + value, 0) / values.length;

/** A cycle of the first clip that has two: the length at which its variables repeat best. */
function cycleOf(model: KeyStyleModel): StyleSamples["cycle"] {
  const clip = model.clips.find(({ frames }) => frames > CYCLE.skip + 2 * CYCLE.longest) ?? model.clips[0]!;
  const first = clip.first + CYCLE.skip;
  const apart = (length: number) => {
    let sum = 0;
    for (let i = 0; i < CYCLE.compared; i++) {
      const [now, later] = [valuesAt(model, first + i), valuesAt(model, first + i + length)];
      sum += now.reduce((total, value, axis) => total + Math.abs(value - later[axis]!), 0);
    }
    return sum;
  };
  let frames = CYCLE.shortest;
  for (let length = CYCLE.shortest; length <= CYCLE.longest; length++)
    if (apart(length) < apart(frames)) frames = length;
  return { first, frames };
}

/** The cycle interpolated from keys, which repeat in the cycles before and after it. */
function keyedCycle(model: KeyStyleModel, { cycle, rateHz, values }: StyleSamples, frames: readonly number[]): Keyed {
  const styling = model.styling();
  try {
    const keys = [-1, 0, 1].flatMap((round): StyleKey[] =>
      frames.map((frame) => ({
        secs: (frame + (round + 1) * cycle.frames) / rateHz,
        values: valuesAt({ values }, cycle.first + frame),
      })),
    );
    const begin = keys[0]!.secs;
    styling.set(
      keys.map(({ secs, values }) => ({ secs: secs - begin, values })),
      "spline",
    );
    const errors = new Float32Array(cycle.frames);
    const followed = new Float32Array(VARIABLES * cycle.frames);
    for (let frame = 0; frame < cycle.frames; frame++) {
      const { pose, reached } = styling.at((frame + cycle.frames) / rateHz - begin, "style");
      const angles = turns(pose, model.recorded(cycle.first + frame)!);
      errors[frame] = meanOf(angles);
      followed.set(reached, VARIABLES * frame);
    }
    return { errors, values: followed };
  } finally {
    styling.dispose();
  }
}
