//! Street statistics beside the band of a style.

use std::fmt;

use super::StreetStatistics;
use crate::Style;

/// Street statistics beside the band of a style: as text, a line for each, with its range and whether it lies in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Judged {
    statistics: StreetStatistics,
    style: Style,
}

impl StreetStatistics {
    /// The statistics beside the band of a style.
    ///
    /// ```
    /// use simworld_citygen::{City, CityConfig, Style};
    /// use simworld_core::seed::Seed;
    /// let city = City::generate(&CityConfig::with_roads(60), Seed(7))?;
    /// let judged = city.report().streets.judged(Style::Mixed).to_string();
    /// assert_eq!(judged.lines().count(), 8);
    /// assert!(judged.contains("streets a junction"));
    /// # Ok::<(), simworld_citygen::CityError>(())
    /// ```
    pub const fn judged(&self, style: Style) -> Judged {
        Judged { statistics: *self, style }
    }
}

impl Judged {
    /// Whether all statistics lie in the band.
    pub fn is_in_band(&self) -> bool {
        self.style.band().check(&self.statistics).iter().all(|(_, _, _, inside)| *inside)
    }
}

impl fmt::Display for Judged {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (name, value, range, inside)) in
            self.style.band().check(&self.statistics).into_iter().enumerate()
        {
            if index > 0 {
                writeln!(f)?;
            }
            let verdict = if inside { "in" } else { "OUT OF" };
            write!(
                f,
                "{name:<22}{value:>9.3}   {verdict} {} to {} ({})",
                range.start(),
                range.end(),
                self.style
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plain_grid_is_told_from_an_organic_city() {
        let streets = StreetStatistics::of(&simworld_core::net::StreetPlan::grid(12, 12, 100.0));
        let judged = streets.judged(Style::Organic);
        let text = judged.to_string();
        let line = |name: &str| text.lines().find(|line| line.starts_with(name)).map(str::to_owned);
        assert!(!judged.is_in_band());
        assert!(line("orientation order").is_some_and(|line| line.contains("OUT OF 0.01 to 0.15 (organic)")));
        assert!(line("median length").is_some_and(|line| line.contains(" in 60 to 105")));
    }
}
