//! Semantic classes: the label ids and colours of Cityscapes (Cordts et al. 2016, `labels.py`, column `id`), and tables of
//! one's own.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use simworld_core::scene::{EntityKind, EntityRef, Scene};

use crate::{Frame, RenderError};

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

/// A class of a table of one's own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OwnClass {
    /// Its number in the class buffer.
    pub id: u8,
    /// What it is called.
    pub name: String,
    /// Its colour in the palette, sRGB.
    pub color: [u8; 3],
}

/// Which class everything is, by a table of one's own: first by the asset it was made from, then by its kind.
///
/// ```
/// use simworld_render::classes::ClassTable;
///
/// let table: ClassTable = serde_json::from_str(r#"{
///     "classes": [{ "id": 0, "name": "nothing", "color": [0, 0, 0] },
///                 { "id": 1, "name": "alive", "color": [220, 20, 60] },
///                 { "id": 2, "name": "kiosk", "color": [0, 90, 200] }],
///     "kinds": { "person": 1, "dog": 1 },
///     "assets": { "market_stall": 2 },
///     "other": 0,
///     "sky": 0
/// }"#)?;
/// table.validate()?;
/// assert_eq!(table.class(1).map(|class| class.name.as_str()), Some("alive"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ClassTable {
    /// Its classes.
    pub classes: Vec<OwnClass>,
    /// The class of a kind of entity.
    pub kinds: BTreeMap<EntityKind, u8>,
    /// The class of what was made from an asset, by the asset's name; goes before its kind.
    pub assets: BTreeMap<String, u8>,
    /// The class of everything else.
    pub other: u8,
    /// The class of pixels on which there is nothing.
    pub sky: u8,
}

impl Default for ClassTable {
    /// That of Cityscapes.
    fn default() -> Self {
        let own = |class: &Class| OwnClass { id: class.id, name: class.name.to_owned(), color: class.color };
        Self {
            classes: CLASSES.iter().map(own).collect(),
            kinds: EntityKind::ALL.iter().map(|kind| (*kind, class_of(*kind))).collect(),
            assets: BTreeMap::new(),
            other: 4,
            sky: SKY.id,
        }
    }
}

impl ClassTable {
    /// Checks that every class that something is given stands in the table once.
    ///
    /// # Errors
    /// A class that stands twice or not at all.
    pub fn validate(&self) -> Result<(), RenderError> {
        let fail = |reason: String| Err(RenderError::Classes { reason });
        for (index, class) in self.classes.iter().enumerate() {
            if let Some(twin) = self.classes[..index].iter().find(|other| other.id == class.id) {
                return fail(format!(
                    "{:?} and {:?} both have id {}: give one another",
                    twin.name, class.name, class.id
                ));
            }
        }
        let of_kinds = self.kinds.iter().map(|(kind, id)| (kind.as_str(), *id));
        let of_assets = self.assets.iter().map(|(name, id)| (name.as_str(), *id));
        let given = of_kinds.chain(of_assets).chain([("other", self.other), ("sky", self.sky)]);
        match given.into_iter().find(|(_, id)| self.class(*id).is_none()) {
            Some((what, id)) => {
                fail(format!("{what} is of class {id}, which is not among the classes: add it there"))
            }
            None => Ok(()),
        }
    }

    /// The class of that id, if the table has it.
    pub fn class(&self, id: u8) -> Option<&OwnClass> {
        self.classes.iter().find(|class| class.id == id)
    }

    /// The class of an entity.
    pub fn class_of(&self, scene: &dyn Scene, entity: &EntityRef<'_>) -> u8 {
        let of_asset = || {
            let asset = scene.assets()?.get(entity.info.asset?)?;
            self.assets.get(&asset.name)
        };
        let named = if self.assets.is_empty() { None } else { of_asset() };
        named.or_else(|| self.kinds.get(&entity.kind)).copied().unwrap_or(self.other)
    }

    /// Writes the classes of a frame anew, by this table, from its ids; the scene must be the one it was taken of.
    pub fn relabel(&self, scene: &dyn Scene, frame: &mut Frame) {
        let of = |id: &simworld_core::id::EntityId| {
            scene.entity(*id).map_or(self.other, |entity| self.class_of(scene, &entity))
        };
        let classes: Vec<u8> = frame.drawn.iter().map(of).collect();
        let class_of_slot = |slot: usize| {
            let position = frame.drawn.binary_search_by_key(&slot, |id| id.index()).ok()?;
            classes.get(position).copied()
        };
        let mut last = (0, self.sky);
        frame.classes.clear();
        frame.classes.extend(frame.ids.iter().map(|id| {
            if *id != last.0 {
                let class =
                    (*id as usize).checked_sub(1).map(|slot| class_of_slot(slot).unwrap_or(self.other));
                last = (*id, class.unwrap_or(self.sky));
            }
            last.1
        }));
    }

    /// The colours of all 256 numbers, three bytes each; black where the table has no class.
    pub fn palette(&self) -> Vec<u8> {
        (0..=u8::MAX).flat_map(|id| self.class(id).map_or([0; 3], |class| class.color)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_table_is_that_of_cityscapes_and_faults_are_named() {
        let mut table = ClassTable::default();
        assert!(table.validate().is_ok());
        assert!(EntityKind::ALL.iter().all(|kind| table.kinds[kind] == class_of(*kind)));
        table.kinds.insert(EntityKind::Dog, 99);
        let error = table.validate().unwrap_err().to_string();
        assert!(error.contains("dog is of class 99"), "{error}");
        table = ClassTable::default();
        table.classes.push(OwnClass { id: 24, name: "people".into(), color: [1; 3] });
        let error = table.validate().unwrap_err().to_string();
        assert!(error.contains("\"person\" and \"people\" both have id 24"), "{error}");
    }

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
