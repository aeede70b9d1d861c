//! Words that say how a thing is: sizes, measures, shapes and colours.

use super::thing::Style;

/// Words that say nothing by themselves.
#[rustfmt::skip]
pub(super) const HARMLESS: &[&str] = &["a", "an", "the", "of", "with", "and", "made", "out", "from", "for", "to", "it", "that", "which", "is",
    "has", "having", "some", "in", "painted", "coloured", "colored", "standing", "please", "one", "single", "ordinary", "plain", "simple", "usual",
    "normal", "very", "extra", "really"];
/// Words behind which something else is spoken of than the thing itself.
#[rustfmt::skip]
pub(super) const BEHIND: &[&str] = &["with", "without", "of", "made", "in", "on", "for", "from", "near", "next", "that", "which", "having", "painted",
    "beside", "under", "behind", "by", "and"];
/// Words that deny what follows.
pub(super) const WITHOUT: &[&str] = &["without", "no"];
/// Words that make the next one stronger.
pub(super) const STRONGER: &[&str] = &["very", "extra", "really", "super", "extremely"];

/// Which sides a word is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sides {
    Height,
    /// The longer side of the ground plan.
    Longer,
    /// From left to right, as seen from the front.
    Width,
    /// From front to back.
    Depth,
    /// Both sides of the ground plan.
    Across,
    /// The side by which the thing is usually measured.
    Main,
    All,
}

/// Words for sizes, and how many times as large the side is.
#[rustfmt::skip]
pub(super) const SIZES: &[(&[&str], Sides, f64)] = &[
    (&["tall", "high"], Sides::Height, 1.5),
    (&["low"], Sides::Height, 0.65),
    (&["short"], Sides::Main, 0.65),
    (&["long"], Sides::Longer, 1.5),
    (&["wide", "broad"], Sides::Width, 1.5),
    (&["narrow"], Sides::Width, 0.65),
    (&["deep"], Sides::Depth, 1.5),
    (&["thick", "fat", "stout"], Sides::Across, 1.4),
    (&["thin", "slim", "slender"], Sides::Across, 0.7),
    (&["small", "little", "mini"], Sides::All, 0.7),
    (&["tiny", "miniature"], Sides::All, 0.45),
    (&["big", "large"], Sides::All, 1.4),
    (&["huge", "giant", "enormous", "gigantic", "massive"], Sides::All, 2.0),
];

/// Words for the side that a measure is of.
#[rustfmt::skip]
pub(super) const MEASURED: &[(&[&str], Sides)] = &[
    (&["high", "tall", "height", "tallness"], Sides::Height),
    (&["long", "length"], Sides::Longer),
    (&["wide", "width", "broad", "across"], Sides::Width),
    (&["deep", "depth"], Sides::Depth),
    (&["thick", "diameter", "thickness"], Sides::Across),
];

/// Units of length, m.
#[rustfmt::skip]
pub(super) const UNITS: &[(&[&str], f64)] = &[
    (&["m", "metre", "metres", "meter", "meters"], 1.0),
    (&["cm", "centimetre", "centimetres", "centimeter", "centimeters"], 0.01),
    (&["mm", "millimetre", "millimetres", "millimeter", "millimeters"], 0.001),
    (&["ft", "foot", "feet"], 0.3048),
    (&["inch", "inches"], 0.0254),
];

/// Words for shapes.
#[rustfmt::skip]
pub(super) const STYLES: &[(&[&str], Style)] = &[
    (&["round", "circular", "cylindrical"], Style::Round),
    (&["square", "rectangular", "angular", "boxy"], Style::Square),
];

/// Colours beyond those that all sentences know, linear-light sRGB.
#[rustfmt::skip]
pub(super) const COLORS: &[(&[&str], [f32; 3])] = &[
    (&["turquoise", "teal", "cyan"], [0.02, 0.35, 0.38]),
    (&["beige", "cream", "ivory", "tan"], [0.62, 0.5, 0.33]),
    (&["magenta", "fuchsia"], [0.6, 0.02, 0.35]),
    (&["lime"], [0.3, 0.6, 0.03]),
    (&["maroon", "burgundy"], [0.14, 0.01, 0.02]),
    (&["olive", "khaki"], [0.2, 0.2, 0.05]),
];

/// Words that make the next colour lighter or darker: towards what, and how far.
pub(super) const SHADES: &[(&[&str], f32, f32)] = &[
    (&["light", "pale", "pastel"], 0.85, 0.45),
    (&["dark", "deep"], 0.0, 0.6),
    (&["bright", "vivid"], 0.0, 0.0),
];

/// Words for stripes, where a thing has a second colour.
pub(super) const STRIPED: &[&str] = &["striped", "stripes", "stripy"];

/// The entry that lists a word.
pub(super) fn listed<'a, T>(rows: &'a [T], words: impl Fn(&T) -> &[&str], word: &str) -> Option<&'a T> {
    rows.iter().find(|row| words(row).contains(&word))
}
