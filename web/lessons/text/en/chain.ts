import type { LessonText } from "../text";

export const chain: LessonText = {
  idea: [
    "This walker follows no input. A step is a chain of five states, and each state knows the mean and the spread of every angle, of its change, and of how long the state lasts.",
    "Between these promises the likeliest motion is found, step after step. That is a hidden semi-Markov model, and its means and variances are all that is left of the recordings.",
    "Mix the means of two models, and you have a mixed walk. Go beyond, and it is exaggerated; go back, and it is negated.",
  ],
  bet: {
    question:
      "The curve must keep three promises: about the angle, about its change, and about the change of its change. Make σ″, the spread of the last, smaller. What becomes of the curve?",
    options: { smoother: "It gets smoother", same: "It stays as it is", rougher: "It gets rougher" },
    reveal: ({ leg, toes }) =>
      `With a tenth of σ″² the thigh jerks ${leg} times as much as before, the toes ${toes} times. A small variance is a firm promise: the change of change may hardly leave its mean, which is smooth.`,
  },
  look: [
    "The stairs are the [mu: mean μ] of each state, the bands its [sigma: deviation σ]. The [c: curve c] is the likeliest one, and the dashed one is that of the model as it was trained.",
    "The short lines are the [delta: changes Δc]. Each has a mean and a spread, too, and the knobs multiply the three variances, from a thousandth to a thousand times.",
    "Below are the states as long as they [d: last]. Drag the end of a step: [rho: ρ] makes each state longer by its own variance ν, so what varies much gives way first. With [k: k] you mix two models.",
  ],
  symbols: {
    c: { symbol: "c", name: "curve; its jerk against the model’s own" },
    mu: { symbol: "μ", name: "mean; how far the curve is from it" },
    sigma: { symbol: "σ²", name: "variance of the pose" },
    delta: { symbol: "Δc", name: "change; factors of σ′² and σ″²" },
    d: { symbol: "d", name: "durations of a left and a right step" },
    rho: { symbol: "ρ", name: "of left and of right steps" },
    k: { symbol: "k", name: "share of the style" },
  },
  why: "Why does the curve not run through the means, though nothing else is said about the angle itself? What would the walk look like if it did?",
  exercises: {
    A: {
      task: "Let the curve of the left thigh be within 2° of the means in every frame.",
      pass: ({ farthest }) =>
        `Yes: ${farthest}° at most. The curve climbs the stairs, and nobody would call that a walk.`,
      near: {
        other: () => "Look at the left thigh of the neutral walk: k 0.",
        further: ({ farthest }) => `Close: ${farthest}°. Further the same way.`,
      },
      refuse: ({ farthest }) =>
        `You loosened another promise: the curve is ${farthest}° from a mean. A small variance is a firm promise.`,
      no: ({ farthest }) => `The curve is ${farthest}° from a mean.`,
      hints: [
        "A small variance is a firm promise. Which of the three is about the angle itself?",
        "Make σ² as small as it goes, or σ′² and σ″² as large.",
      ],
    },
    B: {
      task: "The toes jerk. Halve that, to 0.5 times or less, without leaving the means by more than 2 of the model’s deviations.",
      pass: ({ jerkShare, deviations }) => `Yes: ${jerkShare} times the jerk, at ${deviations} deviations.`,
      near: {
        other: () => "Look at the left toes of the neutral walk: k 0.",
        far: ({ jerkShare, deviations }) =>
          `Close: smooth, at ${jerkShare} times, but ${deviations} deviations away. Less.`,
        rough: ({ jerkShare, deviations }) => `Close: ${jerkShare} times, at ${deviations} deviations. A little more.`,
      },
      refuse: ({ jerkShare, deviations }) =>
        `${jerkShare} times the jerk, but ${deviations} deviations from a mean: a promise that is too firm breaks the others.`,
      no: ({ jerkShare }) => `The curve jerks ${jerkShare} times as much as the model’s own.`,
      hints: [
        "The change of change is what jerks. Make that promise firmer.",
        "Turn σ″² down to somewhere between a tenth and a thirtieth.",
      ],
    },
    C: {
      task: "Slow the neutral walk down to 100 steps a minute, to within 1, by ρ.",
      pass: ({ cadence, left, right }) => `Yes: ${cadence} steps a minute with ρ ${left} and ${right}.`,
      near: {
        other: () => "Use the neutral walk: k 0.",
        longer: ({ cadence }) => `Close: ${cadence}. Make the steps a little longer.`,
        shorter: ({ cadence }) => `Close: ${cadence}. Make the steps a little shorter.`,
      },
      refuse: ({ cadence }) =>
        `A negative ρ makes states shorter: ${cadence} steps a minute. Slower steps last longer.`,
      no: ({ cadence }) => `${cadence} steps a minute.`,
      hints: ["Steps that last longer are fewer a minute.", "Both kinds of steps count. Try ρ near 1 for both."],
    },
  },
  sources: [
    "Tilmanne and Dutoit, Continuous control of style and style transitions through linear interpolation in hidden Markov model based walk synthesis, 2012, sections 4 to 6: models of steps, trajectories by maximum likelihood, durations, and style control.",
    "Trajectories are solved by `rust/strut-core/src/hsmm/mlpg.rs`; durations, and what limits them, are those of `rust/strut-core/src/hsmm/walker/durations.rs`.",
  ],
};
