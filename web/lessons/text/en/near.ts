import type { LessonText } from "../text";

export const near: LessonText = {
  idea: [
    "Strut searches its recordings for moments that look like the pose you give it. For that, it needs a number that measures how alike two moments are.",
    "It compares the last five frames, joint by joint, and adds up squared distances. So two moments are near if both the poses and the motion are alike.",
    "But is walking north any different from walking east? A good distance must know what to ignore.",
  ],
  bet: {
    question: "Turn the walker by 90° and move it by 1 m. How does its distance to the nearest example change?",
    options: { same: "It stays the same", little: "It grows by some centimetres", much: "It grows by much more" },
    reveal: ({ before, after }) =>
      `Before: ${before} mm. After: ${after} mm. A window is the last five frames. Before two windows are compared, one of them is turned and moved on the ground to the best fit.`,
  },
  look: [
    "The solid walker is the query, and p are its joints. Around it stand its 8 nearest examples; the nearer an example, the less transparent it is. T moves the joints p′ of each example to the best fit: a [theta: turn by θ] and a shift by [x0: x₀] and [z0: z₀].",
    "The remaining differences are in [y: height] and [z: on the ground], weighted by [w: how large and visible each part is]. The eight are so similar that the query hides them: drag a limb by its ring, and watch them separate and [D: D] grow.",
    "The second line of the equation finds the best turn and shift without a search. Here y are the heights, and z the positions on the ground as complex numbers, minus their mean; both are multiplied by √w. A turn multiplies z′ by a number of length 1, and the best one makes the product ⟨z, z′⟩ real and positive.",
    "The curve is [D: √D], a distance in millimetres, for every moment of one class (an action in one style), and the dots are the [K: K nearest]. Now drag the ring on the ground: the query moves, the curve does not. The window has [s: s frames], each with 20 joints.",
  ],
  symbols: {
    D: { symbol: "D", name: "mean squared distance; here √D₁" },
    w: { symbol: "wᵢ", name: "largest weight of a joint" },
    theta: { symbol: "θ", name: "turn of the nearest onto the query" },
    x0: { symbol: "x₀", name: "its shift along x" },
    z0: { symbol: "z₀", name: "its shift along z" },
    y: { symbol: "y", name: "difference in height, last frame" },
    z: { symbol: "z", name: "difference on the ground, last frame" },
    s: { symbol: "s", name: "frames of a window" },
    K: { symbol: "K", name: "number of neighbours; √D of the last" },
  },
  why: "The distance ignores position and heading. It does not ignore height. Why not, and for which motions does that matter?",
  exercises: {
    A: {
      task: "How many neighbours are at most twice as far away as the nearest? Set K so that √D of the last is at most 2 √D₁, and that of the next is larger.",
      pass: ({ K, last, first }) => `Yes: number ${K} is ${last} mm away, and 2 √D₁ is twice ${first} mm.`,
      near: {
        other: () => "Use the walker as it was at the start: no bent limbs, five frames, and time forwards.",
        more: ({ K, last }) => `Close: number ${K} is ${last} mm away. A few more fit.`,
        less: ({ K, last }) => `Close: number ${K} is ${last} mm away. That is a little too far.`,
      },
      refuse: ({ K }) => `You compared D, which is squared: with K ${K}, D doubles. The task is about √D.`,
      no: ({ K, last, first }) => `Number ${K} is ${last} mm away. The limit is 2 × ${first} mm.`,
      hints: [
        "Read √D₁ above the plot, and double it.",
        "Turn the knob K until the dashed line, √D of number K, is just below that. Arrow keys change K by one.",
      ],
    },
    B: {
      task: "Turn the query by at least 45° and move it by at least 0.5 m. By how many millimetres did √D₁ change? Enter it.",
      pass: ({ change }) => `Yes: it changed by ${change} mm. Place and heading are not part of the distance.`,
      near: {
        other: () => "Only turn and move it: put bent limbs back, use five frames, and time forwards.",
        further: ({ heading, moved }) => `So far it is turned by ${heading}° and moved by ${moved} m. Go further.`,
        none: () => "Now enter the change below the plot.",
      },
      refuse: ({ guess, change }) =>
        `You entered ${guess} mm, but √D₁ changed by ${change} mm: the best turn and shift undo your move.`,
      no: ({ guess }) => `${guess} mm is not the change.`,
      hints: [
        "Read √D₁ above the plot before and after.",
        "Watch the dots of the curve while you move the query. Do they move?",
      ],
    },
    C: {
      task: "Reverse time, so that the walker goes backwards. What is the shortest window in which the nearest example is at least 4 times as far away as with time forwards?",
      pass: ({ window }) =>
        `Yes: ${window} frames show a direction, so walking backwards is far from walking forwards.`,
      near: {
        other: () => "Use the walker as it was at the start: put bent limbs back.",
        forward: () => "Reverse time first.",
        shorter: ({ window }) => `With ${window} frames it is far enough, but a shorter window is enough, too.`,
      },
      refuse: () => "At s = 1 both directions have the same poses: one frame has no direction, so √D₁ is the same.",
      no: ({ window }) => `${window} frames do not tell the two apart.`,
      hints: [
        "How many frames do you need to see the direction of a movement?",
        "Switch “Reverse time” on and off for each s, and compare √D₁.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Eq. 1. The best turn and shift have a closed form; see `docs/methods/search.md`.",
    "Distances are computed by `rust/strut-core/src/search/metric.rs`, and this lesson’s query by `rust/strut-core/src/transfer/lens/query.rs`.",
  ],
};
