//! Neighbours that voted for a contact (`docs/methods/mar.md` §11).

use super::Lens;
use crate::transfer::contact_likelihood::contact_votes;

/// Vote of a frame; pairs are left and right.
#[derive(Clone, Debug, PartialEq)]
pub struct Contacts {
    /// P: share of the votes for a planted foot, of this frame alone.
    pub votes: [f32; 2],
    /// The same after smoothing over time.
    pub smoothed: [f32; 2],
    /// Mean with the contacts of the registered targets, after smoothing. It decides which feet are planted.
    pub output: [f32; 2],
    /// Whether the foot is held.
    pub planted: [bool; 2],
    /// Rows that vote.
    pub rows: Vec<usize>,
    /// g: weight of each vote.
    pub voices: Vec<[f32; 2]>,
    /// c: whether the foot is planted in each of the rows.
    pub contacts: Vec<[bool; 2]>,
}

impl Lens {
    /// Vote on the current frame.
    pub fn contacts(&self) -> Contacts {
        let inside = self.stylizer.inside();
        let catalogue = self.model().catalogue();
        let frame = self.stylizer.frame();
        let votes: Vec<_> = contact_votes(catalogue, inside.voters, inside.feet).collect();
        Contacts {
            votes: self.stylizer.contact_votes(),
            smoothed: frame.contact,
            output: frame.contact_out,
            planted: frame.planted,
            contacts: votes.iter().map(|v| catalogue.contact(v.row).map(|c| c != 0)).collect(),
            rows: votes.iter().map(|v| v.row).collect(),
            voices: votes.iter().map(|v| v.weights).collect(),
        }
    }
}
