//! Vehicles by class.
//!
//! Cars by segment as registered in Europe (A 3.6 m to F 5.3 m); lorries and buses within the largest lengths, widths and heights
//! of directive 96/53/EC (12 m, articulated 16.5 and 18.75 m, 2.55 m, 4 m; coaches and double-deckers as built); masses empty.

use super::super::Material;
use super::super::row::{Row, boxed, row};
use crate::scene::EntityKind;

use EntityKind::{Bicycle, Bus, Car, Motorcycle, Scooter, Truck};
use Material::Metal;

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    row("taxi", Car, boxed(4.5, 1.8, 1.5), 1450.0, Metal, [0.7, 0.5, 0.05], &["cab", "hire"]),
    row("police_car", Car, boxed(4.7, 1.85, 1.5), 1700.0, Metal, [0.8, 0.8, 0.79], &["patrol", "squad", "emergency", "cruiser"]),
    row("estate_car", Car, boxed(4.7, 1.83, 1.48), 1500.0, Metal, [0.02, 0.05, 0.18], &["station", "wagon", "combi", "family"]),
    row("limousine", Car, boxed(5.3, 1.9, 1.5), 2100.0, Metal, [0.03, 0.03, 0.035], &["luxury", "saloon", "stretch"]),
    row("convertible", Car, boxed(4.2, 1.78, 1.3), 1350.0, Metal, [0.5, 0.04, 0.03], &["cabriolet", "open", "roof", "roadster"]),
    row("electric_car", Car, boxed(4.7, 1.85, 1.45), 1850.0, Metal, [0.8, 0.8, 0.79], &["ev", "battery"]),
    row("city_car", Car, boxed(3.6, 1.65, 1.5), 950.0, Metal, [0.3, 0.45, 0.6], &["mini", "compact", "tiny"]),
    row("minivan", Car, boxed(4.9, 1.9, 1.75), 1900.0, Metal, [0.55, 0.56, 0.58], &["people", "carrier", "mpv", "family"]),
    row("jeep", Car, boxed(4.3, 1.9, 1.85), 1950.0, Metal, [0.03, 0.11, 0.05], &["off", "road", "offroad", "four", "wheel"]),
    row("pickup", Truck, boxed(5.4, 1.9, 1.8), 2100.0, Metal, [0.12, 0.12, 0.13], &["pick", "up", "ute", "flatbed"]),
    row("ambulance", Truck, boxed(6.0, 2.1, 2.7), 3500.0, Metal, [0.8, 0.8, 0.79], &["emergency", "rescue", "hospital"]),
    row("fire_engine", Truck, boxed(8.3, 2.5, 3.3), 14_000.0, Metal, [0.5, 0.04, 0.03], &["fire", "brigade", "emergency", "ladder"]),
    row("garbage_truck", Truck, boxed(9.5, 2.55, 3.5), 15_000.0, Metal, [0.75, 0.25, 0.03], &["refuse", "bin", "waste", "lorry"]),
    row("delivery_truck", Truck, boxed(7.0, 2.3, 3.1), 5500.0, Metal, [0.8, 0.8, 0.79], &["box", "parcel", "courier"]),
    row("food_truck", Truck, boxed(6.0, 2.3, 3.0), 4500.0, Metal, [0.75, 0.25, 0.03], &["street", "food", "kitchen", "catering"]),
    row("tanker", Truck, boxed(10.0, 2.55, 3.5), 14_000.0, Metal, [0.55, 0.56, 0.58], &["fuel", "petrol", "tank", "lorry"]),
    row("cement_mixer", Truck, boxed(9.0, 2.5, 3.8), 14_500.0, Metal, [0.7, 0.5, 0.05], &["concrete", "mixer", "building", "site"]),
    row("dump_truck", Truck, boxed(8.0, 2.5, 3.2), 13_000.0, Metal, [0.7, 0.5, 0.05], &["tipper", "building", "site"]),
    row("flatbed_truck", Truck, boxed(9.0, 2.5, 2.9), 8500.0, Metal, [0.05, 0.13, 0.45], &["open", "lorry"]),
    row("tow_truck", Truck, boxed(8.0, 2.5, 3.0), 9500.0, Metal, [0.7, 0.5, 0.05], &["breakdown", "recovery"]),
    row("semi_trailer", Truck, boxed(16.5, 2.55, 4.0), 15_500.0, Metal, [0.02, 0.05, 0.18], &["articulated", "lorry", "eighteen", "wheeler", "long", "haul"]),
    row("tractor", Truck, boxed(4.5, 2.2, 2.8), 5500.0, Metal, [0.06, 0.25, 0.08], &["farm", "agricultural"]),
    row("excavator", Truck, boxed(7.5, 2.5, 3.0), 14_000.0, Metal, [0.7, 0.5, 0.05], &["digger", "building", "site"]),
    row("forklift", Truck, boxed(2.6, 1.2, 2.2), 3500.0, Metal, [0.75, 0.25, 0.03], &["fork", "lift", "warehouse"]),
    row("street_sweeper", Truck, boxed(5.0, 2.0, 2.6), 6000.0, Metal, [0.75, 0.25, 0.03], &["cleaning", "road"]),
    row("golf_cart", Car, boxed(2.4, 1.2, 1.8), 450.0, Metal, [0.8, 0.8, 0.79], &["buggy", "electric"]),
    row("minibus", Bus, boxed(7.0, 2.1, 2.8), 3800.0, Metal, [0.8, 0.8, 0.79], &["shuttle", "small"]),
    row("coach", Bus, boxed(12.2, 2.55, 3.8), 14_000.0, Metal, [0.28, 0.05, 0.04], &["tour", "travel"]),
    row("double_decker", Bus, boxed(11.0, 2.55, 4.4), 12_500.0, Metal, [0.5, 0.04, 0.03], &["two", "storey", "london"]),
    row("school_bus", Bus, boxed(11.0, 2.5, 3.1), 11_000.0, Metal, [0.7, 0.5, 0.05], &["children", "pupils"]),
    row("articulated_bus", Bus, boxed(18.0, 2.55, 3.1), 17_000.0, Metal, [0.8, 0.8, 0.79], &["bendy", "long"]),
    row("sport_motorcycle", Motorcycle, boxed(2.05, 0.75, 1.15), 200.0, Metal, [0.5, 0.04, 0.03], &["racing", "fast", "superbike"]),
    row("chopper", Motorcycle, boxed(2.4, 0.9, 1.15), 310.0, Metal, [0.03, 0.03, 0.035], &["cruiser", "heavy"]),
    row("moped", Motorcycle, boxed(1.75, 0.7, 1.1), 95.0, Metal, [0.3, 0.45, 0.6], &["motor", "scooter", "vespa"]),
    row("cargo_bike", Bicycle, boxed(2.5, 0.85, 1.1), 40.0, Metal, [0.12, 0.12, 0.13], &["freight", "transport"]),
    row("mountain_bike", Bicycle, boxed(1.8, 0.7, 1.1), 13.0, Metal, [0.75, 0.25, 0.03], &["trail", "off", "road"]),
    row("racing_bike", Bicycle, boxed(1.7, 0.45, 1.0), 8.0, Metal, [0.5, 0.04, 0.03], &["road", "fast"]),
    row("children_bicycle", Bicycle, boxed(1.2, 0.5, 0.8), 9.0, Metal, [0.55, 0.3, 0.28], &["kids", "small"]),
    row("electric_bike", Bicycle, boxed(1.85, 0.65, 1.1), 24.0, Metal, [0.02, 0.05, 0.18], &["pedelec", "ebike"]),
    row("scooter_2", Scooter, boxed(1.15, 0.5, 1.2), 20.0, Metal, [0.5, 0.04, 0.03], &["electric", "kick"]),
    row("scooter_3", Scooter, boxed(1.15, 0.5, 1.2), 20.0, Metal, [0.05, 0.13, 0.45], &["electric", "kick"]),
    row("scooter_4", Scooter, boxed(1.15, 0.5, 1.2), 20.0, Metal, [0.03, 0.03, 0.035], &["electric", "kick"]),
];
