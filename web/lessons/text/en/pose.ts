import type { LessonText } from "../text";

export const pose: LessonText = {
  idea: [
    "To predict a pose, it must be numbers. Each joint is a rotation from its parent, and a rotation is an axis and an angle.",
    "Multiply the axis by the angle, and you have three numbers. They are counted from the joint’s mean rotation, so they are small while a body moves as bodies do.",
    "Twenty joints and the tilt of the hips make 63 numbers. Four more say how high the hips are, and how fast the walker moves and turns.",
  ],
  bet: {
    question: "Turn the walker by 90°. How many of the 67 numbers of its pose change?",
    options: { none: "None", few: "A few: those of the hips", all: "Nearly all" },
    reveal: ({ changed, of, turn }) =>
      `${changed} of ${of}, at ${turn}°. Place and heading are split off: velocities are seen from the walker, and the tilt of the hips is what is left without the heading.`,
  },
  look: [
    "The arrow is [w: w]: the axis about which the joint is turned from [mean: its mean], the ghost. The filled fan is the angle, and its far edge is [R: the joint as it is].",
    "Drag a limb by its ring, or set the three components. Only the numbers of that joint change; all others stay.",
    "The last four cells are the [h: height of the hips], their [v: velocity] to the left and forwards, and [psi: how fast the heading turns].",
  ],
  symbols: {
    w: { symbol: "wⱼ", name: "axis times angle, from the mean; its length" },
    mean: { symbol: "R̄ⱼ", name: "mean rotation of the joint; its angle" },
    R: { symbol: "Rⱼ", name: "rotation of the joint; its angle" },
    h: { symbol: "h", name: "height of the hips" },
    v: { symbol: "v", name: "velocity seen from the walker" },
    psi: { symbol: "ψ̇", name: "rate of turning" },
  },
  why: "Angles of 179° and of −179° are nearly the same rotation, but far apart as numbers. Why is it bad for a prediction if a joint moves there, and how does the mean help?",
  exercises: {
    A: {
      task: "A skeleton’s maker lays a joint’s own axes as they like. Turn those of the left thigh, by φ, until log R jumps by more than 1.5 rad from one frame to the next.",
      pass: ({ phi, rawJump, jump }) =>
        `Yes: at φ ${phi}° log R jumps by ${rawJump} rad, and w never by more than ${jump} rad. The mean takes the axes off.`,
      near: {
        other: () => "Read the left thigh, with no limb bent and the walker not turned.",
        further: ({ phi }) => `Close: at φ ${phi}° both are still smooth. A little further.`,
      },
      refuse: ({ phi }) => `Both are smooth at φ ${phi}°: turn further.`,
      no: ({ rawJump }) => `log R jumps by ${rawJump} rad.`,
      hints: [
        "An angle of 180° is the edge: beyond it the axis flips.",
        "The thigh swings by some tens of degrees. Add φ until the swing reaches 180°.",
      ],
    },
    B: {
      task: "Bring the left knee to its mean, at this instant: to within 3° of the ghost.",
      pass: ({ angle }) => `Yes: |w| is ${angle}°. At its mean, all three numbers of a joint are near 0.`,
      near: {
        other: () => "Read the left lower leg, at the instant of the start.",
        bend: ({ angle }) => `Close: ${angle}°. Bend it a little more.`,
        stretch: ({ angle }) => `Close: ${angle}°. Stretch it a little.`,
      },
      refuse: ({ angle }) =>
        `That is a straight leg, ${angle}° from the mean. Nobody walks on straight legs: the mean knee is bent.`,
      no: ({ angle }) => `|w| is ${angle}°.`,
      hints: [
        "The fan closes when limb and ghost meet.",
        "Drag the ring at the left ankle, or bring each component of w to 0.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, section 4: joint angles as exponential maps, root without place and heading.",
    "The numbers are those of `rust/strut-core/src/pose_vector.rs`, with the logarithm of `rust/strut-core/src/math/exp_map.rs`. Means are taken over the neutral clips of the database.",
  ],
};
