//! What a body knows of its surroundings: the things that a model may name, and how they are described to it.
//!
//! Which things these are follows from where they are and of what kind, never from what is written on them.

use std::fmt::Write as _;
use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Aabb, Point2, heading, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityKind, EntityRef, OPEN, Role, SELLS, Scene};
use simworld_core::value::Value;
use thiserror::Error;

use super::prompts::one_line;
use crate::executor::sees;
use crate::language::name_of_color;

/// The most characters of a name that are shown.
const LONGEST_NAME: usize = 80;

/// What a body looks at before it plans.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ViewConfig {
    /// How far it looks for things, m, 1 to 2000.
    pub radius: f64,
    /// The most things it takes in, the nearest, 1 to 500.
    pub most: usize,
    /// The most of one kind of scenery among them (trees, shrubs, lamps), 0 to 500.
    pub scenery: usize,
    /// How far its map of buildings reaches, m, 0 to 10 000.
    pub map: f64,
    /// The most buildings on its map, the nearest, 0 to 500.
    pub places: usize,
    /// What of all that it knows.
    pub sight: Sight,
}

/// What is known of what is within reach of the senses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sight {
    /// Everything, seen or not, as people know their street.
    #[default]
    All,
    /// What stands in the half before the body with nothing large in between. The map stays.
    InView,
}

impl Default for ViewConfig {
    fn default() -> Self {
        Self { radius: 150.0, most: 64, scenery: 3, map: 1500.0, places: 24, sight: Sight::All }
    }
}

/// A setting that no body can look by.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{field} = {value} is out of range: give {allowed}")]
pub struct ViewConfigError {
    /// The setting.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// What is allowed.
    pub allowed: &'static str,
}

impl ViewConfig {
    /// Checks every field against its range; NaN is in none.
    ///
    /// # Errors
    /// The first field out of range.
    pub fn validate(&self) -> Result<(), ViewConfigError> {
        let checks = [
            ("radius", self.radius, 1.0..=2000.0, "1 to 2000 m"),
            ("most", self.most as f64, 1.0..=500.0, "1 to 500"),
            ("scenery", self.scenery as f64, 0.0..=500.0, "0 to 500"),
            ("map", self.map, 0.0..=10_000.0, "0 to 10 000 m"),
            ("places", self.places as f64, 0.0..=500.0, "0 to 500"),
        ];
        match checks.into_iter().find(|(_, value, range, _)| !range.contains(value)) {
            Some((field, value, _, allowed)) => Err(ViewConfigError { field, value, allowed }),
            None => Ok(()),
        }
    }
}

/// What a thing can be wanted for; it decides which calls may name it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Use {
    Any,
    Seat,
    Item,
    Mover,
    Listener,
    Receiver,
    Door,
    Scooter,
    Car,
    Light,
}

impl Use {
    pub(super) const ALL: [Self; 10] = [
        Self::Any,
        Self::Seat,
        Self::Item,
        Self::Mover,
        Self::Listener,
        Self::Receiver,
        Self::Door,
        Self::Scooter,
        Self::Car,
        Self::Light,
    ];

    /// Its name in schemas.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Any => "thing",
            Self::Seat => "seat",
            Self::Item => "item",
            Self::Mover => "mover",
            Self::Listener => "listener",
            Self::Receiver => "receiver",
            Self::Door => "door",
            Self::Scooter => "scooter",
            Self::Car => "car",
            Self::Light => "light",
        }
    }

    const fn fits(self, kind: EntityKind, has_access: bool) -> bool {
        use EntityKind::{
            Bicycle, Building, Bus, Car, Chair, Cone, Dog, Door, Motorcycle, Parcel, Person, Prop, Robot,
            Scooter, TrafficSignal, Truck,
        };
        match self {
            Self::Any => true,
            Self::Seat => kind.is_seat(),
            Self::Item => matches!(kind, Parcel | Chair | Cone | Prop),
            Self::Mover => kind.is_mobile(),
            Self::Listener => matches!(kind, Person | Dog | Robot),
            Self::Receiver => matches!(kind, Person | Robot),
            Self::Door => matches!(kind, Door) || matches!(kind, Building) && has_access,
            Self::Scooter => matches!(kind, Scooter),
            Self::Car => matches!(kind, Car | Truck | Bus | Motorcycle | Bicycle),
            Self::Light => matches!(kind, TrafficSignal),
        }
    }
}

/// One thing that may be named.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Thing {
    pub(super) id: EntityId,
    kind: EntityKind,
    has_access: bool,
    /// What is sold there, in the order of its attribute.
    pub(super) goods: Vec<String>,
    /// How it is described, one line.
    line: String,
}

/// All that may be named, and how the agent itself is.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Known {
    /// Near things, the nearest first, then the places of the map.
    things: Vec<Thing>,
    near: usize,
    pub(super) here: Point2,
    pub(super) oneself: String,
}

impl Known {
    /// Looks around; `None` if nobody is there to look.
    pub(super) fn look(scene: &dyn Scene, who: EntityId, config: &ViewConfig) -> Option<Self> {
        let me = scene.entity(who)?;
        let seen = |entity: &EntityRef<'_>| match config.sight {
            Sight::All => true,
            Sight::InView => belongs_to(entity, who) || sees(scene, &me, entity, config.radius),
        };
        let near = ranked(scene, &me, config.radius, &|entity| is_thing(entity.kind) && seen(entity));
        let mut chosen: Vec<(f64, EntityId)> = Vec::new();
        let mut scenery = [0_usize; EntityKind::ALL.len()];
        for (distance, id) in near {
            let Some(entity) = scene.entity(id) else { continue };
            let count = &mut scenery[entity.kind as usize];
            *count += 1;
            if chosen.len() < config.most && (!is_scenery(entity.kind) || *count <= config.scenery) {
                chosen.push((distance, id));
            }
        }
        let near = chosen.len();
        let is_place =
            |entity: &EntityRef<'_>| entity.kind == EntityKind::Building || entity.info.place.is_some();
        let places = ranked(scene, &me, config.map, &is_place);
        let news: Vec<(f64, EntityId)> =
            places.into_iter().filter(|place| !chosen.contains(place)).take(config.places).collect();
        chosen.extend(news);
        let things = chosen.iter().filter_map(|(distance, id)| {
            scene.entity(*id).map(|entity| Thing::of(scene, &me, &entity, *distance))
        });
        Some(Self { things: things.collect(), near, here: me.planar(), oneself: oneself(scene, &me) })
    }

    /// The ids that a use allows, as they are written, the nearest first.
    pub(super) fn ids(&self, wanted: Use) -> impl Iterator<Item = String> + '_ {
        let fits = move |thing: &&Thing| wanted.fits(thing.kind, thing.has_access);
        self.things.iter().filter(fits).map(|thing| thing.id.to_string())
    }

    /// What can be bought, as it is written: the place and the position on its list.
    pub(super) fn goods(&self) -> impl Iterator<Item = String> + '_ {
        self.things
            .iter()
            .flat_map(|thing| (0..thing.goods.len()).map(move |index| format!("{}/{index}", thing.id)))
    }

    /// What an id stands for.
    pub(super) fn find(&self, written: &str) -> Option<&Thing> {
        self.things.iter().find(|thing| thing.id.to_string() == written)
    }

    /// The near things, a line each.
    pub(super) fn things_text(&self) -> String {
        lines(&self.things[..self.near])
    }

    /// The places beyond, a line each.
    pub(super) fn places_text(&self) -> String {
        lines(&self.things[self.near..])
    }
}

fn lines(things: &[Thing]) -> String {
    things.iter().map(|thing| thing.line.as_str()).collect::<Vec<_>>().join("\n")
}

impl Thing {
    fn of(scene: &dyn Scene, me: &EntityRef<'_>, entity: &EntityRef<'_>, distance: f64) -> Self {
        let goods = match entity.info.attributes.get(SELLS) {
            Some(Value::Text(sells)) => sells.split(',').map(|sold| sold.trim().to_owned()).collect(),
            _ => Vec::new(),
        };
        let line = described(scene, me, entity, distance, &goods);
        Self { id: entity.id, kind: entity.kind, has_access: entity.info.access.is_some(), goods, line }
    }
}

/// "#12 chair "Tom's", red, 3 m away, 20° to the left, at (123, -40), taken by #4".
fn described(
    scene: &dyn Scene,
    me: &EntityRef<'_>,
    entity: &EntityRef<'_>,
    distance: f64,
    goods: &[String],
) -> String {
    let mut line = format!("{} {}", entity.id, entity.kind);
    // Writing to a text never fails.
    if let Some(place) = entity.info.place {
        let _ = write!(line, " ({place})");
    }
    if let Some(name) = &entity.info.name {
        let _ = write!(line, " {:?}", shown(name));
    }
    if let Some(color) = entity.info.color {
        let _ = write!(line, ", {}", name_of_color(color));
    }
    let offset = entity.bounds.center().xy() - me.planar();
    let bearing =
        if offset.norm() < 1e-9 { 0.0 } else { wrap_angle(heading(&offset) - yaw_of(me.pose)).to_degrees() };
    let side = if bearing >= 0.0 { "left" } else { "right" };
    let _ = write!(line, ", {distance:.0} m away, {:.0}° to the {side}", bearing.abs());
    let at = entity.planar() * 10.0;
    let _ = write!(line, ", at ({:.0}, {:.0})", at.x, at.y);
    if let Some(bond) = entity.attachment {
        let whose = if bond.parent == me.id { "you".to_owned() } else { bond.parent.to_string() };
        let _ = write!(line, ", {} by {whose}", format!("{:?}", bond.role).to_lowercase());
    }
    if let Some(by) = scene.attached(entity.id, Role::Seated).or(scene.attached(entity.id, Role::Aboard)) {
        let _ = write!(line, ", taken by {by}");
    }
    if let Some(Value::Bool(open)) = entity.info.attributes.get(OPEN) {
        line.push_str(if *open { ", open" } else { ", closed" });
    }
    for (index, sold) in goods.iter().enumerate() {
        let _ = write!(
            line,
            "{} {}/{index} = {:?}",
            if index == 0 { ", sells" } else { "," },
            entity.id,
            shown(sold)
        );
    }
    line
}

fn shown(text: &str) -> String {
    one_line(text).chars().take(LONGEST_NAME).collect()
}

/// How one is: kind, place, heading, what one has and sits on.
fn oneself(scene: &dyn Scene, me: &EntityRef<'_>) -> String {
    let at = me.planar() * 10.0;
    let degrees = yaw_of(me.pose).to_degrees().rem_euclid(360.0);
    let mut line =
        format!("{} {}, at ({:.0}, {:.0}), heading {degrees:.0}° from east", me.id, me.kind, at.x, at.y);
    if let Some(bond) = me.attachment {
        let _ = write!(line, ", {} on or in {}", format!("{:?}", bond.role).to_lowercase(), bond.parent);
    }
    scene.visit_attached(me.id, &mut |load| {
        if let Some(bond) = load.attachment {
            let _ = write!(line, ", {} {}", format!("{:?}", bond.role).to_lowercase(), load.id);
        }
    });
    line
}

fn belongs_to(entity: &EntityRef<'_>, who: EntityId) -> bool {
    entity.attachment.is_some_and(|bond| bond.parent == who)
}

/// What passes within a radius, the nearest first; of two at the same distance the lower id.
fn ranked(
    scene: &dyn Scene,
    me: &EntityRef<'_>,
    radius: f64,
    passes: &dyn Fn(&EntityRef<'_>) -> bool,
) -> Vec<(f64, EntityId)> {
    let here = me.planar();
    let mut found = Vec::new();
    let _ = scene.visit(&Aabb::column_around(here, radius), &mut |entity| {
        let distance = entity.info.shape.planar_distance(entity.pose, &here);
        if entity.id != me.id && distance <= radius && passes(&entity) {
            found.push((distance, entity.id));
        }
        ControlFlow::Continue(())
    });
    found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    found
}

/// Surfaces are where things stand, not things; a crossing is something to go to.
const fn is_thing(kind: EntityKind) -> bool {
    !matches!(kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk)
}

/// Things that there are many of, and that are seldom meant.
const fn is_scenery(kind: EntityKind) -> bool {
    matches!(kind, EntityKind::Tree | EntityKind::Shrub | EntityKind::StreetLamp)
}
