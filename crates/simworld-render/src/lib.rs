#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod classes;
mod device;
mod error;
mod frame;
mod gather;
mod mesh;
mod pipeline;
mod renderer;
mod sensor;
mod targets;

pub use classes::{class_color, class_of, class_name};
pub use error::RenderError;
pub use frame::{Frame, SKY_DEPTH};
pub use renderer::{RenderConfig, Renderer};
pub use sensor::{CameraSensor, Mount};
