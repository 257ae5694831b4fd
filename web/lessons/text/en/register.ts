import type { LessonText } from "../text";

export const register: LessonText = {
  idea: [
    "Two people take the same step, one in 1.1 s, the other in 1.5 s. To compare them, you need to know which instants correspond.",
    "Such a correspondence is a path: for each instant of one step it names an instant of the other. Where it is steep, the other one is slow.",
    "The usual way is to pair frames that look alike, as cheaply as possible overall. That is called dynamic time warping, DTW.",
  ],
  bet: {
    question:
      "The greyer a place, the less alike are the two poses. One path winds through the valleys at the least cost, DTW; one is straight. Which is nearer to the truth?",
    options: { true: "The cheapest path", straight: "The straight line" },
    reveal: ({ dtw, linear }) =>
      `The cheapest path is ${dtw} ms off on average, the straight line ${linear} ms. An old person’s pose at mid-stance looks like a neutral one at another time, and DTW pairs what looks alike. The truth is known here, as these steps were scripted.`,
  },
  look: [
    "Across is the neutral step, upwards the old one. The grey is [c: the cost c] of pairing two frames, and [tau: the point] is the pair at the cursor, whose walkers stand below.",
    "A path may be at most three times as fast as the other step, and no slower than a third: [s: the two lines through the point]. The bars outside are feet that stand.",
    "IMW lets poses differ by a [alpha: scale α] and an [beta: offset β] that change slowly. So what is style need not be paid by warping time.",
  ],
  symbols: {
    c: { symbol: "c", name: "cost of the pair at the cursor" },
    s: { symbol: "s", name: "pace of the path there" },
    tau: { symbol: "τ", name: "time in the styled step" },
    alpha: { symbol: "α", name: "scale of the strongest feature" },
    beta: { symbol: "β", name: "its offset" },
  },
  why: "A style changes both when and how somebody moves. Why can no cost of likeness alone tell the two apart, and what else could you measure?",
  exercises: {
    A: {
      task: "Bend your own path at its three points until it costs at most 1.2 times as much as DTW’s.",
      pass: ({ cost, off }) => `Yes: ${cost} times the cost, and ${off} ms from the truth. Cheap is not true.`,
      near: {
        other: () => "Use the old step.",
        up: ({ cost, dearFrom, dearTo }) => `Close: ${cost} times. Bend it up from ${dearFrom} to ${dearTo} ms.`,
        down: ({ cost, dearFrom, dearTo }) => `Close: ${cost} times. Bend it down from ${dearFrom} to ${dearTo} ms.`,
      },
      refuse: ({ cost, off }) =>
        `You follow the truth, ${off} ms from it, at ${cost} times the cost. The task is about cost alone.`,
      no: ({ cost, dearFrom, dearTo }) => `${cost} times the cost. Dearest: from ${dearFrom} to ${dearTo} ms.`,
      hints: [
        "Follow the clear valley: bend the path where a foot strikes, at the ends of the bars.",
        "Look at the path of DTW: bring your points onto it, then move one after the other with the arrow keys.",
      ],
    },
    B: {
      task: "Move the cursor to an instant at which different feet stand when time is shared out evenly, but the same feet stand under DTW.",
      pass: ({ time, tau }) => `Yes: at ${time} ms DTW says ${tau} ms, and the same feet stand.`,
      near: {
        other: () => "Use the old step.",
        later: () => "Close: a little later.",
        earlier: () => "Close: a little earlier.",
      },
      refuse: ({ time }) =>
        `At ${time} ms different feet stand under DTW, too: it pairs what looks alike, not what touches the ground.`,
      no: ({ time }) => `At ${time} ms the same feet stand in linear time already, or under neither.`,
      hints: [
        "The bars outside the plot are feet that stand. Look where one ends.",
        "Read the line below the walkers with the path linear, then with DTW, at each end of a bar.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, section 4: registration; Hsu, Pulli and Popović, Style translation for human motion, SIGGRAPH 2005: iterative motion warping.",
    "The paths are those of `rust/strut-core/src/registration/dtw.rs` and `rust/strut-core/src/registration/imw.rs`. DTW pairs whole frames; a path between frames may cost a little less than its 1 ×.",
  ],
};
