//! Where something that was asked for is to be: how far a point is from there.

use simworld_core::geometry::Point2;
use simworld_core::scene::Place;
use simworld_core::spec::{SiteWish, Water, Whereabouts};

use super::extent::{Extent, side_of};
use super::layout::Laid;
use crate::building::Building;

/// What stands farther from what it should be beside does not stand beside it, m; along water as a share of the place, if that is
/// more.
const BESIDE: f64 = 90.0;
const ALONG_WATER: f64 = 0.55;

/// What something is to be beside.
enum Beside {
    /// Water on the side of the place that lies in a direction, radians from east.
    Shore(f64),
    /// Things, by their middles, m.
    Things(Vec<Point2>),
}

/// Where something is to be.
pub(super) struct Aim {
    extent: Extent,
    at: Whereabouts,
    beside: Option<Beside>,
    /// Where it is looked for if nothing is said, m.
    otherwise: Point2,
}

impl Aim {
    /// Somewhere near a point.
    pub(super) fn near(extent: Extent, otherwise: Point2) -> Self {
        Self { extent, at: Whereabouts::Anywhere, beside: None, otherwise }
    }

    /// Where a site says, among what is there already.
    pub(super) fn of(
        site: &SiteWish,
        extent: Extent,
        waters: &[Water],
        buildings: &[Building],
        laid: &Laid,
    ) -> Self {
        let beside = site.by.as_deref().and_then(|by| beside(by, waters, buildings, laid));
        Self { extent, at: site.at, beside, otherwise: extent.heart }
    }

    /// How far a point is from there, m.
    pub(super) fn cost(&self, point: Point2) -> f64 {
        let beside = self.way_to_beside(point);
        match (self.at, beside) {
            (Whereabouts::Anywhere, None) => (point - self.otherwise).norm(),
            (at, None) => self.extent.away(at, point),
            // What it is beside counts more than in which part of the place that is.
            (at, Some(beside)) => beside + 0.25 * self.extent.away(at, point),
        }
    }

    /// Whether a point lies in the part of the place that was named.
    pub(super) fn is_in_part(&self, point: Point2) -> bool {
        self.extent.holds(self.at, point)
    }

    /// How far a point is from what it should be beside, if it is too far, m.
    pub(super) fn too_far(&self, point: Point2) -> Option<f64> {
        let most = match self.beside {
            Some(Beside::Shore(_)) => BESIDE.max(ALONG_WATER * self.extent.radius),
            _ => BESIDE,
        };
        self.way_to_beside(point).filter(|far| *far > most)
    }

    fn way_to_beside(&self, point: Point2) -> Option<f64> {
        match self.beside.as_ref()? {
            Beside::Shore(heading) => Some(self.extent.way_to_side(*heading, point)),
            Beside::Things(things) => {
                let away = things.iter().map(|thing| (thing - point).norm());
                Some(away.fold(f64::INFINITY, f64::min)).filter(|far| far.is_finite())
            }
        }
    }
}

/// What bears a name of a spec: water, squares, parks, landmarks, houses of a use.
fn beside(name: &str, waters: &[Water], buildings: &[Building], laid: &Laid) -> Option<Beside> {
    if let Some(heading) = side_of(waters, name) {
        return Some(Beside::Shore(heading));
    }
    let areas = laid.areas.iter().filter(|area| area.used_as == name).map(|area| area.middle);
    let landmarks = laid.landmarks.iter().filter(|landmark| landmark.asset == name);
    let place = Place::from_name(name);
    let houses = buildings.iter().filter(|building| Some(building.place) == place);
    let middles = areas.chain(landmarks.map(|landmark| landmark.middle));
    let middles: Vec<Point2> = middles.chain(houses.map(|building| building.center)).collect();
    (!middles.is_empty()).then_some(Beside::Things(middles))
}
