import type { LessonText } from "../text";

export const near: LessonText = {
  idea: [
    "The engine looks for moments of the database that resemble what you do now. For that it needs a number that says how alike two moments are.",
    "It compares the last five frames, joint by joint, and adds up squared distances. So two moments are near if the poses are alike, and if they go on alike.",
    "But is somebody who walks north unlike somebody who walks east? A good distance must know what to ignore.",
  ],
  bet: {
    question: "Turn the walker by 90° and move it by 1 m. What becomes of its distance to the nearest example?",
    options: { same: "It stays the same", little: "It grows by some centimetres", much: "It grows by much more" },
    reveal: ({ before, after }) =>
      `Before: ${before} mm. After: ${after} mm. Before two windows are compared, one of them is turned and moved over the ground to where it fits best.`,
  },
  look: [
    "Around the walker stand its 8 nearest examples, the nearer the denser. Each is [theta: turned by θ] and [x0: moved by x₀] and [z0: z₀] to where it fits best.",
    "What is left are differences in [y: height] and [z: over the ground], weighted by [w: the size of each joint]. Drag a limb by its ring and watch [D: D] grow.",
    "The curve is [D: √D] of every moment of the class, and the dots are the [K: K nearest]. Drag the ring on the ground, too: the query moves, the curve does not.",
  ],
  symbols: {
    D: { symbol: "D", name: "squared distance; √D of the nearest" },
    w: { symbol: "wᵢ", name: "weight of a joint; the largest" },
    theta: { symbol: "θ", name: "turn of the nearest onto the query" },
    x0: { symbol: "x₀", name: "its shift along x" },
    z0: { symbol: "z₀", name: "its shift along z" },
    y: { symbol: "y − y′", name: "left in height, last frame" },
    z: { symbol: "z", name: "left on the ground, last frame" },
    s: { symbol: "s", name: "frames of a window" },
    K: { symbol: "K", name: "neighbours; √D of the last" },
  },
  why: "The distance ignores where somebody is and which way they face. Height is not ignored. Why not, and for which motions would it matter?",
  exercises: {
    A: {
      task: "How many neighbours are at most twice as far as the nearest? Set K so that √D of the last is at most 2 √D₁, and one more would be beyond it.",
      pass: ({ K, last, first }) => `Yes: number ${K} is ${last} mm away, and 2 √D₁ is twice ${first} mm.`,
      near: {
        other: () => "Use the walker as it was, five frames, and time forwards.",
        more: ({ K, last }) => `Close: number ${K} is ${last} mm away. A few more fit.`,
        less: ({ K, last }) => `Close: number ${K} is ${last} mm away. That is a little too far.`,
      },
      refuse: ({ K }) => `You compared D, which is squared: with K ${K}, D doubles. The task is about √D.`,
      no: ({ K, last, first }) => `Number ${K} is ${last} mm away; the nearest ${first} mm.`,
      hints: [
        "Read √D₁ below the plot, and double it.",
        "Turn K until the dashed line, √D of number K, is just below that. Arrow keys change K by one.",
      ],
    },
    B: {
      task: "Turn the query by at least 45° and move it by at least 0.5 m. By how many millimetres did √D₁ change? Enter it.",
      pass: ({ change }) => `Yes: it changed by ${change} mm. Place and heading are not part of the distance.`,
      near: {
        other: () => "Only turn and move it: put bent limbs back, use five frames, and time forwards.",
        further: ({ heading, moved }) => `It is turned by ${heading}° and moved by ${moved} m. Go further.`,
        none: () => "Now enter the change below the plot.",
      },
      refuse: ({ guess, change }) =>
        `You entered ${guess} mm, but √D₁ changed by ${change} mm: the best turn and shift take your move off again.`,
      no: ({ guess }) => `${guess} mm is not the change.`,
      hints: [
        "Read √D₁ below the plot before and after.",
        "Light up θ, x₀ and z₀ while you move: they take up the whole move.",
      ],
    },
    C: {
      task: "Reverse time: the walker goes backwards. Which is the shortest window in which the nearest example is at least 4 times as far as with time forwards?",
      pass: ({ window }) => `Yes: ${window} frames have a direction, so a walk backwards is not near to one forwards.`,
      near: {
        other: () => "Use the walker as it was: put bent limbs back.",
        forward: () => "Reverse time first.",
        shorter: ({ window }) => `With ${window} frames it is far enough, but a shorter window does it, too.`,
      },
      refuse: () => "At s = 1 both are the same poses: one frame has no direction.",
      no: ({ window }) => `${window} frames do not tell the two apart.`,
      hints: ["One frame has no direction.", "Switch “Reverse time” on and off for each s, and compare √D₁."],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Eq. 1. The best turn and shift have a closed form; see `docs/methods/search.md`.",
    "Distances are computed by `rust/strut-core/src/search/metric.rs`, and this lesson’s query by `rust/strut-core/src/transfer/lens/query.rs`.",
  ],
};
