//! Districts: parts of a city whose use does not follow from the fields, because somebody asked for it.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, direction, heading};
use simworld_core::ops::wrap_angle;
use simworld_core::spec::DistrictKind;

use super::Zone;
use crate::CityError;
use crate::range::{check, is_place};

/// The most districts of a city.
const MOST: usize = 64;

/// A part of a city with a character of its own.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct District {
    /// What it is like.
    pub kind: DistrictKind,
    /// What lies in it.
    pub form: DistrictForm,
}

/// The land of a district.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum DistrictForm {
    /// All that lies no farther from a point.
    Disc {
        /// The point, m.
        center: Point2,
        /// How far, m.
        radius: f64,
    },
    /// All that lies farther from a point, in some direction.
    Sector {
        /// The point, m.
        center: Point2,
        /// The direction, radians from east.
        heading: f64,
        /// How far to either side of it, radians in [0, π]: π is all round.
        half_angle: f64,
        /// How far from the point it begins, m.
        beyond: f64,
    },
    /// All that lies beyond a line across a direction.
    Side {
        /// A point, m.
        center: Point2,
        /// The direction, radians from east.
        heading: f64,
        /// How far from the point the line is, m.
        beyond: f64,
    },
}

impl DistrictForm {
    /// Whether a point lies in it.
    pub fn holds(&self, point: Point2) -> bool {
        match *self {
            Self::Disc { center, radius } => (point - center).norm() <= radius,
            Self::Sector { center, heading: towards, half_angle, beyond } => {
                let way = point - center;
                way.norm() > beyond && wrap_angle(heading(&way) - towards).abs() <= half_angle
            }
            Self::Side { center, heading: towards, beyond } => {
                (point - center).dot(&direction(towards)) > beyond
            }
        }
    }

    /// The numbers of it: its point, a direction, an angle, a distance.
    fn parts(&self) -> (Point2, f64, f64, f64) {
        match *self {
            Self::Disc { center, radius } => (center, 0.0, 0.0, radius),
            Self::Sector { center, heading, half_angle, beyond } => (center, heading, half_angle, beyond),
            Self::Side { center, heading, beyond } => (center, heading, 0.0, beyond),
        }
    }
}

impl District {
    /// What the land at a point of it is used for, by the character of the land there, which is spread evenly over [0, 1].
    pub(super) fn zone(&self, character: f64) -> Zone {
        match self.kind {
            DistrictKind::OldTown if character < 0.06 => Zone::Civic,
            DistrictKind::OldTown if character < 0.55 => Zone::Commercial,
            DistrictKind::Residential if character < 0.05 => Zone::Park,
            DistrictKind::Business | DistrictKind::Shopping => Zone::Commercial,
            DistrictKind::Industrial => Zone::Industrial,
            DistrictKind::Civic => Zone::Civic,
            DistrictKind::Green => Zone::Park,
            _ => Zone::Residential,
        }
    }

    /// How densely people live and work there, where the fields say `usual`. Offices need the density of a metropolis, shops and
    /// small houses do not.
    pub(super) fn density(&self, usual: f64) -> f64 {
        match self.kind {
            DistrictKind::OldTown | DistrictKind::Shopping => 0.45,
            DistrictKind::Residential => usual.clamp(0.15, 0.6),
            DistrictKind::Business => usual.max(0.85),
            DistrictKind::Industrial => usual.min(0.3),
            _ => usual,
        }
    }
}

/// Checks the districts of a configuration.
pub(super) fn validate(districts: &[District]) -> Result<(), CityError> {
    let count = districts.len() as f64;
    check(&[("zoning.districts", count, 0.0, MOST as f64, "at most 64")])?;
    for district in districts {
        let (center, heading, half_angle, distance) = district.form.parts();
        let farthest = center.x.abs().max(center.y.abs());
        check(&[
            ("zoning.districts.form.center", farthest, 0.0, 1e7, "at most 10 000 km off"),
            ("zoning.districts.form.heading", heading, -10.0, 10.0, "an angle within ±10 rad"),
            ("zoning.districts.form.half_angle", half_angle, 0.0, std::f64::consts::PI, "0 to π rad"),
            ("zoning.districts.form", distance, -1e7, 1e7, "a distance of at most 10 000 km"),
        ])?;
        // NaN is no coordinate, and `max` passes over one of two.
        if !is_place(&center) {
            let (field, allowed) = ("zoning.districts.form.center", "at most 10 000 km off");
            return Err(CityError::Config { field, value: f64::NAN, allowed });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_hold_what_they_say() {
        let center = Point2::new(10.0, 0.0);
        let at = |x: f64, y: f64| Point2::new(x, y);
        let disc = DistrictForm::Disc { center, radius: 5.0 };
        assert!(disc.holds(at(14.0, 0.0)) && !disc.holds(at(16.0, 0.0)));
        let sector = |heading| DistrictForm::Sector { center, heading, half_angle: 0.8, beyond: 5.0 };
        let (east, west) = (sector(0.0), sector(std::f64::consts::PI));
        assert!(east.holds(at(20.0, 3.0)) && !east.holds(at(14.0, 0.0)) && !east.holds(at(10.0, 20.0)));
        assert!(west.holds(at(0.0, -1.0)) && west.holds(at(0.0, 1.0)) && !west.holds(at(20.0, 0.0)));
        let shore = DistrictForm::Side { center, heading: -std::f64::consts::FRAC_PI_2, beyond: 2.0 };
        assert!(shore.holds(at(500.0, -3.0)) && !shore.holds(at(500.0, -1.0)));
    }

    #[test]
    fn what_is_no_number_is_refused() {
        let disc = |x: f64, radius: f64| District {
            kind: DistrictKind::Green,
            form: DistrictForm::Disc { center: Point2::new(x, 0.0), radius },
        };
        assert!(validate(&[disc(0.0, 10.0)]).is_ok());
        for wrong in [disc(f64::NAN, 10.0), disc(0.0, f64::NAN), disc(1e9, 10.0)] {
            assert!(matches!(validate(&[wrong]), Err(CityError::Config { .. })));
        }
        assert!(validate(&vec![disc(0.0, 10.0); 65]).is_err());
    }
}
