//! What a picture shows: colour, depth, classes, instances, or all four side by side.

use std::fmt;
use std::str::FromStr;

use simworld_render::Frame;
use simworld_render::classes::class_by_id;

use super::canvas::Canvas;

/// From here on depth is black, m.
const FAR: f32 = 160.0;

/// What a picture shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Panes {
    /// Colour.
    #[default]
    Color,
    /// Depth: near is bright.
    Depth,
    /// Classes in the colours of Cityscapes.
    Classes,
    /// Instances, each in a colour of its own.
    Instances,
    /// All four at half the size.
    All,
}

impl Panes {
    const EACH: [(Self, &'static str); 5] = [
        (Self::Color, "color"),
        (Self::Depth, "depth"),
        (Self::Classes, "classes"),
        (Self::Instances, "instances"),
        (Self::All, "all"),
    ];

    /// Puts a frame on the canvas; `color` is its colour with everything that was drawn over it.
    pub(super) fn compose(self, frame: &Frame, color: &Canvas, out: &mut Canvas) {
        let (width, height) = (color.width, color.height);
        if self != Self::All {
            out.load(width, height, &self.pixels(frame, color));
            return;
        }
        out.load(width, height, &[]);
        let quarters =
            [(Self::Color, 0, 0), (Self::Depth, 1, 0), (Self::Classes, 0, 1), (Self::Instances, 1, 1)];
        let (half_width, half_height) = (width / 2, height / 2);
        for (pane, column, row) in quarters {
            let pixels = pane.pixels(frame, color);
            for (y, x) in (0..half_height).flat_map(|y| (0..half_width).map(move |x| (y, x))) {
                let at = 3 * ((row * half_height + y) * width + column * half_width + x);
                let corner = 3 * (2 * y * width + 2 * x);
                for channel in 0..3 {
                    // Ids and classes are never mixed; colours are.
                    let first = corner + channel;
                    out.rgb[at + channel] = if pane == Self::Color {
                        let four = [first, first + 3, first + 3 * width, first + 3 * width + 3];
                        (four.map(|index| u32::from(pixels[index])).iter().sum::<u32>() / 4) as u8
                    } else {
                        pixels[first]
                    };
                }
            }
            let corner = [(column * half_width + 8) as i64, (row * half_height + half_height - 14) as i64];
            out.text(corner, &pane.to_string(), [240, 240, 240], 1);
        }
    }

    fn pixels(self, frame: &Frame, color: &Canvas) -> Vec<u8> {
        match self {
            Self::Color | Self::All => color.rgb.clone(),
            Self::Depth => frame.depth.iter().flat_map(|depth| [shade_of(*depth); 3]).collect(),
            Self::Classes => frame
                .classes
                .iter()
                .flat_map(|id| class_by_id(*id).map_or([0; 3], |class| class.color))
                .collect(),
            Self::Instances => frame.ids.iter().flat_map(|id| color_of(*id)).collect(),
        }
    }
}

/// Grey by the logarithm of depth, from white at 1 m to black at [`FAR`] and in the sky.
fn shade_of(depth: f32) -> u8 {
    if !depth.is_finite() {
        return 0;
    }
    (255.0 * (1.0 - depth.max(1.0).ln() / FAR.ln()).clamp(0.0, 1.0)).round() as u8
}

/// A colour of its own for each id; black for none. Neighbouring numbers are far apart on the wheel.
pub(super) fn color_of(id: u32) -> [u8; 3] {
    if id == 0 {
        return [0; 3];
    }
    let [r, g, b, _] = id.wrapping_mul(0x9e37_79b1).rotate_left(7).wrapping_mul(0x85eb_ca6b).to_le_bytes();
    [r | 0x40, g | 0x40, b | 0x40]
}

impl fmt::Display for Panes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(Self::EACH[*self as usize].1)
    }
}

impl FromStr for Panes {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let found = Self::EACH.into_iter().find(|(_, name)| *name == text);
        found.map(|(panes, _)| panes).ok_or_else(|| {
            format!("{text:?} is no view: give {}", Self::EACH.map(|(_, name)| name).join(", "))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_of_them_have_names() {
        for (panes, name) in Panes::EACH {
            assert_eq!((panes.to_string().as_str(), name.parse()), (name, Ok(panes)));
        }
        assert!("colour".parse::<Panes>().unwrap_err().contains("color, depth"));
    }
}
