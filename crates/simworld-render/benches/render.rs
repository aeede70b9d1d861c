//! Frames per second.
#![allow(missing_docs)]
fn main() {}
