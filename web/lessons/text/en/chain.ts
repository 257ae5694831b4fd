import type { LessonText } from "../text";

export const chain: LessonText = {
  idea: [
    "This walker has no input. A step is a chain of five states. Each state has a mean and a variance for every angle, for its velocity (the change from frame to frame), for its acceleration (the change of that change), and for the duration of the state.",
    "A mean with its variance is like a promise: with a small variance it is firm, with a large one it is loose. The model then picks the motion that keeps all these promises best. It is called a hidden semi-Markov model (“semi”, because it also models durations). Only its means and variances remain of the recordings.",
    "Mix the means of two models, and you have a mixed walk. With k above 1 the style is exaggerated, below 0 it is turned into its opposite.",
  ],
  bet: {
    question:
      "The curve must keep three promises: about the angle, its velocity and its acceleration. Make σ″, the standard deviation of the last, smaller. How does the curve change?",
    options: { smoother: "It gets smoother", same: "It stays as it is", rougher: "It gets rougher" },
    reveal: ({ leg, toes }) =>
      `With a tenth of σ″² the jerk (how fast the acceleration changes) falls to ${leg} times its old value at the thigh, and to ${toes} times at the toes. A small variance is a firm promise: the acceleration must stay close to its mean, which hardly varies.`,
  },
  look: [
    "The stairs are the [mu: mean μ] of each state, the bands its [sigma: standard deviation σ]. The [c: curve c] is the most likely one; the dashed curve is that of the trained model.",
    "The short lines are the [delta: velocities Δc], half the difference between the next frame and the previous one; Δ²c is the acceleration. μ′, σ′ and μ″, σ″ are their means and standard deviations. The knobs multiply the three variances by a thousandth to a thousand.",
    "The blocks are the states; their width is the [d: duration d]. The d with a bar is a state’s mean duration, ν its variance. Drag the end of a step: [rho: ρ] makes each state longer by ρ times its ν, so the states that vary most change most.",
    "m₁ is the model of the neutral walk, m₂ that of the style: with [k: k] you mix them.",
  ],
  symbols: {
    c: { symbol: "c", name: "curve; here its jerk, × the model’s own" },
    mu: { symbol: "μ", name: "mean; here the greatest distance of c" },
    sigma: { symbol: "σ²", name: "variance of poses; here its factor" },
    delta: { symbol: "Δc", name: "velocity; here the factors of σ′² and σ″²" },
    d: { symbol: "d", name: "durations of a left and a right step" },
    rho: { symbol: "ρ", name: "extra length of left and right steps" },
    k: { symbol: "k", name: "share of the style" },
  },
  why: "Why does the curve not pass through the means, although they are the only targets for the angle itself? What would the walk look like if it did?",
  exercises: {
    A: {
      task: "Bring the curve of the left thigh to within 2° of the means in every frame.",
      pass: ({ farthest }) => `Yes: ${farthest}° at most. The curve follows the stairs: it jumps from state to state.`,
      near: {
        other: () => "Look at the left thigh of the neutral walk: k 0.",
        further: ({ farthest }) => `Close: ${farthest}°. Further in the same direction.`,
      },
      refuse: ({ farthest }) =>
        `The promise about the angle is now the weaker one: the curve is ${farthest}° from a mean. A small variance is a firm promise.`,
      no: ({ farthest }) => `The curve is ${farthest}° from a mean.`,
      hints: [
        "A small variance is a firm promise. Which of the three is about the angle itself?",
        "Make σ² as small as it goes, or σ′² and σ″² as large.",
      ],
    },
    B: {
      task: "The toes have a lot of jerk. Reduce it to 0.5 times or less, while the curve stays within 2.2 σ of the means (with the model’s own σ).",
      pass: ({ jerkShare, deviations }) => `Yes: ${jerkShare} times the jerk, at ${deviations} σ.`,
      near: {
        other: () => "Look at the left toes of the neutral walk: k 0.",
        far: ({ jerkShare, deviations }) =>
          `Close: smooth, at ${jerkShare} times, but ${deviations} σ from a mean. A little less firm.`,
        rough: ({ jerkShare, deviations }) => `Close: ${jerkShare} times, at ${deviations} σ. A little firmer.`,
      },
      refuse: ({ jerkShare, deviations }) =>
        `${jerkShare} times the jerk, but ${deviations} σ from a mean: a promise that is too firm breaks the others.`,
      no: ({ jerkShare }) => `The jerk is ${jerkShare} times that of the model’s own curve.`,
      hints: [
        "Jerk is how fast the acceleration changes. Make the promise about the acceleration firmer.",
        "Turn σ″² down to somewhere between a tenth and a thirtieth.",
      ],
    },
    C: {
      task: "Use ρ to slow the neutral walk down to 100 steps a minute, to within 1.",
      pass: ({ cadence, left, right }) => `Yes: ${cadence} steps a minute with ρ ${left} and ${right}.`,
      near: {
        other: () => "Use the neutral walk: k 0.",
        longer: ({ cadence }) => `Close: ${cadence}. Make the steps a little longer.`,
        shorter: ({ cadence }) => `Close: ${cadence}. Make the steps a little shorter.`,
      },
      refuse: ({ cadence }) =>
        `A negative ρ makes states shorter: ${cadence} steps a minute. Slower steps last longer.`,
      no: ({ cadence }) => `${cadence} steps a minute.`,
      hints: [
        "The longer each step lasts, the fewer there are in a minute.",
        "Left and right steps both count. Try ρ near 1 for both.",
      ],
    },
  },
  sources: [
    "Tilmanne and Dutoit, Continuous control of style and style transitions through linear interpolation in hidden Markov model based walk synthesis, 2012, sections 4 to 6: models of steps, trajectories by maximum likelihood, durations, and style control.",
    "Trajectories are computed by `rust/strut-core/src/hsmm/mlpg.rs`; durations, and what limits them, are those of `rust/strut-core/src/hsmm/walker/durations.rs`.",
  ],
};
