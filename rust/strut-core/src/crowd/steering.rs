//! Choice of a step's turn and pace, with avoidance of others.
//!
//! A step is chosen when it begins, because the feet pivot on the ground then. Among a few turns and paces, the step of the
//! least cost is near the desired direction, keeps away from the places that others will reach if they go straight on (after
//! van den Berg, Lin, Manocha, "Reciprocal Velocity Obstacles", 2008), and leaves room for a full circle on the ground.

use crate::hsmm::MAX_TURN;
use crate::math::Vec2;
use crate::math::float_funcs::{atan2, sin_cos};

/// Share of the ground's radius beyond which agents are drawn inward, and the one within which circles of full turns are to
/// stay.
const INWARD: f32 = 0.8;
const EDGE: f32 = 1.1;
/// Weight of wandering relative to the target.
const WANDERING: f32 = 0.3;
/// Number of candidate turns to either side, besides the desired turn.
const TURNS: i16 = 3;
/// Number of predicted steps, and how many of them have the chosen turn.
const FORESIGHT: usize = 5;
const TURNING: usize = 2;
/// Range of avoidance, metres: agents farther away are ignored. From farther away, two agents that approach each other at
/// 1.2 m/s each cannot meet within the predicted steps.
pub(super) const FORESEEN: f32 = 8.0;
/// Agents keep at least this distance from others, metres. It was tuned together with the costs: at four square metres per
/// agent they walk at 0.86 of the speed they have alone.
const COMFORTABLE: f32 = 0.8;
/// Costs, relative to a deviation by a full turn from the desired direction: an imminent collision, short steps, standing
/// (plus the square of the standing time, steps), a metre beyond the edge, and a full turn to the left, as people keep right.
const NEARNESS_COST: f32 = 40.0;
const SHORT_COST: f32 = 1.0;
const STANDING_COST: f32 = 12.0;
const EDGE_COST: f32 = 1000.0;
const LEFT_COST: f32 = 0.02;
/// Ratio of the speed with short steps to the full speed.
const SHORT_SPEED: f32 = 0.7;
/// Of two agents nearer than this, metres, one always walks on.
const TOUCHING: f32 = 0.5;
/// Agents nearer than this to others, metres, are pushed apart, by at most this many metres a frame, less with distance.
/// Their feet slide; it is the last resort.
pub(super) const OVERLAPPING: f32 = 0.4;
const ASIDE: f32 = 0.025;
/// Margin for rounding in tests that skip distant agents.
const ROUNDING: f32 = 1.001;

/// State of an agent as seen by its neighbours.
#[derive(Clone, Copy, Debug, Default)]
pub struct AgentState {
    /// Place, [x, z] in metres.
    pub(super) at: Vec2,
    /// Unit vector of the direction of motion.
    pub(super) facing: Vec2,
    /// Speed along it, m/s.
    pub(super) speed: f32,
}

/// The unit vector of a heading.
pub(super) fn facing(heading: f32) -> Vec2 {
    let (sin, cos) = sin_cos(heading);
    Vec2::new(sin, cos)
}

/// Inputs of the steering decision at a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct SteeringInput {
    /// Random turn, radians.
    pub(super) wander: f32,
    /// Place to go to.
    pub(super) target: Vec2,
    /// Length of a step, metres.
    pub(super) length: f32,
    /// Standing time, steps.
    pub(super) stood: f32,
    /// Radius of the ground, metres.
    pub(super) radius: f32,
}

/// Pace of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pace {
    Walks,
    /// With short steps.
    Short,
    Stands,
}

/// Chooses the next step of an agent whose speed is not 0: its turn, radians to the left, at most [`MAX_TURN`] either way,
/// and its pace. `others` are the agents within [`FORESEEN`].
pub(super) fn step(me: &AgentState, input: &SteeringInput, others: &[AgentState]) -> (f32, Pace) {
    let choice = Choice::new(me, input, others);
    let walking = [(Pace::Walks, 1.0, 0.0), (Pace::Short, SHORT_SPEED, SHORT_COST)].into_iter();
    let steps = walking.flat_map(|(pace, share, cost)| choice.turns().map(move |turn| (turn, pace, share, cost)));
    let costs = steps.map(|(turn, pace, share, cost)| (choice.cost(turn, share, cost), turn, pace));
    let standing = if goes_on(me, others) {
        f32::INFINITY
    } else {
        STANDING_COST + input.stood * input.stood + choice.risks(0.0, 0.0)
    };
    let best = costs.chain([(standing, 0.0, Pace::Stands)]).min_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or((0.0, Pace::Stands), |(_, turn, pace)| (turn, pace))
}

/// Chooses the turn of the next step of an agent that cannot change its pace, because it performs a given motion: radians to
/// the left, at most [`MAX_TURN`] either way. Its speed is not 0, and `others` are the agents within [`FORESEEN`].
pub(super) fn turn(me: &AgentState, input: &SteeringInput, others: &[AgentState]) -> f32 {
    let choice = Choice::new(me, input, others);
    let costs = choice.turns().map(|turn| (choice.cost(turn, 1.0, 0.0), turn));
    costs.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, turn)| turn)
}

/// Candidate steps and their costs.
struct Choice<'a> {
    me: &'a AgentState,
    input: &'a SteeringInput,
    others: &'a [AgentState],
    /// The turn to the desired direction, radians.
    wish: f32,
    /// Duration of a step.
    secs: f32,
}

impl<'a> Choice<'a> {
    fn new(me: &'a AgentState, input: &'a SteeringInput, others: &'a [AgentState]) -> Self {
        let wish = wished(me, input).clamp(-MAX_TURN, MAX_TURN);
        Self { me, input, others, wish, secs: input.length / me.speed }
    }

    fn turns(&self) -> impl Iterator<Item = f32> + Clone + use<> {
        (-TURNS..=TURNS).map(|i| f32::from(i) / f32::from(TURNS) * MAX_TURN).chain([self.wish])
    }

    /// Cost of a step with a turn, whose length is a share of the whole, plus `cost`.
    fn cost(&self, turn: f32, share: f32, cost: f32) -> f32 {
        let (off, length) = ((turn - self.wish) / MAX_TURN, share * self.input.length);
        let beyond = beyond_edge(self.me, turn, length, self.input.radius);
        cost + off * off + EDGE_COST * beyond + LEFT_COST * turn / MAX_TURN + self.risks(turn, length)
    }

    fn risks(&self, turn: f32, length: f32) -> f32 {
        let path = path(self.me, turn, length);
        let meets = |other: &&AgentState| can_meet(self.me, length, other, self.secs);
        NEARNESS_COST * self.others.iter().filter(meets).map(|other| risk(&path, other, self.secs)).sum::<f32>()
    }
}

/// Whether an agent touches another and blocks it more than the other blocks it: if both stood, they would stay there.
fn goes_on(me: &AgentState, others: &[AgentState]) -> bool {
    others.iter().any(|other| {
        let apart = other.at - me.at;
        apart.length_squared().sqrt() < TOUCHING && me.facing.dot(apart) < -other.facing.dot(apart)
    })
}

/// Present place and the places after each of the next steps.
fn path(me: &AgentState, turn: f32, length: f32) -> [Vec2; FORESIGHT + 1] {
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

/// Whether another agent could come near within the predicted steps; if not, there is no risk.
fn can_meet(me: &AgentState, length: f32, other: &AgentState, secs: f32) -> bool {
    let reach = ROUNDING * (COMFORTABLE + FORESIGHT as f32 * (length + other.speed * secs));
    (other.at - me.at).length_squared() < reach * reach
}

/// Risk of a collision with another agent that goes straight on, by distance and time: 0 to 3.
fn risk(path: &[Vec2; FORESIGHT + 1], other: &AgentState, secs: f32) -> f32 {
    let way = other.speed * secs * other.facing;
    let apart = |step: usize| other.at + step as f32 * way - path[step];
    let near = (0..FORESIGHT).map(|step| {
        let near = nearness(least_length_squared(apart(step), apart(step + 1)), COMFORTABLE);
        near * near * (FORESIGHT - step) as f32
    });
    near.sum::<f32>() / FORESIGHT as f32
}

/// Nearness at a distance, given its square: from 1 at 0 to 0 at the limit and beyond.
fn nearness(distance_squared: f32, limit: f32) -> f32 {
    // Most agents are far away: the root is computed only for the near ones.
    if distance_squared > ROUNDING * limit * limit {
        return 0.0;
    }
    let near = 1.0 - distance_squared.sqrt() / limit;
    // `f32::max` would be a function call in WebAssembly.
    if near > 0.0 { near } else { 0.0 }
}

/// Squared length of the shortest vector on the line segment from one to another.
fn least_length_squared(from: Vec2, to: Vec2) -> f32 {
    let way = to - from;
    let squared = way.length_squared();
    let share =
        (-from.dot(way) / if squared > f32::MIN_POSITIVE { squared } else { f32::MIN_POSITIVE }).clamp(0.0, 1.0);
    (from + share * way).length_squared()
}

/// The angle to the desired direction, radians to the left.
fn wished(me: &AgentState, input: &SteeringInput) -> f32 {
    let (sin, cos) = sin_cos(input.wander);
    let wandering = cos * me.facing + sin * left_of(me.facing);
    let distance = me.at.length();
    let inward = (distance / input.radius - INWARD).max(0.0) / (1.0 - INWARD);
    let wish = wandering - me.at * (inward / distance.max(1.0));
    let wish = WANDERING * wish + (input.target - me.at).normalize_or_zero();
    atan2(left_of(me.facing).dot(wish), me.facing.dot(wish))
}

fn left_of(facing: Vec2) -> Vec2 {
    Vec2::new(facing.y, -facing.x)
}

fn turned(me: &AgentState, turn: f32) -> AgentState {
    let (sin, cos) = sin_cos(turn);
    AgentState { facing: cos * me.facing + sin * left_of(me.facing), ..*me }
}

/// Distance beyond the edge that an agent must reach after a step with a turn even if it turns as much as it can from then
/// on, metres.
fn beyond_edge(me: &AgentState, turn: f32, length: f32, ground: f32) -> f32 {
    let half = turned(me, 0.5 * turn);
    let (at, facing) = (me.at + length * half.facing, turned(me, turn).facing);
    // The circle of full turns.
    let radius = length / MAX_TURN;
    let [left, right] = [1.0, -1.0].map(|side| (at + side * radius * left_of(facing)).length());
    (left.min(right) + radius - EDGE * ground).max(0.0)
}

/// Displacement of an agent in a frame away from others within [`OVERLAPPING`], [x, z] in metres.
pub(super) fn aside(me: &AgentState, others: &[AgentState]) -> Vec2 {
    others.iter().fold(Vec2::ZERO, |aside, other| {
        let apart = me.at - other.at;
        let near = nearness(apart.length_squared(), OVERLAPPING);
        if near == 0.0 {
            return aside;
        }
        let distance = apart.length_squared().sqrt();
        // Agents in the same place part to their own left.
        let away = if distance > 0.0 { apart / distance } else { left_of(me.facing) };
        aside + ASIDE * near * away
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const INPUT: SteeringInput =
        SteeringInput { wander: 0.0, target: Vec2::ZERO, length: 0.7, stood: 0.0, radius: 20.0 };

    /// An input to go straight on.
    fn ahead(me: &AgentState) -> SteeringInput {
        SteeringInput { target: me.at + 100.0 * me.facing, ..INPUT }
    }

    fn agent(x: f32, z: f32, heading: f32) -> AgentState {
        AgentState { at: Vec2::new(x, z), facing: facing(heading), speed: 1.2 }
    }

    #[test]
    fn a_lone_agent_takes_the_desired_direction() {
        let alone = |me: AgentState, input: &SteeringInput| step(&me, input, &[]);
        let me = agent(0.0, 0.0, 0.3);
        assert_eq!(alone(me, &ahead(&me)), (0.0, Pace::Walks));
        // The left of +Z is +X.
        let left = SteeringInput { target: Vec2::new(9.0, 0.0), ..INPUT };
        assert_eq!(alone(agent(0.0, 0.0, 0.0), &left), (MAX_TURN, Pace::Walks));
        let (turn, _) = alone(agent(0.0, 18.0, 0.5), &INPUT);
        assert!(turn.abs() > 0.9 * MAX_TURN, "back from the edge: {turn}");
    }

    #[test]
    fn agents_that_can_meet_are_within_the_range_of_avoidance() {
        let (me, secs) = (agent(0.0, 0.0, 0.0), INPUT.length / 1.2);
        let away = |distance: f32| can_meet(&me, INPUT.length, &agent(0.0, distance, 3.0), secs);
        assert!(away(7.7) && !away(FORESEEN));
    }

    #[test]
    fn two_agents_that_meet_keep_right() {
        let (me, other) = (agent(0.0, 0.0, 0.0), agent(0.0, 4.0, std::f32::consts::PI));
        let turns = [(me, other), (other, me)].map(|(me, other)| step(&me, &ahead(&me), &[other]).0);
        assert!(turns[0] < 0.0 && turns[1] < 0.0, "{turns:?}");
    }

    #[test]
    fn of_two_touching_agents_one_keeps_walking() {
        let (behind, before) = (agent(0.0, 0.0, 0.0), agent(0.1, 0.4, 0.4));
        assert!(!goes_on(&behind, &[before]) && goes_on(&before, &[behind]));
        assert!(!goes_on(&before, &[agent(3.0, 0.0, 0.0)]));
    }

    #[test]
    fn overlapping_agents_are_pushed_apart() {
        let (me, other) = (agent(0.1, 0.0, 0.0), agent(0.0, 0.0, 0.0));
        assert!(aside(&me, &[other]).x > 0.0 && aside(&other, &[me]).x < 0.0);
        assert_eq!(aside(&me, &[agent(0.6, 0.0, 0.0)]), Vec2::ZERO);
    }

    proptest! {
        #[test]
        fn a_circle_that_fits_still_fits_after_the_step(x in -18.0f32..18.0, z in -18.0f32..18.0, heading in -3.0f32..3.0) {
            let me = agent(x, z, heading);
            let radius = INPUT.length / MAX_TURN;
            let fits = [1.0, -1.0].iter()
                .any(|side| (me.at + *side * radius * left_of(me.facing)).length() + radius < EDGE * INPUT.radius);
            prop_assume!(fits);
            let (turn, _) = step(&me, &ahead(&me), &[]);
            // A step is a chord of the circle.
            prop_assert!(beyond_edge(&me, turn, INPUT.length, INPUT.radius) < 0.02);
        }
    }
}
