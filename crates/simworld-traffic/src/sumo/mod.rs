//! Files of SUMO, the traffic simulator of the German Aerospace Center: its networks and its demand, so that the same
//! files run there and here.
//!
//! Whatever has no counterpart is a [`SumoWarning`] with its id; a file that is broken is a [`SumoError`].

mod error;
mod net;
mod routes;
mod xml;

pub use error::{SumoError, SumoWarning};
pub use net::{SumoNet, SumoPrograms};
pub use routes::{
    Distribution, SumoBusStop, SumoDemand, SumoFlow, SumoPerson, SumoPersonFlow, SumoPlace, SumoStage,
    SumoStop, SumoTimes, SumoType, SumoVehicle, SumoWay,
};
