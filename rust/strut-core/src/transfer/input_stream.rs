//! Input frames of a stylizer, prepared for its stages. They depend on the poses alone, not on styles, options or output.

use super::contact_likelihood::RecentFeet;
use super::input_guard::{Admitted, InputGuard};
use crate::catalogue::Catalogue;
use crate::humanoid::Pose;
use crate::kinematics::world_from_local;
use crate::pose_vector::{HeadingFilter, Placement, PoseRow, VELOCITY_X, heading_free_positions};
use crate::search::QueryWindow;

/// A stream of checked input poses, and its newest window.
#[derive(Clone, Debug)]
pub(super) struct InputStream {
    guard: InputGuard,
    heading: HeadingFilter,
    window: QueryWindow,
    feet: RecentFeet,
    /// Row and placement of the last frame.
    last: Option<(PoseRow, Placement)>,
}

/// Input frame at t and the one before it. The first frame serves as its own predecessor.
#[derive(Clone, Copy, Debug)]
pub(super) struct InputFrame {
    /// xₜ.
    pub(super) row: PoseRow,
    pub(super) at: Placement,
    /// xₜ₋₁.
    pub(super) previous: PoseRow,
    pub(super) previous_at: Placement,
    /// Whether the pose was invalid and replaced.
    pub(super) repaired: bool,
    /// Whether the frame is a cut: it is not continuous with those before, and the stream restarts with it.
    pub(super) cut: bool,
}

impl InputStream {
    /// A stream without frames, with windows of this length.
    pub(super) fn new(window_length: usize) -> Self {
        Self {
            guard: InputGuard::default(),
            heading: HeadingFilter::default(),
            window: QueryWindow::new(window_length),
            feet: RecentFeet::default(),
            last: None,
        }
    }

    /// Discards all frames.
    pub(super) fn reset(&mut self) {
        self.forget_frames();
        self.guard = InputGuard::default();
    }

    /// Adds the next frame: a pose on the database's proportions, one frame after the last at its rate.
    pub(super) fn push(&mut self, db: &Catalogue, pose: &Pose) -> InputFrame {
        let dt_secs = 1.0 / db.rate_hz;
        let (mut repaired, mut cut) = (false, false);
        let pose = match self.guard.admit(pose, dt_secs) {
            Admitted::Good(pose) => pose,
            Admitted::Repaired(pose) => {
                repaired = true;
                pose
            }
            Admitted::Cut(pose) => {
                cut = true;
                pose
            }
            Admitted::RepairedCut(pose) => {
                (repaired, cut) = (true, true);
                pose
            }
        };
        if cut {
            self.forget_frames();
        }
        let world = world_from_local(&db.proportions, &pose);
        self.feet.push(&world);
        let heading = self.heading.update(&world, dt_secs);
        let at = Placement { x: pose.root.x, z: pose.root.z, heading };
        let row = db.chart.encode(&pose, heading, self.last.map(|(_, place)| place), dt_secs);
        if self.window.frames() == 1 {
            // The first frame has no velocity; that of the second is a better estimate than zero.
            if let Some((first, _)) = &mut self.last {
                first[VELOCITY_X..].copy_from_slice(&row[VELOCITY_X..]);
            }
        }
        self.window.push(&heading_free_positions(&world, heading), at);
        let (previous, previous_at) = self.last.replace((row, at)).unwrap_or((row, at));
        InputFrame { row, at, previous, previous_at, repaired, cut }
    }

    /// The window that ends at the last frame.
    pub(super) fn window(&self) -> &QueryWindow {
        &self.window
    }

    /// Feet in the last frames.
    pub(super) fn feet(&self) -> &RecentFeet {
        &self.feet
    }

    /// xₜ; `None` before the first frame.
    pub(super) fn last_row(&self) -> Option<&PoseRow> {
        self.last.as_ref().map(|(row, _)| row)
    }

    fn forget_frames(&mut self) {
        self.heading = HeadingFilter::default();
        self.window.clear();
        self.feet = RecentFeet::default();
        self.last = None;
    }
}
