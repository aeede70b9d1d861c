//! What is made of pictures: cameras that somebody wears, photos, optical flow, boxes, scans of ranges, maps.
//!
//! A sensor that depends on the scene alone is an [`Observer`](simworld_core::seam::Observer). Optical flow depends on what
//! was before as well, so it is an object of its own that its owner feeds.

mod boxes;
mod camera;
mod drops;
mod flow;
mod lidar;
mod map;
mod outline;
mod photo;

pub use boxes::{BoxSensor, EntityBox, PixelBox, boxes_of};
pub use camera::CameraSensor;
pub use flow::OpticalFlow;
pub use lidar::{Beam, BeamTable, Lidar, LidarConfig, LidarMethod, LidarPoint, LidarWeather, PointCloud};
pub use map::{MapSensor, MapView};
pub use photo::{Photo, PhotoRoll};
