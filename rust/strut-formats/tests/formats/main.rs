//! Tests of all formats, in one program: each file of its own would be linked with everything again.

mod bvh;
mod foreign_skeletons;
#[path = "../mocap/labelled.rs"]
mod labelled;
#[path = "../mocap/mod.rs"]
mod mocap;
mod other_roots;
mod performances;
mod read_from_the_body;
mod real_bvh;
mod registration;
mod retarget_round_trip;
mod strutdb;
