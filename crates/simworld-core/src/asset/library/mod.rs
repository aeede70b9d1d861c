//! The library: beyond the ordinary things of a street what towns, parks, roads and building sites hold.

mod buildings;
mod characters;
mod furniture;
mod models;
mod props;
mod released;
mod vegetation;
mod vehicles;

use super::Asset;
use super::row::Row;

/// The street elements that the Python release names, and what they are here. What it calls a can, a cart or rubbish has no
/// published look; its boxes of 2.56 m for all of them are no sizes.
const ELEMENTS: &[(&str, &str)] = &[
    ("bp_box", "cardboard_box"),
    ("bp_box2", "large_box"),
    ("bp_box3", "stack_of_boxes"),
    ("bp_can", "metal_can"),
    ("bp_can2", "jerry_can"),
    ("bp_cart", "hand_cart"),
    ("bp_cart2", "shopping_cart"),
    ("bp_couch", "couch"),
    ("bp_hydrant", "hydrant"),
    ("bp_rabbish", "rubbish_pile"),
    ("bp_roadblocker", "road_blocker"),
    ("bp_roadcone", "cone"),
    ("bp_scooter_01", "scooter"),
    ("bp_scooter_02", "scooter_2"),
    ("bp_scooter_03", "scooter_3"),
    ("bp_scooter_04", "scooter_4"),
    ("bp_soda1", "soda_1"),
    ("bp_soda2", "soda_2"),
    ("bp_soda3", "soda_3"),
    ("bp_soda4", "soda_4"),
    ("bp_table", "table"),
    ("bp_table2", "round_table"),
    ("bp_table3", "long_table"),
    ("bp_trash_bin_a", "trash_bin"),
    ("bp_trash_bin_b", "trash_bin_b"),
    ("bp_trash_can", "metal_trash_can"),
    ("bp_tree1", "tree_1"),
    ("bp_tree2", "tree_2"),
    ("bp_tree3", "tree_3"),
    ("bp_tree4", "tree_4"),
    ("bp_tree5", "tree_5"),
    ("bp_tree6", "tree_6"),
    ("bp_hospital", "building_87"),
    ("bp_school", "building_88"),
];

/// The assets of all tables, in an order that never changes, with their models.
pub(super) fn assets() -> impl Iterator<Item = Asset> {
    rows().map(|row| models::modelled(row.asset()))
}

/// The rows of all tables.
fn rows() -> impl Iterator<Item = &'static Row> {
    let tables = [
        furniture::ROWS,
        props::ROWS,
        vegetation::ROWS,
        vehicles::ROWS,
        characters::ROWS,
        buildings::ROWS,
        released::ROWS,
    ];
    tables.into_iter().flatten()
}

/// The name here of a class of the Python release, such as `BP_Building_07_C`; none if it names no asset.
pub(super) fn released_as(class: &str) -> Option<String> {
    let class = class.to_ascii_lowercase();
    let class = class.strip_suffix("_c").unwrap_or(&class);
    if let Some((_, name)) = ELEMENTS.iter().find(|(named, _)| *named == class) {
        return Some((*name).to_owned());
    }
    let number: u32 = class.strip_prefix("bp_building_")?.parse().ok()?;
    let name = format!("building_{number:02}");
    released::ROWS.iter().any(|row| row.name == name).then_some(name)
}

#[cfg(test)]
mod tests {
    use std::collections::{BTreeMap, BTreeSet};

    use super::*;
    use crate::asset::{Affordance, Catalogue, Material};
    use crate::scene::{EntityKind, Shape};

    /// Least and greatest length of the longest side, height (m) and mass (kg) of a kind.
    fn prior(kind: EntityKind) -> ([f64; 2], [f64; 2], [f64; 2]) {
        match kind {
            EntityKind::Building => ([2.5, 250.0], [2.0, 450.0], [0.0, 0.0]),
            EntityKind::Tree => ([0.05, 1.2], [2.0, 30.0], [0.0, 0.0]),
            EntityKind::Shrub => ([0.4, 3.5], [0.2, 4.5], [0.0, 0.0]),
            EntityKind::StreetLamp | EntityKind::TrafficSignal => ([0.1, 0.5], [2.0, 14.0], [0.0, 0.0]),
            EntityKind::Sign => ([0.05, 6.5], [0.8, 10.0], [0.0, 20.0]),
            EntityKind::Bench => ([1.5, 3.5], [0.4, 1.1], [30.0, 800.0]),
            EntityKind::Chair => ([0.3, 1.2], [0.4, 1.1], [2.0, 40.0]),
            EntityKind::Table => ([0.6, 3.0], [0.4, 1.0], [5.0, 500.0]),
            EntityKind::TrashBin => ([0.3, 4.0], [0.5, 1.8], [5.0, 100.0]),
            EntityKind::Mailbox => ([0.3, 3.0], [1.0, 2.5], [20.0, 80.0]),
            EntityKind::Hydrant => ([0.2, 0.5], [0.5, 1.2], [0.0, 0.0]),
            EntityKind::Cone => ([0.15, 0.8], [0.3, 1.2], [0.5, 10.0]),
            EntityKind::BusStop => ([2.0, 6.0], [2.0, 3.5], [0.0, 0.0]),
            EntityKind::Parcel => ([0.05, 1.2], [0.004, 1.2], [0.01, 16.0]),
            EntityKind::Car => ([2.3, 5.6], [1.1, 2.0], [400.0, 2600.0]),
            EntityKind::Truck => ([2.5, 18.75], [1.5, 4.0], [1500.0, 18_000.0]),
            EntityKind::Bus => ([6.0, 18.75], [2.5, 4.5], [3000.0, 19_000.0]),
            EntityKind::Motorcycle => ([1.5, 2.6], [0.9, 1.4], [70.0, 400.0]),
            EntityKind::Bicycle => ([1.0, 2.8], [0.7, 1.3], [6.0, 60.0]),
            EntityKind::Scooter => ([0.8, 1.5], [0.9, 1.4], [8.0, 40.0]),
            EntityKind::Person => ([0.3, 0.8], [1.0, 2.1], [20.0, 130.0]),
            EntityKind::Dog => ([0.3, 1.2], [0.2, 0.9], [3.0, 70.0]),
            EntityKind::Robot => ([0.3, 1.5], [0.3, 2.0], [10.0, 250.0]),
            EntityKind::Prop => ([0.1, 7.0], [0.03, 12.5], [0.3, 3000.0]),
            other => panic!("the library has no {other}"),
        }
    }

    #[test]
    fn every_row_is_sound_and_sized_as_its_kind() {
        let library = Catalogue::library();
        let rows = Catalogue::standard().len() + assets().count();
        assert_eq!(library.len(), rows, "every row is sound and has a name of its own");
        for (_, asset) in library.iter() {
            let (name, size) = (&asset.name, asset.collider.size());
            let (side, height, mass) = prior(asset.kind);
            assert!(
                (side[0]..=side[1]).contains(&size.x.max(size.y)),
                "{name} is {} m long",
                size.x.max(size.y)
            );
            assert!((height[0]..=height[1]).contains(&size.z), "{name} is {} m high", size.z);
            if let Some(kilograms) = asset.mass {
                assert!((mass[0]..=mass[1]).contains(&kilograms), "{name} weighs {kilograms} kg");
            }
            assert!(
                asset.material.is_some() && asset.color.is_some(),
                "{name} is of nothing, or has no colour"
            );
            assert!(!asset.source.is_empty() && !asset.licence.is_empty(), "{name} comes from nowhere");
            let tags: BTreeSet<&String> = asset.tags.iter().collect();
            assert_eq!(tags.len(), asset.tags.len(), "{name} has a tag twice");
        }
    }

    #[test]
    fn nothing_weighs_more_than_a_full_piece_of_what_it_is_made_of() {
        for (_, asset) in Catalogue::library().iter() {
            let (Some(mass), Some(material)) = (asset.mass, asset.material) else { continue };
            let size = asset.collider.size();
            let share =
                if matches!(asset.collider, Shape::Box { .. }) { 1.0 } else { std::f64::consts::FRAC_PI_4 };
            let full = size.x * size.y * size.z * share * material.density();
            let is_filled = ["metal_can", "cement_bags", "snowman"].contains(&asset.name.as_str());
            assert!(
                is_filled || mass <= full * 1.02,
                "{} weighs {mass} kg of {full} kg of {material}",
                asset.name
            );
        }
    }

    #[test]
    fn there_is_enough_of_everything() {
        let mut count: BTreeMap<&str, usize> = BTreeMap::new();
        let mut seasonal = 0;
        for (_, asset) in Catalogue::library().iter() {
            let class = match asset.kind {
                EntityKind::Building => "building",
                EntityKind::Tree | EntityKind::Shrub => "plant",
                kind if kind.is_vehicle() => "vehicle",
                kind if kind.is_mobile() => "character",
                _ => "prop",
            };
            *count.entry(class).or_default() += 1;
            seasonal += usize::from(asset.seasons.is_some());
        }
        for (class, least) in
            [("building", 180), ("plant", 30), ("vehicle", 40), ("character", 25), ("prop", 120)]
        {
            assert!(count[class] >= least, "{class}: {}", count[class]);
        }
        assert!(seasonal >= 25, "{seasonal} plants have seasons");
    }

    #[test]
    fn every_name_of_the_release_stands_for_an_asset() {
        let library = Catalogue::library();
        let missing = [57, 120];
        let buildings = (1..=126).filter(|number| !missing.contains(number));
        let mut found: BTreeSet<_> = buildings
            .map(|number| {
                let class = format!("BP_Building_{number:02}_C");
                library.find_released(&class).unwrap_or_else(|| panic!("{class}"))
            })
            .collect();
        assert_eq!(found.len(), 124);
        let elements = ELEMENTS.iter().filter(|(_, name)| !name.starts_with("building"));
        for (class, _) in elements {
            assert!(
                found.insert(library.find_released(class).unwrap_or_else(|| panic!("{class}"))),
                "{class}"
            );
        }
        assert_eq!(found.len(), 124 + 32);
        for stranger in ["BP_Building_57_C", "BP_Building_999_C", "BP_Building_-1_C", "BP_Zeppelin_C", ""] {
            assert_eq!(library.find_released(stranger), None, "{stranger}");
        }
    }

    /// What the paper names: residential, commercial and industrial buildings; trees, grass and shrubs; benches, mailboxes, lamp
    /// posts and traffic signs; road cones, parked vehicles; humans, vehicles, quadrupeds and other robots; scooters.
    #[test]
    fn the_kinds_of_the_paper_are_there_by_name() {
        let library = Catalogue::library();
        for name in [
            "apartment_block",
            "house",
            "shop",
            "office_tower",
            "factory",
            "warehouse",
            "hospital",
            "museum",
            "school",
            "restaurant",
            "tree",
            "tall_grass",
            "lawn",
            "shrub",
            "bench",
            "chair",
            "mailbox",
            "street_lamp",
            "stop_sign",
            "traffic_signal",
            "hydrant",
            "trash_bin",
            "cone",
            "car",
            "sports_car",
            "bus",
            "truck",
            "motorcycle",
            "scooter",
            "bicycle",
            "person",
            "robot_dog",
            "humanoid_robot",
            "delivery_robot",
            "charging_station",
        ] {
            assert!(library.find(name).is_some(), "{name}");
        }
    }

    #[test]
    fn things_afford_what_they_are_for() {
        let library = Catalogue::library();
        for (name, affordance, can) in [
            ("couch", Affordance::Sit, true),
            ("boulder", Affordance::Sit, true),
            ("boulder", Affordance::Carry, false),
            ("bollard", Affordance::Carry, false),
            ("dumpster", Affordance::Open, true),
            ("backpack", Affordance::PickUp, true),
            ("backpack", Affordance::Open, true),
            ("ladder", Affordance::Carry, true),
            ("scooter_2", Affordance::Ride, true),
            ("taxi", Affordance::Enter, true),
            ("statue", Affordance::PickUp, false),
        ] {
            let asset = library.get(library.find(name).unwrap()).unwrap();
            assert_eq!(asset.affordances().contains(affordance), can, "{name}: {affordance}");
        }
        let fixed = library.iter().filter(|(_, asset)| asset.mass.is_none());
        for (_, asset) in fixed {
            let can = asset.affordances();
            assert!(!can.contains(Affordance::Carry) && !can.contains(Affordance::PickUp), "{}", asset.name);
            assert_ne!(asset.material, Some(Material::Flesh), "{}", asset.name);
        }
    }
}
