//! A field of styles over the ground: an agent near a vertex walks in the vertex's style.

use super::limits::{CrowdError, INTENSITY, MAX_VERTICES, REACH, check_place};
use crate::math::Vec2;

/// Square of the distance below which a vertex's weight hardly increases, m².
const CORE: f32 = 0.25;

/// A style at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vertex {
    /// Index of the style in the model.
    pub style: usize,
    /// Place on the ground, metres: at most [`FARTHEST`](super::FARTHEST) from the origin along either axis.
    pub x: f32,
    /// See `x`.
    pub z: f32,
    /// Distance at which a single vertex has half its weight, metres: see [`REACH`].
    pub reach: f32,
    /// Weight of the style at its centre: see [`INTENSITY`].
    pub intensity: f32,
}

/// The styles of all places. With φ = (reach² / (d² + 0.25 m²))² of a vertex at a distance d, the weight of a style is the
/// sum of intensity · φ / (1 + Σφ) over its vertices; the remainder to 1 is the average walk.
#[derive(Clone, Debug, Default)]
pub(super) struct Field {
    vertices: Vec<Vertex>,
}

impl Field {
    /// Creates a field of vertices for a model with `styles` styles.
    pub(super) fn new(vertices: &[Vertex], styles: usize) -> Result<Self, CrowdError> {
        if vertices.len() > MAX_VERTICES {
            return Err(CrowdError::Vertices(vertices.len()));
        }
        for vertex in vertices {
            if vertex.style >= styles {
                return Err(CrowdError::Style { style: vertex.style, styles });
            }
            check_place([vertex.x, vertex.z])?;
            if !(REACH[0]..=REACH[1]).contains(&vertex.reach) {
                return Err(CrowdError::Reach(vertex.reach));
            }
            if !(INTENSITY[0]..=INTENSITY[1]).contains(&vertex.intensity) {
                return Err(CrowdError::Intensity(vertex.intensity));
            }
        }
        Ok(Self { vertices: vertices.to_vec() })
    }

    /// Writes the weights at a place, one per style, and returns whether any has changed.
    pub(super) fn write_weights(&self, at: Vec2, weights: &mut [f32]) -> bool {
        let nearness = |vertex: &Vertex| {
            let square = vertex.reach * vertex.reach / (at.distance_squared(Vec2::new(vertex.x, vertex.z)) + CORE);
            square * square
        };
        let all = 1.0 + self.vertices.iter().map(nearness).sum::<f32>();
        let mut is_other = false;
        for (style, weight) in weights.iter_mut().enumerate() {
            let own = self.vertices.iter().filter(|vertex| vertex.style == style);
            let new = own.map(|vertex| vertex.intensity * nearness(vertex)).sum::<f32>() / all;
            is_other |= new != *weight;
            *weight = new;
        }
        is_other
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vertex() -> impl Strategy<Value = Vertex> {
        (0usize..3, -8.0f32..8.0, -8.0f32..8.0, 0.5f32..10.0, -1.0f32..2.0)
            .prop_map(|(style, x, z, reach, intensity)| Vertex { style, x, z, reach, intensity })
    }

    proptest! {
        #[test]
        fn weights_are_within_the_intensities(
            vertices in prop::collection::vec(vertex(), 0..=MAX_VERTICES), x in -9.0f32..9.0, z in -9.0f32..9.0,
        ) {
            let field = Field::new(&vertices, 3).unwrap();
            let mut weights = [0.0; 3];
            field.write_weights(Vec2::new(x, z), &mut weights);
            let bounds = |by: fn(f32, f32) -> f32| vertices.iter().map(|v| v.intensity).fold(0.0, by);
            let sum = weights.iter().sum::<f32>();
            prop_assert!(sum <= bounds(f32::max) + 1e-5 && sum >= bounds(f32::min) - 1e-5, "{:?}", weights);
            prop_assert!(!field.write_weights(Vec2::new(x, z), &mut weights), "the same place has the same weights");
        }
    }

    #[test]
    fn a_vertex_counts_half_at_its_reach_and_whole_in_its_middle() {
        let field = Field::new(&[Vertex { style: 1, x: 2.0, z: 0.0, reach: 3.0, intensity: 1.0 }], 2).unwrap();
        let at = |x: f32| {
            let mut weights = [0.0; 2];
            field.write_weights(Vec2::new(x, 0.0), &mut weights);
            assert_eq!(weights[0], 0.0);
            weights[1]
        };
        assert!(at(2.0) > 0.999 && (at(5.0) - 0.5).abs() < 0.03 && at(14.0) < 0.01);
    }

    #[test]
    fn what_is_no_vertex_is_refused() {
        let good = Vertex { style: 0, x: 0.0, z: 0.0, reach: 1.0, intensity: 1.0 };
        let refused = |vertex: Vertex| Field::new(&[good, vertex], 1).unwrap_err();
        assert_eq!(refused(Vertex { style: 1, ..good }), CrowdError::Style { style: 1, styles: 1 });
        assert!(matches!(refused(Vertex { x: f32::NAN, ..good }), CrowdError::Place(_)));
        assert_eq!(refused(Vertex { z: -100.5, ..good }), CrowdError::Place(-100.5));
        for reach in [0.4, 10.1, f32::NAN, f32::INFINITY] {
            assert!(matches!(refused(Vertex { reach, ..good }), CrowdError::Reach(_)));
        }
        for intensity in [-1.1, 2.1, f32::NAN] {
            assert!(matches!(refused(Vertex { intensity, ..good }), CrowdError::Intensity(_)));
        }
        assert_eq!(Field::new(&[good; MAX_VERTICES + 1], 1).unwrap_err(), CrowdError::Vertices(13));
        assert!(Field::new(&[good; MAX_VERTICES], 1).is_ok() && Field::new(&[], 1).is_ok());
    }
}
