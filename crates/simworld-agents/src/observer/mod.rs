//! Senses beside the camera: the scene as a graph of things and relations, and the position as a receiver gives it.

mod frame;
mod gps;
mod nearest;
mod scene_graph;
mod screens;
mod senses;
mod text;

pub use frame::Frame;
pub use gps::{GpsFix, GpsObserver};
pub use scene_graph::{Oneself, SceneGraph, SceneGraphObserver, Sighting};
pub use senses::{Describe, Feedback, Sense, Senses};
pub use text::tokens_in;
