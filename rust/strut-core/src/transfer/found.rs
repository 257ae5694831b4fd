//! Search results of a clip's frames, used when the clip is styled.

use crate::search::Neighbour;
use std::ops::Range;

/// Search results of successive frames.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Found {
    /// All lists, one after the other.
    neighbours: Vec<Neighbour>,
    /// Index of a component of the mixture, and the range of its list.
    components: Vec<(usize, Range<usize>)>,
    /// For each frame its components, and the list of the neighbours that vote for its contacts.
    frames: Vec<(Range<usize>, Range<usize>)>,
}

impl Found {
    /// Frames in order.
    pub fn frames(&self) -> impl Iterator<Item = FoundFrame<'_>> {
        self.frames.iter().map(|(components, voters)| FoundFrame {
            neighbours: &self.neighbours,
            components: &self.components[components.clone()],
            voters: voters.clone(),
        })
    }

    pub(super) fn add<'a>(&mut self, components: impl Iterator<Item = (usize, &'a [Neighbour])>, voters: &[Neighbour]) {
        let first = self.components.len();
        for (component, neighbours) in components {
            let list = self.keep(neighbours);
            self.components.push((component, list));
        }
        let voters = self.keep(voters);
        self.frames.push((first..self.components.len(), voters));
    }

    fn keep(&mut self, list: &[Neighbour]) -> Range<usize> {
        let first = self.neighbours.len();
        self.neighbours.extend_from_slice(list);
        first..self.neighbours.len()
    }
}

/// Search results of a frame: the neighbours in all components of the mixture that have a weight, and those that vote
/// for its contacts.
#[derive(Clone, Debug)]
pub struct FoundFrame<'a> {
    neighbours: &'a [Neighbour],
    components: &'a [(usize, Range<usize>)],
    voters: Range<usize>,
}

impl<'a> FoundFrame<'a> {
    /// Index of each component that has a weight, and its neighbours, nearest first.
    pub(super) fn components(&self) -> impl Iterator<Item = (usize, &'a [Neighbour])> {
        self.components.iter().map(|(component, list)| (*component, &self.neighbours[list.clone()]))
    }

    /// Nearest windows by the lower-body metric in the classes that have a weight.
    pub(super) fn voters(&self) -> &'a [Neighbour] {
        &self.neighbours[self.voters.clone()]
    }
}
