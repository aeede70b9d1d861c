//! Colours of robots: files say them as red, green, blue and how much they cover, each from 0 to 1, of which the first three are
//! values of sRGB.

use roxmltree::Node;
use simworld_core::asset::light_of;

use super::xml::numbers;
use crate::robot::RobotError;
use crate::robot::description::LinkSolid;

/// The colour that a text says, linear light: values beyond 0 or 1 are taken as that, and fewer than three are no colour.
pub(super) fn read(node: Node<'_, '_>, text: &str) -> Result<Option<[f32; 3]>, RobotError> {
    let values = numbers(node, "rgba", text)?;
    let light = |value: f64| light_of((value.clamp(0.0, 1.0) * 255.0).round() as u8);
    Ok(values.first_chunk::<3>().map(|values| values.map(light)))
}

/// The values of a colour: the greatest of 255 steps that are no lighter.
#[cfg(feature = "mjcf")]
pub(in crate::robot) fn values_of(color: [f32; 3]) -> [f64; 3] {
    color.map(|light| {
        let value = (1..=u8::MAX).take_while(|value| light_of(*value) <= light).last().unwrap_or(0);
        f64::from(value) / 255.0
    })
}

/// Gives solids of a link that have no colour that of what is seen of the link.
pub(super) fn lend(solids: &mut [LinkSolid], seen: Option<[f32; 3]>) {
    for solid in solids {
        solid.color = solid.color.or(seen);
    }
}
