import type { LessonText } from "../text";

export const mix: LessonText = {
  idea: [
    "The database has forty classes: five actions, each in eight styles. Every class gives an answer from its own line. Which answer counts?",
    "The engine is not told that the input runs. It measures how far the pose is from the nearest examples of each class, and gives nearer classes more weight.",
    "So the weights also show what the engine recognises: here the input runs, walks, jumps, and walks again.",
  ],
  bet: {
    question:
      "The width δ says how slowly a weight falls with the distance. Double it: does the winning class gain or lose?",
    options: { gains: "It gains", loses: "It loses", same: "Nothing changes" },
    reveal: ({ before, after }) =>
      `Its weight goes from ${before} to ${after}. A larger δ tolerates distance: the other classes catch up, and because all weights sum to 1, the winner loses.`,
  },
  look: [
    "The areas are the [lambda: weights λ] of the actions over time, all styles of an action together. They always sum to 1. Before and after the jumps the engine briefly recognises a kick: there the input stands still, as before a kick.",
    "The list has the nearest classes at the playhead. [D: D] is the mean squared distance of a class’s nearest examples, in cm²; the bar beside it is the weight that D becomes. The sign ∝ means “in proportion”: at the end all weights are divided by their sum.",
    "The curve beside the list shows how weight falls with distance. It begins at the [min: smallest D], the distance of the nearest class. Over [delta: δ] times min D it falls to 1/e, about a third. Turn δ and watch the other classes.",
    "D is divided by min D, so only ratios count: if all distances were twice as long, the weights would be the same. That holds where the database has similar poses. Where even the nearest class is several centimetres away, the engine increases δ; the display then shows both values.",
    "The second line of the equation is the answer, E(y): each class j has a line uᵀβ, as in lesson 5, and their answers are averaged with these weights.",
  ],
  symbols: {
    lambda: { symbol: "λⱼ", name: "weight of a class; here of the second" },
    D: { symbol: "Dⱼ", name: "mean squared distance of the same class" },
    delta: { symbol: "δ", name: "width: how slowly weight falls" },
    min: { symbol: "min D", name: "the smallest D: of the nearest class" },
    t: { symbol: "t", name: "instant of the input" },
  },
  why: "Why is it the ratio of the distances that counts, and not their difference? Compare a frame whose two nearest classes are at 1 and 2 cm² with one where they are at 21 and 22 cm².",
  exercises: {
    A: {
      task: "When does running become walking? Find the first instant at which all walking classes together weigh at least as much as all running ones.",
      pass: ({ secs, walk, run }) => `Yes: at ${secs} s walking has ${walk} and running ${run}.`,
      near: {
        other: () => "Keep the input and δ as they were: only the playhead should move.",
        later: ({ walk, run }) => `Close: walking has ${walk}, running ${run}. A little later.`,
        earlier: ({ walk, run }) => `Close: walking has ${walk}, running ${run}. A little earlier.`,
      },
      refuse: ({ walk, run }) =>
        `Here it has changed already: walking has ${walk}, running ${run}. The question is when it changes.`,
      no: ({ secs, walk, run }) => `At ${secs} s walking has ${walk} and running ${run}.`,
      hints: [
        "The change is not sudden: for some frames both answer, and the output is a mixture of both.",
        "Drag the playhead to where the areas of run and walk meet at one half, then use Shift and the arrow keys.",
      ],
    },
    B: {
      task: "Where the playhead stands, neutral running has more than half of the weight. Find the δ at which it has one half.",
      pass: ({ delta, running }) => `Yes: with δ ${delta} neutral running has ${running}.`,
      near: {
        other: () => "Keep the input, and leave the playhead where it was: only δ should change.",
        more: ({ running }) => `Close: ${running}. A little more δ.`,
        less: ({ running }) => `Close: ${running}. A little less δ.`,
      },
      refuse: ({ delta, running }) =>
        `δ is a width, not a weight: with δ ${delta} neutral running has ${running}, not one half.`,
      no: ({ delta, running }) => `With δ ${delta} neutral running has ${running}.`,
      hints: [
        "A larger δ tolerates distance, and the winner loses.",
        "Read the weight of run / neutral in the list of the nearest classes while you turn δ.",
      ],
    },
    C: {
      task: "Take the two nearest classes alone, with the δ that is set. Compute the weight of the first from the two distances, and type it in.",
      pass: ({ alone, first, second }) => `Yes: ${first} and ${second} cm² give ${alone}.`,
      near: {
        other: () => "Keep the input, the instant and δ as they were. “Begin” brings them back.",
        none: () => "Type a number from 0 to 1 into the field below the classes.",
        more: () => "Close. It is a little more.",
        less: () => "Close. It is a little less.",
      },
      refuse: ({ guess }) => `That is exp(−D): ${guess}. First divide both distances by the smaller one, and by δ.`,
      no: ({ guess, first, second }) => `${guess} is not the weight for ${first} and ${second} cm².`,
      hints: [
        "Divide by the smallest first: for the first class D / min D is 1.",
        "Two terms: exp(−1/δ) and exp(−D₂/(δ D₁)). The weight is the first, divided by their sum.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Eq. 3–5: the mixture of autoregressive models.",
    "Weights are computed by `class_weights` in `rust/strut-core/src/transfer/class_weights.rs`. min D is at least 1 mm². Weights below two hundred-thousandths of the largest are dropped. δ is widened up to three times where the input is unknown, and twice where min D is 25 cm².",
  ],
};
