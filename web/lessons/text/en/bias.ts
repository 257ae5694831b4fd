import type { LessonText } from "../text";

export const bias: LessonText = {
  idea: [
    "The input walks with both arms raised. No walk in the database is like that, so the nearest examples have their arms at their sides.",
    "A line that was fitted to such examples knows nothing of raised arms. Far outside its dots, its answer would be nonsense.",
    "So the engine sets aside the part of the pose that no example covers, styles the rest, then adds a share of that part back. How large should the share be?",
  ],
  bet: {
    question: "Set the share to 0: nothing is added back. How much of the raise survives?",
    options: { little: "Next to nothing", half: "About half", all: "Nearly all" },
    reveal: ({ share, usual, keep }) =>
      `${share} of it. Only the examples decide, and their arms hang. With the engine’s setting, ρ = ${keep}, ${usual} of the raise survives.`,
  },
  look: [
    "The dots are the neighbours’ angles. The band around their [mu: mean μ] reaches [kappa: κ] times their [sigma: standard deviation σ] to both sides.",
    "If the [x: input x] is outside the band, clamp moves it to the nearest end. The part that is cut off is the [dx: bias Δx].",
    "The line β of lesson 5 was fitted to examples without raised arms, so the input must first be brought back into its range: ũ is the input now and one frame ago minus Δx, and the last output minus ρΔx. The line’s answer is [beta: the ring].",
    "Then the [rho: share ρ] of the bias is added back, and the output is [y: y]. Drag the input along the axis, and turn ρ between 0 and 1.",
  ],
  symbols: {
    x: { symbol: "xₜ", name: "angle of the input’s arm" },
    mu: { symbol: "μ", name: "mean of the neighbours" },
    sigma: { symbol: "σ", name: "their standard deviation" },
    kappa: { symbol: "κ", name: "half the band, in σ" },
    dx: { symbol: "Δx", name: "bias: the part outside the band" },
    beta: { symbol: "ũᵀβ", name: "answer of the line" },
    rho: { symbol: "ρ", name: "share that is added back" },
    y: { symbol: "yₜ", name: "angle of the output" },
  },
  why: "When would you choose ρ = 1, and when ρ = 0? Think of a person who carries a tray, and of an arm that was recorded badly.",
  exercises: {
    A: {
      task: "The arms are raised by 60°. Find the ρ with which half of the raise survives over the whole walk, to within 0.02.",
      pass: ({ keep, share }) => `Yes: with ρ ${keep}, ${share} of the raise survives.`,
      near: {
        other: () => "Keep the raise at 60°, and κ and the style as they were: only ρ should change.",
        more: ({ share }) => `Close: ${share} survives. A little more ρ.`,
        less: ({ share }) => `Close: ${share} survives. A little less ρ.`,
      },
      refuse: ({ keep, share }) =>
        `ρ is a share of the bias at one joint, not of the raise: with ρ ${keep}, ${share} survives.`,
      no: ({ keep, share }) => `With ρ ${keep}, ${share} of the raise survives.`,
      hints: [
        "The more of the bias is added back, the more of the raise survives. But the styled arm hangs differently from the neutral one, so the two shares are not equal.",
        "Highlight ρ: its arrow shows the part that is added back, here and likewise at every joint. Begin at ρ = 1, and go down.",
      ],
    },
    B: {
      task: "Now the arms are raised by 10° only. At this instant, what is the smallest κ with the input inside the band? Up to 0.3 more still counts.",
      pass: ({ reach }) => `Yes: with κ ${reach} the band just reaches the input.`,
      near: {
        other: () => "Keep the raise at 10°, and the instant and the style as they were.",
        more: ({ bias }) => `Close: ${bias}° are still outside. A little more κ.`,
        less: ({ reach }) => `Close: with κ ${reach} the input is inside, but a little less κ is enough.`,
      },
      refuse: ({ reach }) =>
        `The input is inside the band, but κ ${reach} is larger than necessary: the line is used far from its dots.`,
      no: ({ bias, reach }) => `With κ ${reach}, ${bias}° are outside the band.`,
      hints: [
        "The band ends where |x − μ| = κσ.",
        "Highlight x, μ and σ: their values are shown below the equation. Divide.",
      ],
    },
    C: {
      task: "The arms are raised by 60° again. How many degrees are added back at this joint? Compute ρΔx, and enter it.",
      pass: ({ returned }) => `Yes: ${returned}° are added back.`,
      near: {
        other: () => "Keep the raise, κ, ρ, the instant and the style as they were. “Begin” brings them back.",
        more: ({ guess }) => `Close: a little more than ${guess}°.`,
        less: ({ guess }) => `Close: a little less than ${guess}°.`,
        none: () => "Enter a number of degrees below the figure.",
        edge: ({ guess }) => `Close: ${guess}°. Mind the edge of the band: the bias begins at μ ± κσ, not at μ.`,
      },
      refuse: ({ guess }) => `You took all of x: ${guess}°. Only the part outside the band is the bias.`,
      no: ({ guess }) => `${guess}° is not the part that is added back.`,
      hints: [
        "Only the part outside the band counts.",
        "Δx = x − (μ + κσ), because the input is above the band. Then take the share ρ of it.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Eq. 6 and 7. The paper prints yₜ = ũᵀβ − ρΔx; the engine adds ρΔx, because with the minus a larger ρ would push the output away from the input.",
    "The bias is removed and added back in `rust/strut-core/src/transfer/bias.rs`. σ has a minimum for neighbours that all agree, so that noise does not count as content.",
  ],
};
