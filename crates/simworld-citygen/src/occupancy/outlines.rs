//! The outlines themselves, by number. Nearly all are rectangles: those stand one after another without anything that
//! says where each begins, and are known for rectangles when they are tested.

use simworld_core::geometry::Point2;

/// The numbers from here on are those of outlines that are no rectangles.
const FIRST_OTHER: u32 = 1 << 31;

/// Outlines, each with a number.
#[derive(Clone, Debug, Default)]
pub(super) struct Outlines {
    rectangles: Vec<[Point2; 4]>,
    /// Where the corners of each other outline end; they begin where those of the one before end.
    ends: Vec<u32>,
    corners: Vec<Point2>,
}

/// An outline.
pub(super) enum Outline<'a> {
    Rectangle(&'a [Point2; 4]),
    Other(&'a [Point2]),
}

impl Outlines {
    /// Empty, with room for so many rectangles.
    pub(super) fn with_capacity(rectangles: usize) -> Self {
        Self { rectangles: Vec::with_capacity(rectangles), ..Self::default() }
    }

    /// Makes room for so many more rectangles at once.
    pub(super) fn reserve(&mut self, rectangles: usize) {
        self.rectangles.reserve(rectangles);
    }

    pub(super) fn len(&self) -> usize {
        self.rectangles.len() + self.ends.len()
    }

    /// Keeps an outline; says its number.
    pub(super) fn push(&mut self, outline: &Outline<'_>) -> u32 {
        match outline {
            Outline::Rectangle(corners) => {
                self.rectangles.push(**corners);
                self.rectangles.len() as u32 - 1
            }
            Outline::Other(corners) => {
                self.corners.extend_from_slice(corners);
                self.ends.push(self.corners.len() as u32);
                FIRST_OTHER + (self.ends.len() as u32 - 1)
            }
        }
    }

    /// The outline of a number that [`push`](Self::push) said.
    #[inline]
    pub(super) fn get(&self, number: u32) -> Outline<'_> {
        if number < FIRST_OTHER {
            return Outline::Rectangle(&self.rectangles[number as usize]);
        }
        let index = (number - FIRST_OTHER) as usize;
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        Outline::Other(&self.corners[start as usize..self.ends[index] as usize])
    }

    /// All numbers.
    pub(super) fn numbers(&self) -> impl Iterator<Item = u32> + use<> {
        let others = FIRST_OTHER..FIRST_OTHER + self.ends.len() as u32;
        (0..self.rectangles.len() as u32).chain(others)
    }
}

impl<'a> Outline<'a> {
    pub(super) fn of(corners: &'a [Point2]) -> Self {
        match <&[Point2; 4]>::try_from(corners) {
            Ok(four) if is_rectangle(four) => Self::Rectangle(four),
            _ => Self::Other(corners),
        }
    }

    #[inline]
    pub(super) fn corners(&self) -> &'a [Point2] {
        match self {
            Self::Rectangle(corners) => *corners,
            Self::Other(corners) => corners,
        }
    }
}

/// Whether four corners are a rectangle, up to the rounding of coordinates a thousand kilometres out.
#[inline]
fn is_rectangle([a, b, c, d]: &[Point2; 4]) -> bool {
    let (side, next) = (b - a, c - b);
    let skew = side - (c - d);
    let dot = side.dot(&next);
    skew.norm_squared() < 1e-18 && dot * dot < 1e-18 * side.norm_squared() * next.norm_squared()
}
