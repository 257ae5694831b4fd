import type { LessonText } from "../text";

export const register: LessonText = {
  idea: [
    "Two people take the same step (here: left and right, up to the next left heel strike), one in 1.1 s, the other in 1.5 s. To compare them, you need to know which instants correspond.",
    "Such a correspondence is a path: for each instant of one step it names an instant of the other. Where the path is steep, the other walker takes longer for the same part of the step.",
    "The usual method gives each pair of frames a cost, small if they look alike, and chooses the path with the smallest total cost. It is called dynamic time warping, DTW.",
  ],
  bet: {
    question:
      "The darker a point in the plot, the less alike the two poses are. One path, DTW, follows the bright valleys at the smallest cost; the other is straight. Which is closer to the truth?",
    options: { true: "The cheapest path", straight: "The straight line" },
    reveal: ({ dtw, linear }) =>
      `The cheapest path is ${dtw} ms off on average, the straight line ${linear} ms. An old walker in the middle of a step can look like a neutral one at another time, and DTW pairs poses that look alike. The truth is known here because a program generated both steps.`,
  },
  look: [
    "The neutral step runs to the right, the old one upwards. The shade is the [c: cost c] of pairing two frames: the squared distance of their features (positions and velocities of the joints, and foot contacts). The [tau: point τ] is the pair at the cursor; its two walkers are shown below.",
    "Cᵢⱼ is the smallest cost of a path from the start to the pair i, j. From one pair to the next, the path moves one frame in both steps, or [s: s] frames in one and one frame in the other, with s at most 3. So its slope is at most three to one: the two thin lines through the point.",
    "Iterative motion warping, IMW, lets the features a of the neutral step differ from the features b of the other one by a [alpha: scale α] and an [beta: offset β]. So IMW can explain a difference in style as a change of size or position, instead of warping time. IMW minimises E: D takes the difference of successive frames, so the term with λ = 225 makes α and β change slowly, and the one with μ = 0.1 keeps them near 1 and 0.",
    "The bars outside the plot show when each foot is on the ground: above for the neutral walker, at the right for the other one.",
  ],
  symbols: {
    c: { symbol: "c", name: "cost of the pair at the cursor" },
    s: { symbol: "s", name: "pace of the path at the cursor" },
    tau: { symbol: "τ", name: "time that it is paired with" },
    alpha: { symbol: "α", name: "scale of the strongest feature, IMW" },
    beta: { symbol: "β", name: "its offset" },
  },
  why: "A style changes both the timing and the poses. Why can a cost that measures only similarity not tell the two apart, and what else could you measure?",
  exercises: {
    A: {
      task: "Bend your own path at its three points until it costs at most 1.2 times as much as DTW’s.",
      pass: ({ cost, off }) =>
        `Yes: ${cost} times the cost, and ${off} ms from the truth. A cheap path need not be a true one.`,
      near: {
        other: () => "Use the old step.",
        up: ({ cost, dearFrom, dearTo }) => `Close: ${cost} times. Bend it up from ${dearFrom} to ${dearTo} ms.`,
        down: ({ cost, dearFrom, dearTo }) => `Close: ${cost} times. Bend it down from ${dearFrom} to ${dearTo} ms.`,
      },
      refuse: ({ cost, off }) =>
        `Your path is only ${off} ms from the truth, but it costs ${cost} times as much as DTW’s. This task is about cost alone.`,
      no: ({ cost, dearFrom, dearTo }) =>
        `${cost} times the cost of DTW. Most of the extra cost is from ${dearFrom} to ${dearTo} ms.`,
      hints: [
        "Follow the bright valley. It bends where a foot strikes or lifts, at the ends of the bars.",
        "Put your three points onto the path of DTW where it bends. Then move one after the other with the arrow keys.",
      ],
    },
    B: {
      task: "Move the cursor to an instant at which the linear path pairs frames with different feet on the ground, but DTW frames with the same feet.",
      pass: ({ time, tauDtw, tauLinear }) =>
        `Yes: DTW pairs ${time} ms with ${tauDtw} ms, where the same feet are on the ground. The linear path pairs it with ${tauLinear} ms, where they are not.`,
      near: {
        other: () => "Use the old step.",
        later: () => "Close: a little later.",
        earlier: () => "Close: a little earlier.",
      },
      refuse: ({ time }) =>
        `At ${time} ms DTW pairs different feet, too: it pairs poses that look alike, even with other feet on the ground.`,
      no: ({ time }) => `At ${time} ms the linear path pairs the same feet already.`,
      hints: [
        "The bars outside the plot show when each foot is on the ground. Look where one ends.",
        "At each end of a bar, read the line below the walkers: once with the path linear, once with DTW.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, section 4: registration; Hsu, Pulli and Popović, Style translation for human motion, SIGGRAPH 2005: iterative motion warping.",
    "The paths are those of `rust/strut-core/src/registration/dtw.rs` and `rust/strut-core/src/registration/imw.rs`. DTW pairs whole frames, so a path between frames may cost a little less than 1 ×.",
  ],
};
