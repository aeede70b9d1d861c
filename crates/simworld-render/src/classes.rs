//! Semantic classes: the Cityscapes ids and palette, and which kind of entity belongs to which.

use simworld_core::scene::EntityKind;

/// The classes in use: Cityscapes id, name, palette colour (sRGB).
const CLASSES: [(u8, &str, [u8; 3]); 16] = [
    (0, "unlabeled", [0, 0, 0]),
    (5, "dynamic", [111, 74, 0]),
    (6, "ground", [81, 0, 81]),
    (7, "road", [128, 64, 128]),
    (8, "sidewalk", [244, 35, 232]),
    (11, "building", [70, 70, 70]),
    (17, "pole", [153, 153, 153]),
    (19, "traffic light", [250, 170, 30]),
    (20, "traffic sign", [220, 220, 0]),
    (21, "vegetation", [107, 142, 35]),
    (23, "sky", [70, 130, 180]),
    (24, "person", [220, 20, 60]),
    (26, "car", [0, 0, 142]),
    (27, "truck", [0, 0, 70]),
    (28, "bus", [0, 60, 100]),
    (33, "bicycle", [119, 11, 32]),
];

/// The Cityscapes class id of a kind of entity.
pub const fn class_of(kind: EntityKind) -> u8 {
    match kind {
        EntityKind::Ground => 6,
        EntityKind::Road | EntityKind::Crosswalk => 7,
        EntityKind::Sidewalk => 8,
        EntityKind::Building | EntityKind::BusStop => 11,
        EntityKind::StreetLamp => 17,
        EntityKind::TrafficSignal => 19,
        EntityKind::Sign => 20,
        EntityKind::Tree | EntityKind::Shrub => 21,
        EntityKind::Person => 24,
        EntityKind::Car => 26,
        EntityKind::Truck => 27,
        EntityKind::Bus => 28,
        EntityKind::Bicycle | EntityKind::Motorcycle | EntityKind::Scooter => 33,
        _ => 5,
    }
}

/// The name of a class; "unlabeled" for ids that are not in use.
pub fn class_name(class: u8) -> &'static str {
    CLASSES.iter().find(|(id, ..)| *id == class).map_or("unlabeled", |(_, name, _)| name)
}

/// The palette colour of a class, sRGB; black for ids that are not in use.
pub fn class_color(class: u8) -> [u8; 3] {
    CLASSES.iter().find(|(id, ..)| *id == class).map_or([0; 3], |(_, _, color)| *color)
}
