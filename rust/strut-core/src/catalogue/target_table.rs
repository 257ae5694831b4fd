//! The target of every row of a catalogue in one style.

use super::quantised::QuantisedRows;
use super::runtime::Catalogue;
use crate::pose_vector::{PoseRow, ROW};

/// The registered target of every row in one style: the mean of the poses, durations and contacts at
/// the row's counterparts (`docs/methods/mar.md` §4).
#[derive(Clone, Debug)]
pub struct TargetTable {
    /// Index of the style.
    pub style: u16,
    /// Target poses; the row itself where the style has no counterpart.
    pub pose: QuantisedRows,
    /// Seconds that the target style takes for the row's input step of one frame.
    pub step_secs: Vec<f32>,
    /// Share of the counterparts whose left and right foot is planted, in 65,535ths.
    contact: Vec<[u16; 2]>,
    /// For each class whether its rows have counterparts in this style.
    pub class_has_target: Vec<bool>,
}

impl TargetTable {
    /// The table of a style. Takes tens of milliseconds for 80,000 rows.
    ///
    /// # Panics
    /// If `style` is not one of the catalogue's.
    pub fn build(of: &Catalogue, style: u16) -> Self {
        assert!(usize::from(style) < of.styles.len(), "style {style} of {}", of.styles.len());
        let n = of.frames();
        let frame_secs = 1.0 / of.rate_hz;
        let mut table = Self {
            style,
            // A mean of rows is within their range.
            pose: QuantisedRows::with_range(of.observed_range(), n),
            step_secs: Vec::with_capacity(n),
            contact: Vec::with_capacity(n),
            class_has_target: vec![false; of.classes().len()],
        };
        for (class, has_target) in of.classes().iter().zip(&mut table.class_has_target) {
            for row in class.rows.clone() {
                let mut mean = Mean::default();
                for at in of.counterparts(row, style) {
                    mean.add(of, at);
                }
                if mean.count > 0.0 {
                    *has_target = true;
                    let k = 1.0 / mean.count;
                    table.pose.push(&mean.pose.map(|v| v * k));
                    table.step_secs.push(frame_secs * (mean.time_step * k) / of.time_step(row));
                    table.contact.push(mean.contact.map(|v| (v * k * f32::from(u16::MAX) + 0.5) as u16));
                } else {
                    table.pose.push(&of.rows().get(row));
                    table.step_secs.push(frame_secs);
                    table.contact.push(of.contact(row).map(|planted| u16::from(planted) * u16::MAX));
                }
            }
        }
        table
    }

    /// Share of a row's counterparts whose left and right foot is planted.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn contact(&self, row: usize) -> [f32; 2] {
        self.contact[row].map(|share| f32::from(share) / f32::from(u16::MAX))
    }
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
    #[inline(never)] // In WebAssembly a function becomes fast once it has been called often.
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
