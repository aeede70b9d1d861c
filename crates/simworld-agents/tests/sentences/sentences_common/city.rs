//! Cities as data.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;
use simworld_core::action::ActionSet;
use simworld_core::asset::Catalogue;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::{AssetId, EntityId};
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::{EntityDesc, EntityKind, Place, Scene, Shape, World};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Thing {
    kind: String,
    at: [f64; 2],
    /// Degrees from east.
    #[serde(default)]
    facing: f64,
    size: Option<[f64; 3]>,
    name: Option<String>,
    place: Option<String>,
    access: Option<[f64; 2]>,
    color: Option<String>,
    sells: Option<String>,
    #[serde(default)]
    locked: bool,
    #[serde(default)]
    open: bool,
    signal_group: Option<i64>,
    area: Option<String>,
    /// Of the library.
    asset: Option<String>,
}

/// A city and what its things are called in the tables.
pub(crate) struct City {
    pub(crate) world: World,
    pub(crate) me: EntityId,
    pub(crate) ids: BTreeMap<String, EntityId>,
}

impl City {
    pub(crate) fn read(name: &str) -> Self {
        let path = format!("{}/tests/sentences/{name}.city.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
        let things: BTreeMap<String, Thing> =
            toml::from_str(&text).unwrap_or_else(|error| panic!("{path}: {error}"));
        let mut world = World::new();
        let roads_of = |plan: &StreetPlan| RoadNetwork::derive(plan, &NetworkConfig::default());
        let mut plan = StreetPlan::grid(3, 3, 100.0);
        if name == "quarter" {
            name_streets(&mut plan);
        } else if name != "town" {
            // A crossroads far away lends its signals, all of them red at first.
            plan = StreetPlan::crossroads(100.0);
            for node in &mut plan.nodes {
                node.x += 3000.0;
            }
        }
        let roads = roads_of(&plan).expect("the streets are sound");
        world.set_roads(std::sync::Arc::new(roads));
        if name == "quarter" {
            close(&mut world, piece("mill_b"));
        }
        let mut ids = BTreeMap::new();
        for (key, thing) in things {
            let mut desc = describe(&thing);
            desc.info.asset = thing.asset.as_deref().map(|asset| stocked(&mut world, asset));
            let id = world.spawn(desc).unwrap_or_else(|error| panic!("{key}: {error}"));
            ids.insert(key, id);
        }
        Self { world, me: ids["me"], ids }
    }

    /// Who is spoken to: the city's dog in what is said to dogs, else "me".
    pub(crate) fn spoken_to(&self, family: &str) -> EntityId {
        let is_dog =
            |id: &&EntityId| self.world.entity(**id).is_some_and(|thing| thing.kind == EntityKind::Dog);
        let dog = self.ids.values().find(is_dog).filter(|_| family == "dog");
        dog.copied().unwrap_or(self.me)
    }

    /// Bodies in the city with what each can do: a person, and a dog and a car that come to it.
    pub(crate) fn bodies(&mut self) -> [(EntityId, ActionSet); 3] {
        let mut put = |kind, size: [f64; 3]| {
            let pose = pose_facing(Point3::new(2.0, 2.0, 0.0), 0.0);
            self.world.spawn(EntityDesc::new(kind, pose, Shape::cuboid(size[0], size[1], size[2])))
        };
        let dog = put(EntityKind::Dog, [0.8, 0.3, 0.6]).expect("a dog stands anywhere");
        let car = put(EntityKind::Car, [4.5, 1.8, 1.5]).expect("a car stands anywhere");
        [(self.me, ActionSet::humanoid()), (dog, ActionSet::dog()), (car, ActionSet::vehicle())]
    }

    /// What the thing is called in the tables; its label, if it came later.
    pub(crate) fn key(&self, id: EntityId) -> String {
        self.ids
            .iter()
            .find(|(_, known)| **known == id)
            .map_or_else(|| id.to_string(), |(key, _)| key.clone())
    }
}

/// The streets of the quarter: key, name, and whether it goes east at that height or north at that place, m.
pub(crate) const STREETS: [(&str, &str, bool, f64); 6] = [
    ("oak", "Oak Street", true, 0.0),
    ("elm", "Elm Street", true, 100.0),
    ("mill", "Mill Lane", true, 200.0),
    ("harbour", "Harbour Road", false, 0.0),
    ("station", "Station Road", false, 100.0),
    ("walk", "River Walk", false, 200.0),
];

/// Names the streets of a grid of 3 by 3.
fn name_streets(plan: &mut StreetPlan) {
    for (_, name, goes_east, at) in STREETS {
        let name = plan.add_name(name);
        for street in &mut plan.streets {
            let [a, b] = [street.from, street.to].map(|node| plan.nodes[node]);
            let on_it = if goes_east { a.y == at && b.y == at } else { a.x == at && b.x == at };
            if on_it {
                street.name = Some(name);
            }
        }
    }
}

/// The middle of a piece of a street of the quarter: `oak_a` is the first of Oak Street, `oak_b` the second.
pub(crate) fn piece(key: &str) -> [f64; 2] {
    let (street, half) = key.split_once('_').unwrap_or_else(|| panic!("no piece {key}"));
    let along = if half == "a" { 50.0 } else { 150.0 };
    let (.., goes_east, at) =
        STREETS.into_iter().find(|known| known.0 == street).unwrap_or_else(|| panic!("no street {street}"));
    if goes_east { [along, at] } else { [at, along] }
}

/// The road whose middle that is.
pub(crate) fn road_at(world: &World, [x, y]: [f64; 2]) -> simworld_core::id::RoadId {
    let roads = &world.roads().expect("the quarter has streets").roads;
    let is_there = |road: &simworld_core::net::Road| {
        let (a, b) = (road.centerline[0], road.centerline[road.centerline.len() - 1]);
        ((a.x + b.x) * 0.5 - x).abs() < 1.0 && ((a.y + b.y) * 0.5 - y).abs() < 1.0
    };
    simworld_core::id::RoadId::from_index(roads.iter().position(is_there).expect("there is such a street"))
}

fn close(world: &mut World, middle: [f64; 2]) {
    let road = road_at(world, middle);
    for direction in [simworld_core::net::LaneDirection::Forward, simworld_core::net::LaneDirection::Backward]
    {
        world.set_passage((road, direction), simworld_core::passage::Passage::Closed).expect("it has lanes");
    }
}

/// The world's own copy of an asset of the library.
fn stocked(world: &mut World, name: &str) -> AssetId {
    static LIBRARY: LazyLock<Catalogue> = LazyLock::new(Catalogue::library);
    let asset =
        LIBRARY.find(name).and_then(|id| LIBRARY.get(id)).unwrap_or_else(|| panic!("no asset {name}"));
    world.add_asset(asset.clone()).expect("the library is sound")
}

fn describe(thing: &Thing) -> EntityDesc {
    let kind = EntityKind::from_name(&thing.kind).unwrap_or_else(|| panic!("no kind {}", thing.kind));
    let pose = pose_facing(Point3::new(thing.at[0], thing.at[1], 0.0), thing.facing.to_radians());
    let [x, y, z] = thing.size.unwrap_or_else(|| usual_size(kind));
    let shape = match kind {
        EntityKind::Person => Shape::Capsule { radius: 0.25, height: 1.8 },
        _ => Shape::cuboid(x, y, z),
    };
    let mut desc = EntityDesc::new(kind, pose, shape);
    desc.info.name.clone_from(&thing.name);
    desc.info.place =
        thing.place.as_deref().map(|place| Place::from_name(place).unwrap_or_else(|| panic!("no {place}")));
    if let Some([x, y]) = thing.access {
        desc = desc.accessed_at(Point3::new(x, y, 0.0));
    }
    desc.info.color = thing.color.as_deref().map(paint);
    if let Some(sells) = &thing.sells {
        desc = desc.with("sells", sells.as_str());
    }
    for (key, set) in [("locked", thing.locked), ("open", thing.open)] {
        if set {
            desc = desc.with(key, true);
        }
    }
    if let Some(area) = &thing.area {
        desc = desc.with("area", area.as_str());
    }
    if let Some(group) = thing.signal_group {
        desc = desc.with("signal_group", group);
    }
    desc
}

fn usual_size(kind: EntityKind) -> [f64; 3] {
    match kind {
        EntityKind::Building => [10.0, 10.0, 8.0],
        EntityKind::Bench => [0.6, 1.8, 0.8],
        EntityKind::Car => [4.5, 1.8, 1.5],
        EntityKind::Truck => [6.0, 2.2, 2.8],
        EntityKind::Bus => [12.0, 2.5, 3.1],
        EntityKind::BusStop => [1.4, 4.0, 2.5],
        EntityKind::Scooter => [1.1, 0.45, 1.1],
        EntityKind::Motorcycle | EntityKind::Bicycle => [1.9, 0.6, 1.1],
        EntityKind::Parcel => [0.3, 0.3, 0.3],
        EntityKind::Door => [0.1, 1.0, 2.1],
        EntityKind::StreetLamp | EntityKind::TrafficSignal => [0.2, 0.2, 4.0],
        EntityKind::Table => [0.8, 0.8, 0.75],
        _ => [0.5, 0.5, 0.9],
    }
}

/// Paint, linear-light sRGB, as cars and furniture wear it.
fn paint(name: &str) -> [f32; 3] {
    match name {
        "red" => [0.55, 0.03, 0.02],
        "blue" => [0.03, 0.08, 0.45],
        "green" => [0.05, 0.35, 0.06],
        "yellow" => [0.8, 0.6, 0.03],
        "orange" => [0.8, 0.2, 0.02],
        "purple" => [0.2, 0.03, 0.35],
        "brown" => [0.2, 0.08, 0.03],
        "white" => [0.8, 0.8, 0.8],
        "black" => [0.01, 0.01, 0.012],
        "grey" => [0.2, 0.2, 0.2],
        other => panic!("no paint {other}"),
    }
}
