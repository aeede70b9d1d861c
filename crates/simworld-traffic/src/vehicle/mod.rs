//! Vehicles: types, car following, and the manager that moves them along lanes and across intersections.

mod closures;
mod conflicts;
mod controls;
mod deadlock;
mod entry;
mod following;
mod gaps;
mod halts;
mod idm;
mod join;
mod junction;
mod kerb;
mod lane_change;
mod lanes;
mod layout;
mod lookahead;
mod manager;
mod otherwise;
mod part;
mod patience;
mod perception;
mod precedence;
mod ragged;
mod saved;
mod sirens;
mod slabs;
mod spawn;
mod tally;
mod threads;
mod tracks;
mod types;

pub(crate) use controls::FreeVehicle;
pub use following::{CarFollowing, Leader};
pub use gaps::Gaps;
pub(crate) use halts::{Halt, Order, Then};
#[cfg(feature = "validation")]
pub(crate) use idm::advance;
pub use idm::{HARDEST_BRAKING, Idm};
pub(crate) use kerb::BEFORE_JUNCTION;
pub use lane_change::Mobil;
pub(crate) use manager::{Moment, NONE, Path, STANDING, Sight, Vehicle, VehicleManager};
pub use perception::Perception;
pub(crate) use tracks::{Obstacle, Tracks, Way};
pub(crate) use types::{TypeIndex, draw_type};
pub use types::{VehicleKind, VehicleType, standard_types};
