import type { LessonText } from "../text";

export const time: LessonText = {
  idea: [
    "A style changes not only how a body moves, but also how fast. The old walker takes longer over each step; after a few seconds it is several steps behind.",
    "So the engine predicts two things for every frame: a pose, and how long it lasts. It reads both off the neighbours, the nearest examples in the database.",
    "If you blend two styles, poses and durations are blended in the same way. Can you compute the pace before you watch the walk?",
  ],
  bet: {
    question:
      "Played fully old, the walk takes longer. Take half old and half neutral: how much of that delay is left?",
    options: { less: "Less than half", half: "Half", more: "More than half" },
    reveal: ({ half, all, share }) =>
      `Fully old takes ${all} % longer, half old ${half} %: ${share} of the delay. Durations are blended with the same weights as poses, so the delay is linear in the weight.`,
  },
  look: [
    "Drag the point: its position sets the weights [s: s] of old and childlike. Neutral gets the rest, so that the sum is 1. In the hatched part, weights are below 0 or above 1: styles are exaggerated.",
    "The curve gives the time in the blend for each time in the input; the dashed line is the input’s own pace. The slope of the curve is the [w: duration w] of a frame, divided by the 16.7 ms that it lasts in the input.",
    "The last figure shows where the duration of one style comes from. Each dot is a neighbour k at distance d, whose frame lasted wₖ. A nearer neighbour has a greater [g: weight gₖ]; how fast g falls is the [h: bandwidth h], the mean distance of all K. vₖ is the weight from lesson 5. The horizontal line is the mean with both weights.",
    "The other lines blend the styles m: yᵐ is the pose of a style, wᵐ its duration, and both are blended with the same weights. Finally the engine corrects frames where the neighbours run ahead of or behind the input, so w is not exactly their mean.",
  ],
  symbols: {
    w: { symbol: "w", name: "duration of the frame" },
    g: { symbol: "gₖ", name: "weight by distance; the sum Σ of all" },
    h: { symbol: "h", name: "bandwidth: mean distance, in σ" },
    s: { symbol: "sₘ", name: "weights: old, childlike, neutral" },
  },
  why: "If you blended only poses and kept the input’s pace, what would an old walk look like? And if you blended only durations?",
  exercises: {
    A: {
      task: "With old alone, make the walk take 1.2 times as long as the input, to within 0.005.",
      pass: ({ old, ratio }) => `Yes: with ${old} of old it takes ${ratio} times as long.`,
      near: {
        other: () => "Use old alone: childlike must be 0.",
        more: ({ length }) => `Close: length now ${length} s. A little more old.`,
        less: ({ length }) => `Close: length now ${length} s. A little less old.`,
      },
      refuse: ({ old, ratio }) =>
        `${old} is the weight, not the delay: fully old takes far less than twice as long. Now it is ${ratio} times.`,
      no: ({ length, input }) => `Length now ${length} s, for ${input} s of input.`,
      hints: [
        "The delay is linear in the weight: read it at weight 1, and take the part that you need.",
        "At weight 1 the readout gives the factor. Divide 0.2 by its part above 1.",
      ],
    },
    B: {
      task: "Old is slower, childlike is faster. Take at least 0.25 of each, within the triangle, so that the walk is as long as the input, to within 0.005.",
      pass: ({ old, childlike, ratio }) => `Yes: ${old} of old and ${childlike} of childlike cancel: ${ratio} times.`,
      near: {
        motion: () => "Use the neutral walk.",
        other: () => "At least 0.25 of each, and no weight below 0.",
        slow: ({ length }) => `Close: length now ${length} s. A little too slow.`,
        fast: ({ length }) => `Close: length now ${length} s. A little too fast.`,
      },
      refuse: ({ ratio }) =>
        `Equal weights do not cancel: old slows down more than childlike speeds up. Now it is ${ratio} times as long.`,
      no: ({ length, input }) => `Length now ${length} s, for ${input} s of input.`,
      hints: [
        "Read the delay of each style alone. What one adds, the other must take away.",
        "Set old to a little above 0.25, then raise childlike until the readout says 1.00.",
      ],
    },
    C: {
      task: "Make the walk take longer than its slowest recorded performance in any style.",
      pass: ({ ratio, longest, longestStyle }) =>
        `Yes: ${ratio} times, and the slowest recorded one, ${longestStyle}, took ${longest} times. No recording is this slow.`,
      near: {
        other: () => "Use the neutral walk.",
        further: ({ ratio, longest }) => `Beyond the data, at ${ratio} times. It takes more than ${longest}: further.`,
      },
      refuse: ({ ratio }) =>
        `Within the triangle nothing is slower than its slowest corner: now ${ratio} times. Leave the triangle.`,
      no: ({ ratio }) => `Now ${ratio} times as long.`,
      hints: ["Weights may exceed 1: then neutral is subtracted.", "Drag the point to the right, into the hatching."],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, sections 5.1 and 5.4: timing, interpolation and extrapolation of styles.",
    "Durations are computed by `rust/strut-core/src/transfer/timing.rs`, and blended with poses by `rust/strut-core/src/transfer/blend.rs`. The engine divides every g by that of the nearest neighbour, so that none becomes 0 where all are far; in the mean this cancels.",
  ],
};
