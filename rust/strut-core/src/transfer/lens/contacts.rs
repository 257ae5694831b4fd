//! Who says that a foot stands (`docs/methods/mar.md` §11).

use super::Lens;
use crate::transfer::contact_likelihood::voices;

/// The vote of a frame; pairs are left and right.
#[derive(Clone, Debug, PartialEq)]
pub struct Contacts {
    /// P: share of the voices that say that the foot stands, of this frame alone.
    pub votes: [f32; 2],
    /// The same after smoothing over time.
    pub smoothed: [f32; 2],
    /// Mean with the contacts of the registered targets, after smoothing: what feet are planted by.
    pub output: [f32; 2],
    /// Whether the foot is held.
    pub planted: [bool; 2],
    /// The rows that vote.
    pub rows: Vec<usize>,
    /// g: how much each of them counts.
    pub voices: Vec<[f32; 2]>,
    /// c: whether the foot stands in each of them.
    pub contacts: Vec<[bool; 2]>,
}

impl Lens {
    /// The vote on the frame that is looked at.
    pub fn contacts(&self) -> Contacts {
        let inside = self.stylizer.inside();
        let catalogue = self.model().catalogue();
        let frame = self.stylizer.frame();
        let voices: Vec<_> = voices(catalogue, inside.voters, inside.feet).collect();
        Contacts {
            votes: self.stylizer.contact_votes(),
            smoothed: frame.contact,
            output: frame.contact_out,
            planted: frame.planted,
            contacts: voices.iter().map(|v| catalogue.contact(v.row).map(|c| c != 0)).collect(),
            rows: voices.iter().map(|v| v.row).collect(),
            voices: voices.iter().map(|v| v.weights).collect(),
        }
    }
}
