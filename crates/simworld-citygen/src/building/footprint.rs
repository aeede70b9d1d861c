//! Outlines of buildings: what stands on the ground, and the boxes of which it is made.
//!
//! Body frame: the origin is the middle of the rectangle round the outline, x looks out of the entrance, y to the left.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::seed::StreamRng;

use super::Surveyed;

/// The form of an outline.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FootprintKind {
    /// A rectangle.
    Rectangle,
    /// A wing along the street and one to the rear.
    L,
    /// A wing along the street and two to the rear.
    U,
    /// Four wings round a courtyard.
    Courtyard,
    /// A tower on a wider base.
    Stepped,
    /// As it stands on a map.
    Surveyed,
}

/// An outline within the rectangle of a building's width and depth.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Footprint {
    /// All of it.
    #[default]
    Rectangle,
    /// A wing along the street, `front` m deep, and one to the rear, |`side`| m wide: on the left of the body if `side`
    /// is positive, on its right if it is negative.
    L {
        /// m.
        front: f64,
        /// m.
        side: f64,
    },
    /// A wing along the street, `front` m deep, and two to the rear, each `side` m wide.
    U {
        /// m.
        front: f64,
        /// m.
        side: f64,
    },
    /// Four wings, each `wing` m deep.
    Courtyard {
        /// m.
        wing: f64,
    },
    /// A base of so many storeys, and a tower that stands back by `setback` m on every side.
    Stepped {
        /// Storeys of the base.
        base: u32,
        /// m.
        setback: f64,
    },
    /// As it stands on a map.
    Surveyed(Box<Surveyed>),
}

/// A box of a building in its body frame: the middle of its bottom, its length along x and width along y, its storeys.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// m.
    pub middle: Point2,
    /// m.
    pub length: f64,
    /// m.
    pub width: f64,
    /// Storeys from the ground.
    pub storeys: u32,
}

impl Footprint {
    /// A form fitted to a size; a rectangle where the size is too small for it.
    pub(super) fn fitted(
        kind: FootprintKind,
        width: f64,
        depth: f64,
        storeys: u32,
        rng: &mut StreamRng,
    ) -> Self {
        let share = rng.uniform(0.42, 0.58);
        match kind {
            FootprintKind::L if width >= 10.0 && depth >= 10.0 => {
                let side = width * share;
                Self::L { front: depth * (1.0 - share), side: if rng.chance(0.5) { side } else { -side } }
            }
            FootprintKind::U if width >= 18.0 && depth >= 13.0 => {
                Self::U { front: depth * share, side: width * share * 0.6 }
            }
            FootprintKind::Courtyard if width >= 22.0 && depth >= 20.0 => {
                Self::Courtyard { wing: width.min(depth) * share * 0.65 }
            }
            FootprintKind::Stepped if storeys >= 5 && width.min(depth) >= 12.0 => {
                Self::Stepped { base: 1 + storeys / 6, setback: 2.0 + share * 2.0 }
            }
            _ => Self::Rectangle,
        }
    }

    /// What form it is.
    pub const fn kind(&self) -> FootprintKind {
        match self {
            Self::Rectangle => FootprintKind::Rectangle,
            Self::L { .. } => FootprintKind::L,
            Self::U { .. } => FootprintKind::U,
            Self::Courtyard { .. } => FootprintKind::Courtyard,
            Self::Stepped { .. } => FootprintKind::Stepped,
            Self::Surveyed(_) => FootprintKind::Surveyed,
        }
    }

    /// Whether it lies within a rectangle of that size.
    pub fn fits(&self, width: f64, depth: f64) -> bool {
        let inside = |part: f64, whole: f64| part > 0.0 && part < whole;
        match self {
            Self::Rectangle => true,
            Self::L { front, side } => inside(*front, depth) && inside(side.abs(), width),
            Self::U { front, side } => inside(*front, depth) && inside(2.0 * side, width),
            Self::Courtyard { wing } => inside(2.0 * wing, width.min(depth)),
            Self::Stepped { setback, .. } => inside(2.0 * setback, width.min(depth)),
            Self::Surveyed(form) => form.fits(width, depth),
        }
    }

    /// The corners of the outline, counter-clockwise, without the courtyard.
    pub fn outline(&self, width: f64, depth: f64) -> Vec<Point2> {
        let (x, y) = (depth * 0.5, width * 0.5);
        let point = Point2::new;
        match *self {
            Self::Surveyed(ref form) => form.outline.clone(),
            Self::L { front, side } if side >= 0.0 => vec![
                point(x, -y),
                point(x, y),
                point(-x, y),
                point(-x, y - side),
                point(x - front, y - side),
                point(x - front, -y),
            ],
            Self::L { front, side } => vec![
                point(x, -y),
                point(x, y),
                point(x - front, y),
                point(x - front, -y - side),
                point(-x, -y - side),
                point(-x, -y),
            ],
            Self::U { front, side } => vec![
                point(x, -y),
                point(x, y),
                point(-x, y),
                point(-x, y - side),
                point(x - front, y - side),
                point(x - front, side - y),
                point(-x, side - y),
                point(-x, -y),
            ],
            _ => vec![point(x, -y), point(x, y), point(-x, y), point(-x, -y)],
        }
    }

    /// The corners of the courtyard, counter-clockwise, if it has one.
    pub fn courtyard(&self, width: f64, depth: f64) -> Option<[Point2; 4]> {
        let Self::Courtyard { wing } = *self else { return None };
        let (x, y) = (depth * 0.5 - wing, width * 0.5 - wing);
        Some([Point2::new(x, -y), Point2::new(x, y), Point2::new(-x, y), Point2::new(-x, -y)])
    }

    /// The corners of every courtyard, counter-clockwise.
    pub fn courtyards(&self, width: f64, depth: f64) -> Vec<Vec<Point2>> {
        match self {
            Self::Surveyed(form) => form.courts.clone(),
            _ => self.courtyard(width, depth).map(|court| court.to_vec()).into_iter().collect(),
        }
    }

    /// Area on the ground, m².
    pub fn area(&self, width: f64, depth: f64) -> f64 {
        let open = match *self {
            Self::Surveyed(ref form) => return form.area(),
            Self::Rectangle | Self::Stepped { .. } => 0.0,
            Self::L { front, side } => (depth - front) * (width - side.abs()),
            Self::U { front, side } => (depth - front) * (width - 2.0 * side),
            Self::Courtyard { wing } => (depth - 2.0 * wing) * (width - 2.0 * wing),
        };
        width * depth - open
    }

    /// The boxes of which it is made, the one with the entrance first. They touch and do not overlap, but for a tower,
    /// which goes through its base. Walls of a surveyed outline that run askew are laid in steps.
    pub fn parts(&self, width: f64, depth: f64, storeys: u32) -> impl Iterator<Item = Part> + use<> {
        let part = |x: f64, y: f64, length: f64, width: f64, storeys: u32| {
            Some(Part { middle: Point2::new(x, y), length, width, storeys })
        };
        let surveyed = match self {
            Self::Surveyed(form) => form.parts(storeys),
            _ => Vec::new(),
        };
        let parts: [Option<Part>; 4] = match *self {
            Self::Surveyed(_) => [None; 4],
            Self::Rectangle => [part(0.0, 0.0, depth, width, storeys), None, None, None],
            Self::L { front, side } => {
                let rear = (width - side.abs()) * 0.5 * side.signum();
                let wing = part(-front * 0.5, rear, depth - front, side.abs(), storeys);
                [part((depth - front) * 0.5, 0.0, front, width, storeys), wing, None, None]
            }
            Self::U { front, side } => {
                let rear =
                    |sign: f64| part(-front * 0.5, sign * (width - side) * 0.5, depth - front, side, storeys);
                [part((depth - front) * 0.5, 0.0, front, width, storeys), rear(1.0), rear(-1.0), None]
            }
            Self::Courtyard { wing } => {
                let across = |sign: f64| part(sign * (depth - wing) * 0.5, 0.0, wing, width, storeys);
                let along =
                    |sign: f64| part(0.0, sign * (width - wing) * 0.5, depth - 2.0 * wing, wing, storeys);
                [across(1.0), across(-1.0), along(1.0), along(-1.0)]
            }
            Self::Stepped { base, setback } => {
                let tower = part(0.0, 0.0, depth - 2.0 * setback, width - 2.0 * setback, storeys);
                [part(0.0, 0.0, depth, width, base), tower, None, None]
            }
        };
        parts.into_iter().flatten().chain(surveyed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(outline: &[Point2]) -> f64 {
        let next = outline.iter().cycle().skip(1);
        outline.iter().zip(next).map(|(a, b)| a.coords.perp(&b.coords)).sum::<f64>() * 0.5
    }

    #[test]
    fn outline_parts_and_area_agree() {
        let forms = [
            Footprint::Rectangle,
            Footprint::L { front: 8.0, side: 9.0 },
            Footprint::L { front: 8.0, side: -9.0 },
            Footprint::U { front: 8.0, side: 6.0 },
            Footprint::Courtyard { wing: 5.0 },
        ];
        for form in forms {
            let (width, depth) = (24.0, 20.0);
            assert!(form.fits(width, depth));
            let outline = form.outline(width, depth);
            let open = form.courtyard(width, depth).map_or(0.0, |court| area(&court));
            let boxes: f64 = form.parts(width, depth, 3).map(|part| part.length * part.width).sum();
            let expected = form.area(width, depth);
            assert!((area(&outline) - open - expected).abs() < 1e-9, "{form:?}: {}", area(&outline));
            assert!((boxes - expected).abs() < 1e-9, "{form:?}: {boxes}");
            for part in form.parts(width, depth, 3) {
                assert!(part.middle.x.abs() + part.length * 0.5 <= depth * 0.5 + 1e-9);
                assert!(part.middle.y.abs() + part.width * 0.5 <= width * 0.5 + 1e-9);
            }
        }
    }

    #[test]
    fn a_tower_stands_on_its_base() {
        let form = Footprint::Stepped { base: 3, setback: 2.5 };
        let parts: Vec<Part> = form.parts(20.0, 20.0, 12).collect();
        assert_eq!((parts[0].storeys, parts[1].storeys), (3, 12));
        assert_eq!(parts[1].width, 15.0);
    }
}
