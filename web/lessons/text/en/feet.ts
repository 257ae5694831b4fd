import type { LessonText } from "../text";

export const feet: LessonText = {
  idea: [
    "A predicted pose can be right to the centimetre and still look wrong the moment a planted foot slides. That is called foot skate.",
    "The picture shows the sole of one foot from above: a line from heel to ball for each frame of a stance, the time on the ground. If the foot did not move, all lines would coincide. The red line is the foot at the chosen instant; the dashed one shows where the hold puts it.",
    "The cure has three parts: detect whether the foot is planted, hold it in place, and bend the knee so that the leg reaches it.",
  ],
  bet: {
    question: "The hold is off. When does a planted foot slide fastest?",
    options: { strike: "When it strikes", middle: "In the middle of the stance", lift: "When it is lifted" },
    reveal: ({ most, middle, held, nth, frames }) =>
      `This stance has ${frames} frames, and the foot slides fastest in frame ${nth}: at ${most} cm/s, against ${middle} cm/s in the middle. A landing foot counts as planted a little before it is at rest. With the hold it slides at ${held} cm/s there.`,
  },
  look: [
    "Is the foot planted? The 40 most similar frames of the database vote: cₖ is 1 if the foot of frame k is planted, else 0. A vote counts more the smaller eₖ is: how much the feet of frame k differ from the input’s in height and speed. Each dot is [c: the vote at one instant]. [P: P] is the vote averaged with the recorded style’s own contacts, then smoothed over time. The foot is planted from P 0.6 on and released below 0.4, the dotted lines; a low and slow foot counts as planted anyway. Where it is planted, the plot is grey.",
    "The thick curve is [p: the slide Δp], per second; the dashed one is the slide with the other setting of the hold. Move the playhead to an [i: instant], and switch the hold: [q: the correction q] moves a planted foot back by the distance it has slid. n counts the frames since the foot was planted, so that the hold fades in over three frames.",
    "Now the position of the ankle is fixed, and with it its [d: distance d] from the hip. Thigh a, shin b and d make a triangle: the law of cosines gives the [gamma: angle γ] at the knee.",
  ],
  symbols: {
    P: { symbol: "P", name: "how likely the foot is planted" },
    c: { symbol: "c", name: "share of the votes for planted" },
    p: { symbol: "Δp", name: "slide of the foot" },
    q: { symbol: "q", name: "how far the hold moves the foot" },
    gamma: { symbol: "γ", name: "angle between thigh and shin" },
    d: { symbol: "d", name: "from hip to ankle" },
    i: { symbol: "t", name: "instant" },
  },
  why: "Why are two limits better than one: 0.6 to plant, 0.4 to release? Think of a P that jitters around 0.5.",
  exercises: {
    A: {
      task: "The hold is off. In the stretch that you see, go to the instant where the planted left foot slides fastest, to within 3 frames.",
      pass: ({ speed, most }) => `Yes: ${speed} cm/s here, and ${most} cm/s at most, where the foot lands.`,
      near: {
        other: () => "Look at the left foot of the old walk, in this stretch.",
        held: () => "Switch the hold off first: held, the foot stays where it is.",
        later: () => "Close, but here the foot is still lifted. A little later.",
        earlier: ({ speed }) => `Close: ${speed} cm/s. A little earlier.`,
      },
      refuse: ({ speed }) => `A lifted foot may move, even at ${speed} cm/s. Look where it is planted: in grey.`,
      no: ({ speed }) => `Here it slides at ${speed} cm/s. It is faster somewhere else.`,
      hints: [
        "Only the speed of a planted foot counts: look in the grey stretches.",
        "Look at the edges of the grey stretches. Arrow keys move the playhead, with Shift by single frames.",
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
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, section 6: contacts by the nearest neighbours’ vote. The paper weighs votes by 1/D; the engine by how similar the feet are in height and speed.",
    "Votes are counted by `rust/strut-core/src/transfer/contact_likelihood.rs`, feet are held by `rust/strut-core/src/transfer/footplant.rs`, and knees solved by `rust/strut-core/src/kinematics/two_bone_ik.rs`.",
  ],
};
