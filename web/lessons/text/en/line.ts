import type { LessonText } from "../text";

export const line: LessonText = {
  idea: [
    "How far does an old walker bend the knee at this instant? No frame in the database has exactly this pose. But some frames are close, and for each of them we know the frame of the old walk with the same content.",
    "Plot one angle against the other: the input’s left knee (the rotation of its lower leg) to the right, that of the old walk upwards. Every dot is one close frame.",
    "A straight line fitted to the dots gives the answer for poses in between. Every joint has its own line, and every frame a new one.",
  ],
  bet: {
    question: "Fit the line to the nearest dot alone, K = 1. What is its slope?",
    options: { zero: "0: the line is level", one: "1: it rises as the input does", any: "Any: one dot fixes no slope" },
    reveal: ({ slope }) =>
      `It is ${slope}. One dot fits every slope equally well. The second term of the equation penalises steep lines, so the level line wins: the prediction is the dot itself.`,
  },
  look: [
    "The dots are the [K: K nearest frames]; the larger a dot, the greater its [v: weight v]. The ring is the [y: answer y]: it lies on the line, above the [x: input x]. The band shows the error of the full fit (all three inputs), one standard deviation. The line is only a slice through that fit, so dots may lie outside.",
    "[c: c] is the slope of the line. Two more terms, [a: a] and [b: b], weight the input and the output of the previous frame. [d: d] is the constant that remains when all three are 0. The lower figure adds up the four terms.",
    "The second line defines the fit. β holds a, b and c. For each neighbour k, u holds three numbers: the previous x, the previous y and the current x; y is its output. A tilde means that the neighbours’ mean is subtracted. The first term asks for small errors.",
    "The second term penalises slopes. V is the sum of all weights and σ the standard deviation of this joint in the whole database, so the same [lambda: ridge λ] suits every K and every joint. Turn λ up: the line flattens onto the dotted mean, and d gives the whole answer.",
    "b is kept within ±0.9. An error in one frame is passed on to the next, multiplied by b. If |b| < 1, it dies away.",
  ],
  symbols: {
    y: { symbol: "yₜ", name: "predicted angle of the output, from its mean" },
    x: { symbol: "xₜ", name: "angle of the input, from its mean" },
    a: { symbol: "aₜ", name: "weight of the input one frame ago" },
    b: { symbol: "bₜ", name: "weight of the output one frame ago" },
    c: { symbol: "cₜ", name: "weight of the input: the slope" },
    d: { symbol: "dₜ", name: "constant: the answer without slopes" },
    K: { symbol: "K", name: "number of neighbours" },
    v: { symbol: "vₖ", name: "weight of a dot, 0 to 1; V is their sum" },
    lambda: { symbol: "λ", name: "ridge: the penalty on slopes" },
  },
  why: "Why may the engine fit a straight line although a knee does not move in a straight line?",
  exercises: {
    A: {
      task: "Twelve dots, all of equal weight, with 4° of noise. Predict the whole walk, and compare it with the recorded angry walk: find a λ whose error is within 1 % of the smallest.",
      pass: ({ error, lambda }) => `Yes: λ ${lambda} gives ${error}°, and no λ is better by more than 1 %.`,
      near: {
        other: () =>
          "Keep the knee of the angry walk, K at 12, ν at 4, and all dots of equal weight: only λ should change.",
        more: ({ error, leastError }) => `Close: ${error}°, the least is ${leastError}°. A little more λ.`,
        less: ({ error, leastError }) => `Close: ${error}°, the least is ${leastError}°. A little less λ.`,
      },
      refuse: ({ error, leastError }) =>
        `The line follows the noise of the 12 points: ${error}°, where ${leastError}° is possible.`,
      no: ({ error, leastError, left }) =>
        left === "mean"
          ? `Only the mean is left, and the pose of the input no longer matters: ${error}°, where ${leastError}° is possible.`
          : `Too much λ: the line is flatter than its dots. ${error}°, where ${leastError}° is possible.`,
      hints: [
        "With a small λ the line follows the noise, with a large one it ignores the input. The best lies between.",
        "Watch the line while you turn λ: it should be neither steep nor level.",
      ],
    },
    B: {
      task: "Without noise, at 40 neighbours: what is the smallest λ at which the prediction is within 0.1° of the neighbours’ mean? Up to 1.5 times that λ still counts.",
      pass: ({ lambda, above }) => `Yes: at λ ${lambda} the prediction is ${above}° from the mean.`,
      near: {
        other: () => "Keep the joint, K at 40, ν at 0, the weights and the instant as they were: only λ should change.",
        more: ({ above }) => `Close: still ${above}° from the mean. A little more λ.`,
        less: ({ lambda, above }) => `Close: at λ ${lambda} it is ${above}° already. A little less would do.`,
      },
      refuse: ({ lambda, above }) => `Only the mean is left: λ ${lambda} gives ${above}°, but far less λ would do.`,
      no: ({ lambda, above }) => `At λ ${lambda} the prediction is still ${above}° from the mean.`,
      hints: [
        "λ → ∞ leaves the mean alone. You are looking for the λ at which the line has all but reached it.",
        "Read the distance from the mean below the plot, and turn λ with Shift and the arrow keys.",
      ],
    },
    C: {
      task: "Find an instant where the line’s answer differs from the mean by at least 2°. K and λ are free.",
      pass: ({ above, lambda, k }) => `Yes: ${above}° from the mean, with K ${k} and λ ${lambda}.`,
      near: {
        other: () =>
          "Keep the joint and the weights as they were, and the noise ν at 0: only K, λ and the instant are free.",
        close: ({ above }) => `Close: ${above}°. Look for an instant where the dots rise or fall more steeply.`,
      },
      refuse: ({ above }) =>
        `Only the mean is left: ${above}°. A steep line needs a small λ, and more than one or two dots.`,
      no: ({ above }) => `${above}° from the mean. At other instants it is more.`,
      hints: [
        "Far from the mean means a steep line, and an input far to one side of its neighbours.",
        "Turn K up to 160 and λ far down, then move the instant through the walk.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Eq. 2: one local model for each degree of freedom.",
    "The line is fitted by `predict` in `rust/strut-core/src/transfer/regression.rs`; the weights are those of `rust/strut-core/src/transfer/coherence.rs`. The feedback b is limited to ±0.9, so that a prediction cannot run away.",
    "Once exercise A is solved, a curve beside this text shows the error for every λ: drag [lambda: λ] along it.",
  ],
};
