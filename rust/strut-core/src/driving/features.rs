//! Features by which rows are compared: the present pose of the body, and the future trajectory of its root.

use super::clips::DrivingClips;
use crate::humanoid::Role;
use crate::kinematics::world_from_local;
use crate::math::float_funcs::{atan2, sin_cos};
use crate::math::{Quat, Vec2, Vec3};

/// Features per row: 27 and a zero, so that they fill whole SIMD lanes.
pub(super) const FEATURES: usize = 28;

/// The times at which the root's place and heading are compared, seconds from now: 20, 40 and 60 frames at 60 Hz.
pub(super) const HORIZONS_SECS: [f32; 3] = [1.0 / 3.0, 2.0 / 3.0, 1.0];

/// Trajectory of a root: at every horizon a place (x, z) in metres and a heading in radians.
pub type Trajectory = [(Vec2, f32); HORIZONS_SECS.len()];

/// Layout of a row: places of the left and the right toes in the root's frame, (x, y, z) each; their velocities; the
/// hips' velocity; for every horizon the root's place (x, z) and heading (sine, cosine) in the present root's frame.
const TOES_AT: usize = 0;
const TOES_VELOCITY_AT: usize = 6;
const HIPS_VELOCITY_AT: usize = 12;
pub(super) const TRAJECTORY_AT: usize = 15;

/// Index of a horizon's place; its heading follows two numbers later.
const fn place_at(horizon: usize) -> usize {
    TRAJECTORY_AT + 4 * horizon
}

/// Units of the differences: metres for the toes, m/s for the toes and for the hips, metres for the root, and sine and
/// cosine of its heading.
const TOES: f32 = 0.16;
const TOES_VELOCITY: f32 = 0.9;
const HIPS_VELOCITY: f32 = 0.8;
const PLACE: f32 = 0.30;
const HEADING: f32 = 0.10;

/// Beyond the end of a clip its motion is extrapolated by the mean of this time before the end, seconds: 20 frames at
/// 60 Hz.
const TAIL_SECS: f32 = 1.0 / 3.0;

/// The features of a row, scaled by their units.
pub(super) type Features = [f32; FEATURES];

/// The features of every row of some clips.
pub(super) fn features_of(clips: &DrivingClips) -> Vec<Features> {
    let mut rows = Vec::with_capacity(clips.rows());
    for clip in clips.clips() {
        let bodies: Vec<Body> = clip.rows.clone().map(|row| Body::of(clips, row)).collect();
        for row in clip.rows.clone() {
            let mut features = [0.0; FEATURES];
            write_pose(&mut features, clips, &bodies, row - clip.rows.start, row);
            for (horizon, &secs) in HORIZONS_SECS.iter().enumerate() {
                let frames = (secs * clips.rate_hz).round() as usize;
                let (place, heading) = ahead(clips, row, clip.rows.end, frames);
                write_trajectory(&mut features, horizon, place, heading);
            }
            rows.push(features);
        }
    }
    rows
}

/// A query: the body of a row, and the target trajectory in the present root's frame.
pub(super) fn query_of(row: &Features, asked: &Trajectory) -> Features {
    let mut query = *row;
    for (horizon, &(place, heading)) in asked.iter().enumerate() {
        write_trajectory(&mut query, horizon, place, heading);
    }
    query
}

/// The displacement of the root in a row's clip up to a horizon, in the present root's frame: place in metres, heading
/// in radians.
pub(super) fn ahead_of(row: &Features, horizon: usize) -> (Vec2, f32) {
    let (at, facing) = (place_at(horizon), place_at(horizon) + 2);
    (Vec2::new(row[at], row[at + 1]) * PLACE, atan2(row[facing], row[facing + 1]))
}

/// Positions of the toes and the hips in the frame of the root.
struct Body {
    points: [Vec3; 3],
}

impl Body {
    fn of(clips: &DrivingClips, row: usize) -> Self {
        let world = world_from_local(&clips.proportions, clips.pose(row));
        Self { points: [Role::LeftToes, Role::RightToes, Role::Hips].map(|role| world.positions[role.index()]) }
    }
}

/// Writes the places and velocities of a row's body. Velocities are relative to the ground, in the root's frame.
fn write_pose(features: &mut Features, clips: &DrivingClips, bodies: &[Body], i: usize, row: usize) {
    let (a, b) = (i.saturating_sub(1), (i + 1).min(bodies.len() - 1));
    let per_sec = clips.rate_hz / (b - a).max(1) as f32;
    let motion = clips.motion(row);
    for point in 0..3 {
        let place = bodies[i].points[point];
        let within = (bodies[b].points[point] - bodies[a].points[point]) * per_sec;
        // Velocity from the motion of the root's frame.
        let carried = Vec3::new(motion.velocity.x, 0.0, motion.velocity.y) + Vec3::Y.cross(place) * motion.turn_rate;
        let velocity = within + carried;
        if point < 2 {
            write(features, TOES_AT + 3 * point, place / TOES);
            write(features, TOES_VELOCITY_AT + 3 * point, velocity / TOES_VELOCITY);
        } else {
            write(features, HIPS_VELOCITY_AT, velocity / HIPS_VELOCITY);
        }
    }
}

fn write(features: &mut Features, at: usize, v: Vec3) {
    features[at..at + 3].copy_from_slice(&v.to_array());
}

fn write_trajectory(features: &mut Features, horizon: usize, place: Vec2, heading: f32) {
    let (sine, cosine) = sin_cos(heading);
    let (at, facing) = (place_at(horizon), place_at(horizon) + 2);
    features[at..at + 2].copy_from_slice(&(place / PLACE).to_array());
    features[facing..facing + 2].copy_from_slice(&[sine / HEADING, cosine / HEADING]);
}

/// Place and heading of the root `frames` after a row, in the frame of that row's root. Beyond `end` the mean motion
/// before the end is extrapolated.
fn ahead(clips: &DrivingClips, row: usize, end: usize, frames: usize) -> (Vec2, f32) {
    let dt = 1.0 / clips.rate_hz;
    let tail = ((TAIL_SECS * clips.rate_hz).round() as usize).max(1);
    let (mut place, mut heading) = (Vec3::ZERO, 0.0);
    for step in row..row + frames {
        let (velocity, turn_rate) = if step < end {
            moved(clips, step..step + 1)
        } else {
            moved(clips, end.saturating_sub(tail).max(row)..end)
        };
        place += Quat::from_rotation_y(heading) * Vec3::new(velocity.x, 0.0, velocity.y) * dt;
        heading += turn_rate * dt;
    }
    (Vec2::new(place.x, place.z), heading)
}

/// Mean velocity and turn rate of rows.
fn moved(clips: &DrivingClips, rows: std::ops::Range<usize>) -> (Vec2, f32) {
    let n = rows.len() as f32;
    let (velocity, turn_rate) = rows
        .map(|row| clips.motion(row))
        .fold((Vec2::ZERO, 0.0), |(v, w), motion| (v + motion.velocity, w + motion.turn_rate));
    (velocity / n, turn_rate / n)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::driving::tests::circle;
    use crate::humanoid::Proportions;

    fn of_circle(speed: f32, turn_rate: f32) -> (DrivingClips, Vec<Features>) {
        let clips =
            DrivingClips::new(Proportions::default(), 60.0, &[circle(600, speed, turn_rate)], &[], &[]).unwrap();
        let features = features_of(&clips);
        (clips, features)
    }

    #[test]
    fn say_where_the_root_will_be() {
        let (speed, turn) = (1.2, 0.5);
        let (_, features) = of_circle(speed, turn);
        for row in [100, 300, 590] {
            for (horizon, secs) in HORIZONS_SECS.into_iter().enumerate() {
                // On a circle of radius speed / turn, walked towards +Z.
                let (sine, cosine) = sin_cos(turn * secs);
                let asked = Vec2::new(1.0 - cosine, sine) * (speed / turn);
                let (place, heading) = ahead_of(&features[row], horizon);
                assert!(place.distance(asked) < 0.03, "{place:?} {asked:?}");
                assert!((heading - turn * secs).abs() < 0.02, "{heading}");
            }
        }
    }

    #[test]
    fn of_a_mirror_image_are_mirrored() {
        let (_, features) = of_circle(1.2, 0.5);
        for row in 0..600 {
            let (one, other) = (features[row], features[row + 600]);
            let place = place_at(1);
            assert!((one[place] + other[place]).abs() < 1e-5 && (one[place + 1] - other[place + 1]).abs() < 1e-5);
            assert!((one[TOES_AT] + other[TOES_AT + 3]).abs() < 1e-5);
        }
    }

    #[test]
    fn of_a_query_are_the_row_s_own_where_it_asks_for_what_comes() {
        let (clips, features) = of_circle(1.0, 0.3);
        let end = clips.clips()[0].rows.end;
        let asked = HORIZONS_SECS.map(|secs| ahead(&clips, 200, end, (60.0 * secs).round() as usize));
        assert_eq!(query_of(&features[200], &asked), features[200]);
    }
}
