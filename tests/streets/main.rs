//! What moves through whole cities: traffic by the day, drivers of the agents', and files through SUMO.

mod cities_go_through_sumo;
mod drivers_drive;
mod traffic_is_safe;
mod traffic_keeps_flowing;
