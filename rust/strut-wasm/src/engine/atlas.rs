//! Handle of the atlas: a picture of all distances between an input and a database.

use crate::common::{EngineError, floats_of};
use crate::engine::database::Database;
use crate::engine::input::Input;
use std::sync::Arc;
use strut_core::humanoid::Pose;
use strut_core::pose_vector::{HeadingFilter, Placement};
use strut_core::search::{self, AtlasView, BodyPart, PackedWindow, QueryWindow, WINDOW, nearest_placement};
use strut_core::transfer::Model;
use wasm_bindgen::prelude::wasm_bindgen;

/// The picture of an input in a database. Columns are frames of the input, lines are windows of the database.
#[wasm_bindgen]
pub struct Atlas {
    model: Arc<Model>,
    picture: search::Atlas,
    /// The input frame of each column.
    frames: Vec<usize>,
    /// The input's pose in each column.
    poses: Vec<Pose>,
}

#[wasm_bindgen]
impl Atlas {
    /// Creates the picture with at most `columns` columns: input frames at even distances.
    #[wasm_bindgen(constructor)]
    pub fn new(database: &Database, input: &Input, columns: usize) -> Self {
        let model = Arc::clone(database.model());
        let db = model.catalogue();
        let poses = &input.humanoid().poses;
        let columns = columns.clamp(1, poses.len().max(1));
        let (mut window, mut filter) = (QueryWindow::default(), HeadingFilter::default());
        let (mut windows, mut frames) = (Vec::with_capacity(columns), Vec::with_capacity(columns));
        for (frame, pose) in poses.iter().enumerate() {
            window.follow(pose, &db.proportions, db.rate_hz, &mut filter);
            if frame == windows.len() * poses.len() / columns {
                windows.push(window.clone());
                frames.push(frame);
            }
        }
        let poses = frames.iter().map(|&frame| poses[frame]).collect();
        Self { picture: search::Atlas::new(model.index(), windows), model, frames, poses }
    }

    /// Returns the input frame of each column.
    pub fn frames(&self) -> Vec<u32> {
        self.frames.iter().map(|&frame| frame as u32).collect()
    }

    /// Returns the index of the first window of each class, and the number of all windows.
    pub fn firsts(&self) -> Vec<u32> {
        self.picture.firsts().iter().map(|&first| first as u32).collect()
    }

    /// Sets the view: a part of the body by its index, the range of windows, and the number of lines. Returns the first
    /// window, the end of the range and the number of lines that are shown.
    ///
    /// # Errors
    /// If there is no such part.
    #[wasm_bindgen(js_name = setView)]
    pub fn set_view(&mut self, part: usize, first: usize, last: usize, height: usize) -> Result<Vec<u32>, EngineError> {
        let part =
            BodyPart::ALL.get(part).ok_or_else(|| EngineError::bad_input("there is no such part of the body"))?;
        self.picture.set_view(AtlasView { part: *part, windows: [first, last], height });
        let AtlasView { windows: [first, last], height, .. } = self.picture.view();
        Ok([first, last, height].map(|v| v as u32).into())
    }

    /// Returns the least D of each line in some columns, m², column by column.
    ///
    /// # Errors
    /// If there is no such column.
    pub fn draw(&mut self, columns: &[u32]) -> Result<Vec<f32>, EngineError> {
        let height = self.picture.view().height;
        let mut all = vec![0.0; columns.len() * height];
        for (column, out) in columns.iter().zip(all.chunks_exact_mut(height)) {
            self.column(*column as usize)?;
            self.picture.draw(self.model.index(), *column as usize, out);
        }
        Ok(all)
    }

    /// Returns the nearest window of a line in a column: its index, its clip's index, its last frame in the clip, and
    /// √D in metres.
    ///
    /// # Errors
    /// If there is no such column or line.
    pub fn nearest(&mut self, column: usize, line: usize) -> Result<Vec<f64>, EngineError> {
        let found = self.picture.nearest(self.model.index(), column, line);
        let found = found.ok_or_else(|| EngineError::bad_input("there is no such column or line"))?;
        let clips = &self.model.catalogue().clips;
        let clip = clips.partition_point(|clip| clip.first_frame <= found.row) - 1;
        let frame = found.row - clips[clip].first_frame;
        Ok(vec![found.window as f64, clip as f64, frame as f64, f64::from(found.distance.sqrt())])
    }

    /// Returns the name of a clip.
    ///
    /// # Errors
    /// If there is no such clip.
    #[wasm_bindgen(js_name = clipName)]
    pub fn clip_name(&self, clip: usize) -> Result<String, EngineError> {
        let clip = self.model.catalogue().clips.get(clip);
        clip.map(|clip| clip.name.clone()).ok_or_else(|| EngineError::bad_input("there is no such clip"))
    }

    /// Returns the pose at a frame of a clip, with the turn and the shift that minimise its distance from a column of
    /// the input.
    ///
    /// # Errors
    /// If there is no such column, or no window ends there.
    pub fn pose(&self, column: usize, clip: usize, frame: usize) -> Result<Vec<f32>, EngineError> {
        let window = self.column(column)?;
        let db = self.model.catalogue();
        let found = db.clips.get(clip).filter(|clip| (WINDOW - 1..clip.frames).contains(&frame));
        let row = found.ok_or_else(|| EngineError::bad_input("no window ends there"))?.first_frame + frame;
        let stored = db.rows().get(row);
        let pose = db.chart.decode(&stored, Placement::default());
        let at = nearest_placement(self.model.index(), window, row, &pose, &db.proportions);
        let root = self.poses[column].root;
        let at = Placement { x: at.x + root.x, z: at.z + root.z, ..at };
        Ok(floats_of([db.chart.decode(&stored, at)].iter()))
    }

    /// Returns the database's rows for the GPU, with the joints of the view.
    #[wasm_bindgen(js_name = packedRows)]
    pub fn packed_rows(&mut self) -> Vec<f32> {
        self.picture.packed(self.model.index()).rows.as_flattened().to_vec()
    }

    /// Returns the windows of these rows, in whole tiles.
    #[wasm_bindgen(js_name = packedWindows)]
    pub fn packed_windows(&mut self) -> Vec<u32> {
        self.picture.packed(self.model.index()).windows.iter().flat_map(PackedWindow::words).collect()
    }

    /// Returns the line of each of these windows; the largest number for none.
    #[wasm_bindgen(js_name = packedLines)]
    pub fn packed_lines(&self) -> Vec<u32> {
        self.picture.packed_lines()
    }

    /// Returns the rows of the columns, with the joints of the view.
    #[wasm_bindgen(js_name = packedColumnRows)]
    pub fn packed_column_rows(&mut self) -> Vec<f32> {
        self.picture.packed_columns(self.model.index()).iter().flat_map(|query| query.rows).flatten().collect()
    }

    /// Returns the windows of these rows.
    #[wasm_bindgen(js_name = packedColumns)]
    pub fn packed_columns(&mut self) -> Vec<u32> {
        self.picture.packed_columns(self.model.index()).iter().flat_map(|query| query.window.words()).collect()
    }
}

impl Atlas {
    fn column(&self, column: usize) -> Result<&QueryWindow, EngineError> {
        self.picture.column(column).ok_or_else(|| EngineError::bad_input("there is no such column"))
    }
}
