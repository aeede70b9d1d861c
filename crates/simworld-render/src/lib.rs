#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod atmosphere;
mod batch;
pub mod classes;
mod coats;
mod config;
mod coverage;
mod deck;
mod demand;
mod draw_list;
mod error;
mod export;
mod falling;
mod frame;
mod gpu;
mod lamps;
mod light;
mod look;
mod mesh;
mod models;
mod npy;
mod occlusion;
mod poses;
mod raster;
mod raycast;
mod renderer;
mod resident;
mod sensor;
mod shadow;
mod sieve;
mod sources;
mod tangent;
mod threads;
mod view;
mod works;

pub use batch::{Channels, PixelFormat, Projection, Span, ViewOptions, ViewRequest, Views};
pub use config::{AdapterChoice, AntiAliasing, Backend, Backends, Culling, LevelOfDetail, RenderConfig};
pub use error::RenderError;
pub use export::PNG_DEPTH_LIMIT;
pub use frame::{Frame, SKY_DEPTH};
pub use renderer::{DeviceViews, Renderer, Ticket};
pub use sensor::{
    Beam, BeamTable, BoxSensor, CameraSensor, EntityBox, Lidar, LidarConfig, LidarMethod, LidarPoint,
    LidarWeather, MapSensor, MapView, OpticalFlow, Photo, PhotoRoll, PixelBox, PointCloud, boxes_of,
};
pub use wgpu;
