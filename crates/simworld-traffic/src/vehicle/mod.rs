//! Vehicles: types, car following, and the manager that moves them along lanes and across intersections.

mod clock;
mod driving;
mod foreign;
mod junctions;
mod manager;
mod part;
mod queues;
mod saved;
mod scene;
mod threads;
mod tracks;
mod trips;
mod types;

pub(crate) use clock::Moment;
pub use driving::following::{CarFollowing, Leader};
#[cfg(feature = "validation")]
pub(crate) use driving::idm::advance;
pub use driving::idm::{HARDEST_BRAKING, Idm};
pub use driving::mobil::Mobil;
pub use driving::perception::Perception;
pub(crate) use foreign::controls::FreeVehicle;
pub(crate) use junctions::gaps;
pub(crate) use manager::{NONE, STANDING, Vehicle, VehicleManager};
pub(crate) use queues::path::Path;
pub(crate) use scene::Sight;
pub use simworld_core::net::CriticalGaps as Gaps;
pub(crate) use tracks::swept::{FRONT_AXLE, REAR_AXLE, held};
pub(crate) use tracks::{Obstacle, Tracks, Way};
pub(crate) use trips::halts::{Halt, Order, Then};
pub(crate) use trips::kerb::BEFORE_JUNCTION;
pub(crate) use types::{TypeIndex, draw_type};
pub use types::{VehicleKind, VehicleType, standard_types};
