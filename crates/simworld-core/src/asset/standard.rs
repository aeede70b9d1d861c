//! The ordinary things of a street.
//!
//! Sizes are typical ones: passenger cars by class as in European registrations (B 4.05 x 1.75 x 1.45 m, 1150 kg; C 4.35 x
//! 1.80 m, 1350 kg; SUV 4.6 x 1.87 x 1.67 m, 1650 kg), a city bus of 12 m, people of 1.75 m and 75 kg, furniture as sold.

use super::row::{Row, boxed, fixed, round, row};
use super::{Affordance, Asset, Material};
use crate::scene::{EntityKind, Shape};

use Affordance::Open;
use EntityKind::{
    Bench, Bicycle, Bus, BusStop, Car, Chair, Cone, Dog, Hydrant, Mailbox, Motorcycle, Parcel, Person, Robot,
    Scooter, Shrub, Sign, StreetLamp, Table, TrafficSignal, TrashBin, Tree, Truck,
};
use Material::{Flesh, Foliage, Glass, Metal, Paper, Plastic, Wood};

/// Broad leaves: fresh, full, yellow, bare.
pub(super) const LEAFY: [[f32; 3]; 4] =
    [[0.16, 0.3, 0.07], [0.08, 0.2, 0.06], [0.4, 0.2, 0.03], [0.14, 0.11, 0.08]];

#[rustfmt::skip]
const ROWS: &[Row] = &[
    fixed("tree", Tree, round(0.18, 7.0), Wood, [0.08, 0.2, 0.06], &["linden", "plant"]).through(LEAFY),
    fixed("tall_tree", Tree, round(0.3, 14.0), Wood, [0.07, 0.18, 0.06], &["plane", "plant", "large"]).through(LEAFY),
    fixed("shrub", Shrub, boxed(0.7, 1.6, 0.9), Foliage, [0.1, 0.22, 0.07], &["hedge", "bush", "plant"]).through(LEAFY),
    fixed("street_lamp", StreetLamp, round(0.09, 6.0), Metal, [0.12, 0.12, 0.13], &["light", "post"]),
    fixed("traffic_signal", TrafficSignal, round(0.08, 3.5), Metal, [0.1, 0.1, 0.1], &["light", "traffic", "post"]),
    fixed("sign", Sign, round(0.05, 2.4), Metal, [0.5, 0.5, 0.5], &["post"]),
    row("bench", Bench, boxed(0.6, 1.8, 0.85), 60.0, Wood, [0.3, 0.19, 0.1], &["seat", "wooden"]),
    row("chair", Chair, boxed(0.5, 0.5, 0.85), 5.0, Wood, [0.35, 0.3, 0.22], &["seat"]),
    row("table", Table, boxed(0.8, 0.8, 0.75), 18.0, Wood, [0.4, 0.33, 0.24], &["terrace"]),
    row("trash_bin", TrashBin, round(0.25, 0.9), 20.0, Metal, [0.05, 0.12, 0.07], &["bin", "litter", "rubbish"]),
    row("mailbox", Mailbox, boxed(0.4, 0.5, 1.2), 45.0, Metal, [0.05, 0.1, 0.4], &["letter", "post"]).can(&[Open]),
    fixed("hydrant", Hydrant, round(0.15, 0.8), Metal, [0.5, 0.04, 0.03], &["fire", "water"]),
    row("cone", Cone, round(0.18, 0.7), 3.0, Plastic, [0.8, 0.2, 0.02], &["traffic", "orange"]),
    fixed("bus_stop", BusStop, boxed(1.4, 4.0, 2.5), Glass, [0.3, 0.35, 0.38], &["shelter"]),
    row("parcel", Parcel, boxed(0.35, 0.25, 0.2), 2.0, Paper, [0.45, 0.3, 0.15], &["package", "box", "delivery"]),
    row("meal", Parcel, boxed(0.3, 0.3, 0.15), 1.0, Paper, [0.6, 0.5, 0.35], &["food", "bag", "delivery"]),
    row("small_car", Car, boxed(4.05, 1.75, 1.45), 1150.0, Metal, [0.5, 0.5, 0.52], &["hatchback", "passenger"]),
    row("car", Car, boxed(4.35, 1.8, 1.47), 1350.0, Metal, [0.55, 0.55, 0.57], &["sedan", "passenger"]),
    row("suv", Car, boxed(4.6, 1.87, 1.67), 1650.0, Metal, [0.1, 0.1, 0.12], &["large", "passenger"]),
    row("sports_car", Car, boxed(4.4, 1.85, 1.25), 1450.0, Metal, [0.55, 0.03, 0.02], &["coupe", "fast"]),
    row("van", Truck, boxed(5.6, 2.0, 2.5), 2200.0, Metal, [0.75, 0.75, 0.74], &["delivery", "transporter"]),
    row("truck", Truck, boxed(8.5, 2.5, 3.4), 9000.0, Metal, [0.25, 0.3, 0.4], &["lorry", "large"]),
    row("bus", Bus, boxed(12.0, 2.55, 3.1), 12_000.0, Metal, [0.6, 0.35, 0.05], &["city", "large"]),
    row("motorcycle", Motorcycle, boxed(2.1, 0.8, 1.2), 190.0, Metal, [0.05, 0.05, 0.06], &["motorbike"]),
    row("bicycle", Bicycle, boxed(1.75, 0.6, 1.1), 15.0, Metal, [0.1, 0.25, 0.3], &["bike", "cycle"]),
    row("scooter", Scooter, boxed(1.15, 0.5, 1.2), 20.0, Metal, [0.12, 0.35, 0.2], &["electric", "kick"]),
    row("person", Person, Shape::Capsule { radius: 0.25, height: 1.75 }, 75.0, Flesh, [0.3, 0.25, 0.3], &["human", "pedestrian"]),
    row("robot_dog", Dog, boxed(0.7, 0.35, 0.5), 15.0, Plastic, [0.6, 0.45, 0.05], &["robot", "quadruped"]),
    row("delivery_robot", Robot, boxed(0.7, 0.55, 0.6), 35.0, Plastic, [0.8, 0.8, 0.8], &["delivery", "sidewalk"]),
];

/// The assets of the table.
pub(super) fn assets() -> impl Iterator<Item = Asset> {
    ROWS.iter().map(Row::asset)
}
