import type { LessonText } from "../text";

export const pose: LessonText = {
  idea: [
    "To predict a pose, we must write it as numbers. Each joint has a rotation relative to its parent joint. A rotation is an axis and an angle.",
    "Multiply the axis, a vector of length 1, by the angle, and you have three numbers. They are measured from the joint’s mean rotation: joints seldom turn far from their mean, so the numbers stay small.",
    "Twenty joints and the tilt of the hips give 21 · 3 = 63 numbers. Four more give the height of the hips, and how fast the walker moves and turns. Each number is called a degree of freedom.",
  ],
  bet: {
    question: "Turn the walker by 90°. How many of the 67 numbers of its pose change?",
    options: { none: "None", few: "A few: those of the hips", all: "Nearly all" },
    reveal: ({ changed, of, turn }) =>
      `${changed} of ${of} change when the walker turns by ${turn}°. Position and heading are not part of the pose: velocities are relative to the walker, and the tilt of the hips is measured without the heading.`,
  },
  look: [
    "The arrow is [w: w]. Its direction is the axis of the joint’s rotation away from [mean: its mean R̄], drawn as a translucent figure. Its length is the angle. The coloured fan shows the same angle, from the mean to [R: the joint’s rotation R].",
    "The logarithm log converts a rotation to axis times angle. It takes the shorter of the two directions, so the angle ‖w‖ is never more than π, half a turn. The vector x is the whole pose.",
    "Drag a limb by its ring, or set the three components of w. Only the three numbers of that joint change.",
    "The last four numbers are the [h: height h of the hips], their [v: velocity v] to the left and forwards, and [psi: the rate ψ̇] at which the heading turns.",
  ],
  symbols: {
    w: { symbol: "wⱼ", name: "axis times angle, from the mean; the angle" },
    mean: { symbol: "R̄ⱼ", name: "mean rotation of the joint; the angle" },
    R: { symbol: "Rⱼ", name: "rotation of the joint; the angle" },
    h: { symbol: "h", name: "height of the hips" },
    v: { symbol: "v", name: "velocity to the left, and forwards" },
    psi: { symbol: "ψ̇", name: "rate at which the heading turns" },
  },
  why: "Angles of 179° and of −179° are nearly the same rotation, but far apart as numbers. Why is that bad for a prediction if a joint moves there, and how does the mean help?",
  exercises: {
    A: {
      task: "The x, y and z axes of a joint are a convention. Rotate those of the left thigh by φ until log R, computed without the mean, jumps by more than 1.5 rad (86°) from one frame to the next.",
      pass: ({ phi, rawJump, jump }) =>
        `Yes: at φ ${phi}° log R jumps by ${rawJump} rad, and w never by more than ${jump} rad. φ rotates R and R̄ equally, so the angle between them does not change.`,
      near: {
        other: () => "Use the left thigh of the neutral walk, with no limb bent and the walker not turned.",
        further: ({ phi }) => `Close: at φ ${phi}° both are still smooth. A little further.`,
      },
      refuse: ({ phi }) => `Both are smooth at φ ${phi}°: turn further.`,
      no: ({ rawJump }) => `log R jumps by ${rawJump} rad.`,
      hints: [
        "An angle of 180° is the limit: beyond it the other direction is shorter, and the axis flips.",
        "Look at the curve of log R: the swing of the thigh is added to φ. Turn φ until the curve reaches 180°.",
      ],
    },
    B: {
      task: "Bring the left knee to its mean at this instant: turn the lower leg to within 3° of the translucent one.",
      pass: ({ angle }) => `Yes: |w| is ${angle}°. At its mean, all three numbers of a joint are near 0.`,
      near: {
        other: () => "Use the left lower leg of the neutral walk, at the instant where the exercise began.",
        bend: ({ angle }) => `Close: ${angle}°. Bend it a little more.`,
        stretch: ({ angle }) => `Close: ${angle}°. Straighten it a little.`,
        aside: ({ angle }) => `Close: ${angle}°. It is turned sideways: bring w y and w z to 0.`,
      },
      refuse: ({ angle }) =>
        `That is a straight leg, ${angle}° from the mean. In a walk the knee is bent most of the time, so its mean is bent, too.`,
      no: ({ angle }) => `|w| is ${angle}°.`,
      hints: [
        "The coloured fan closes when the leg reaches its mean.",
        "Drag the ring at the left ankle, or bring each component of w to 0.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, section 4: joint angles as exponential maps, root without position and heading.",
    "The numbers are those of `rust/strut-core/src/pose_vector.rs`, with the logarithm of `rust/strut-core/src/math/exp_map.rs`. The means come from the neutral clips of the database.",
  ],
};
