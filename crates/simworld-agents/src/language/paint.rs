//! Colours as people name them.

/// A colour word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Paint {
    Red,
    Orange,
    Yellow,
    Green,
    Blue,
    Purple,
    Pink,
    Brown,
    White,
    Grey,
    Black,
}

/// Words for colours.
pub(crate) const PAINTS: &[(&[&str], Paint)] = &[
    (&["red", "crimson", "scarlet"], Paint::Red),
    (&["orange"], Paint::Orange),
    (&["yellow"], Paint::Yellow),
    (&["green"], Paint::Green),
    (&["blue", "navy"], Paint::Blue),
    (&["purple", "violet"], Paint::Purple),
    (&["pink"], Paint::Pink),
    (&["brown"], Paint::Brown),
    (&["white"], Paint::White),
    (&["grey", "gray", "silver"], Paint::Grey),
    (&["black", "dark"], Paint::Black),
];

/// The colours that models may name, with what each is, linear-light sRGB.
#[cfg(feature = "thought")]
pub(crate) fn named_colors() -> impl Iterator<Item = (&'static str, [f32; 3])> {
    PAINTS.iter().map(|(words, paint)| (words[0], paint.color()))
}

impl Paint {
    /// A colour of that name as paint has it, linear-light sRGB.
    pub(crate) const fn color(self) -> [f32; 3] {
        match self {
            Self::Red => [0.55, 0.03, 0.02],
            Self::Orange => [0.8, 0.2, 0.02],
            Self::Yellow => [0.8, 0.6, 0.03],
            Self::Green => [0.05, 0.35, 0.06],
            Self::Blue => [0.03, 0.08, 0.45],
            Self::Purple => [0.2, 0.03, 0.35],
            Self::Pink => [0.85, 0.25, 0.4],
            Self::Brown => [0.2, 0.08, 0.03],
            Self::White => [0.8, 0.8, 0.8],
            Self::Grey => [0.3, 0.3, 0.31],
            Self::Black => [0.01, 0.01, 0.012],
        }
    }

    /// The word for a colour in linear-light sRGB: by value and saturation for the greys, else by hue, with the sector
    /// borders of the usual hue circle (red 345 to 15°, orange to 38°, yellow to 70°, green to 165°, blue to 260°).
    /// Linear [0.55, 0.03, 0.02] is sRGB (194, 48, 39) and reads red.
    pub(super) fn of(linear: [f32; 3]) -> Self {
        // Gamma 2.2 is near enough to the sRGB curve to name a colour.
        let [r, g, b] =
            linear.map(|channel| simworld_core::ops::pow(f64::from(channel.clamp(0.0, 1.0)), 1.0 / 2.2));
        let (most, least) = (r.max(g).max(b), r.min(g).min(b));
        let spread = most - least;
        let saturation = if most > 0.0 { spread / most } else { 0.0 };
        if most < 0.2 {
            return Self::Black;
        }
        if saturation < 0.18 {
            return if most > 0.85 { Self::White } else { Self::Grey };
        }
        let sector = if most == r {
            ((g - b) / spread).rem_euclid(6.0)
        } else if most == g {
            (b - r) / spread + 2.0
        } else {
            (r - g) / spread + 4.0
        };
        match sector * 60.0 {
            hue if !(15.0..345.0).contains(&hue) => {
                if saturation < 0.45 && most > 0.7 {
                    Self::Pink
                } else {
                    Self::Red
                }
            }
            hue if hue < 38.0 => {
                if most < 0.6 {
                    Self::Brown
                } else {
                    Self::Orange
                }
            }
            hue if hue < 70.0 => Self::Yellow,
            hue if hue < 165.0 => Self::Green,
            hue if hue < 260.0 => Self::Blue,
            hue if hue < 310.0 => Self::Purple,
            _ => Self::Pink,
        }
    }
}

/// The word for a colour in linear-light sRGB.
#[cfg(feature = "thought")]
pub(crate) fn name_of_color(linear: [f32; 3]) -> &'static str {
    let paint = Paint::of(linear);
    // Every paint has a word.
    PAINTS.iter().find(|(_, named)| *named == paint).map_or("", |(words, _)| words[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paint_is_of_its_colour() {
        for (_, paint) in PAINTS {
            assert_eq!(Paint::of(paint.color()), *paint);
        }
    }

    #[test]
    fn paints_have_the_names_that_people_give_them() {
        for (linear, paint) in [
            ([0.55, 0.03, 0.02], Paint::Red),
            ([0.03, 0.08, 0.45], Paint::Blue),
            ([0.05, 0.35, 0.06], Paint::Green),
            ([0.8, 0.6, 0.03], Paint::Yellow),
            ([0.8, 0.2, 0.02], Paint::Orange),
            ([0.2, 0.08, 0.03], Paint::Brown),
            ([0.8, 0.8, 0.8], Paint::White),
            ([0.3, 0.3, 0.31], Paint::Grey),
            ([0.01, 0.01, 0.012], Paint::Black),
        ] {
            assert_eq!(Paint::of(linear), paint, "{linear:?}");
        }
    }
}
