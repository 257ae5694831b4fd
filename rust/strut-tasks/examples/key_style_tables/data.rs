//! The prototype's clips, and the held-out part of them (`docs/methods/somn.md` §2).

use std::path::PathBuf;
use strut_core::somn::{KeyStyleModel, Learning, Measure, Options, Recording, SEED, TrainError, train};
use strut_tasks::progress::unwatched;
use strut_tasks::recordings::read_recordings;
use strut_tasks::{Outcome, TaskError};

/// Number of components of all models.
const COMPONENTS: usize = 16;

/// How clips are held out.
#[derive(Clone, Copy, Debug)]
enum Held {
    /// Every fourth block of this many frames of the concatenated clips.
    Blocks(usize),
    /// The first clips of every group of `of` clips.
    Clips { first: usize, of: usize },
}

/// A data set of the prototype.
#[derive(Debug)]
pub(super) struct Plan {
    pub(super) name: &'static str,
    /// Description of the clips.
    pub(super) clips: &'static str,
    axes: &'static str,
    folder: &'static str,
    /// Prefixes of the file names, with the last take of each.
    files: &'static [&'static str],
    takes: usize,
    held: Held,
    /// Whether it is one of the main data sets, of which more is measured.
    pub(super) is_shown: bool,
    /// Errors of the prototype, degrees and centimetres: SOMN and EM.
    pub(super) published: [[f64; 2]; 2],
    /// Differences between requested and measured styles of the prototype.
    pub(super) published_control: &'static str,
}

const STYLES: &str = "active elderly exhausted feminine masculine normal youthful";
const FEET: &str = "foot_separation, foot_height_difference";

pub(super) const ALL: [Plan; 5] = [
    Plan {
        name: "punch",
        clips: "set 1 punch, 2 clips",
        axes: "hips_height, reach_left, reach_right",
        folder: "bandai-namco-1",
        files: &["dataset-1_punch_normal"],
        takes: 2,
        held: Held::Blocks(20),
        is_shown: true,
        published: [[5.30, 2.63], [5.30, 2.61]],
        published_control: "0.1, 0.8, 0.5 cm",
    },
    Plan {
        name: "walk",
        clips: "set 2 walk_normal, 8 clips",
        axes: FEET,
        folder: "bandai-namco-2",
        files: &["dataset-2_walk_normal"],
        takes: 8,
        held: Held::Clips { first: 2, of: 8 },
        is_shown: true,
        published: [[2.44, 1.23], [2.46, 1.29]],
        published_control: "0.4, 0.25 cm",
    },
    Plan {
        name: "hands",
        clips: "set 2 wave-both-hands, 7 styles × 3",
        axes: "hand_height_left, hand_height_right",
        folder: "bandai-namco-2",
        files: &["dataset-2_wave-both-hands_{style}"],
        takes: 3,
        held: Held::Clips { first: 7, of: 21 },
        is_shown: false,
        published: [[11.9, 5.0], [12.2, f64::NAN]],
        published_control: "1.8, 2.3 cm",
    },
    Plan {
        name: "dance",
        clips: "set 1 dance-short",
        axes: "hips_height, hand_height_left, hand_height_right",
        folder: "bandai-namco-1",
        files: &["dataset-1_dance-short_normal"],
        takes: 1,
        held: Held::Blocks(40),
        is_shown: false,
        published: [[18.9, 10.7], [18.8, f64::NAN]],
        published_control: "0.04, 3.3, 3.6 cm",
    },
    Plan {
        name: "walk-all",
        clips: "set 2 walk, 7 styles × 8",
        axes: "foot_separation, foot_height_difference, torso_lean",
        folder: "bandai-namco-2",
        files: &["dataset-2_walk_{style}"],
        takes: 8,
        held: Held::Clips { first: 2, of: 8 },
        is_shown: false,
        published: [[7.28, 2.51], [7.51, 2.60]],
        published_control: "not given",
    },
];

/// Training clips and test clips.
pub(super) struct DataSet {
    pub(super) plan: &'static Plan,
    pub(super) axes: Vec<Measure>,
    pub(super) training: Vec<Recording>,
    pub(super) test: Vec<Recording>,
}

impl DataSet {
    /// Reads the set from folders that contain the plan's folder, or are it.
    pub(super) fn read(plan: &'static Plan, folders: &[PathBuf]) -> Outcome<Self> {
        let names: Vec<String> = plan
            .files
            .iter()
            .flat_map(|file| STYLES.split(' ').map(move |style| file.replace("{style}", style)))
            .flat_map(|name| (1..=plan.takes).map(move |take| format!("{name}_{take:03}.bvh")))
            .collect();
        let find = |name: &String| {
            let places = folders.iter().flat_map(|folder| [folder.join(plan.folder).join(name), folder.join(name)]);
            let mut places = places.filter(|path| path.is_file());
            places.next().ok_or_else(|| TaskError::new(format_args!("{name}: this file is not in the given folders")))
        };
        let mut paths = names.iter().map(find).collect::<Outcome<Vec<_>>>()?;
        paths.dedup();
        let mut refused = Vec::new();
        let recordings = read_recordings(&paths, &mut refused, &unwatched)?;
        if let Some(first) = refused.first() {
            return Err(TaskError::new(format_args!("{}: {}", first.file, first.reason)));
        }
        let axes = Measure::parse_list(plan.axes).map_err(TaskError::new)?;
        let (training, test) = match plan.held {
            Held::Clips { first, of } => {
                let (test, training): (Vec<_>, Vec<_>) =
                    recordings.into_iter().enumerate().partition(|(i, _)| i % of < first);
                let clips = |of: Vec<(usize, Recording)>| of.into_iter().map(|(_, clip)| clip).collect();
                (clips(training), clips(test))
            }
            Held::Blocks(frames) => blocks(&recordings, frames),
        };
        Ok(Self { plan, axes, training, test })
    }

    /// Trains a model on the training clips.
    pub(super) fn train(&self, learning: Learning, components: usize, seed: u64) -> Result<KeyStyleModel, TrainError> {
        let options = Options { components: Some(components), seed, learning };
        train(&self.training.iter().collect::<Vec<_>>(), &self.axes, options)
    }

    /// Trains the displayed model: as the page and the command do, but with 16 components.
    pub(super) fn model(&self) -> Outcome<KeyStyleModel> {
        self.train(Learning::Som, COMPONENTS, SEED).map_err(TaskError::new)
    }

    /// Trains one model per seed.
    pub(super) fn models(&self, learning: Learning, seeds: u64) -> Outcome<Vec<KeyStyleModel>> {
        (0..seeds).map(|seed| self.train(learning, COMPONENTS, seed).map_err(TaskError::new)).collect()
    }
}

/// Separates every fourth block of the concatenated clips from the rest.
fn blocks(recordings: &[Recording], frames: usize) -> (Vec<Recording>, Vec<Recording>) {
    let (mut training, mut test) = (Vec::new(), Vec::new());
    let mut before = 0;
    for recording in recordings {
        let count = recording.poses.len();
        let is_held = |frame: usize| (before + frame) / frames % 4 == 3;
        let mut begin = 0;
        for end in 1..=count {
            if end == count || is_held(end) != is_held(begin) {
                let part = recording.part(begin..end);
                if is_held(begin) {
                    test.push(part);
                } else {
                    training.push(part);
                }
                begin = end;
            }
        }
        before += count;
    }
    (training, test)
}
