//! Tests of the command, in one program: each file of its own would be linked with everything again.

mod bad_input;
mod batch;
mod commands;
mod common;
mod drive;
mod evaluate;
mod key_style;
mod live;
mod opening;
mod real_data;
mod robustness;
mod search;
mod walk;
