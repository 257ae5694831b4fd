//! The report `docs/demo-motions.md`: description and measurements of the built-in motions.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use strut_core::humanoid::{HumanoidMotion, Proportions, Role};
use strut_core::metrics;
use strut_core::retarget::to_humanoid;
use strut_core::transfer::beyond_anatomy;
use strut_demo::measure::{self, Cycle};
use strut_demo::{
    Action, FULL_RATE_HZ, Passage, Performance, PlannedClip, STYLES, Script, Style, TABLE_1, WALKING_BANDS, perform,
};
use strut_tasks::clip::read_clip;
use strut_tasks::{Outcome, TaskError};

/// Numbers of the recorded actions in the file names of `xia/`.
const RECORDED: [(&str, &str); 5] = [("walk", "01"), ("run", "13"), ("jump", "16"), ("punch", "18"), ("kick", "22")];

/// Speeds at which a gait is measured, relative to the preferred speed.
const PACES: [&[Passage]; 4] = [&straight(0.7), &straight(0.85), &straight(1.0), &straight(1.25)];

const fn straight(speed: f32) -> [Passage; 1] {
    [Passage { strides: 12, speed, turn_degrees: 0.0 }]
}

/// Returns the report as Markdown. `recordings` is a folder with `xia/` and `bandai-namco-2/`.
pub(crate) fn report(recordings: Option<&Path>) -> Outcome<String> {
    let clips = strut_demo::full_clips();
    let mut out = String::from(PREFACE);
    composition(&mut out, &clips);
    walking(&mut out, recordings)?;
    speeds(&mut out);
    running(&mut out);
    quality(&mut out, &clips, recordings)?;
    styles(&mut out);
    out.push_str(CRITICISM);
    Ok(out)
}

// Writing to a string cannot fail.
macro_rules! line {
    ($out:expr, $($text:tt)*) => { let _ = writeln!($out, $($text)*); };
}

fn composition(out: &mut String, clips: &[PlannedClip]) {
    line!(
        out,
        "\n## Composition\n\nThe numbers of frames, at {FULL_RATE_HZ} Hz, are those of Table 1 of Xia et al. 2015.\n"
    );
    line!(out, "| Action | Takes per style | Frames | Table 1 |\n| --- | ---: | ---: | ---: |");
    for (action, wanted) in TABLE_1 {
        let of = || clips.iter().filter(|c| c.clip.action == action);
        let frames: usize = of().map(|c| c.planted.len()).sum();
        line!(out, "| {action} | {} | {frames} | {wanted} |", of().count() / STYLES.len());
    }
}

/// Returns a straight gait of a style at a multiple of its speed.
fn paced(action: Action, passages: &'static [Passage], style: &Style) -> Performance {
    let script = Script { name: "straight", action, passages, seed: 4 };
    perform(&script, style, &Proportions::default(), FULL_RATE_HZ)
}

fn cycles(take: &Performance) -> Vec<Cycle> {
    measure::cycles_between(&take.motion, &measure::strikes(&take.phase))
}

fn walking(out: &mut String, recordings: Option<&Path>) -> Outcome {
    let cycles = cycles(&paced(Action::Walk, PACES[2], &STYLES[0]));
    line!(out, "\n## Neutral walking against published bands\n");
    line!(
        out,
        "The angles are, in degrees, the thigh against the vertical (hip), the flexion of the knee, and the \
         dorsiflexion"
    );
    line!(
        out,
        "of the ankle. They are means of 12 strides of both legs, at 0, 10, … 90 % of the cycle from heel strike. \
         *Share*"
    );
    line!(out, "is the part of the cycle within ±1 SD of the published values.\n");
    line!(out, "| Angle | | {} | Share |", cells(|i| format!("{i} %")));
    line!(out, "| --- | --- |{}", " ---: |".repeat(11));
    let recorded = recordings.map(recorded_walks).transpose()?;
    for (angle, band) in WALKING_BANDS.iter().enumerate() {
        let curve = measure::mean_and_sd(&cycles, angle);
        let published = cells(|i| {
            let (mean, sd) = band.at(i as f32 / 100.0);
            format!("{mean:.0} ± {sd:.0}")
        });
        line!(out, "| {} | published | {published} | |", band.name);
        let share = 100.0 * measure::share_within(band, &curve);
        line!(out, "| | built-in | {} | **{share:.0} %** |", cells(|i| format!("{:.0}", curve[i].0)));
        if let Some(recorded) = &recorded {
            let real = measure::mean_and_sd(recorded, angle);
            let share = 100.0 * measure::share_within(band, &real);
            let real = cells(|i| format!("{:.0} ± {:.0}", real[i].0, real[i].1));
            line!(out, "| | recorded | {real} | {share:.0} % |");
        }
    }
    if let Some(recorded) = &recorded {
        line!(
            out,
            "\n*Recorded* are {} straight strides of the neutral walks of `xia/` and `bandai-namco-2/`. A strike is \
             assumed where",
            recorded.len()
        );
        line!(out, "the ankle is farthest in front of the pelvis, which is about 2 % of a cycle too early.");
    }
    Ok(())
}

/// Returns the cells of a table's row at 0, 10, … 90 % of the cycle.
fn cells(cell: impl Fn(usize) -> String) -> String {
    (0..10).map(|i| cell(10 * i)).collect::<Vec<_>>().join(" | ")
}

fn recorded_walks(folder: &Path) -> Outcome<Vec<Cycle>> {
    let mut all = Vec::new();
    let names = (1..=8).map(|take| format!("bandai-namco-2/dataset-2_walk_normal_{take:03}.bvh"));
    for name in names.chain(["xia/neutral_01_000.bvh".to_owned()]) {
        all.extend(measure::cycles(&recorded(&folder.join(name))?));
    }
    Ok(all)
}

fn recorded(path: &Path) -> Outcome<HumanoidMotion> {
    let clip = read_clip(path)?;
    Ok(to_humanoid(&clip.motion, &clip.binding, &clip.binding.proportions))
}

fn speeds(out: &mut String) {
    line!(out, "\n## Cadence and step length against speed\n");
    line!(
        out,
        "The walk ratio is the step length divided by the cadence. It does not change with speed (Sekiya et al. \
         1996). The style is neutral.\n"
    );
    line!(
        out,
        "| Gait | Speed m/s | Cadence steps/min | Step m | Walk ratio mm·min |\n| --- | ---: | ---: | ---: | ---: |"
    );
    for (action, passages) in [Action::Walk, Action::Run].into_iter().flat_map(|a| PACES.map(|p| (a, p))) {
        let take = paced(action, passages, &STYLES[0]);
        let (secs, strides) = (take.phase.len() as f32 / FULL_RATE_HZ, passages[0].strides as f32);
        let way = take.motion.poses.last().map_or(0.0, |p| p.root.with_y(0.0).length());
        let (cadence, step) = (120.0 * strides / secs, way / (2.0 * strides));
        let ratio = 1000.0 * step / cadence;
        line!(out, "| {} | {:.2} | {cadence:.0} | {step:.3} | {ratio:.2} |", action.name(), way / secs);
    }
}

fn running(out: &mut String) {
    let take = paced(Action::Run, PACES[2], &STYLES[0]);
    let knee = measure::mean_and_sd(&cycles(&take), 1);
    let share = |of: &dyn Fn(&[bool; 2]) -> bool| {
        100.0 * take.planted.iter().filter(|p| of(p)).count() as f32 / take.planted.len() as f32
    };
    let most = |from: usize, to: usize| knee[from..to].iter().map(|k| k.0).fold(f32::MIN, f32::max);
    line!(out, "\n## Neutral running\n\n| | Built-in | Novacheck 1998 |\n| --- | ---: | ---: |");
    line!(out, "| Stance, % of the cycle | {:.0} | under 40 |", share(&|p| p[0]));
    line!(out, "| Both feet in the air, % of the cycle | {:.0} | about 25 |", share(&|p| !p[0] && !p[1]));
    line!(out, "| Knee at the strike, degrees | {:.0} | 10–20 |", knee[0].0);
    line!(out, "| Knee in mid stance | {:.0} | 40–45 |", most(5, 30));
    line!(out, "| Knee in swing | {:.0} | 90–105 |", most(45, 95));
}

fn quality(out: &mut String, clips: &[PlannedClip], recordings: Option<&Path>) -> Outcome {
    line!(out, "\n## Skate, anatomy, jerk\n");
    line!(
        out,
        "*Skate* is the mean speed of the part that supports a planted foot (heel, ball or toes), in the worst clip. \
         *Beyond"
    );
    line!(
        out,
        "anatomy* counts frames with a joint outside its limits. *Jerk* is the mean over joints and frames of the \
         neutral"
    );
    line!(out, "style; it is compared with the neutral clip of `xia/` at the same rate.\n");
    line!(
        out,
        "| Action | Skate cm/s | Beyond anatomy | Jerk m/s³ | Jerk / recorded |\n| --- | ---: | ---: | ---: | ---: |"
    );
    for (action, _) in TABLE_1 {
        let of = || clips.iter().filter(|c| c.clip.action == action);
        let skate = of().map(|c| 100.0 * measure::skate(&c.clip.motion, &c.planted)).fold(0.0, f32::max);
        let beyond = of()
            .flat_map(|c| &c.clip.motion.poses)
            .filter(|pose| Role::ALL.iter().any(|&role| beyond_anatomy(role, pose.rotations[role.index()]) > 0.0));
        let neutral: Vec<f32> =
            of().filter(|c| c.clip.style == STYLES[0].name).map(|c| metrics::mean_jerk(&c.clip.motion)).collect();
        let jerk = neutral.iter().sum::<f32>() / neutral.len().max(1) as f32;
        let number = RECORDED.iter().find(|r| r.0 == action);
        let ratio = match (recordings, number) {
            (Some(folder), Some((_, number))) => {
                let path = folder.join(format!("xia/neutral_{number}_000.bvh"));
                let recorded = recorded(&path)?.resampled(FULL_RATE_HZ).map_err(|e| TaskError::in_file(&path, e))?;
                format!("{:.2}", jerk / metrics::mean_jerk(&recorded))
            }
            _ => "–".to_owned(),
        };
        line!(out, "| {action} | {skate:.3} | {} | {jerk:.0} | {ratio} |", beyond.count());
    }
    Ok(())
}

fn styles(out: &mut String) {
    line!(
        out,
        "\n## Styles\n\nThese are the rows of `rust/strut-demo/src/styles.rs`, which names the source of each value. \
         Speed,"
    );
    line!(out, "cadence and step are those of walking.\n");
    line!(
        out,
        "| Style | Speed m/s | Cadence | Step m | Jump m | Speed of jump, punch, kick |\n| --- | ---: | ---: | ---: | ---: | ---: |"
    );
    let by_name: BTreeMap<&str, &Style> = STYLES.iter().map(|s| (s.name, s)).collect();
    for (name, s) in by_name {
        let speed = s.step_length * s.cadence / 60.0;
        line!(
            out,
            "| {name} | {speed:.2} | {:.0} | {:.2} | {:.2} | {:.2}, {:.2}, {:.2} |",
            s.cadence,
            s.step_length,
            s.jump.rise,
            s.jump.speed,
            s.punch.speed,
            s.kick.speed
        );
    }
}

const PREFACE: &str = "\
# The built-in motions

Written by `npm run strut -- demo-db -o demo.strutdb --report docs/demo-motions.md --recordings ../shared/data`. Without
`--recordings` there are no comparisons with motion capture. The database has no recorded motion: `rust/strut-demo` synthesises
everything from a script, a style and a seed.
";

const CRITICISM: &str = include_str!("demo_criticism.md");
