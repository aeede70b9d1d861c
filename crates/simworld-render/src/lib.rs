#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

pub mod classes;
mod config;
mod draw_list;
mod error;
mod export;
mod frame;
mod gpu;
mod light;
mod look;
mod mesh;
mod models;
mod renderer;
mod sensor;
mod shadow;
mod view;

pub use config::{AdapterChoice, AntiAliasing, Backends, RenderConfig};
pub use error::RenderError;
pub use export::PNG_DEPTH_LIMIT;
pub use frame::{Frame, SKY_DEPTH};
pub use renderer::Renderer;
pub use sensor::CameraSensor;
