//! Published kinematics of adult walking as knots over the gait cycle.
//!
//! Phase 0 is the heel strike of the limb (for pelvis and trunk: of the left limb), 1 the next one;
//! degrees. Values are means at natural cadence, rounded, at the events of the cycle, after
//! - P: Perry & Burnfield, *Gait Analysis: Normal and Pathological Function*, 2nd ed. 2010;
//! - W: Winter, *The Biomechanics and Motor Control of Human Gait*, 2nd ed. 1991;
//! - M: Murray, Drought & Kory, "Walking patterns of normal men", J. Bone Joint Surg. 46-A, 1964, and
//!   Murray, Sepic & Barnard, "Patterns of sagittal rotation of the upper limbs in walking", Phys. Ther. 47, 1967.
//!
//! Step length, foot roll and posture follow the style; these curves define the shapes.

/// A periodic list of (phase, degrees).
pub(crate) type Knots = &'static [(f32, f32)];

/// Share of the cycle in which a foot is on the ground at natural cadence (P: 62 %, W: 60–62 %).
pub(crate) const NATURAL_DUTY: f32 = 0.608;

/// Knee flexion of the supporting leg from which the height of the pelvis is computed. The resulting flexion is softer:
/// where legs cannot reach, the pelvis is lower, and its path is smoothed. The result is compared with
/// [`WALKING_BANDS`].
pub(crate) const STANCE_KNEE: Knots = &[
    (0.0, 3.6),
    (0.05, 21.2),
    (0.13, 20.5),
    (0.25, 10.0),
    (0.36, 8.4),
    (0.46, 5.2),
    (0.52, 11.6),
    (0.61, 33.9),
    (0.8, 30.6),
];

/// Knee flexion of the supporting leg in running at an easy speed: about 20 at the strike, 45 in mid stance, 20 at
/// toe-off (Novacheck 1998, "The biomechanics of running", Gait & Posture 7). Phases for a stance of 36 %.
pub(crate) const RUNNING_STANCE_KNEE: Knots = &[(0.0, 20.0), (0.16, 48.0), (0.36, 20.0), (0.8, 40.0)];

/// Rotation of the pelvis about the vertical as a share of its half range: the side of the leading leg is
/// forward at heel strike; positive turns to the left (P: ±5°, M: ±5°).
pub(crate) const PELVIS_YAW: Knots = &[(0.0, -1.0), (0.25, 0.0), (0.5, 1.0), (0.75, 0.0)];

/// Obliquity of the pelvis as a share of its half range: the swing side drops while the stance leg is loaded, and
/// returns by mid stance; positive lifts the left side (P: ±4°).
pub(crate) const PELVIS_ROLL: Knots =
    &[(0.0, 0.1), (0.16, 1.0), (0.32, 0.45), (0.5, -0.1), (0.66, -1.0), (0.82, -0.45)];

/// Flexion of the upper arm as a share of its half range: furthest back at the heel strike of its own side,
/// furthest forward at that of the other (M 1967; the return is slower than the forward swing).
pub(crate) const ARM_SWING: Knots = &[(0.02, -1.0), (0.28, 0.05), (0.52, 1.0), (0.76, 0.08)];

/// Flexion of the elbow as a share of its half range: greatest just after the arm is furthest forward (M 1967).
pub(crate) const ELBOW_SWING: Knots = &[(0.08, -1.0), (0.34, 0.1), (0.57, 1.0), (0.82, -0.15)];

/// A published mean with its standard deviation between people, over the cycle.
#[derive(Clone, Copy, Debug)]
pub struct Band {
    /// Name of the angle.
    pub name: &'static str,
    /// (phase, mean, standard deviation), phases ascending in [0, 1), degrees.
    knots: &'static [(f32, f32, f32)],
}

impl Band {
    /// Mean and standard deviation at a phase, linear between knots.
    pub fn at(&self, phase: f32) -> (f32, f32) {
        let phase = phase - phase.floor();
        let n = self.knots.len();
        let next = self.knots.iter().position(|k| k.0 > phase).unwrap_or(n);
        let (a, b) = (self.knots[(next + n - 1) % n], self.knots[next % n]);
        let span = if next == n { 1.0 + b.0 - a.0 } else { b.0 - a.0 };
        let t = (phase - a.0) / span;
        (a.1 + (b.1 - a.1) * t, a.2 + (b.2 - a.2) * t)
    }
}

/// Bands of natural walking against which the neutral style is tested: hip (thigh relative to the vertical), knee,
/// ankle. Means and standard deviations between 19 adults at natural cadence after W, rounded to whole degrees at the
/// events of the cycle; P and Kadaba, Ramakrishnan & Wootten 1990 ("Measurement of lower extremity kinematics during
/// level walking", J. Orthop. Res. 8) have the same shapes within these deviations. The books were not available: the
/// values were checked against second-hand tables of P and W, and the ankle's against the bands of Schwartz, Rozumalski
/// & Trost 2008.
pub const WALKING_BANDS: [Band; 3] = [
    Band {
        name: "hip",
        knots: &[
            (0.00, 20.0, 6.5),
            (0.10, 17.0, 6.5),
            (0.20, 9.0, 6.0),
            (0.30, 1.0, 6.0),
            (0.40, -6.0, 6.0),
            (0.52, -11.0, 6.5),
            (0.60, -6.0, 7.0),
            (0.70, 9.0, 7.0),
            (0.80, 19.0, 6.5),
            (0.86, 22.0, 6.5),
            (0.95, 20.0, 6.5),
        ],
    },
    Band {
        name: "knee",
        knots: &[
            (0.00, 4.0, 4.0),
            (0.06, 13.0, 5.0),
            (0.14, 19.0, 6.0),
            (0.20, 17.0, 6.0),
            (0.30, 11.0, 5.5),
            (0.41, 6.5, 5.0),
            (0.50, 12.0, 5.5),
            (0.55, 23.0, 7.0),
            (0.60, 38.0, 8.0),
            (0.66, 56.0, 7.0),
            (0.72, 64.0, 5.5),
            (0.80, 53.0, 7.0),
            (0.90, 20.0, 8.0),
            (0.96, 3.0, 4.5),
        ],
    },
    Band {
        name: "ankle",
        knots: &[
            (0.00, 0.0, 4.0),
            (0.06, -5.0, 4.0),
            (0.14, 1.0, 4.0),
            (0.20, 4.0, 3.5),
            (0.30, 6.5, 3.5),
            (0.44, 9.5, 4.0),
            (0.50, 7.0, 5.0),
            (0.54, 0.0, 6.0),
            (0.63, -20.0, 6.5),
            (0.70, -11.0, 5.5),
            (0.80, 0.0, 4.0),
            (0.86, 1.0, 4.0),
            (0.95, -1.0, 4.0),
        ],
    },
];
