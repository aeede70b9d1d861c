//! What is known of an entity, in a line or on a card.

use simworld_core::geometry::{Point3, yaw_of};
use simworld_core::scene::{EntityRef, Scene, World};

/// So many attributes stand on a card.
const ATTRIBUTES: usize = 10;

/// What something is, in a line: name, kind, id, place, and speed if it moves.
pub(super) fn line(entity: &EntityRef<'_>) -> String {
    let at = entity.position();
    let mut text = format!("{} {} at ({:.1}, {:.1}, {:.1})", entity.kind, entity.id, at.x, at.y, at.z);
    if let Some(name) = &entity.info.name {
        text = format!("{name}, {text}");
    } else if let Some(place) = entity.info.place {
        text = format!("{}, {text}", place.as_str());
    }
    if entity.kind.is_mobile() {
        text = format!("{text}, {:.1} m/s", entity.twist.ground_speed());
    }
    text
}

/// All that is known of something, in lines of label and value; `eye` is where it is looked at from.
pub fn card(world: &World, entity: &EntityRef<'_>, eye: &Point3) -> Vec<String> {
    let (info, at) = (entity.info, entity.position());
    let mut lines = vec![format!("{} {}", entity.kind, entity.id)];
    let mut tell = |label: &str, value: String| lines.push(format!("{label:<9} {value}"));
    if let Some(name) = &info.name {
        tell("name", name.clone());
    }
    if let Some(place) = info.place {
        tell("place", place.as_str().to_owned());
    }
    if let Some(asset) = info.asset.and_then(|id| world.assets()?.get(id)) {
        tell("asset", asset.name.clone());
    }
    tell("position", format!("({:.2}, {:.2}, {:.2}) m", at.x, at.y, at.z));
    tell("heading", format!("{:.0} deg from east", yaw_of(entity.pose).to_degrees()));
    tell("distance", format!("{:.1} m", (at - eye).norm()));
    if entity.kind.is_mobile() {
        tell("speed", format!("{:.2} m/s", entity.twist.ground_speed()));
    }
    let size = info.shape.size();
    tell("size", format!("{:.2} x {:.2} x {:.2} m", size.x, size.y, size.z));
    if let Some(mass) = info.mass {
        tell("mass", format!("{mass:.1} kg"));
    }
    if let Some(bond) = entity.attachment {
        let parent = world.entity(bond.parent);
        let name = parent.map_or_else(String::new, |parent| format!("{} ", parent.kind));
        tell("bond", format!("{:?} of {name}{}", bond.role, bond.parent).to_lowercase());
    }
    for (key, value) in info.attributes.iter().take(ATTRIBUTES) {
        tell(key, value.to_string());
    }
    if info.attributes.len() > ATTRIBUTES {
        tell("", format!("and {} more attributes", info.attributes.len() - ATTRIBUTES));
    }
    lines
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Vector3, pose_facing};
    use simworld_core::scene::{EntityDesc, EntityKind, Shape};
    use simworld_core::value::Value;

    use super::*;

    #[test]
    fn a_card_says_what_the_world_knows() {
        let mut world = World::new();
        let pose = pose_facing(Point3::new(3.0, 4.0, 0.0), std::f64::consts::FRAC_PI_2);
        let mut desc = EntityDesc::new(EntityKind::Car, pose, Shape::cuboid(4.5, 1.8, 1.5)).named("Bea's");
        desc.twist.linear = Vector3::new(0.0, 5.5, 0.0);
        desc.info.attributes.insert("lights".to_owned(), Value::Bool(true));
        let id = world.spawn(desc).unwrap();
        let entity = world.entity(id).unwrap();
        let text = card(&world, &entity, &Point3::origin()).join("\n");
        for part in
            ["Bea's", "(3.00, 4.00", "90 deg", "5.0 m", "5.50 m/s", "4.50 x 1.80 x 1.50 m", "lights    true"]
        {
            assert!(text.contains(part), "{part} is missing: {text}");
        }
        assert!(line(&entity).starts_with("Bea's, car"), "{}", line(&entity));
    }
}
