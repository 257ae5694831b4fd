import type { LessonText } from "../text";

export const judge: LessonText = {
  idea: [
    "How good is a method that predicts an old walk? Take one performance out of the database, let the method predict it from a neutral walk, and compare with what was really performed. That is called holding out.",
    "No two performances are alike, not even by the same person. So another real take of the same style differs, too: the vertical line. An error below it is as good as a second try.",
    "Here the take “walk-pace” is held out in every style. A mean error is only one number, though, and this lesson is about what it hides.",
  ],
  bet: {
    question:
      "KNN answers with the mean of the nearest frames; MAR fits lines through them. On recorded walks, held out: by how much is MAR’s mean error smaller?",
    options: {
      little: "By less than 0.1 mm",
      some: "By 0.1 to 1 mm",
      much: "By more than 1 mm",
    },
    reveal: ({ knn, mar, difference, other }) =>
      `KNN errs by ${knn} mm and MAR by ${mar} mm: ${difference} mm apart. Even the best other real take errs by ${other} mm, so both are as good as a second try, and on this data the error cannot tell them apart.`,
  },
  look: [
    "The table has [e: the mean error ē] of each method, over F frames and J joints: all but the hips, at which the bodies are laid over each other. It also says how [acceleration: rough] the motion is, as its acceleration over the input’s, and how much [content: content] is left: the correlation r of the fast movements of input and output. One column alone may mislead: GAR, one line for all, is the smoothest, and the farthest off.",
    "The curves are [p: the error] of two methods over time, the distance of the predicted joints p̂ from the performed ones p. The fill between them has the colour of the better one. The mean says that one is ahead, the curve says [i: when].",
    "KNN answers with the neighbours’ mean ȳ. The line’s answer ŷ differs from it by slopes times distance: β are the slopes, u is the input and ū the mean of the neighbours’ inputs. The histogram counts [u: this difference] over the whole take.",
    "An evaluation is honest only if the answer was not in the database. Leave the take in, and NN, which answers with the nearest frame, finds the answer there.",
  ],
  symbols: {
    e: { symbol: "ē", name: "mean error of the chosen method" },
    p: { symbol: "p̂ − p", name: "its error at the instant" },
    u: { symbol: "u − ū", name: "times β: what the line adds to the mean" },
    i: { symbol: "i", name: "instant of the take" },
    acceleration: { symbol: "×", name: "acceleration against the input’s" },
    content: { symbol: "r", name: "content that is left, 1 is all" },
  },
  why: "Why does KNN nearly tie? The histogram has what the line adds to the neighbours’ mean. Where neighbours stand all around the input, what are u and ū?",
  exercises: {
    A: {
      task: "MAR’s mean is smaller than KNN’s. Find an instant at which MAR is better by at least 0.3 mm, and one at which KNN is. Pin both.",
      pass: ({ pick, pickGain, rival, rivalGain }) =>
        `Yes: ${pick} is better by ${pickGain} mm at one pin, ${rival} by ${rivalGain} mm at the other. A mean hides both.`,
      near: {
        other: () => "Compare MAR with KNN on walk-pace in the style old, held out.",
        noPick: ({ pick }) => `A pin for ${pick} is still missing.`,
        noRival: ({ rival }) => `A pin for ${rival} is still missing.`,
        pick: ({ pick, pickGain }) => `Close: ${pick} is better by ${pickGain} mm at its pin. It needs 0.3 mm.`,
        rival: ({ rival, rivalGain }) => `Close: ${rival} is better by ${rivalGain} mm at its pin. It needs 0.3 mm.`,
      },
      refuse: ({ pick, pickGain, rival, rivalGain }) =>
        `The lower curve is the better one. At the pins ${pick} is ahead by ${pickGain} mm and ${rival} by ${rivalGain} mm.`,
      no: ({ pick, pickGain, rival, rivalGain }) =>
        `At the pins ${pick} is ahead by ${pickGain} mm and ${rival} by ${rivalGain} mm: not enough for both.`,
      hints: [
        "An error is a distance: the lower curve is better. Who is ahead changes many times in a step.",
        "Look for fill in the colour of KNN’s curve, drag the playhead there, then use Shift and the arrow keys.",
      ],
    },
    B: {
      task: "Leave walk-pace in the database and see NN’s error fall below 1 mm. Then tick which of NN’s two numbers says how well it predicts.",
      pass: ({ out, in: left }) =>
        `Yes: ${out} mm. The ${left} mm say only that NN can find a walk that it has already.`,
      near: {
        other: () => "Stay with walk-pace in the style old.",
        leave: () => "Leave the take in first, and read what becomes of NN.",
        tick: ({ in: left }) => `NN errs by ${left} mm now. Tick the number that you would publish.`,
      },
      refuse: ({ in: left }) => `It had seen the answer. ${left} mm is a look-up, and no prediction.`,
      no: () => "NN should err by less than 1 mm: choose its take.",
      hints: [
        "Which motion do you want to predict: one that the database has already?",
        "Switch “Leave it in”, then compare NN’s row with that of MAR: who gains most from having seen the answer?",
      ],
    },
    C: {
      task: "Now motions of other collections, which nobody performed in the styles. Choose the method whose acceleration is nearest to the input’s, among those that keep a content of at least 0.8.",
      pass: ({ pick, acceleration, content }) =>
        `Yes: ${pick}, with acceleration ${acceleration} × and content ${content}: of those here it alone has the bias term of lesson 7. On the recorded walks the errors tied; here the methods are far apart.`,
      near: {
        other: () => "Choose “other collections” as the source of the numbers.",
        unmeasured: ({ pick }) => `${pick} was not measured there. Choose one with numbers.`,
      },
      refuse: ({ pick, content, acceleration }) =>
        `${pick} keeps only ${content} of the content, at ${acceleration} × the acceleration: the motion jitters, and no longer follows the input.`,
      no: ({ pick, acceleration }) => `${pick} has acceleration ${acceleration} ×. There is a smoother one.`,
      hints: [
        "Without a performance there is no error. Look at jitter: 1 × is as smooth as the input.",
        "The line in the column of acceleration marks 1 ×, the dotted one in that of content 0.8. Which method reaches beyond it?",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, section 7: comparisons and leave-one-out evaluation.",
    "Recorded numbers are those of `docs/evaluation.md`, read when this page was built; `rust/strut-evaluation/src/leave_one_out.rs` computes them, over whole gait cycles. Live ones are over all frames of one take, before feet are planted.",
    "NN is the nearest neighbour, KNN the mean of the nearest, LAR one local line, MAR a mixture of them, GAR one line for all, LTI a linear system, GP a Gaussian process. The histogram is that of [u: β⊤(u − ū)]: mostly near 0, so the line says what the mean says.",
  ],
};
