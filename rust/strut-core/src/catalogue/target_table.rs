//! Target of every row of a catalogue in one style.

use super::quantised::{Quantiser, Steps};
use super::runtime::Catalogue;
use crate::pose_vector::{PoseRow, ROW};
use crate::registration::MAX_COUNTERPARTS;
use std::sync::{Arc, OnceLock};

/// A counterpart that moves by this number of rows or more from one frame to the next is not continuous: it is in
/// another cycle.
const JUMP_ROWS: f32 = 4.0;

/// Number of rows whose targets are computed together. Similar motion is near for a part of a cycle only: with 64 rows,
/// a clip of a walk needs twice the memory.
const PART: usize = 16;

/// Registered target of every row in one style: the mean of the poses and contacts at the row's counterparts, and the
/// time that the counterparts take (`docs/methods/mar.md` §4). Targets are computed when they are first read, and kept:
/// most motions are near a small part of a database.
#[derive(Debug)]
pub struct TargetTable {
    catalogue: Arc<Catalogue>,
    style: u16,
    parts: Vec<OnceLock<Vec<Target>>>,
}

/// Target of a row.
#[derive(Debug)]
struct Target {
    pose: Steps,
    step_secs: f32,
    /// In units of 1/65,535.
    contact: [u16; 2],
}

impl TargetTable {
    /// Creates the table of a style.
    ///
    /// # Panics
    /// If the catalogue does not contain `style`.
    pub fn new(catalogue: Arc<Catalogue>, style: u16) -> Self {
        assert!(usize::from(style) < catalogue.styles.len(), "style {style} of {}", catalogue.styles.len());
        let parts = std::iter::repeat_with(OnceLock::new).take(catalogue.frames().div_ceil(PART)).collect();
        Self { catalogue, style, parts }
    }

    /// Memory of a table of this number of rows after every target has been read, bytes.
    pub(super) fn bytes(rows: u64) -> u64 {
        // Overhead of an allocation.
        let part = size_of::<OnceLock<Vec<Target>>>() as u64 + 16;
        let targets = rows.saturating_mul(size_of::<Target>() as u64);
        targets.saturating_add(rows.div_ceil(PART as u64).saturating_mul(part))
    }

    /// Index of the style.
    pub fn style(&self) -> u16 {
        self.style
    }

    /// Returns whether rows of a class have counterparts in this style.
    ///
    /// # Panics
    /// If the class does not exist.
    pub fn class_has_target(&self, class: usize) -> bool {
        let mut rows = self.catalogue.classes()[class].rows.clone();
        rows.any(|row| self.catalogue.counterparts(row, self.style).next().is_some())
    }

    /// Target pose of a row; the row itself if it has no counterpart in the style.
    ///
    /// # Panics
    /// If the row does not exist.
    pub fn pose(&self, row: usize) -> PoseRow {
        self.quantiser().row(&self.target(row).pose)
    }

    /// Time that the target style takes for a row's input step of one frame, seconds: the mean time by which the row's
    /// counterparts advance or, if none is continuous, the quotient of their mean duration and the row's own.
    ///
    /// # Panics
    /// If the row does not exist.
    #[inline]
    pub fn step_secs(&self, row: usize) -> f32 {
        self.target(row).step_secs
    }

    /// Share of a row's counterparts with a planted left and right foot.
    ///
    /// # Panics
    /// If the row does not exist.
    pub fn contact(&self, row: usize) -> [f32; 2] {
        self.target(row).contact.map(|share| f32::from(share) / f32::from(u16::MAX))
    }

    /// Quantiser; a mean of rows is within the range of rows.
    #[inline]
    pub(super) fn quantiser(&self) -> &Quantiser {
        self.catalogue.rows().quantiser()
    }

    /// Target pose of a row as integers; the row must exist.
    #[inline]
    pub(super) fn steps(&self, row: usize) -> &Steps {
        &self.target(row).pose
    }

    #[inline(never)] // It is read once for all lanes, in many places.
    fn target(&self, row: usize) -> &Target {
        &self.parts[row / PART].get_or_init(|| self.compute_part(row / PART))[row % PART]
    }

    #[inline(never)]
    fn compute_part(&self, part: usize) -> Vec<Target> {
        let rows = part * PART..self.catalogue.frames().min((part + 1) * PART);
        rows.map(|row| self.compute(row)).collect()
    }

    fn compute(&self, row: usize) -> Target {
        let of = &*self.catalogue;
        let frame_secs = 1.0 / of.rate_hz;
        let mut mean = Mean::default();
        for at in of.counterparts(row, self.style) {
            mean.add(of, at);
        }
        if mean.count == 0.0 {
            return Target {
                pose: self.quantiser().quantised(&of.rows().get(row)),
                step_secs: frame_secs,
                contact: of.contact(row).map(|planted| u16::from(planted) * u16::MAX),
            };
        }
        let k = 1.0 / mean.count;
        let of_clip = of.clips[of.clip_of_row(row)].rows();
        let slots = |row: usize| of_clip.contains(&row).then(|| slots_of(of, row, self.style));
        let around = [row.checked_sub(1).and_then(slots), slots(row), slots(row + 1)];
        let quotient = || mean.time_step * k / of.time_step(row);
        Target {
            pose: self.quantiser().quantised(&mean.pose.map(|v| v * k)),
            step_secs: frame_secs * mean_advance(around).unwrap_or_else(quotient),
            contact: mean.contact.map(|v| (v * k * f32::from(u16::MAX) + 0.5) as u16),
        }
    }
}

/// Counterparts of a row in a style. In each slot they continue those of the previous row if they are continuous; NaN
/// in empty slots.
type Slots = [f32; MAX_COUNTERPARTS];

fn slots_of(of: &Catalogue, row: usize, style: u16) -> Slots {
    let mut slots = [f32::NAN; MAX_COUNTERPARTS];
    slots.iter_mut().zip(of.counterparts(row, style)).for_each(|(slot, at)| *slot = at);
    slots
}

/// Number of rows by which the counterparts of a row advance per frame, from the rows before, at and after it: the mean
/// of the slots that are continuous to either side. `None` if there are none.
fn mean_advance([before, now, after]: [Option<Slots>; 3]) -> Option<f32> {
    let now = now?;
    let advance = |from: Option<&Slots>, to: Option<&Slots>, slot: usize| {
        let rows = to?[slot] - from?[slot];
        (0.0..JUMP_ROWS).contains(&rows).then_some(rows)
    };
    let (mut sum, mut count) = (0.0, 0.0);
    for slot in 0..MAX_COUNTERPARTS {
        let sides = [advance(before.as_ref(), Some(&now), slot), advance(Some(&now), after.as_ref(), slot)];
        let known = sides.iter().flatten().count();
        if known > 0 {
            sum += sides.iter().flatten().sum::<f32>() / known as f32;
            count += 1.0;
        }
    }
    (count > 0.0).then(|| sum / count)
}

struct Mean {
    pose: PoseRow,
    time_step: f32,
    contact: [f32; 2],
    count: f32,
}

impl Default for Mean {
    fn default() -> Self {
        Self { pose: [0.0; ROW], time_step: 0.0, contact: [0.0; 2], count: 0.0 }
    }
}

impl Mean {
    /// Adds the values at a fractional row, interpolated between the rows around it.
    #[inline(never)] // In WebAssembly a function is optimised once it has been called often.
    fn add(&mut self, of: &Catalogue, at: f32) {
        let i = (at as usize).min(of.frames() - 1);
        let j = (i + 1).min(of.frames() - 1);
        let t = at - i as f32;
        for (sum, (a, b)) in self.pose.iter_mut().zip(of.rows().get(i).into_iter().zip(of.rows().get(j))) {
            *sum += a + (b - a) * t;
        }
        self.time_step += of.time_step(i) + (of.time_step(j) - of.time_step(i)) * t;
        for side in 0..2 {
            let (a, b) = (f32::from(of.contact(i)[side]), f32::from(of.contact(j)[side]));
            self.contact[side] += a + (b - a) * t;
        }
        self.count += 1.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::database;

    #[test]
    fn only_targets_beside_those_that_are_read_are_computed() {
        let table = TargetTable::new(Arc::new(Catalogue::new(database())), 1);
        let computed = || table.parts.iter().filter_map(OnceLock::get).map(Vec::len).sum::<usize>();
        assert_eq!(computed(), 0);
        let first = table.pose(PART);
        assert_eq!((table.pose(PART), computed()), (first, PART));
        let all: Vec<PoseRow> = (0..table.catalogue.frames()).map(|row| table.pose(row)).collect();
        assert_eq!((all[PART], computed()), (first, all.len()));
    }

    /// A row with two known counterparts.
    fn of(a: f32, b: f32) -> Slots {
        let mut slots = [f32::NAN; MAX_COUNTERPARTS];
        (slots[0], slots[1]) = (a, b);
        slots
    }

    #[test]
    fn counterparts_advance_by_half_the_way_between_the_rows_around() {
        let around = [of(10.0, 40.0), of(11.0, 42.0), of(13.0, 44.0)];
        assert_eq!(mean_advance(around.map(Some)), Some(1.75));
    }

    #[test]
    fn what_jumps_or_ends_counts_from_the_other_side() {
        let now = Some(of(11.0, 42.0));
        assert_eq!(mean_advance([Some(of(90.0, 40.0)), now, Some(of(13.0, 90.0))]), Some(2.0));
        assert_eq!(mean_advance([None, now, Some(of(12.0, 43.0))]), Some(1.0));
        assert_eq!(mean_advance([Some(of(10.0, f32::NAN)), now, None]), Some(1.0));
    }

    #[test]
    fn where_nothing_goes_on_nothing_is_said() {
        let now = Some(of(11.0, 42.0));
        assert_eq!(mean_advance([Some(of(90.0, 80.0)), now, Some(of(9.0, 46.0))]), None);
        assert_eq!(mean_advance([None, now, None]), None);
    }
}
