//! Where to turn, and when to give way.
//!
//! A step is chosen when it begins, as the feet pivot on the ground then: among a few turns and paces the one that is near a wish,
//! keeps away from where others will be if they go straight on (after van den Berg, Lin, Manocha, "Reciprocal Velocity Obstacles",
//! 2008), and after which a full circle still fits onto the ground.

use crate::hsmm::MAX_TURN;
use crate::math::Vec2;
use crate::math::float_funcs::{atan2, sin_cos};

/// Share of the ground's radius from which one wishes to go back, and that within which full turns are to lead.
const INWARD: f32 = 0.8;
const EDGE: f32 = 1.1;
/// How much wandering counts beside the target.
const WANDERING: f32 = 0.3;
/// Turns that are looked at, either way, beside the wish.
const TURNS: i16 = 3;
/// Steps that are looked ahead, and of which so many turn alike.
const FORESIGHT: usize = 5;
const TURNING: usize = 2;
/// Range of avoidance, metres: walkers farther away are ignored. Two who approach each other at 1.2 m/s each cannot meet within the
/// predicted steps from farther away.
pub(super) const FORESEEN: f32 = 8.0;
/// Nobody wants others nearer than this, metres. It is found by trial, as the costs are: people walk at 0.86 of the speed they
/// have alone where everybody has four square metres.
const COMFORTABLE: f32 = 0.8;
/// What counts as much as a full turn aside from the wish: another who is met at once, over this; short steps; standing, which
/// grows with the square of the steps that are stood; a metre beyond the edge; a full turn to the left: people keep right.
const NEARNESS_COST: f32 = 40.0;
const SHORT_COST: f32 = 1.0;
const STANDING_COST: f32 = 12.0;
const EDGE_COST: f32 = 1000.0;
const LEFT_COST: f32 = 0.02;
/// Speed with short steps, as a share.
const SHORT_SPEED: f32 = 0.7;
/// Of two who are nearer than this, metres, one goes on.
const TOUCHING: f32 = 0.5;
/// Whoever is nearer than this to others, metres, moves aside: by so many metres a frame from where the other is, and less by
/// distance. Feet slide by it; it is the last resort.
pub(super) const OVERLAPPING: f32 = 0.4;
const ASIDE: f32 = 0.025;
/// Room for rounding where somebody is left out whose distance cannot count.
const ROUNDING: f32 = 1.001;

/// Somebody on the ground as others see them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Figure {
    /// Place, [x, z] in metres.
    pub(super) at: Vec2,
    /// A unit vector.
    pub(super) facing: Vec2,
    /// Along it, m/s.
    pub(super) speed: f32,
}

/// The unit vector of a heading.
pub(super) fn facing(heading: f32) -> Vec2 {
    let (sin, cos) = sin_cos(heading);
    Vec2::new(sin, cos)
}

/// What somebody wants who begins a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Intention {
    /// Turn by which they would wander, radians.
    pub(super) wander: f32,
    /// Where they should go.
    pub(super) target: Vec2,
    /// Length of a step, metres.
    pub(super) length: f32,
    /// Steps that they have stood.
    pub(super) stood: f32,
    /// Radius of the ground, metres.
    pub(super) radius: f32,
}

/// How a step is walked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pace {
    Walks,
    /// With short steps.
    Short,
    Stands,
}

/// The step that begins of somebody who walks with a speed that is not 0: its turn, radians to the left, at most [`MAX_TURN`]
/// either way, and its pace. The others are those within [`FORESEEN`].
pub(super) fn step(me: &Figure, intention: &Intention, others: &[Figure]) -> (f32, Pace) {
    let choice = Choice::new(me, intention, others);
    let walking = [(Pace::Walks, 1.0, 0.0), (Pace::Short, SHORT_SPEED, SHORT_COST)].into_iter();
    let steps = walking.flat_map(|(pace, share, cost)| choice.turns().map(move |turn| (turn, pace, share, cost)));
    let costs = steps.map(|(turn, pace, share, cost)| (choice.cost(turn, share, cost), turn, pace));
    let standing = if goes_on(me, others) {
        f32::INFINITY
    } else {
        STANDING_COST + intention.stood * intention.stood + choice.risks(0.0, 0.0)
    };
    let best = costs.chain([(standing, 0.0, Pace::Stands)]).min_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or((0.0, Pace::Stands), |(_, turn, pace)| (turn, pace))
}

/// The turn of the step that begins of somebody who cannot but go on, as they perform what others have chosen: radians to the
/// left, at most [`MAX_TURN`] either way. Their speed is not 0, and the others are those within [`FORESEEN`].
pub(super) fn turn(me: &Figure, intention: &Intention, others: &[Figure]) -> f32 {
    let choice = Choice::new(me, intention, others);
    let costs = choice.turns().map(|turn| (choice.cost(turn, 1.0, 0.0), turn));
    costs.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, turn)| turn)
}

/// Among what a step is chosen, and what each of it costs.
struct Choice<'a> {
    me: &'a Figure,
    intention: &'a Intention,
    others: &'a [Figure],
    /// The turn to where one would go alone, radians.
    wish: f32,
    /// Time that a step takes.
    secs: f32,
}

impl<'a> Choice<'a> {
    fn new(me: &'a Figure, intention: &'a Intention, others: &'a [Figure]) -> Self {
        let wish = wished(me, intention).clamp(-MAX_TURN, MAX_TURN);
        Self { me, intention, others, wish, secs: intention.length / me.speed }
    }

    fn turns(&self) -> impl Iterator<Item = f32> + Clone + use<> {
        (-TURNS..=TURNS).map(|i| f32::from(i) / f32::from(TURNS) * MAX_TURN).chain([self.wish])
    }

    /// What a step with a turn costs whose length is a share of the whole, and a cost of its own besides.
    fn cost(&self, turn: f32, share: f32, cost: f32) -> f32 {
        let (off, length) = ((turn - self.wish) / MAX_TURN, share * self.intention.length);
        let beyond = beyond_edge(self.me, turn, length, self.intention.radius);
        cost + off * off + EDGE_COST * beyond + LEFT_COST * turn / MAX_TURN + self.risks(turn, length)
    }

    fn risks(&self, turn: f32, length: f32) -> f32 {
        let path = path(self.me, turn, length);
        let meets = |other: &&Figure| can_meet(self.me, length, other, self.secs);
        NEARNESS_COST * self.others.iter().filter(meets).map(|other| risk(&path, other, self.secs)).sum::<f32>()
    }
}

/// Whether somebody touches another and is more in front of that other than the other of them: who both stood would stay there.
fn goes_on(me: &Figure, others: &[Figure]) -> bool {
    others.iter().any(|other| {
        let apart = other.at - me.at;
        apart.length_squared().sqrt() < TOUCHING && me.facing.dot(apart) < -other.facing.dot(apart)
    })
}

/// Where somebody is now and after each of the next steps.
fn path(me: &Figure, turn: f32, length: f32) -> [Vec2; FORESIGHT + 1] {
    let mut walking = *me;
    std::array::from_fn(|step| {
        if (1..=TURNING).contains(&step) {
            walking = turned(&walking, turn);
        }
        if step > 0 {
            walking.at += length * walking.facing;
        }
        walking.at
    })
}

/// Whether another could come near within the steps that are looked ahead; where not, there is no risk.
fn can_meet(me: &Figure, length: f32, other: &Figure, secs: f32) -> bool {
    let reach = ROUNDING * (COMFORTABLE + FORESIGHT as f32 * (length + other.speed * secs));
    (other.at - me.at).length_squared() < reach * reach
}

/// How near somebody comes who goes straight on, and how soon: 0 to 3.
fn risk(path: &[Vec2; FORESIGHT + 1], other: &Figure, secs: f32) -> f32 {
    let way = other.speed * secs * other.facing;
    let apart = |step: usize| other.at + step as f32 * way - path[step];
    let near = (0..FORESIGHT).map(|step| {
        let near = nearness(least_length_squared(apart(step), apart(step + 1)), COMFORTABLE);
        near * near * (FORESIGHT - step) as f32
    });
    near.sum::<f32>() / FORESIGHT as f32
}

/// How near somebody is at a distance, whose square is given: from 1 to 0, at a limit and beyond.
fn nearness(distance_squared: f32, limit: f32) -> f32 {
    // Most are far away: roots are for the others.
    if distance_squared > ROUNDING * limit * limit {
        return 0.0;
    }
    let near = 1.0 - distance_squared.sqrt() / limit;
    // `f32::max` would be a function call in WebAssembly.
    if near > 0.0 { near } else { 0.0 }
}

/// Squared length of the shortest vector on the way from one to another.
fn least_length_squared(from: Vec2, to: Vec2) -> f32 {
    let way = to - from;
    let squared = way.length_squared();
    let share =
        (-from.dot(way) / if squared > f32::MIN_POSITIVE { squared } else { f32::MIN_POSITIVE }).clamp(0.0, 1.0);
    (from + share * way).length_squared()
}

/// The angle to where somebody would go alone, radians to the left.
fn wished(me: &Figure, intention: &Intention) -> f32 {
    let (sin, cos) = sin_cos(intention.wander);
    let wandering = cos * me.facing + sin * left_of(me.facing);
    let distance = me.at.length();
    let inward = (distance / intention.radius - INWARD).max(0.0) / (1.0 - INWARD);
    let wish = wandering - me.at * (inward / distance.max(1.0));
    let wish = WANDERING * wish + (intention.target - me.at).normalize_or_zero();
    atan2(left_of(me.facing).dot(wish), me.facing.dot(wish))
}

fn left_of(facing: Vec2) -> Vec2 {
    Vec2::new(facing.y, -facing.x)
}

fn turned(me: &Figure, turn: f32) -> Figure {
    let (sin, cos) = sin_cos(turn);
    Figure { facing: cos * me.facing + sin * left_of(me.facing), ..*me }
}

/// How far somebody must go beyond the edge after a step with a turn even if they turn as much as they can from then on, metres.
fn beyond_edge(me: &Figure, turn: f32, length: f32, ground: f32) -> f32 {
    let half = turned(me, 0.5 * turn);
    let (at, facing) = (me.at + length * half.facing, turned(me, turn).facing);
    // The circle of full turns.
    let radius = length / MAX_TURN;
    let [left, right] = [1.0, -1.0].map(|side| (at + side * radius * left_of(facing)).length());
    (left.min(right) + radius - EDGE * ground).max(0.0)
}

/// How far a walker moves aside in a frame, [x, z] in metres, for others within [`OVERLAPPING`].
pub(super) fn aside(me: &Figure, others: &[Figure]) -> Vec2 {
    others.iter().fold(Vec2::ZERO, |aside, other| {
        let apart = me.at - other.at;
        let near = nearness(apart.length_squared(), OVERLAPPING);
        if near == 0.0 {
            return aside;
        }
        let distance = apart.length_squared().sqrt();
        // Who stand in the same place part to their own left.
        let away = if distance > 0.0 { apart / distance } else { left_of(me.facing) };
        aside + ASIDE * near * away
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const INTENTION: Intention = Intention { wander: 0.0, target: Vec2::ZERO, length: 0.7, stood: 0.0, radius: 20.0 };

    /// Straight on.
    fn ahead(me: &Figure) -> Intention {
        Intention { target: me.at + 100.0 * me.facing, ..INTENTION }
    }

    fn figure(x: f32, z: f32, heading: f32) -> Figure {
        Figure { at: Vec2::new(x, z), facing: facing(heading), speed: 1.2 }
    }

    #[test]
    fn who_is_alone_goes_where_they_wish() {
        let alone = |me: Figure, intention: &Intention| step(&me, intention, &[]);
        let me = figure(0.0, 0.0, 0.3);
        assert_eq!(alone(me, &ahead(&me)), (0.0, Pace::Walks));
        // The left of +Z is +X.
        let left = Intention { target: Vec2::new(9.0, 0.0), ..INTENTION };
        assert_eq!(alone(figure(0.0, 0.0, 0.0), &left), (MAX_TURN, Pace::Walks));
        let (turn, _) = alone(figure(0.0, 18.0, 0.5), &INTENTION);
        assert!(turn.abs() > 0.9 * MAX_TURN, "back from the edge: {turn}");
    }

    #[test]
    fn walkers_who_can_meet_are_within_the_range_of_avoidance() {
        let (me, secs) = (figure(0.0, 0.0, 0.0), INTENTION.length / 1.2);
        let away = |distance: f32| can_meet(&me, INTENTION.length, &figure(0.0, distance, 3.0), secs);
        assert!(away(7.7) && !away(FORESEEN));
    }

    #[test]
    fn two_who_meet_keep_right() {
        let (me, other) = (figure(0.0, 0.0, 0.0), figure(0.0, 4.0, std::f32::consts::PI));
        let turns = [(me, other), (other, me)].map(|(me, other)| step(&me, &ahead(&me), &[other]).0);
        assert!(turns[0] < 0.0 && turns[1] < 0.0, "{turns:?}");
    }

    #[test]
    fn of_two_who_touch_one_goes_on() {
        let (behind, before) = (figure(0.0, 0.0, 0.0), figure(0.1, 0.4, 0.4));
        assert!(!goes_on(&behind, &[before]) && goes_on(&before, &[behind]));
        assert!(!goes_on(&before, &[figure(3.0, 0.0, 0.0)]));
    }

    #[test]
    fn who_overlap_part() {
        let (me, other) = (figure(0.1, 0.0, 0.0), figure(0.0, 0.0, 0.0));
        assert!(aside(&me, &[other]).x > 0.0 && aside(&other, &[me]).x < 0.0);
        assert_eq!(aside(&me, &[figure(0.6, 0.0, 0.0)]), Vec2::ZERO);
    }

    proptest! {
        #[test]
        fn a_circle_that_fits_still_fits_after_the_step(x in -18.0f32..18.0, z in -18.0f32..18.0, heading in -3.0f32..3.0) {
            let me = figure(x, z, heading);
            let radius = INTENTION.length / MAX_TURN;
            let fits = [1.0, -1.0].iter()
                .any(|side| (me.at + *side * radius * left_of(me.facing)).length() + radius < EDGE * INTENTION.radius);
            prop_assume!(fits);
            let (turn, _) = step(&me, &ahead(&me), &[]);
            // A step is a chord of the circle.
            prop_assert!(beyond_edge(&me, turn, INTENTION.length, INTENTION.radius) < 0.02);
        }
    }
}
