import type { LessonText } from "../text";

export const feet: LessonText = {
  idea: [
    "A predicted pose is right to a centimetre, and still you see at once if a standing foot slides. That is called skate, and nothing looks more artificial.",
    "The picture is the sole of one foot from above, an outline for each frame of a stance. A foot that stands should leave one outline.",
    "The cure has three parts: know whether a foot stands, keep it where it is, and bend the knee so that the leg reaches it.",
  ],
  bet: {
    question: "The hold is off. When does a standing foot slide fastest?",
    options: { strike: "When it strikes", middle: "In the middle of the stance", lift: "When it is lifted" },
    reveal: ({ most, middle, held }) =>
      `Just after the strike: ${most} cm/s, and ${middle} cm/s in the middle of the stance. A foot that was swinging is called standing before it is quite at rest. With the hold it is ${held} cm/s.`,
  },
  look: [
    "In the grey stretches the foot stands. It does so from [P: P] 0.6 on and until it falls below 0.4: the dots are the [c: neighbours’ votes], which are smoothed over time. A foot that is low and slow stands at once.",
    "The thick curve is [q: the slide], and the dashed one that with the other setting of the hold. Move the playhead to an [i: instant], and switch the hold.",
    "A held foot is corrected by what it would have slid, over three frames. Then the [d: distance d] from hip to ankle is given, and the knee has the [gamma: angle γ].",
  ],
  symbols: {
    P: { symbol: "P", name: "how likely the foot stands" },
    c: { symbol: "c", name: "votes of the neighbours" },
    q: { symbol: "Δp", name: "slide of the foot, as the hold has it" },
    gamma: { symbol: "γ", name: "angle between thigh and shin" },
    d: { symbol: "d", name: "from hip to ankle" },
    i: { symbol: "t", name: "instant" },
  },
  why: "Why are two limits better than one: 0.6 to plant, 0.4 to release? Think of a P that trembles about 0.5.",
  exercises: {
    A: {
      task: "With the hold off: go to within 3 frames of the instant at which the standing left foot slides fastest.",
      pass: ({ speed, most }) => `Yes: ${speed} cm/s here, and ${most} cm/s at most, at the strike.`,
      near: {
        other: () => "Look at the left foot of the old walk, in this stretch.",
        later: ({ speed }) => `Close: ${speed} cm/s. A little later.`,
        earlier: ({ speed }) => `Close: ${speed} cm/s. A little earlier.`,
      },
      refuse: ({ speed }) => `A lifted foot may move, even at ${speed} cm/s. Stay in the grey stretches.`,
      no: ({ speed }) => `Here it slides at ${speed} cm/s. It is faster somewhere else.`,
      hints: [
        "Only where the foot stands does its speed matter: the grey stretches.",
        "Look at the edges of the stretches, and use Shift with the arrow keys for single frames.",
      ],
    },
    B: {
      task: "Drag the ankle until the knee is bent by 60°, to within 1°.",
      pass: ({ d, bend }) => `Yes: at d ${d} m the knee is bent by ${bend}°.`,
      near: {
        more: ({ bend }) => `Close: ${bend}°. Bend it a little more.`,
        less: ({ bend }) => `Close: ${bend}°. Bend it a little less.`,
      },
      refuse: ({ gamma, bend }) =>
        `γ is ${gamma}°, the angle between the bones. A straight leg has γ 180°: this knee is bent by ${bend}°.`,
      no: ({ bend }) => `The knee is bent by ${bend}°.`,
      hints: [
        "A straight leg has γ = 180°, so the bend is 180° − γ.",
        "You need γ = 120°. Only d counts: pull the ankle towards the hip, or away from it.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, section 6: contacts by the nearest neighbours’ vote. The paper weighs votes by 1/D; the engine weighs them by how alike heights and speeds of the feet are.",
    "Votes are counted by `rust/strut-core/src/transfer/contact_likelihood.rs`, feet are held by `rust/strut-core/src/transfer/footplant.rs`, and knees solved by `rust/strut-core/src/kinematics/two_bone_ik.rs`.",
  ],
};
