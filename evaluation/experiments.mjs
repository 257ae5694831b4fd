// The experiments of docs/evaluation.md: the paper's section 7 and its components, each one command.

const BN1 = "--data $MOCAP/bandai-namco-1 --source normal";
const BN2 = "--data $MOCAP/bandai-namco-2 --source normal";
const ALL_METHODS = "nn,knn,lar,mar,gar,lti,lti-dof,gp";
const FOREIGN = "--protocol off-database --inputs $MOCAP/cmu,$MOCAP/xia";

/**
 * Each experiment: `id` names its files, `title` and `question` are above its table, `args` follow `strut evaluate`;
 * `$MOCAP` stands for the folder of real clips and `$DEMO` for the built-in motions as BVH files. With `set` it is in
 * the figure of error bars, with `curves` it writes curves over time, too, and `findings` follow the table.
 */
export const experiments = [
  {
    id: "walk",
    title: "One action, every method",
    question:
      "Walking in seven styles, eight takes each; 8 folds × 6 targets. The paper's Table 3 and Figure 6, homogeneous.",
    args: `${BN2} --actions walk --methods ${ALL_METHODS}`,
    set: "walk, 7 styles",
  },
  {
    id: "heterogeneous",
    title: "Four actions in one database, nothing known of the input",
    question: "Walk, run and turns in one database. The engine finds action and style itself.",
    args: `${BN2} --actions walk,run,walk-turn-left,walk-turn-right --methods ${ALL_METHODS} --folds 4`,
    set: "4 actions, 7 styles",
    findings: `The timing error of \`mar\` differs by action; the floor, the mean of three other takes, is in parentheses. It is 20.5 ms in walks
(19.3), 24.0 in runs (13.5), 33.8 in turns to the left (23.6) and 51.3 in turns to the right (21.5). In turns to the right two
styles lie above the floor: elderly with 95.2 ms and exhausted with 103.5 ms. The other four have 20 to 40. They are as far off
with action and style known (82.5 and 102.3), and by every method (nn 79.9 and 100.0 is the least). Their first takes are slower
than the rest. Exhausted turns to the right last 248 and 170 frames in takes 1 and 2, and 110 to 120 in the other six. In four
folds the floor is made of the first three other takes, which are slow as well, while a method mixes all seven. Over all eight
folds (the table of η below, .5) these two are at the floor: elderly has 58.7 ms (floor 62.8), exhausted 82.3 (floor 79.2). So is the mean of all pairs: 29.0 ms and 2.18 cm, where three other takes have 27.0 and 2.21.`,
  },
  {
    id: "labels",
    title: "What labels are worth",
    question: "The same data with action and style known, one of them, or neither.",
    args: `${BN2} --actions walk,run,walk-turn-left,walk-turn-right --methods knn,lar,mar --labels both,action,style --folds 4`,
  },
  {
    id: "tempo",
    title: "Whose tempo",
    question:
      "η of the phase lock: at 0 the input keeps its own tempo and durations are the neighbours', at 1 the style's tempo replaces it. All eight folds of the four actions.",
    args: `${BN2} --actions walk,run,walk-turn-left,walk-turn-right --methods mar --tempo 0,0.5,1`,
  },
  {
    id: "tempo-runs",
    title: "Whose tempo: runs",
    question: "Running alone, action and style known.",
    args: `${BN2} --actions run --methods mar --labels both --tempo 0,0.5,1`,
  },
  {
    id: "tempo-turns",
    title: "Whose tempo: turns",
    question: "Turns alone, action and style known.",
    args: `${BN2} --actions walk-turn-left,walk-turn-right --methods mar --labels both --tempo 0,0.5,1`,
  },
  {
    id: "one-take",
    title: "One example of each style",
    question:
      "Walking in fifteen acted styles, two takes each: one is held out, one is all the database knows. The second neutral take is one second long, so that in one of the two folds there is hardly a neutral step to go by.",
    args: `${BN1} --actions walk --methods ${ALL_METHODS}`,
    set: "walk, 15 styles, 1 take",
  },
  {
    id: "one-take-labels",
    title: "One example of each style: labels",
    question: "The same with action and style known.",
    args: `${BN1} --actions walk --methods mar --labels both`,
  },
  {
    id: "takes",
    title: "Number of target takes",
    question:
      "How many performances of a style does the database need? Chosen by chance, three times a fold. The neutral style keeps all of its own.",
    args: `${BN2} --actions walk --methods knn,mar --takes 1,2,4,0`,
  },
  {
    id: "progress",
    title: "How much of a style comes out",
    question:
      "Share of the way from the input to the style that the output covers, and the real take held out, mean ± standard deviation over the folds. The way leads to the mean of the style's other takes, in the means and deviations of the joints' places, each in units of its spread over takes. Action and style known; least beside the real takes first.",
    args: `${BN2} --methods mar --labels both --progress`,
    findings: `Four of the weakest five are \`exhausted\`, one is a wave. In all of them joints are on average where they should be (84 to 99 %
of the way in the means). They move too little about that place (24 to 45 % in the deviations). The target of a frame is the
mean of its counterparts, so that differences between counterparts cancel. With one take of each target style in the databases
(\`--takes 1\`) the five cover 0.78, 0.89, 0.81, 0.73 and 0.88 of the way. Pose errors are then 0.2 to 0.7 cm larger, except in
the masculine wave.

- \`exhausted\` turns, left and right: two manners. Takes 1–4 cover 0.4 to 1.0 of the way to the others; takes 5–8, which stagger,
  cover 1.1 to 1.6. In left turns their heads sway sideways by 1.3 and 3.2 cm (standard deviations). The output sways by 1.0 cm.
  \`strut build-db\` names both.
- \`masculine\` wave: another content. Neutral hands wave 12 or 13 times, at 2 Hz and 20 cm wide; masculine ones 5 or 6 times, at
  0.75 Hz and 55 cm wide. The output keeps the strokes of the input: 12 to 14 of them, 29 to 40 cm wide at most. Real takes do
  not wave together either: at equal canonical time their hands correlate by 0.0 to 0.3.
- \`exhausted\` walk: swaying that is not in step. The head sways by 1.9 cm, of which 1.0 cm recurs with every step; the rest
  differs from cycle to cycle. The output sways by 0.8 cm, nearly all of it in step.
- \`exhausted\` wave: both. Hands wave 5 times, 40 cm wide, at 0.75 Hz. The feet shift beside the hips by 8 to 18 cm, differently
  in each take (correlations −0.9 to 0.5); in the output by 3 to 5 cm.`,
  },
  {
    id: "foreign-methods",
    title: "Motion that the database does not hold: methods",
    question:
      "Every clip of two other collections is styled, unlabelled, with walking and running. Columns are how rough it becomes against the input (1 is as smooth), how much of its fast content is left (1 is all), and how far it moved.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly,active,exhausted,feminine --methods nn,knn,lar,mar`,
  },
  {
    id: "foreign-bias",
    title: "Motion that the database does not hold: bias",
    question:
      "Without the bias term (κ inf), with it, and for ρ from all style to all content (the paper's section 5.4).",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly --methods mar --kappa 3 --rho 0,0.3,0.7,1`,
  },
  {
    id: "foreign-kappa",
    title: "Motion that the database does not hold: κ",
    question: "How many standard deviations of the neighbours the database is taken to know.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly --methods mar --kappa 1,inf`,
  },
  {
    id: "foreign-coherence",
    title: "Motion that the database does not hold: coherence",
    question:
      "Beyond the paper: neighbours weigh less the farther they are, and predictions correct an expectation (`--coherence`, on by default).",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly --methods mar --coherence on,off`,
  },
  {
    id: "foreign-tempo",
    title: "Motion that the database does not hold: tempo and width",
    question: "The phase lock fades out where the input is unknown, and δ is three times as wide there.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly,active,exhausted,feminine --methods mar --tempo 0,0.5,1 --delta 0.2,0.35,0.7`,
  },
  {
    id: "extrapolation",
    title: "More of a style than was performed, and its opposite",
    question:
      "Weights of the target style beyond 0 to 1, kept within the joints' limits: how far any joint ends up beyond what anatomy allows where its input was not.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly,active --methods mar --intensity=-0.5,0,0.5,1,1.5,2`,
  },
  {
    id: "parts",
    title: "A style for a part of the body",
    question:
      "The rest is neutral. A part turns against the input by as much as when the whole body takes the style, the others by as much as without it.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly,active --methods mar --part whole,head,torso,arms,legs`,
  },
  {
    id: "coherence-inside",
    title: "What coherence costs where it is not needed",
    question: "Held-out walking and running.",
    args: `${BN2} --actions walk,run --methods mar --coherence on,off --folds 2`,
  },
  {
    id: "cross-action",
    title: "An action that the database does not have",
    question: "Running styled with a database of walking.",
    args: `${BN2} --actions run --database-actions walk --methods nn,knn,lar,mar --kappa 3,1 --folds 2`,
  },
  {
    id: "bias-inside",
    title: "What the bias costs where it is not needed",
    question: "Held-out walking, with and without the bias term.",
    args: `${BN2} --actions walk --methods mar --kappa 1,3,inf --folds 2`,
  },
  {
    id: "k",
    title: "K",
    question: "Neighbours in each class.",
    args: `${BN2} --actions walk --methods mar -k 5,10,20,40,80,160 --folds 2`,
  },
  {
    id: "window",
    title: "s",
    question: "Frames that are compared in the search for neighbours.",
    args: `${BN2} --actions walk --methods mar --window 1,5,9,15 --folds 2`,
  },
  {
    id: "search",
    title: "Exact search and kd-trees",
    question:
      "Neighbours found exactly, or among so many candidates of a kd-tree in each class, as libraries offer it.",
    args: `${BN2} --actions walk,run --methods mar --search exact,kdtree:40,kdtree:160,kdtree:320 --folds 1`,
  },
  {
    id: "delta",
    title: "δ",
    question: "How far classes less near than the nearest take part, where there are many classes.",
    args: `${BN2} --actions walk,run --methods mar --delta 0.2,0.35,0.7,3 --folds 2`,
  },
  {
    id: "lambda",
    title: "λ",
    question: "Ridge of the regressions, as a share of K.",
    args: `${BN2} --actions walk --methods mar --lambda 0.001,0.01,0.1,1,10 --folds 2`,
  },
  {
    id: "registration",
    title: "Registration",
    question: "Dynamic time warping, iterative motion warping and linear time within gait cycles.",
    args: `${BN2} --actions walk --methods mar --registration dtw,imw,linear --folds 2`,
  },
  {
    id: "online",
    title: "Live and whole clips",
    question: "Frame by frame, or with a view of what comes after when contacts are smoothed and feet planted.",
    args: `${BN2} --actions walk,run --methods mar --mode offline,online --folds 2`,
  },
  {
    id: "paper-database",
    title: "The paper's own database",
    question: "Eight styles, one clip each of five actions, styling other performers.",
    args: "--data $MOCAP/xia --source neutral --protocol off-database --inputs $MOCAP/bandai-namco-2/dataset-2_walk_normal_001.bvh,$MOCAP/bandai-namco-2/dataset-2_run_normal_001.bvh,$MOCAP/cmu --methods nn,knn,mar",
  },
  {
    id: "demo",
    title: "The built-in motions",
    question: "Synthetic walking: what needs no data to repeat, and what the curves below show.",
    args: `--data $DEMO --source neutral --actions walk --targets old --methods ${ALL_METHODS}`,
    curves: true,
  },
];
