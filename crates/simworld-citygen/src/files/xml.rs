//! What writers of XML share: safe text, short numbers.

use std::borrow::Cow;
use std::fmt::{self, Display};

use simworld_core::geometry::Point2;

/// Text that may stand between quotes or tags.
pub(crate) fn escaped(text: &str) -> Cow<'_, str> {
    if !text.contains(|c: char| matches!(c, '<' | '>' | '&' | '"') || c.is_control()) {
        return Cow::Borrowed(text);
    }
    let mut safe = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        match c {
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '&' => safe.push_str("&amp;"),
            '"' => safe.push_str("&quot;"),
            c if c.is_control() => safe.push(' '),
            c => safe.push(c),
        }
    }
    Cow::Owned(safe)
}

/// A number with two decimals, as SUMO writes them; never `-0.00`.
pub(crate) struct Two(pub(crate) f64);

impl Display for Two {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding zero turns -0 into 0.
        write!(f, "{:.2}", (self.0 * 100.0).round() / 100.0 + 0.0)
    }
}

/// Points as `x,y x,y`.
pub(crate) struct Shape<'a>(pub(crate) &'a [Point2]);

impl Display for Shape<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, point) in self.0.iter().enumerate() {
            let gap = if index == 0 { "" } else { " " };
            write!(f, "{gap}{},{}", Two(point.x), Two(point.y))?;
        }
        Ok(())
    }
}
