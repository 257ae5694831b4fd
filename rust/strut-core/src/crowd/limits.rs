//! What a crowd can be, and why it cannot be otherwise.

use thiserror::Error;

/// Most walkers of a crowd.
pub const MAX_COUNT: usize = 1000;
/// Most points of a route.
pub const MAX_ROUTE_POINTS: usize = 64;
/// Most vertices of a field.
pub const MAX_VERTICES: usize = 12;
/// Least and greatest reach of a vertex, metres.
pub const REACH: [f32; 2] = [0.5, 10.0];
/// Least and greatest intensity of a vertex: −1 is the opposite of the style.
pub const INTENSITY: [f32; 2] = [-1.0, 2.0];
/// Farthest place along x or z that a vertex, or a point of a route, can have, metres.
pub const FARTHEST: f32 = 100.0;
/// Longest offset of a bone along an axis, metres.
pub const LONGEST_BONE: f32 = 10.0;

/// Why a crowd is not as asked for; then nothing changes.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CrowdError {
    /// Too few walkers, or too many.
    #[error("a crowd of {0} was asked for; 1 to {MAX_COUNT} were expected")]
    Count(usize),
    /// Too many vertices.
    #[error("{0} vertices were given; at most {MAX_VERTICES} were expected")]
    Vertices(usize),
    /// The model lacks a vertex's style.
    #[error("a vertex has style {style} of a model of {styles}")]
    Style {
        /// Its number.
        style: usize,
        /// Styles of the model.
        styles: usize,
    },
    /// A place is none, or too far away.
    #[error("a place is at {0} m; a number from -{FARTHEST} to {FARTHEST} was expected")]
    Place(f32),
    /// See [`REACH`].
    #[error("a vertex reaches {0} m; {least} to {greatest} were expected", least = REACH[0], greatest = REACH[1])]
    Reach(f32),
    /// See [`INTENSITY`].
    #[error(
        "a vertex has intensity {0}; {least} to {greatest} were expected", least = INTENSITY[0], greatest = INTENSITY[1]
    )]
    Intensity(f32),
    /// Too few points of a route, or too many.
    #[error("a route of {0} points was given; none, or 2 to {MAX_ROUTE_POINTS}, were expected")]
    Route(usize),
    /// A bone is none.
    #[error("a bone is offset by {0} m; a number from -{LONGEST_BONE} to {LONGEST_BONE} was expected")]
    Bone(f32),
}

/// Whether somebody can be sent to a place [x, z].
pub(super) fn check_place(place: [f32; 2]) -> Result<(), CrowdError> {
    let bad = place.into_iter().find(|v| !(-FARTHEST..=FARTHEST).contains(v));
    bad.map_or(Ok(()), |v| Err(CrowdError::Place(v)))
}
