import type { LessonText } from "../text";

export const judge: LessonText = {
  idea: [
    "How good is a method that predicts an old walk? Take one recording out of the database, let the method predict it from a neutral walk, and compare the result with the recording. That is called holding out.",
    "No two performances are alike, not even by the same person. So another real take of the same style differs, too; the vertical line shows by how much. An error below it is within the spread of real performances.",
    "Here the take “walk-pace” is held out in every style. A mean error is only one number, though, and this lesson is about what it hides.",
  ],
  bet: {
    question:
      "KNN (k nearest neighbours) answers with the mean of the nearest frames; MAR (mixture of autoregressive models) fits lines through them. On held-out recorded walks, by how much is MAR’s mean error smaller?",
    options: {
      little: "By less than 0.1 mm",
      some: "By 0.1 to 1 mm",
      much: "By more than 1 mm",
    },
    reveal: ({ knn, mar, difference, other }) =>
      `KNN’s error is ${knn} mm, MAR’s ${mar} mm: ${difference} mm apart. Even the best other real take is off by ${other} mm, so both are within the spread of real performances: this error measure cannot separate them.`,
  },
  look: [
    "The table has [e: the mean error ē] of each method, over F frames and J joints: every joint except the hips, where the two bodies are aligned. It also shows how [acceleration: rough] the motion is (its acceleration relative to the input’s), and how much [content: content] is left: the correlation r of the fast movements of input and output. One column alone may mislead: GAR, one line for all frames, is the smoothest and has the largest error.",
    "The curves are [p: the error] of two methods over time, the distance of the predicted joints p̂ from the recorded ones p. The fill between them has the colour of the better one. The mean shows which one is ahead, the curves show [i: when].",
    "KNN answers with the neighbours’ mean ȳ. The line’s answer ŷ differs from it by slopes times distance: β are the slopes, u is the input and ū the mean of the neighbours’ inputs. The histogram counts [u: this difference] over the whole take.",
    "An evaluation is honest only if the answer was not in the database. If you leave the take in, NN, which answers with the nearest frame, finds the answer there.",
  ],
  symbols: {
    e: { symbol: "ē", name: "mean error of the chosen method" },
    p: { symbol: "p̂ − p", name: "its error at the instant" },
    u: { symbol: "u − ū", name: "input minus the neighbours’ mean" },
    i: { symbol: "i", name: "instant of the take" },
    acceleration: { symbol: "×", name: "acceleration relative to the input’s" },
    content: { symbol: "r", name: "remaining content; 1 is all" },
  },
  why: "Why is KNN almost as good? The histogram shows what the line adds to the neighbours’ mean. If neighbours surround the input, how do u and ū compare?",
  exercises: {
    A: {
      task: "MAR’s mean error is smaller than KNN’s. Find an instant where MAR is better by at least 0.3 mm, and one where KNN is. Pin both.",
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
      task: "Leave walk-pace in the database and see NN’s error fall below 1 mm. Then tick the one of NN’s two numbers that shows how well it predicts.",
      pass: ({ out, in: left }) =>
        `Yes: ${out} mm. The ${left} mm only show that NN finds a walk that is in the database.`,
      near: {
        other: () => "Stay with walk-pace in the style old.",
        leave: () => "Leave the take in first, and read NN’s error.",
        tick: ({ in: left }) => `NN’s error is ${left} mm now. Tick the number that you would publish.`,
      },
      refuse: ({ in: left }) => `NN had seen the answer. ${left} mm is a look-up, not a prediction.`,
      no: () => "NN’s error should be less than 1 mm: choose its take.",
      hints: [
        "Which motion do you want to predict: one that is already in the database?",
        "Switch “Leave it in”, then compare NN’s row with MAR’s: which method gains most from having seen the answer?",
      ],
    },
    C: {
      task: "Now use motions of other collections, which were not recorded in the styles. Among the methods that keep a content of at least 0.8, choose the one whose acceleration is nearest to the input’s.",
      pass: ({ pick, acceleration, content }) =>
        `Yes: ${pick}, with acceleration ${acceleration} × and content ${content}: it is the only one here with the bias term of lesson 7. On the recorded walks the errors were almost equal; here the methods are far apart.`,
      near: {
        other: () => "Choose “other collections” as the source of the numbers.",
        unmeasured: ({ pick }) => `${pick} was not measured there. Choose one with numbers.`,
      },
      refuse: ({ pick, content, acceleration }) =>
        `${pick} keeps only ${content} of the content, at ${acceleration} × the acceleration: the motion jitters, and no longer follows the input.`,
      no: ({ pick, acceleration }) => `${pick} has acceleration ${acceleration} ×. There is a smoother one.`,
      hints: [
        "Without a recording in the style there is no error. Look at the jitter: 1 × is as smooth as the input.",
        "The line in the acceleration column marks 1 ×; the dotted line in the content column marks 0.8. Which method reaches beyond it?",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, section 7: comparisons and leave-one-out evaluation.",
    "Recorded numbers are those of `docs/evaluation.md`, read when this page was built; `rust/strut-evaluation/src/leave_one_out.rs` computes them, over whole gait cycles. Live ones are over all frames of one take, before feet are planted.",
    "NN is the nearest neighbour, KNN the mean of the nearest, LAR one local line, MAR a mixture of them, GAR one line for all, LTI a linear system, GP a Gaussian process. The histogram is that of [u: β⊤(u − ū)]: mostly near 0, so the line gives the same answer as the mean.",
  ],
};
