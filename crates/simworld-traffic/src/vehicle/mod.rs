//! Vehicles: types, car following, and the manager that moves them along lanes and across intersections.

mod idm;
mod junction;
mod kinds;
mod lookahead;
mod manager;
mod tracks;

pub use idm::{HARDEST_BRAKING, Idm};
pub use kinds::VehicleKind;
pub(crate) use manager::{STANDING, Sight, VehicleManager};
pub(crate) use tracks::Tracks;
