import type { LessonText } from "../text";

export const bias: LessonText = {
  idea: [
    "The input walks with both arms raised. No walk in the database is like that, so the nearest examples have their arms at their sides.",
    "A line that was fitted to such examples knows nothing of raised arms. Far outside its dots it would answer with nonsense.",
    "So the engine takes off what sticks out of the examples, styles the rest, and gives a share of it back. How large should the share be?",
  ],
  bet: {
    question: "Let the share be 0: nothing is given back. How much of the raise survives?",
    options: { little: "Next to nothing", half: "About half", all: "Nearly all" },
    reveal: ({ share, usual, keep }) =>
      `${share} of it. The examples decide alone, and their arms hang. With the engine’s own share, ${keep}, ${usual} of the raise survives.`,
  },
  look: [
    "The dots are the neighbours’ angles. The band around their [mu: mean μ] reaches [kappa: κ] times their [sigma: standard deviation σ] to both sides.",
    "clamp moves the [x: input x] to the nearest end of the band, if it is outside. What is cut off is the [dx: bias Δx].",
    "The line β of lesson 5 was fitted to examples without raised arms, so it must be asked without them, too: ũ is the input now and one frame ago less Δx, and the last output less ρΔx. The line answers with [beta: the ring].",
    "Then the [rho: share ρ] of the bias returns, and the output ends at [y: y]. Drag the input along the axis, and turn ρ between 0 and 1.",
  ],
  symbols: {
    x: { symbol: "xₜ", name: "angle of the input’s arm" },
    mu: { symbol: "μ", name: "mean of the neighbours" },
    sigma: { symbol: "σ", name: "their standard deviation" },
    kappa: { symbol: "κ", name: "half the band, in σ" },
    dx: { symbol: "Δx", name: "bias: what sticks out" },
    beta: { symbol: "ũᵀβ", name: "answer of the line" },
    rho: { symbol: "ρ", name: "share that returns" },
    y: { symbol: "yₜ", name: "angle of the output" },
  },
  why: "When would you choose ρ = 1, and when ρ = 0? Think of somebody who carries a tray, and of somebody whose arm was recorded badly.",
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
        `ρ is a share of what sticks out at one joint, not of the raise: with ρ ${keep}, ${share} survives.`,
      no: ({ keep, share }) => `With ρ ${keep}, ${share} of the raise survives.`,
      hints: [
        "The more of the bias returns, the more of the raise survives. But the styled arm does not hang as the neutral one does, so the two shares are not equal.",
        "Light up ρ: its arrow is what returns, here and in the same way at every joint. Begin at ρ = 1, and go down.",
      ],
    },
    B: {
      task: "Now the arms are raised by 10° only. At this instant, which is the least κ at which nothing sticks out? Up to 0.3 more still counts.",
      pass: ({ reach }) => `Yes: with κ ${reach} the band just reaches the input.`,
      near: {
        other: () => "Keep the raise at 10°, and the instant and the style as they were.",
        more: ({ bias }) => `Close: ${bias}° still stick out. A little more κ.`,
        less: ({ reach }) => `Close: with κ ${reach} nothing sticks out, but a little less κ would do.`,
      },
      refuse: ({ reach }) =>
        `Nothing sticks out, but κ ${reach} is wider than it needs to be: the line is asked far from its dots.`,
      no: ({ bias, reach }) => `With κ ${reach}, ${bias}° stick out.`,
      hints: [
        "The band ends where |x − μ| = κσ.",
        "Light up x, μ and σ: their values stand below the equation. Divide.",
      ],
    },
    C: {
      task: "The arms are raised by 60° again. How many degrees return at this joint? Compute ρΔx, and enter it.",
      pass: ({ returned }) => `Yes: ${returned}° return.`,
      near: {
        other: () => "Keep the raise, κ, ρ, the instant and the style as they were. “Begin” brings them back.",
        more: ({ guess }) => `Close: a little more than ${guess}°.`,
        less: ({ guess }) => `Close: a little less than ${guess}°.`,
        none: () => "Enter a number of degrees below the figure.",
        edge: ({ guess }) => `Close: ${guess}°. Mind the edge of the band: the bias begins at μ ± κσ, not at μ.`,
      },
      refuse: ({ guess }) => `You took all of x: ${guess}°. Only what is outside the band is the bias.`,
      no: ({ guess }) => `${guess}° is not what returns.`,
      hints: [
        "Only what is outside the band counts.",
        "Δx = x − (μ + κσ), as the input lies above the band. Then take the share ρ of it.",
      ],
    },
  },
  sources: [
    "Xia, Wang, Chai and Hodgins, Realtime style transfer for unlabeled heterogeneous human motion, SIGGRAPH 2015, Eq. 6 and 7. The paper prints yₜ = ũᵀβ − ρΔx; the engine adds ρΔx, as with the minus a larger ρ would push the output away from the input.",
    "The bias is taken off and given back in `rust/strut-core/src/transfer/bias.rs`. Where all neighbours agree, σ has a least value, so that noise is not taken for content.",
  ],
};
