//! Actuators of MJCF: which joints have motors, and how strong they are.

use roxmltree::Node;

use super::Reading;
use super::mjcf::Gains;
use super::mjcf_read::{Class, Settings, some};
use super::xml::{children, place, shortened};
use crate::robot::{RobotDescription, RobotError};

/// Gives the joints of a robot their motors; what those of positions and speeds are to have is returned.
pub(super) fn read(
    root: Node<'_, '_>,
    settings: &Settings<'_>,
    description: &mut RobotDescription,
    reading: &mut Reading<'_>,
) -> Result<Gains, RobotError> {
    let mut gains = Gains::new();
    for node in children(root, "actuator").flat_map(|list| list.children()).filter(Node::is_element) {
        let kind = node.tag_name().name();
        if !matches!(kind, "motor" | "position" | "velocity" | "general") {
            reading.note(place(node), "actuators of this kind are passed over");
            continue;
        }
        let class = settings.class(node, None, kind)?;
        let Some(name) = class.get("joint") else {
            reading.note(place(node), "an actuator of something else than a joint is passed over");
            continue;
        };
        let Some(joint) = description.joints.iter_mut().find(|joint| joint.name == name) else {
            let (place, name) = (place(node), shortened(name));
            return Err(RobotError::Unknown { place, kind: "joint", name });
        };
        let gear = some(&class, "gear")?.first().copied().unwrap_or(1.0).abs();
        joint.effort = strength(&class, settings, kind)?.map(|force| force * gear);
        let number = |attribute, usual| Ok::<f64, RobotError>(class.number(attribute)?.unwrap_or(usual));
        let pair = match kind {
            "position" => [number("kp", 1.0)?, number("kv", 0.0)?],
            "velocity" => [0.0, number("kv", 1.0)?],
            _ => continue,
        };
        gains.insert(name.to_owned(), pair.map(|gain| gain * gear * gear));
    }
    Ok(gains)
}

/// The greatest force before the gear; none where nothing bounds it.
fn strength(class: &Class<'_, '_>, settings: &Settings<'_>, kind: &str) -> Result<Option<f64>, RobotError> {
    let most = |[low, high]: [f64; 2]| low.abs().max(high.abs());
    if let Some(range) = class.range("forcerange", "forcelimited", settings.autolimits)? {
        return Ok(Some(most(range)));
    }
    if kind != "motor" {
        return Ok(None);
    }
    Ok(class.range("ctrlrange", "ctrllimited", settings.autolimits)?.map(most))
}
