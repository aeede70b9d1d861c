//! Things by what they are called: which mesh stands for an asset of the library.

use crate::mesh::MeshId;

/// Words in names of assets and the meshes they stand for; the first that fits is taken.
const NAMED: &[(&[&str], MeshId)] = &[
    (&["bollard", "delineator", "parking_meter", "sundial"], MeshId::Bollard),
    (&["hoop"], MeshId::Frame),
    (&["football", "basketball"], MeshId::Ball),
    (&["barrel", "drum", "metal_can", "soda", "bottle", "bucket", "cup"], MeshId::Barrel),
    (&["planter"], MeshId::Planter),
    (&["picket"], MeshId::PicketFence),
    (&["railing", "guard_rail"], MeshId::Railing),
    (&["crowd_barrier", "construction_fence"], MeshId::SiteFence),
    (&["road_blocker", "roadblocker"], MeshId::Barricade),
    (&["concrete_barrier"], MeshId::Jersey),
    (&["newsstand", "food_cart"], MeshId::Kiosk),
    (&["market_stall"], MeshId::Stall),
    (&["parasol"], MeshId::Parasol),
    (&["vending", "cash_machine", "charging_point", "newspaper_box"], MeshId::Machine),
    (&["phone_booth"], MeshId::Booth),
    (&["utility_box", "transformer", "portable_toilet", "generator", "heat_pump", "locker"], MeshId::Cabinet),
    (&["bicycle_rack"], MeshId::Rack),
    (&["fountain", "bird_bath", "well"], MeshId::Fountain),
    (&["statue", "bust", "snowman", "memorial"], MeshId::Statue),
    (&["obelisk"], MeshId::Obelisk),
    (&["container", "site_cabin", "dumpster"], MeshId::Container),
    (&["crate", "pallet", "stack_of_boxes"], MeshId::Crate),
    (&["pile", "campfire", "fire_pit"], MeshId::Heap),
    (&["awning_tent", "gazebo", "pergola"], MeshId::Pavilion),
    (&["tent"], MeshId::Tent),
    (&["utility_pole", "surveillance", "weather_station"], MeshId::Mast),
    (&["flagpole"], MeshId::Flag),
    (&["goal", "swing", "climbing", "scaffold"], MeshId::Frame),
    (&["boat"], MeshId::Boat),
    (&["stop_sign"], MeshId::StopSign),
    (&["yield_sign"], MeshId::YieldSign),
    (&["street_name", "direction_sign"], MeshId::NameSign),
    (&["information_board", "billboard", "banner"], MeshId::Board),
    (&["advertising_column"], MeshId::PosterColumn),
    (&["park_lantern"], MeshId::Lantern),
    (&["double_street_lamp", "floodlight"], MeshId::DoubleLamp),
    (&["pedestrian_signal"], MeshId::WalkSignal),
    (&["clock_post"], MeshId::Lantern),
];

/// The mesh of an asset of that name, if it has one of its own.
pub(super) fn named(name: &str) -> Option<MeshId> {
    NAMED.iter().find(|(words, _)| words.iter().any(|word| name.contains(word))).map(|(_, mesh)| *mesh)
}
