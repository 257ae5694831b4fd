//! Live streams. Their package is loaded when a live stream starts. The engine, which has the database, does the styling;
//! this package does the steps before and after it.

mod sender;
mod stream;

pub use stream::Stream;
