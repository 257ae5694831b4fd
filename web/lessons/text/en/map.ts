import type { LessonText } from "../text";

export const map: LessonText = {
  idea: [
    "Two numbers, the style variables, give a whole pose: they set how far apart the feet are, front to back and in height. Drag the point, and the body follows.",
    "Several linear maps turn the two numbers into the pose. Each map covers a region of the plane, and where regions meet, the maps share the answer.",
    "They organise themselves: every recorded frame pulls the maps that are near to it, first many at once, then fewer and fewer. One such pull is an update.",
  ],
  bet: {
    question:
      "An update moves a map towards the sample, one recorded frame. The paper prints the formula with a minus, which moves it away. What happens if you use the printed formula?",
    options: {
      same: "It learns just as well",
      slower: "It learns more slowly",
      diverges: "The error grows without end",
    },
    reveal: ({ updates, right, printed }) =>
      `After ${updates} updates the error is ${right}° with the right sign, and ${printed}° as printed. Every update moves the map away from the sample, and the greater the distance, the larger the next update.`,
  },
  look: [
    "The dots are recorded frames, placed by their style variables. Each ellipse is the region of one component, a map Zᵢ: mᵢ is its centre, Sᵢ its spread. The darker it is, the greater its [a: share a] of all samples. Make one update: the ring is [x: the sample x], and the bars show [r: the part r] of it that each component takes.",
    "The map Zᵢ turns v (the two variables and a 1) into a pose. The solid body is the sample’s pose, the ghost is [Z: the prediction Zv]. An update moves Zv towards x by the fraction δ r; δ is the [delta: learning rate]. The strokes show how far it has moved the centres.",
    "The dashed ring shows the [sigma: width σ] of the neighbourhood: a component whose prediction is farther than σ from the sample takes little of it. From pass to pass σ and δ decrease, so that in the end only the nearest component learns. The curve is the [E: error] of the model after each pass. Press Play, and try the sign as printed, too.",
    "Finally, request a pose: [u: drag u]. All maps answer; the [w: weight w] of each depends on how well u fits its mᵢ and Sᵢ. The higher the temperature [T: T], the more equal the weights are.",
  ],
  symbols: {
    u: { symbol: "u", name: "requested style variables" },
    x: { symbol: "x", name: "the sample, by its variables" },
    r: { symbol: "rᵢ", name: "largest part of the sample" },
    a: { symbol: "aᵢ", name: "largest share" },
    Z: { symbol: "Zᵢv", name: "distance of the prediction from x" },
    delta: { symbol: "δ", name: "learning rate" },
    sigma: { symbol: "σ", name: "width of the neighbourhood" },
    w: { symbol: "w", name: "greatest weight in the pose" },
    T: { symbol: "T", name: "temperature of sharing" },
    E: { symbol: "E", name: "error after the last pass" },
  },
  why: "Why does the neighbourhood begin wide? Think of a map that never gets a sample, and of neighbours that learn different things.",
  exercises: {
    A: {
      task: "When has the model learned? Find the first pass (over all frames) after which the error is at most 1.05 times that after the last pass.",
      pass: ({ pass, learned, last }) => `Yes: pass ${pass}, ${learned}°, and ${last}° at the end. The rest is polish.`,
      near: {
        later: ({ pass, learned }) => `Close: ${learned}° after pass ${pass}. A little later.`,
        earlier: ({ pass, learned }) => `${learned}° after pass ${pass} is enough, but an earlier pass was, too.`,
      },
      refuse: ({ passes, last }) =>
        `After ${passes} passes it is ${last}°. That is the end; learning was nearly over long before.`,
      no: ({ pass, learned }) => `After pass ${pass} the error is ${learned}°.`,
      hints: [
        "Drag the flag to the end first, and read the last error. Multiply it by 1.05.",
        "Then go back with the arrow keys until the error is just below that.",
      ],
    },
    B: {
      task: "Dragging should be smooth: set T so that on ten fixed drags no joint turns by more than 6° a frame, while the error at recorded poses is at most 2°.",
      pass: ({ temperature, change, shared }) =>
        `Yes: with T ${temperature}, ${change}° a frame at an error of ${shared}°.`,
      near: {
        softer: ({ change }) => `Close: ${change}° a frame. A little more T.`,
        harder: ({ shared }) => `Close: the error is ${shared}°. A little less T.`,
      },
      refuse: ({ change }) =>
        `Weights that switch abruptly make the body jump: ${change}° a frame. With a higher T the maps share.`,
      no: ({ change, shared }) => `${change}° a frame, at an error of ${shared}°.`,
      hints: [
        "The higher T, the softer the change from map to map, and the less each map counts alone.",
        "Both numbers are shown below the plane. Turn T up slowly.",
      ],
    },
    C: {
      task: "A key sets the two numbers at one instant, and a smooth curve joins the keys. Make the cycle from at most 3 keys, with a mean error of at most 2°.",
      pass: ({ count, keyed }) => `Yes: ${count} keys, two numbers each, and ${keyed}° of error for a whole cycle.`,
      near: {
        fewer: ({ count, keyed }) => `${keyed}° is good, but ${count} keys are too many.`,
        turns: ({ keyed, from, to, worst }) =>
          `Close: ${keyed}°. From key ${from} ms to ${to} ms it is off by up to ${worst}°.`,
      },
      refuse: ({ count, from, to, worst }) =>
        `${count} keys are too few: from key ${from} ms to ${to} ms it is off by up to ${worst}°.`,
      no: ({ keyed, from, to, worst }) => `${keyed}°. From key ${from} ms to ${to} ms it is off by up to ${worst}°.`,
      hints: [
        "The curve through the keys should turn where the recorded one turns. Put keys where its direction changes.",
        "Take three keys, about a third of the cycle apart, and shift them together.",
      ],
    },
  },
  sources: [
    "Wang, Liu and Zhou, Key-styling: learning motion style for real-time synthesis of 3D animation, 2006. Its Eq. 7 and 8 print the opposite sign, and it has no weights by regions of styles (mᵢ, Sᵢ); `docs/methods/somn.md` says why both are changed.",
    "Updates are made by `rust/strut-core/src/somn/learning.rs`, poses by `rust/strut-core/src/somn/synthesis.rs`, and cycles from keys by `rust/strut-core/src/somn/key_styling.rs`.",
  ],
};
