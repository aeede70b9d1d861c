//! The table of classes.
//!
//! Sizes are those of things as sold or built: cars by European registrations; furniture by EN 1729 and DIN 68880 to the nearest
//! 5 cm; street furniture by makers' catalogues; people by DIN 33402; animals by breed standards. Shares of solid are fitted, so
//! that a thing of the typical size that fills the usual part of its box (half for a car, a tenth for a chair) has the typical
//! mass.

use simworld_core::asset::Material;
use simworld_core::scene::EntityKind;

/// Names with their synonyms, kind, length, width and height in metres, how many times larger or smaller one may be, what it
/// is made of, and which share of the room inside its surface is that (none: it is fixed to the ground).
pub(super) type Row = (&'static [&'static str], EntityKind, [f64; 3], f64, Material, Option<f64>);

use EntityKind::{
    Bench, Bicycle, Building, Bus, BusStop, Car, Chair, Cone, Dog, Hydrant, Mailbox, Motorcycle, Parcel,
    Person, Prop, Robot, Scooter, Shrub, Sign, StreetLamp, Table, TrafficSignal, TrashBin, Tree, Truck,
};
use Material::{Concrete, Fabric, Flesh, Glass, Metal, Paper, Plastic, Rubber, Stone, Wood};

#[rustfmt::skip]
pub(super) const ROWS: &[Row] = &[
    (&["car", "sedan", "taxi", "hatchback", "coupe", "limousine", "jeep"], Car, [4.4, 1.8, 1.45], 1.8, Metal, Some(0.025)),
    (&["van", "minibus", "camper", "ambulance"], Truck, [5.6, 2.0, 2.4], 1.8, Metal, Some(0.016)),
    (&["truck", "lorry", "fire engine"], Truck, [8.5, 2.5, 3.4], 2.2, Metal, Some(0.028)),
    (&["bus", "coach", "tram"], Bus, [12.0, 2.55, 3.1], 2.2, Metal, Some(0.018)),
    (&["tractor", "excavator", "bulldozer"], Truck, [4.5, 2.2, 2.8], 2.2, Metal, Some(0.05)),
    (&["motorcycle", "motorbike", "moped"], Motorcycle, [2.1, 0.8, 1.2], 1.8, Metal, Some(0.07)),
    (&["bicycle", "bike", "tricycle"], Bicycle, [1.75, 0.6, 1.1], 1.8, Metal, Some(0.06)),
    (&["scooter", "kick scooter"], Scooter, [1.15, 0.5, 1.2], 1.8, Metal, Some(0.08)),
    (&["boat", "dinghy", "canoe", "kayak"], Prop, [4.5, 1.6, 1.0], 3.0, Wood, Some(0.15)),
    (&["bench"], Bench, [0.6, 1.8, 0.85], 2.0, Wood, Some(0.6)),
    (&["chair", "armchair", "throne"], Chair, [0.55, 0.55, 0.9], 2.0, Wood, Some(0.5)),
    (&["stool"], Chair, [0.4, 0.4, 0.55], 2.0, Wood, Some(0.6)),
    (&["sofa", "couch", "settee"], Bench, [0.9, 2.0, 0.85], 2.0, Fabric, Some(0.15)),
    (&["table", "desk"], Table, [0.8, 1.3, 0.75], 2.5, Wood, Some(0.9)),
    (&["picnic table"], Table, [1.6, 1.8, 0.75], 2.0, Wood, Some(0.9)),
    (&["bed", "mattress"], Prop, [2.0, 1.5, 0.7], 2.0, Fabric, Some(0.15)),
    (&["bookshelf", "bookcase", "shelf", "cupboard", "wardrobe", "cabinet"], Prop, [0.4, 1.0, 1.9], 2.2, Wood, Some(0.25)),
    (&["piano"], Prop, [0.65, 1.5, 1.2], 2.0, Wood, Some(0.5)),
    (&["television", "tv", "screen", "monitor"], Prop, [0.15, 1.1, 0.65], 3.0, Plastic, Some(0.4)),
    (&["crate", "chest", "box"], Prop, [0.6, 0.8, 0.6], 3.0, Wood, Some(0.2)),
    (&["barrel", "cask", "drum"], Prop, [0.6, 0.6, 0.9], 2.0, Wood, Some(0.35)),
    (&["bucket", "pail"], Prop, [0.3, 0.3, 0.3], 2.0, Plastic, Some(0.06)),
    (&["basket"], Prop, [0.35, 0.45, 0.35], 2.0, Wood, Some(0.1)),
    (&["suitcase", "trunk"], Prop, [0.25, 0.45, 0.65], 2.0, Plastic, Some(0.07)),
    (&["backpack", "bag", "handbag"], Parcel, [0.25, 0.35, 0.45], 2.5, Fabric, Some(0.15)),
    (&["parcel", "package", "carton"], Parcel, [0.35, 0.25, 0.2], 3.0, Paper, Some(0.15)),
    (&["vase", "urn", "jar", "jug"], Prop, [0.25, 0.25, 0.4], 3.0, Stone, Some(0.15)),
    (&["flower pot", "flowerpot", "planter", "pot"], Prop, [0.6, 0.6, 0.5], 3.0, Concrete, Some(0.35)),
    (&["bottle"], Parcel, [0.08, 0.08, 0.3], 2.0, Glass, Some(0.3)),
    (&["cup", "mug", "bowl", "teapot", "kettle"], Parcel, [0.15, 0.15, 0.13], 2.5, Stone, Some(0.25)),
    (&["ball", "football", "basketball"], Prop, [0.22, 0.22, 0.22], 2.5, Rubber, Some(0.07)),
    (&["umbrella", "parasol", "sunshade"], Prop, [2.5, 2.5, 2.5], 2.5, Metal, Some(0.01)),
    (&["tent", "gazebo", "pavilion"], Prop, [3.0, 3.0, 2.4], 2.5, Fabric, Some(0.01)),
    (&["market stall", "stall", "booth", "stand"], Prop, [2.0, 2.5, 2.5], 2.0, Wood, Some(0.1)),
    (&["kiosk", "phone box", "telephone box", "telephone booth", "phone booth"], Prop, [1.2, 1.2, 2.5], 2.5, Metal, Some(0.02)),
    (&["trash bin", "trash can", "bin", "litter bin", "dustbin", "garbage can"], TrashBin, [0.5, 0.5, 0.9], 2.0, Metal, Some(0.02)),
    (&["dumpster", "skip", "container"], TrashBin, [1.4, 2.0, 1.4], 3.0, Metal, Some(0.02)),
    (&["mailbox", "letter box", "letterbox", "postbox", "post box"], Mailbox, [0.4, 0.5, 1.2], 2.0, Metal, Some(0.03)),
    (&["hydrant"], Hydrant, [0.35, 0.35, 0.8], 2.0, Metal, None),
    (&["traffic cone", "cone"], Cone, [0.36, 0.36, 0.7], 2.0, Plastic, Some(0.1)),
    (&["bollard"], Prop, [0.2, 0.2, 0.9], 2.0, Metal, None),
    (&["barrier", "barricade", "roadblock"], Prop, [0.5, 1.8, 1.0], 2.5, Plastic, Some(0.1)),
    (&["fence", "railing", "hedge"], Prop, [0.1, 2.0, 1.1], 5.0, Wood, None),
    (&["gate", "door", "portal"], Prop, [0.15, 1.5, 2.0], 3.0, Wood, None),
    (&["wall"], Prop, [0.25, 3.0, 2.0], 4.0, Stone, None),
    (&["arch", "archway", "triumphal arch"], Prop, [1.0, 3.5, 3.5], 3.5, Stone, None),
    (&["column", "pillar", "obelisk"], Prop, [0.7, 0.7, 3.5], 3.5, Stone, None),
    (&["statue", "sculpture", "monument", "bust"], Prop, [0.9, 0.9, 2.2], 3.5, Stone, None),
    (&["fountain"], Prop, [3.0, 3.0, 2.0], 3.0, Stone, None),
    (&["well"], Prop, [1.5, 1.5, 2.0], 2.0, Stone, None),
    (&["sign", "signpost", "street sign"], Sign, [0.1, 0.6, 2.4], 2.5, Metal, None),
    (&["billboard"], Sign, [0.5, 4.0, 4.0], 2.5, Metal, None),
    (&["lamp post", "lamppost", "street lamp", "streetlight", "street light", "lamp", "lantern"], StreetLamp, [0.6, 0.4, 5.0], 2.5, Metal, None),
    (&["traffic light", "traffic signal"], TrafficSignal, [0.4, 0.4, 3.5], 2.5, Metal, None),
    (&["flag", "flag pole", "flagpole", "mast"], Prop, [0.3, 1.2, 7.0], 3.0, Metal, None),
    (&["bus stop", "shelter", "bus shelter"], BusStop, [1.4, 4.0, 2.5], 2.0, Glass, None),
    (&["clock", "clock tower"], Prop, [3.5, 3.5, 12.0], 3.5, Stone, None),
    (&["tree", "oak", "palm", "pine", "fir", "linden"], Tree, [5.0, 5.0, 8.0], 3.0, Wood, None),
    (&["shrub", "bush", "plant", "flower"], Shrub, [0.8, 0.8, 0.8], 3.0, Wood, None),
    (&["rock", "stone", "boulder"], Prop, [1.0, 1.0, 0.7], 4.0, Stone, Some(1.0)),
    (&["pumpkin", "melon"], Prop, [0.3, 0.3, 0.25], 2.5, Flesh, Some(0.6)),
    (&["snowman", "scarecrow"], Prop, [0.8, 0.9, 1.6], 2.0, Wood, Some(0.3)),
    (&["ladder"], Prop, [0.15, 0.5, 2.5], 3.0, Wood, Some(0.7)),
    (&["wheelbarrow", "handcart"], Prop, [1.4, 0.65, 0.65], 2.0, Metal, Some(0.03)),
    (&["cart", "wagon", "carriage"], Prop, [2.4, 1.2, 1.4], 2.0, Wood, Some(0.2)),
    (&["slide"], Prop, [3.0, 0.8, 2.0], 2.0, Metal, None),
    (&["swing", "seesaw"], Prop, [2.0, 3.0, 2.2], 2.5, Wood, None),
    (&["shed", "hut", "cabin", "garage"], Building, [3.5, 3.5, 2.8], 2.5, Wood, None),
    (&["house", "cottage", "villa", "shop", "cafe"], Building, [10.0, 10.0, 8.0], 3.0, Stone, None),
    (&["building", "tower block", "church", "hotel", "office"], Building, [18.0, 18.0, 18.0], 4.0, Stone, None),
    (&["tower", "lighthouse", "water tower", "windmill", "skyscraper"], Building, [8.0, 8.0, 25.0], 4.0, Stone, None),
    (&["bridge", "footbridge"], Prop, [8.0, 2.5, 1.8], 3.0, Stone, None),
    (&["person", "man", "woman", "human"], Person, [0.4, 0.55, 1.75], 1.6, Flesh, Some(1.0)),
    (&["child", "boy", "girl"], Person, [0.3, 0.4, 1.2], 1.6, Flesh, Some(1.0)),
    (&["dog", "robot dog"], Dog, [0.8, 0.3, 0.6], 2.5, Flesh, Some(1.0)),
    (&["cat", "rabbit", "fox"], Prop, [0.5, 0.2, 0.3], 2.5, Flesh, Some(1.0)),
    (&["horse", "cow", "donkey", "camel"], Prop, [2.3, 0.65, 1.6], 2.0, Flesh, Some(1.0)),
    (&["elephant", "dinosaur"], Prop, [5.0, 2.0, 3.0], 3.0, Flesh, Some(1.0)),
    (&["bird", "duck", "pigeon", "owl"], Prop, [0.35, 0.2, 0.25], 3.0, Flesh, Some(0.8)),
    (&["robot", "delivery robot"], Robot, [0.7, 0.55, 0.8], 2.5, Metal, Some(0.04)),
];
