//! Semantic classes: the label ids and colours of Cityscapes (Cordts et al. 2016, `labels.py`, column `id`).

use simworld_core::scene::EntityKind;

/// A class of the semantic buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Class {
    /// Cityscapes label id.
    pub id: u8,
    /// Cityscapes name.
    pub name: &'static str,
    /// Cityscapes colour, sRGB.
    pub color: [u8; 3],
}

const fn class(id: u8, name: &'static str, color: [u8; 3]) -> Class {
    Class { id, name, color }
}

/// The class of pixels on which there is nothing.
pub const SKY: Class = class(23, "sky", [70, 130, 180]);

/// Every class that a frame can hold, by ascending id.
pub const CLASSES: &[Class] = &[
    class(4, "static", [0, 0, 0]),
    class(5, "dynamic", [111, 74, 0]),
    class(7, "road", [128, 64, 128]),
    class(8, "sidewalk", [244, 35, 232]),
    class(11, "building", [70, 70, 70]),
    class(17, "pole", [153, 153, 153]),
    class(19, "traffic light", [250, 170, 30]),
    class(20, "traffic sign", [220, 220, 0]),
    class(21, "vegetation", [107, 142, 35]),
    class(22, "terrain", [152, 251, 152]),
    SKY,
    class(24, "person", [220, 20, 60]),
    class(26, "car", [0, 0, 142]),
    class(27, "truck", [0, 0, 70]),
    class(28, "bus", [0, 60, 100]),
    class(32, "motorcycle", [0, 0, 230]),
    class(33, "bicycle", [119, 11, 32]),
];

/// The Cityscapes label id of a kind of entity.
///
/// Crosswalks are road, as markings are in Cityscapes; street furniture is static; parcels, kick scooters, dogs and
/// robots are dynamic.
pub fn class_of(kind: EntityKind) -> u8 {
    match kind {
        EntityKind::Road | EntityKind::Crosswalk => 7,
        EntityKind::Sidewalk => 8,
        EntityKind::Building => 11,
        EntityKind::StreetLamp => 17,
        EntityKind::TrafficSignal => 19,
        EntityKind::Sign => 20,
        EntityKind::Tree | EntityKind::Shrub => 21,
        EntityKind::Ground => 22,
        EntityKind::Person => 24,
        EntityKind::Car => 26,
        EntityKind::Truck => 27,
        EntityKind::Bus => 28,
        EntityKind::Motorcycle => 32,
        EntityKind::Bicycle => 33,
        EntityKind::Parcel | EntityKind::Scooter | EntityKind::Dog | EntityKind::Robot => 5,
        _ => 4,
    }
}

/// The class of that id, if a frame can hold it.
pub fn class_by_id(id: u8) -> Option<&'static Class> {
    CLASSES.binary_search_by_key(&id, |class| class.id).ok().map(|index| &CLASSES[index])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_has_a_class_with_a_colour() {
        assert!(CLASSES.windows(2).all(|pair| pair[0].id < pair[1].id));
        for kind in EntityKind::ALL {
            assert!(class_by_id(class_of(*kind)).is_some(), "{kind}");
        }
        assert_eq!(class_by_id(SKY.id).map(|class| class.name), Some("sky"));
        assert!(class_by_id(0).is_none());
    }
}
