//! Published kinematics of adult walking as knots over the gait cycle.
//!
//! Phase 0 is the heel strike of the limb (for pelvis and trunk: of the left limb), 1 the next one;
//! degrees. Values are means at natural cadence, rounded, at the events of the cycle, after
//! - P: Perry & Burnfield, *Gait Analysis: Normal and Pathological Function*, 2nd ed. 2010;
//! - W: Winter, *The Biomechanics and Motor Control of Human Gait*, 2nd ed. 1991;
//! - M: Murray, Drought & Kory, "Walking patterns of normal men", J. Bone Joint Surg. 46-A, 1964, and
//!   Murray, Sepic & Barnard, "Patterns of sagittal rotation of the upper limbs in walking", Phys. Ther. 47, 1967.
//!
//! Step length, foot roll and posture follow the style; these curves give the shapes.

/// A periodic list of (phase, degrees).
pub(crate) type Knots = &'static [(f32, f32)];

/// Share of the cycle that a foot is on the ground at natural cadence (P: 62 %, W: 60–62 %).
pub(crate) const NATURAL_DUTY: f32 = 0.61;

/// Knee flexion of the supporting leg: loading wave of 18 at 13 %, least at 40 %, and yielding into pre-swing (P,
/// W). Kept 2 to 3 above the published least of 5, where a small change of height swings the knee
/// through many degrees. Swing is left out: there the foot's path decides.
pub(crate) const STANCE_KNEE: Knots = &[
    (0.0, 7.0),
    (0.05, 13.0),
    (0.13, 18.0),
    (0.25, 12.0),
    (0.36, 7.5),
    (0.46, 10.0),
    (0.52, 16.0),
    (0.61, 40.0),
    (0.8, 40.0),
];

/// Knee flexion of the supporting leg in running at an easy speed: some 20 at the strike, 45 in mid stance, 20 when
/// the toes leave (Novacheck 1998, "The biomechanics of running", Gait & Posture 7). Phases for a stance of 36 %.
pub(crate) const RUNNING_STANCE_KNEE: Knots = &[(0.0, 20.0), (0.16, 48.0), (0.36, 20.0), (0.8, 40.0)];

/// Rotation of the pelvis about the vertical as a share of its half range: the side of the leading leg is
/// forward at heel strike; positive turns to the left (P: ±5°, M: ±5°).
pub(crate) const PELVIS_YAW: Knots = &[(0.0, -1.0), (0.25, 0.0), (0.5, 1.0), (0.75, 0.0)];

/// Obliquity of the pelvis as a share of its half range: the swing side drops while the stance leg is loaded,
/// and comes back by mid stance; positive lifts the left side (P: ±4°).
pub(crate) const PELVIS_ROLL: Knots =
    &[(0.0, 0.1), (0.16, 1.0), (0.32, 0.45), (0.5, -0.1), (0.66, -1.0), (0.82, -0.45)];

/// Flexion of the upper arm as a share of its half range: furthest back at the heel strike of its own side,
/// furthest forward at that of the other (M 1967; the return is slower than the forward swing).
pub(crate) const ARM_SWING: Knots = &[(0.02, -1.0), (0.28, 0.05), (0.52, 1.0), (0.76, 0.08)];

/// Flexion of the elbow as a share of its half range: most just after the arm is furthest forward (M 1967).
pub(crate) const ELBOW_SWING: Knots = &[(0.08, -1.0), (0.34, 0.1), (0.57, 1.0), (0.82, -0.15)];
