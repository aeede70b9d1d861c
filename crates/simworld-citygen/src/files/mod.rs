//! Files of a city: what others read and write.

pub mod atomic;
pub mod geojson;
pub mod gltf;
pub mod opendrive;

pub mod save;
pub mod sumo;
pub(crate) mod xml;
