/** Texts of the Key-style view. */
import { counted } from "../../strings/counted.en";

const components = counted("component");

export const keyStyle = {
  heading: "Style pad",
  caption: (variables: string) => `${variables} in, a whole pose out`,
  numbers: (n: number, word: string) => `${word} ${n === 1 ? "number" : "numbers"}`,
  picture: "A mannequin in the pose for these style variables.",
  comparePicture: "The same keys with three methods, side by side: key-style, hybrid and key-framing.",

  // Training motions.
  set: "Training motions",
  builtIn: "Built in",
  sets: { walk: "Walking", punch: "Punching", run: "Running" },
  openDatabase: "Open database",
  openFiles: "Files dropped here",
  chosenClips: (n: number) => (n === 1 ? "1 clip" : `${n} clips`),
  chooseClips: "Clips…",
  clips: "Training clips",
  clipsWhy: "Choose clips of one activity. Where equal values belong to different poses, the result is their mean.",
  clipSecs: (secs: string) => `${secs} s`,
  take: "Train",
  cancel: "Cancel",

  // Style variables.
  axes: {
    hips_height: { title: "hips height", short: "hips" },
    reach_left: { title: "left reach", short: "left reach" },
    reach_right: { title: "right reach", short: "right reach" },
    hand_height_left: { title: "left hand height", short: "left hand" },
    hand_height_right: { title: "right hand height", short: "right hand" },
    foot_separation: { title: "foot separation", short: "feet apart" },
    foot_height_difference: { title: "foot height difference", short: "feet up" },
    torso_lean: { title: "torso lean", short: "lean" },
    hands_apart: { title: "distance of the hands", short: "hands apart" },
    knee_bend_left: { title: "left knee bend", short: "left knee" },
    knee_bend_right: { title: "right knee bend", short: "right knee" },
    speed: { title: "speed", short: "speed" },
  },
  axis: ["First style variable", "Second style variable", "Third style variable"] as readonly string[],
  by: "by",
  none: "–",
  expression: "Expression…",
  expressionOf: (which: string) => `${which}, as an expression`,
  expressionHint: "For example left_hand.y − left_upper_arm.y",
  axisTitle: (title: string, unit: string) => (unit === "" ? title : `${title}, ${unit}`),
  recordingTime: "time in the recordings",

  // The pad.
  handle: "Style",
  recordedPoses: "recorded poses",
  noData: "no data: the pose is a guess",
  beyond: "Beyond the data: the nearest pose of the model is shown.",
  hint: "Drag the point: every position is a pose.",
  hintWalk: "Drag the point clockwise: the character walks.",
  replay: "Replay the drag",
  trailToKeys: "Keys from the drag",
  valueOf: (title: string, value: string, unit: string) => `${title} ${value}${unit === "" ? "" : ` ${unit}`}`,

  // The model.
  reading: "Reading the motions.",
  model: (count: number, secs: string) => `${components(count)} · trained in ${secs} s`,
  modelSettings: "Model",
  componentCount: "Components",
  byRule: (n: number) => (n === 0 ? "automatic" : String(n)),
  learning: "Training",
  som: "SOMN",
  em: "EM",
  choosing: "Pose",
  smooth: "Smooth",
  hard: "Hard",
  smoothWhy:
    "Neighbouring components share the pose. Hard uses only the best component, as in the paper: the pose jumps at boundaries.",
  component: (n: number, home: string) => `Component ${n}: ${home}`,
  components: (count: number, winner: number) => `${components(count)}; number ${winner} contributes most`,

  unexplained: (percent: string) =>
    `The style variables leave ${percent} % of the pose undetermined. Try another variable.`,

  // The picture.
  ghost: "Nearest recording",
  method: "Method between keys",
  methods: { style: "Key-style", hybrid: "Hybrid", frame: "Key-frame", all: "All three" },
  methodCaptions: {
    style: "style variables alone",
    hybrid: "through recorded poses at the keys",
    frame: "recorded poses, blended",
  },
  compared:
    "Key-framing uses a whole recorded pose at every key; key-style uses only the style variables. Dense keys favour key-framing. With keys at least ten frames apart, key-style preserves the dynamics.",

  // Time.
  pane: "Below the pad",
  keysPane: "Keys",
  recordingsPane: "Recordings",
  timeline: "Keys of the style variables",
  keyOf: (n: number, title: string) => `Key ${n}, ${title}`,
  keyAt: (secs: string, value: string) => `${secs} s, ${value}`,
  previous: "Previous key",
  next: "Next key",
  loop: "Repeat",
  length: "Length, seconds",
  ofLength: "of",
  seconds: "s",
  curve: "Between keys",
  curves: { spline: "Smooth", monotone: "No overshoot" },
  addKey: "Key",
  setKey: "Set a key",
  removeKey: "Remove key",
  drags: "Drag to record.",
  setsKey: "sets a key.",
  tooManyKeys: (max: number) => `There are already ${max} keys. Remove one, then set another.`,
  recording: "Recording",
  recordedPose: "Time in the recording",
  recordedAt: (clip: string, secs: string) => `${clip}, ${secs} s`,

  // Exports.
  fileName: "key-style",

  // Without a model.
  nothing: "No model trained yet",
  training: "Training",
  noModel: "The model could not be trained.",
  tryAgain: "Train again",
  useBuiltIn: "Use the built-in walk",
  noClips: (action: string) => `There is no clip of “${action}” here. Choose other clips.`,
  filesMissing:
    "This link uses files that are not here. Drop them on the page. Until then, the built-in walk is shown.",
};
