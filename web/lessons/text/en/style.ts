import type { LessonText } from "../text";

export const style: LessonText = {
  idea: [
    "Two walkers take the same steps: left, right, left, in the same order. That is the content.",
    "One of them walks neutrally, the other like an old person: bent forward, and slower. That is the style.",
    "To see style alone, you have to compare equal instants of the step. But which instants are equal?",
  ],
  bet: {
    question:
      "You can pair the two walkers by the clock, second with second, or by the step, foot strike with foot strike. Which pairing shows more difference between the poses?",
    options: { second: "The same second", content: "The same content" },
    reveal: ({ second, content }) =>
      `Over the whole walk the poses differ by ${second} cm in the same second, and by ${content} cm at the same content. The old walker is slower: after a few seconds one stands on the left foot while the other stands on the right. That is a difference in pace, but the clock counts it as a difference in pose.`,
  },
  look: [
    "At each instant i, measure how far each joint of one walker is from the same joint of the other. Position and heading are removed first. The mean over the [J: J joints] is the [e: difference e], in centimetres.",
    "The [tau: pairing τ] decides which instant of the styled walk is compared with i. Below the curve, a thread leads from the [i: playhead] to that instant.",
    "Drag the playhead, change the style, and switch between *same second* and *same content*. The larger a dot on the body, the farther apart that joint is in the two walkers.",
  ],
  symbols: {
    e: { symbol: "e", name: "difference of the poses" },
    p: { symbol: "p", name: "joints of the neutral walker" },
    q: { symbol: "p′", name: "joints of the styled walker" },
    tau: { symbol: "τ(i)", name: "instant that i is paired with" },
    i: { symbol: "i", name: "instant of the input" },
    J: { symbol: "J", name: "number of joints" },
  },
  why: "Why does the curve of the same second rise and fall, while that of the same content stays nearly level?",
  exercises: {
    A: {
      task: "Which style is nearest to neutral? Choose the style with the smallest mean difference.",
      pass: ({ style, meanContent }) => `Yes: ${style}, with ${meanContent} cm on average.`,
      near: {
        other: () => "Choose one of the styles other than neutral, on the neutral walk.",
      },
      refuse: ({ style, meanContent, meanSecond }) =>
        `You compared different moments of the step. By the clock, ${style} has the smallest difference, ${meanSecond} cm; at equal instants it has ${meanContent} cm.`,
      no: ({ style, meanContent }) => `${style} has ${meanContent} cm on average. Another style is closer.`,
      hints: [
        "Pace is style too, but it is not pose. Pair equal instants.",
        "Set *same content* and read the mean beside the curve of that name.",
      ],
    },
    B: {
      task: "Find an instant of the sexy walk at which the difference in the same second is at least four times that at the same content.",
      pass: ({ secs, second, content }) => `Yes: at ${secs} s it is ${second} cm against ${content} cm.`,
      near: {
        other: () => "Show the style “sexy” on the neutral walk, and the mean of all joints.",
        later: ({ second, content }) => `Close: ${second} cm against ${content} cm. Go a little later.`,
        earlier: ({ second, content }) => `Close: ${second} cm against ${content} cm. Go a little earlier.`,
      },
      refuse: () => "Here the two are in step: the same second is the same content. Look where they are out of step.",
      no: ({ secs, second, content }) => `At ${secs} s it is ${second} cm against ${content} cm. Look for a wider gap.`,
      hints: [
        "The sexy walker is slower and falls behind. One step late, it stands on the other foot; two steps late, the two are in step again.",
        "Watch the legs: where one walker has the left foot in front and the other the right, the gap is widest.",
      ],
    },
    C: {
      task: "Which joint does the old style move most, on average? Choose it from the list, or click its dot on the body.",
      pass: ({ joint, jointMean }) => `Yes: ${joint}, by ${jointMean} cm on average.`,
      near: {
        other: () => "Show the style “old” on the neutral walk.",
        none: () => "Choose a joint from the list above the curve, or click its dot on the body.",
        close: ({ joint, jointMean }) => `Close: ${joint}, ${jointMean} cm. A joint near it moves more.`,
      },
      refuse: ({ joint, jointMean, jointMeanSecond }) =>
        `The legs move most in every walk, so by the clock they are far apart: ${joint} by ${jointMeanSecond} cm. That is pace. At equal instants it is ${jointMean} cm.`,
      no: ({ joint, jointMean }) => `${joint}: ${jointMean} cm on average. Another joint moves more.`,
      hints: [
        "An old walker is bent forward at the hips. The higher above them a joint is, the more it moves.",
        "Set *same content* and find the largest dot on the body.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, §1 and §4: what style is, and how motions of one content are registered.",
    "The difference is `meanDistance` in `web/player/measured.ts`; the styled walk with the same content is `counterpart` in `rust/strut-demo/src/database.rs`.",
  ],
};
