//! Things and places in words, for answers.

use simworld_core::geometry::{Point2, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityInfo, EntityRef, Relation, Scene, World};

use super::edit::Stand;

/// So many things are listed by name.
const LISTED: usize = 20;

/// What a thing is called in answers: its name or, of what was made for words, these; else what it is used as, or what it is.
pub(crate) fn called(scene: &dyn Scene, thing: &EntityRef<'_>) -> String {
    let made = if thing.info.name.is_none() { made_as(scene, thing.info) } else { None };
    made.unwrap_or_else(|| thing.label().to_owned())
}

/// The words for which a thing was made.
pub(crate) fn made_as(scene: &dyn Scene, thing: &EntityInfo) -> Option<String> {
    let asset = scene.assets()?.get(thing.asset?)?;
    asset.has_address().then(|| asset.called())
}

/// What a thing is, where it stands and what is special about it.
pub(super) fn describe(world: &World, thing: EntityId) -> String {
    let Some(entity) = world.entity(thing) else { return format!("{thing} is gone") };
    let (size, at) = (entity.info.shape.size(), entity.planar());
    let mut told = vec![format!(
        "{} ({thing}), a {}, {:.1} m long, {:.1} m wide and {:.1} m high, at ({:.1}, {:.1}), turned {:.0}° from east",
        called(world, &entity),
        entity.kind.as_str().replace('_', " "),
        size.x,
        size.y,
        size.z,
        at.x,
        at.y,
        yaw_of(entity.pose).to_degrees()
    )];
    told.extend(entity.info.place.map(|place| format!("used as {}", place.as_str().replace('_', " "))));
    told.extend(entity.info.mass.map(|mass| format!("{mass:.0} kg")));
    told.extend(entity.info.attributes.iter().map(|(key, value)| format!("{key}: {value}")));
    told.join("; ")
}

/// Things by what they are called, with their numbers and distances.
pub(super) fn listed(world: &World, things: &[EntityId], from: Point2) -> String {
    let told = |thing: &EntityId| {
        let entity = world.entity(*thing)?;
        let distance = entity.info.shape.planar_distance(entity.pose, &from);
        Some(format!("{} ({thing}) at {distance:.0} m", called(world, &entity)))
    };
    let mut all: Vec<String> = things.iter().take(LISTED).filter_map(told).collect();
    if things.len() > LISTED {
        all.push(format!("and {} more", things.len() - LISTED));
    }
    if all.is_empty() { "nothing".to_owned() } else { all.join(", ") }
}

impl Stand {
    /// The relation in words: "next to Turing Library".
    pub fn told(&self, scene: &dyn Scene) -> String {
        let label = |id: &EntityId| {
            let told = |entity: EntityRef<'_>| called(scene, &entity).replace('_', " ");
            scene.entity(*id).map_or_else(|| id.to_string(), told)
        };
        match self {
            Self::To { relation, anchor } => {
                let words = match relation {
                    Relation::NextTo => "next to",
                    Relation::Near => "near",
                    Relation::FarFrom => "far from",
                    Relation::InFrontOf => "in front of",
                    Relation::Behind => "behind",
                    Relation::LeftOf => "to the left of",
                    Relation::RightOf => "to the right of",
                    Relation::OnTopOf => "on top of",
                    Relation::Inside => "inside",
                    _ => "at",
                };
                format!("{words} {}", label(anchor))
            }
            Self::Between { one, other } => format!("between {} and {}", label(one), label(other)),
            Self::AcrossFrom { anchor } => format!("across from {}", label(anchor)),
            Self::Along { anchor } => format!("along {}", label(anchor)),
            Self::AlongRoad { .. } => "along the street".to_owned(),
            Self::OnSide { .. } => "on that side of the street".to_owned(),
            Self::AtCornerOf { anchor } => format!("at the corner of {}", label(anchor)),
            Self::Towards { anchor, .. } => format!("on that side of {}", label(anchor)),
            Self::Offset { anchor, heading, distance } => {
                let degrees = heading.to_degrees();
                format!("{distance:.2} m from {}, {degrees:.0}° from east", label(anchor))
            }
            Self::Apart { anchor, least, most } => {
                format!("{least:.1} to {most:.1} m from {}", label(anchor))
            }
            Self::OnBlockOf { anchor } => format!("on the block of {}", label(anchor)),
            Self::InMiddleOf { anchor } => format!("in the middle of {}", label(anchor)),
            Self::AtEdgeOf { anchor } => format!("at the edge of {}", label(anchor)),
            Self::AtJunction { .. } => "at the junction".to_owned(),
            Self::At { point } => format!("at ({:.1}, {:.1})", point.x, point.y),
            Self::Around { point } => format!("around ({:.1}, {:.1})", point.x, point.y),
        }
    }
}
