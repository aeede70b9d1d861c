//! The ordinary things of a street.
//!
//! Sizes are typical ones: passenger cars by class as in European registrations (B 4.05 x 1.75 x 1.45 m, 1150 kg; C 4.35 x
//! 1.80 m, 1350 kg; SUV 4.6 x 1.87 x 1.67 m, 1650 kg), a city bus of 12 m, people of 1.75 m and 75 kg, furniture as sold.

use super::Asset;
use crate::scene::{EntityKind, Shape};

const SOURCE: &str = "simworld, procedural";

const fn boxed(length: f64, width: f64, height: f64) -> Shape {
    Shape::Box { size: crate::geometry::Vector3::new(length, width, height) }
}

const fn round(radius: f64, height: f64) -> Shape {
    Shape::Cylinder { radius, height }
}

/// A row: name, kind, collider, mass in kg or none, colour, tags.
type Row = (&'static str, EntityKind, Shape, Option<f64>, [f32; 3], &'static [&'static str]);

use EntityKind::{
    Bench, Bicycle, Bus, BusStop, Car, Chair, Cone, Dog, Hydrant, Mailbox, Motorcycle, Parcel, Person, Robot,
    Scooter, Shrub, Sign, StreetLamp, Table, TrafficSignal, TrashBin, Tree, Truck,
};

#[rustfmt::skip]
const ROWS: &[Row] = &[
    ("tree", Tree, round(0.18, 7.0), None, [0.08, 0.2, 0.06], &["linden", "plant"]),
    ("tall_tree", Tree, round(0.3, 14.0), None, [0.07, 0.18, 0.06], &["plane", "plant", "large"]),
    ("shrub", Shrub, boxed(0.7, 1.6, 0.9), None, [0.1, 0.22, 0.07], &["hedge", "bush", "plant"]),
    ("street_lamp", StreetLamp, round(0.09, 6.0), None, [0.12, 0.12, 0.13], &["light", "post"]),
    ("traffic_signal", TrafficSignal, round(0.08, 3.5), None, [0.1, 0.1, 0.1], &["light", "traffic", "post"]),
    ("sign", Sign, round(0.05, 2.4), None, [0.5, 0.5, 0.5], &["post"]),
    ("bench", Bench, boxed(0.6, 1.8, 0.85), Some(60.0), [0.3, 0.19, 0.1], &["seat", "wooden"]),
    ("chair", Chair, boxed(0.5, 0.5, 0.85), Some(5.0), [0.35, 0.3, 0.22], &["seat"]),
    ("table", Table, boxed(0.8, 0.8, 0.75), Some(18.0), [0.4, 0.33, 0.24], &["terrace"]),
    ("trash_bin", TrashBin, round(0.25, 0.9), Some(20.0), [0.05, 0.12, 0.07], &["bin", "litter", "rubbish"]),
    ("mailbox", Mailbox, boxed(0.4, 0.5, 1.2), Some(45.0), [0.05, 0.1, 0.4], &["letter", "post"]),
    ("hydrant", Hydrant, round(0.15, 0.8), None, [0.5, 0.04, 0.03], &["fire", "water"]),
    ("cone", Cone, round(0.18, 0.7), Some(3.0), [0.8, 0.2, 0.02], &["traffic", "orange"]),
    ("bus_stop", BusStop, boxed(1.4, 4.0, 2.5), None, [0.3, 0.35, 0.38], &["shelter"]),
    ("parcel", Parcel, boxed(0.35, 0.25, 0.2), Some(2.0), [0.45, 0.3, 0.15], &["package", "box", "delivery"]),
    ("meal", Parcel, boxed(0.3, 0.3, 0.15), Some(1.0), [0.6, 0.5, 0.35], &["food", "bag", "delivery"]),
    ("small_car", Car, boxed(4.05, 1.75, 1.45), Some(1150.0), [0.5, 0.5, 0.52], &["hatchback", "passenger"]),
    ("car", Car, boxed(4.35, 1.8, 1.47), Some(1350.0), [0.55, 0.55, 0.57], &["sedan", "passenger"]),
    ("suv", Car, boxed(4.6, 1.87, 1.67), Some(1650.0), [0.1, 0.1, 0.12], &["large", "passenger"]),
    ("sports_car", Car, boxed(4.4, 1.85, 1.25), Some(1450.0), [0.55, 0.03, 0.02], &["coupe", "fast"]),
    ("van", Truck, boxed(5.6, 2.0, 2.5), Some(2200.0), [0.75, 0.75, 0.74], &["delivery", "transporter"]),
    ("truck", Truck, boxed(8.5, 2.5, 3.4), Some(9000.0), [0.25, 0.3, 0.4], &["lorry", "large"]),
    ("bus", Bus, boxed(12.0, 2.55, 3.1), Some(12_000.0), [0.6, 0.35, 0.05], &["city", "large"]),
    ("motorcycle", Motorcycle, boxed(2.1, 0.8, 1.2), Some(190.0), [0.05, 0.05, 0.06], &["motorbike"]),
    ("bicycle", Bicycle, boxed(1.75, 0.6, 1.1), Some(15.0), [0.1, 0.25, 0.3], &["bike", "cycle"]),
    ("scooter", Scooter, boxed(1.15, 0.5, 1.2), Some(20.0), [0.12, 0.35, 0.2], &["electric", "kick"]),
    ("person", Person, Shape::Capsule { radius: 0.25, height: 1.75 }, Some(75.0), [0.3, 0.25, 0.3], &["human", "pedestrian"]),
    ("robot_dog", Dog, boxed(0.7, 0.35, 0.5), Some(15.0), [0.6, 0.45, 0.05], &["robot", "quadruped"]),
    ("delivery_robot", Robot, boxed(0.7, 0.55, 0.6), Some(35.0), [0.8, 0.8, 0.8], &["delivery", "sidewalk"]),
];

/// The assets of the table.
pub(super) fn assets() -> impl Iterator<Item = Asset> {
    ROWS.iter().map(|(name, kind, collider, mass, color, tags)| {
        let asset = Asset::new(*name, *kind, *collider).tagged(tags.iter().copied());
        Asset { mass: *mass, color: Some(*color), source: SOURCE.to_owned(), ..asset }
    })
}
