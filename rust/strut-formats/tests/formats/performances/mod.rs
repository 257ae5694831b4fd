//! Distance between two readings of a performance.

use strut_core::humanoid::{HumanoidMotion, JOINTS};
use strut_core::kinematics::world_from_local;

/// Greatest distance between the same joint of two motions in the same frame, metres.
pub(crate) fn apart(a: &HumanoidMotion, b: &HumanoidMotion) -> f32 {
    assert_eq!(a.poses.len(), b.poses.len());
    let mut most = 0.0_f32;
    for (p, q) in a.poses.iter().zip(&b.poses) {
        let (p, q) = (world_from_local(&a.proportions, p), world_from_local(&b.proportions, q));
        most = (0..JOINTS).map(|j| (p.positions[j] - q.positions[j]).length()).fold(most, f32::max);
    }
    most
}
