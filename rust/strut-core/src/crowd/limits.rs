//! Limits of a crowd's parameters, and the errors when they are exceeded.

use thiserror::Error;

/// Largest number of walkers.
pub const MAX_COUNT: usize = 1000;
/// Largest number of points of a route.
pub const MAX_ROUTE_POINTS: usize = 64;
/// Largest number of vertices of a field.
pub const MAX_VERTICES: usize = 12;
/// Least and greatest reach of a vertex, metres.
pub const REACH: [f32; 2] = [0.5, 10.0];
/// Least and greatest intensity of a vertex: −1 is the opposite of the style.
pub const INTENSITY: [f32; 2] = [-1.0, 2.0];
/// Largest absolute coordinate of a vertex or of a point of a route, metres.
pub const FARTHEST: f32 = 100.0;
/// Largest offset of a bone along an axis, metres.
pub const LONGEST_BONE: f32 = 10.0;

/// Error of a crowd's parameters; the crowd is then unchanged.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CrowdError {
    /// Too few walkers, or too many.
    #[error("a crowd of {0} was requested; 1 to {MAX_COUNT} were expected")]
    Count(usize),
    /// Too many vertices.
    #[error("{0} vertices were given; at most {MAX_VERTICES} were expected")]
    Vertices(usize),
    /// A vertex's style is not in the model.
    #[error("a vertex has style {style}; the model has {styles} styles")]
    Style {
        /// Its number.
        style: usize,
        /// Number of styles of the model.
        styles: usize,
    },
    /// A coordinate is NaN or out of range.
    #[error("a coordinate is {0} m; a number from -{FARTHEST} to {FARTHEST} was expected")]
    Place(f32),
    /// A reach is out of range; see [`REACH`].
    #[error("a vertex has a radius of {0} m; {least} to {greatest} were expected", least = REACH[0], greatest = REACH[1])]
    Reach(f32),
    /// An intensity is out of range; see [`INTENSITY`].
    #[error(
        "a vertex has intensity {0}; {least} to {greatest} were expected", least = INTENSITY[0], greatest = INTENSITY[1]
    )]
    Intensity(f32),
    /// A route has too few points, or too many.
    #[error("the route has {0} points; none, or 2 to {MAX_ROUTE_POINTS}, were expected")]
    Route(usize),
    /// A bone offset is NaN or larger than [`LONGEST_BONE`].
    #[error("a bone offset is {0} m; a number from -{LONGEST_BONE} to {LONGEST_BONE} was expected")]
    Bone(f32),
}

/// Checks that a place [x, z] is within range.
pub(super) fn check_place(place: [f32; 2]) -> Result<(), CrowdError> {
    let bad = place.into_iter().find(|v| !(-FARTHEST..=FARTHEST).contains(v));
    bad.map_or(Ok(()), |v| Err(CrowdError::Place(v)))
}
