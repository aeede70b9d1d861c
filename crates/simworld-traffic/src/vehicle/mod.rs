//! Vehicles: types, car following, and the manager that moves them along lanes and across intersections.

mod entry;
mod idm;
mod junction;
mod kinds;
mod lane_change;
mod lookahead;
mod manager;
mod tracks;

pub use idm::{HARDEST_BRAKING, Idm};
pub use kinds::VehicleKind;
pub use lane_change::Mobil;
pub(crate) use manager::{STANDING, Sight, VehicleManager};
pub(crate) use tracks::Tracks;
