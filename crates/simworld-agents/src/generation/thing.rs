//! What a thing of the grammar is: its names, its usual size, what words change of it, and how it is made.

use simworld_core::asset::Paint;
use simworld_core::scene::EntityKind;
use simworld_core::seed::StreamRng;

use super::sculpt::{Finish, Sculpt};
use super::stuff::Stuff;

/// A thing that can be made.
#[derive(Clone, Copy, Debug)]
pub(super) struct Thing {
    /// Its names in the singular, the usual one first.
    pub(super) names: &'static [&'static str],
    pub(super) kind: EntityKind,
    /// Usual length (x), width (y) and height, m.
    pub(super) size: [f64; 3],
    /// What most of it is made of.
    pub(super) stuff: Stuff,
    /// Its usual colour, linear-light sRGB; that of the material by default.
    pub(super) color: Option<[f32; 3]>,
    /// What words change beside its size and colour.
    pub(super) takes: &'static [Takes],
    /// The least and the greatest mass that is plausible at its usual size, kg.
    pub(super) mass: [f64; 2],
    pub(super) make: fn(&mut Sculpt, &mut Plan),
}

/// What words may change of a thing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Takes {
    /// It can be made of something else.
    Material,
    /// It can be round, and is not by itself.
    Round,
    /// It can be square, and is not by itself.
    Square,
    /// It has a second colour.
    Accent,
    /// It has a number of something.
    Count {
        /// Of what, in the plural and the singular.
        of: &'static [&'static str],
        usual: u32,
        least: u32,
        most: u32,
    },
    /// It has something, or has it not.
    Feature { what: &'static [&'static str], usual: Usual },
}

/// How a thing is where nothing is said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Usual {
    With,
    Without,
}

/// How a thing is shaped in the plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Style {
    Round,
    Square,
}

/// One thing with everything that was said of it, ready to be made.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// m.
    pub(super) size: [f64; 3],
    pub(super) stuff: Stuff,
    /// Whether words named the material.
    pub(super) stuff_is_said: bool,
    pub(super) accent: Option<[f32; 3]>,
    pub(super) style: Option<Style>,
    /// In the order of the thing's [`Takes::Count`].
    pub(super) counts: Vec<u32>,
    /// In the order of the thing's [`Takes::Feature`].
    pub(super) features: Vec<bool>,
    pub(super) rng: StreamRng,
}

impl Plan {
    /// How many of the first counted thing, or of another.
    pub(super) fn count(&self, which: usize) -> usize {
        self.counts.get(which).copied().unwrap_or(0) as usize
    }

    /// Whether it has the first feature, or another.
    pub(super) fn has(&self, which: usize) -> bool {
        self.features.get(which).copied().unwrap_or(false)
    }

    pub(super) fn is_round(&self) -> bool {
        self.style == Some(Style::Round)
    }

    pub(super) fn is_square(&self) -> bool {
        self.style == Some(Style::Square)
    }

    /// The main surface, in the colour of the thing.
    pub(super) fn main(&self) -> Finish {
        self.shaded(1.0)
    }

    /// The main surface, darker by a factor.
    pub(super) fn shaded(&self, factor: f32) -> Finish {
        Finish::dull([factor; 3], Paint::Entity, self.stuff.density())
    }

    /// The main surface, a little lighter or darker by chance: boards and stones differ.
    pub(super) fn varied(&mut self) -> Finish {
        let factor = self.rng.uniform(0.72, 1.0) as f32;
        self.shaded(factor)
    }

    /// Something that keeps its own colour.
    pub(super) fn own(stuff: Stuff) -> Finish {
        Self::painted(stuff, stuff.color())
    }

    /// Something with a colour that it keeps.
    pub(super) fn painted(stuff: Stuff, color: [f32; 3]) -> Finish {
        Finish::dull(color, Paint::Own, stuff.density())
    }

    /// The second colour, or another where none is said.
    pub(super) fn second(&self, stuff: Stuff, usual: [f32; 3]) -> Finish {
        Self::painted(stuff, self.accent.unwrap_or(usual))
    }

    /// What carries the rest: of its own material, or of the one that words name, a little darker.
    pub(super) fn support(&self, usual: Stuff) -> Finish {
        if self.stuff_is_said { self.shaded(0.6) } else { Self::own(usual) }
    }
}
