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
      "Walking in seven styles, eight takes each; 8 folds × 6 target styles. This corresponds to the homogeneous case of the paper's Table 3 and Figure 6.",
    args: `${BN2} --actions walk --methods ${ALL_METHODS}`,
    set: "walk, 7 styles",
  },
  {
    id: "heterogeneous",
    title: "Four actions in one database, without labels of the input",
    question:
      "The database has walks, runs and two turns. The engine recognises the action and the style of the input.",
    args: `${BN2} --actions walk,run,walk-turn-left,walk-turn-right --methods ${ALL_METHODS} --folds 4`,
    set: "4 actions, 7 styles",
    findings: `The timing error of \`mar\` depends on the action. It is 20.5 ms for walks, 24.0 for runs, 33.8 for turns to the left and 51.3 for
turns to the right. The floors, means of three other takes, are 19.3, 13.5, 23.6 and 21.5 ms.

In turns to the right, two styles are far above the floor: elderly with 95.2 ms and exhausted with 103.5 ms. The other four
styles have 20 to 40 ms. The errors of these two styles are similar if action and style are known: 82.5 and 102.3 ms. They are
also similar with every method; the smallest are those of nn, 79.9 and 100.0 ms. The reason is that their first takes are
slower than the others. Exhausted turns to the right last 248 and 170 frames in takes 1 and 2, and 110 to 120 frames in the
other six. With four folds, the floor consists of the first three other takes, which are also slow, but a method mixes all
seven. Over all eight folds (the table of η below, at 0.5) both styles are near the floor: elderly has 58.7 ms (floor 62.8),
exhausted 82.3 ms (floor 79.2). So is the mean of all pairs, with 29.0 ms and 2.18 cm; three other takes have 27.0 ms and 2.21
cm.`,
  },
  {
    id: "labels",
    title: "The effect of labels",
    question: "The same data, with both labels of the input known (action and style), or one of them.",
    args: `${BN2} --actions walk,run,walk-turn-left,walk-turn-right --methods knn,lar,mar --labels both,action,style --folds 4`,
  },
  {
    id: "tempo",
    title: "Tempo",
    question:
      "η of the phase lock sets the tempo. At 0 the output keeps the input's tempo, and durations are those of the neighbours. At 1 the output has the style's tempo. All eight folds of the four actions.",
    args: `${BN2} --actions walk,run,walk-turn-left,walk-turn-right --methods mar --tempo 0,0.5,1`,
  },
  {
    id: "tempo-runs",
    title: "Tempo: runs",
    question: "Runs only, with action and style known.",
    args: `${BN2} --actions run --methods mar --labels both --tempo 0,0.5,1`,
  },
  {
    id: "tempo-turns",
    title: "Tempo: turns",
    question: "Turns only, with action and style known.",
    args: `${BN2} --actions walk-turn-left,walk-turn-right --methods mar --labels both --tempo 0,0.5,1`,
  },
  {
    id: "one-take",
    title: "One example of each style",
    question:
      "Walking in fifteen acted styles, two takes each: one take is held out, the other is the only one in the database. The second neutral take lasts one second, so one of the two folds has hardly a neutral step.",
    args: `${BN1} --actions walk --methods ${ALL_METHODS}`,
    set: "walk, 15 styles, 1 take",
  },
  {
    id: "one-take-labels",
    title: "One example of each style: labels",
    question: "The same, with action and style known.",
    args: `${BN1} --actions walk --methods mar --labels both`,
  },
  {
    id: "takes",
    title: "Number of target takes",
    question:
      "How many takes of a style does the database need? They are chosen at random, three times per fold. The neutral style keeps all its takes.",
    args: `${BN2} --actions walk --methods knn,mar --takes 1,2,4,0`,
  },
  {
    id: "progress",
    title: "How much of a style is reached",
    question:
      "The table has the share of the distance from the input to the style that the output covers, and the same for the held-out real take. Values are means ± standard deviations over the folds. The distance to the mean of the style's other takes is measured in means and standard deviations of the joint positions, each in units of its spread over takes. Action and style are known. The lowest shares, relative to the real takes, come first.",
    args: `${BN2} --methods mar --labels both --progress`,
    findings: `Of the weakest five, four are \`exhausted\`, and one is a wave. In all five, the mean positions of the joints are nearly right (84 to
99 % of the distance). But the joints move too little about these positions (24 to 45 % in the deviations). The target of a frame
is the mean of its counterparts, so differences between counterparts cancel. With one take of each target style in the databases
(\`--takes 1\`), the five cover 0.78, 0.89, 0.81, 0.73 and 0.88 of the distance. Pose errors are then 0.2 to 0.7 cm larger, except
in the masculine wave.

- \`exhausted\` turns, left and right: the takes form two groups. Takes 1–4 cover 0.4 to 1.0 of the distance to the others; takes 5–8,
  which stagger, cover 1.1 to 1.6. In left turns the heads of the two groups sway sideways by 1.3 and 3.2 cm (standard
  deviations). The head of the output sways by 1.0 cm. \`strut build-db\` reports both groups.
- \`masculine\` wave: the content differs. In the neutral style the hands wave 12 or 13 times, at 2 Hz and 20 cm wide. In the
  masculine style they wave 5 or 6 times, at 0.75 Hz and 55 cm wide. The output keeps the 12 to 14 waves of the input, at most
  29 to 40 cm wide. Real takes are not synchronous either: at equal canonical time, the correlation of their hands is 0.0 to
  0.3.
- \`exhausted\` walk: swaying that is not synchronous with the steps. The head sways by 1.9 cm, of which 1.0 cm recurs with every
  step; the rest differs from cycle to cycle. The output sways by 0.8 cm, nearly all of it in step.
- \`exhausted\` wave: both causes. Hands wave 5 times, 40 cm wide, at 0.75 Hz. The feet shift relative to the hips by 8 to 18 cm,
  differently in each take (correlations −0.9 to 0.5). In the output they shift by 3 to 5 cm.`,
  },
  {
    id: "foreign-methods",
    title: "Motion that the database does not hold: methods",
    question:
      "All clips of two other data sets are styled without labels, with a database of walks and runs. *Acceleration* is relative to the input: 1 is equally smooth. *Content* is the share of the fast movements that remains: 1 is all of them. *Distance* is the difference from the input.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly,active,exhausted,feminine --methods nn,knn,lar,mar`,
  },
  {
    id: "foreign-bias",
    title: "Motion that the database does not hold: bias",
    question: "The bias term, with ρ from all style (0) to all content (1), as in section 5.4 of the paper.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly --methods mar --kappa 3 --rho 0,0.3,0.7,1`,
  },
  {
    id: "foreign-kappa",
    title: "Motion that the database does not hold: κ",
    question:
      "κ is the tolerance in standard deviations of the neighbours: input within it has no bias. With inf there is no bias term.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly --methods mar --kappa 1,inf`,
  },
  {
    id: "foreign-coherence",
    title: "Motion that the database does not hold: coherence",
    question:
      "Coherence is not in the paper: distant neighbours have less weight, and a complementary filter smooths the predictions (`--coherence`, on by default).",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly --methods mar --coherence on,off`,
  },
  {
    id: "foreign-tempo",
    title: "Motion that the database does not hold: tempo and δ",
    question: "Where the database has no similar motion, the phase lock fades out, and δ is three times as large.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly,active,exhausted,feminine --methods mar --tempo 0,0.5,1 --delta 0.2,0.35,0.7`,
  },
  {
    id: "extrapolation",
    title: "Exaggerated and opposite styles",
    question:
      "The target style has weights below 0 and above 1. Joints are kept within their limits. *Beyond anatomy* is the largest angle of a joint outside the anatomical range, where the input was inside.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly,active --methods mar --intensity=-0.5,0,0.5,1,1.5,2`,
  },
  {
    id: "parts",
    title: "A style for a part of the body",
    question:
      "One part has the style, the rest is neutral. That part differs from the input as much as if the whole body had the style. The other parts differ as much as in the neutral style.",
    args: `${BN2} ${FOREIGN} --actions walk,run --targets elderly,active --methods mar --part whole,head,torso,arms,legs`,
  },
  {
    id: "coherence-inside",
    title: "Coherence inside the database",
    question: "Held-out walks and runs.",
    args: `${BN2} --actions walk,run --methods mar --coherence on,off --folds 2`,
  },
  {
    id: "cross-action",
    title: "An action that is not in the database",
    question: "Runs are styled with a database of walks.",
    args: `${BN2} --actions run --database-actions walk --methods nn,knn,lar,mar --kappa 3,1 --folds 2`,
  },
  {
    id: "bias-inside",
    title: "Bias inside the database",
    question: "Held-out walks, with and without the bias term.",
    args: `${BN2} --actions walk --methods mar --kappa 1,3,inf --folds 2`,
  },
  {
    id: "k",
    title: "K",
    question: "Number of neighbours in each class.",
    args: `${BN2} --actions walk --methods mar -k 5,10,20,40,80,160 --folds 2`,
  },
  {
    id: "window",
    title: "s",
    question: "Number of frames of a search window.",
    args: `${BN2} --actions walk --methods mar --window 1,5,9,15 --folds 2`,
  },
  {
    id: "search",
    title: "Exact search and kd-trees",
    question: "Neighbours are found exactly, or among the given number of candidates of a kd-tree in each class.",
    args: `${BN2} --actions walk,run --methods mar --search exact,kdtree:40,kdtree:160,kdtree:320 --folds 1`,
  },
  {
    id: "delta",
    title: "δ",
    question: "δ sets how much weight more distant classes have. The database has many classes.",
    args: `${BN2} --actions walk,run --methods mar --delta 0.2,0.35,0.7,3 --folds 2`,
  },
  {
    id: "lambda",
    title: "λ",
    question: "Ridge regularisation of the regressions, as a share of K.",
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
    question: "*Online*: frame by frame. *Offline*: contacts are smoothed and feet are planted with later frames, too.",
    args: `${BN2} --actions walk,run --methods mar --mode offline,online --folds 2`,
  },
  {
    id: "paper-database",
    title: "The paper's own database",
    question: "Eight styles with one clip of each of five actions. Motions of other performers are styled.",
    args: "--data $MOCAP/xia --source neutral --protocol off-database --inputs $MOCAP/bandai-namco-2/dataset-2_walk_normal_001.bvh,$MOCAP/bandai-namco-2/dataset-2_run_normal_001.bvh,$MOCAP/cmu --methods nn,knn,mar",
  },
  {
    id: "demo",
    title: "The built-in motions",
    question: "Synthetic walks. This experiment needs no data, and the curves below show it.",
    args: `--data $DEMO --source neutral --actions walk --targets old --methods ${ALL_METHODS}`,
    curves: true,
  },
];
