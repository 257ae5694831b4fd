import type { LessonText } from "../text";

export const line: LessonText = {
  idea: [
    "How far does an old walker bend the knee at this instant? Nobody in the database stood in exactly this pose. But some frames are close, and for each of them we know the frame of the old walk with the same content.",
    "Plot one angle against the other: the input's knee to the right, the old knee upwards. Every dot is one close frame.",
    "A straight line through the dots answers for poses in between. Every joint has its own line, and every frame a new one.",
  ],
  bet: {
    question: "Fit the line to the nearest dot alone, K = 1. What is its slope?",
    options: { zero: "0: the line is level", one: "1: it rises as the input does", any: "Any: one dot fixes no slope" },
    reveal: ({ slope }) =>
      `It is ${slope}. One dot fits every slope equally well. The second term of the equation charges for steepness, so the cheapest line wins, and it is level: the prediction is the dot itself.`,
  },
  look: [
    "The dots are the [K: K nearest frames]; the larger a dot, the greater its [v: weight v]. The ring is the answer: it lies on the line, above the [x: input x].",
    "The line is drawn for the slope [c: c]. Two more terms, [a: a] and [b: b], know where the input and the output stood one frame ago. They move the line up and down as the walk goes on.",
    "The [lambda: ridge λ] makes slopes expensive. Turn it up and the line lies down on the dotted mean. Turn K up and the dots spread: more evidence, but from poses that are less alike.",
  ],
  symbols: {
    y: { symbol: "yₜ", name: "predicted angle of the output" },
    x: { symbol: "xₜ", name: "angle of the input" },
    a: { symbol: "aₜ", name: "weight of the input one frame ago" },
    b: { symbol: "bₜ", name: "weight of the output one frame ago" },
    c: { symbol: "cₜ", name: "weight of the input: the slope" },
    d: { symbol: "dₜ", name: "where the line begins" },
    K: { symbol: "K", name: "number of neighbours" },
    v: { symbol: "V", name: "sum of the neighbours’ weights v" },
    lambda: { symbol: "λ", name: "weight of the ridge" },
  },
  why: "Why may the engine fit a straight line although a knee does not move in a straight line?",
  exercises: {
    A: {
      task: "Twelve dots, all of equal weight, with 4° of noise. Find a λ whose prediction of the whole walk is as good as can be: within 1 % of the least error.",
      pass: ({ error, lambda }) => `Yes: λ ${lambda} gives ${error}°, and no λ is better by more than 1 %.`,
      near: {
        other: () => "Keep K at 12, ν at 4, and all dots of equal weight.",
        more: ({ error, leastError }) => `Close: ${error}°, the least is ${leastError}°. A little more λ.`,
        less: ({ error, leastError }) => `Close: ${error}°, the least is ${leastError}°. A little less λ.`,
      },
      refuse: ({ error, leastError }) =>
        `The line follows 12 points, noise and all: ${error}°, where ${leastError}° is possible.`,
      no: ({ error, leastError }) =>
        `Only the mean is left, and the pose of the input no longer matters: ${error}°, where ${leastError}° is possible.`,
      hints: [
        "A small λ believes the noise, a large one believes nothing. The best lies between.",
        "Watch the slope c while you turn λ: it should be neither wild nor 0.",
      ],
    },
    B: {
      task: "Without noise, at 40 neighbours: what is the least λ at which the prediction is within 0.1° of the neighbours’ mean? A half too much still counts.",
      pass: ({ lambda, above }) => `Yes: at λ ${lambda} the prediction is ${above}° from the mean.`,
      near: {
        other: () => "Keep K at 40, ν at 0, and the instant where it was.",
        more: ({ above }) => `Close: still ${above}° from the mean. A little more λ.`,
        less: ({ lambda, above }) => `Close: at λ ${lambda} it is ${above}° already. A little less would do.`,
      },
      refuse: ({ lambda, above }) => `Only the mean is left: λ ${lambda} gives ${above}°, but far less λ would do.`,
      no: ({ lambda, above }) => `At λ ${lambda} the prediction is still ${above}° from the mean.`,
      hints: [
        "λ → ∞ leaves the mean. You are looking for the point where it is nearly left already.",
        "Read the distance from the mean below the plot, and turn λ with Shift and the arrow keys.",
      ],
    },
    C: {
      task: "Find an instant at which the line says something else than the mean: at least 2° from it. K and λ are free.",
      pass: ({ above, lambda, k }) => `Yes: ${above}° from the mean, with K ${k} and λ ${lambda}.`,
      near: {
        other: () => "Set the noise ν to 0: it is the line that should differ, not the noise.",
        close: ({ above }) => `Close: ${above}°. Look for an instant at which the dots rise or fall more steeply.`,
      },
      refuse: ({ above }) => `Only the mean is left: ${above}°. A steep line must be cheap, and needs more than a dot.`,
      no: ({ above }) => `${above}° from the mean. There is more.`,
      hints: [
        "Far from the mean means a steep line, and an input far to one side of its neighbours.",
        "Turn K up to 160 and λ far down, then move the instant through the walk.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Eq. 2: one local model for each degree of freedom.",
    "The line is fitted by `predict` in `rust/strut-core/src/transfer/regression.rs`; the weights are those of `rust/strut-core/src/transfer/coherence.rs`. The feedback b is limited to ±0.9, so that a prediction cannot run away.",
    "The curve beside this text is the whole sweep of exercise A: drag [lambda: λ] along it.",
  ],
};
