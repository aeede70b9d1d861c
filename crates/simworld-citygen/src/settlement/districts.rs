//! Districts of a place: the wishes for them as land.

use std::f64::consts::{FRAC_PI_4, FRAC_PI_8, PI};

use simworld_core::geometry::Compass;
use simworld_core::seed::Seed;
use simworld_core::spec::{DistrictKind, FeatureWish, Whereabouts};

use super::extent::{Extent, side_of};
use crate::zoning::{District, DistrictForm};

/// As shares of the way from the middle of the place to its farthest house: how far the middle reaches, where districts in a
/// direction begin, along water, and on the outskirts.
const MIDDLE: f64 = 0.4;
const ASIDE: f64 = 0.25;
const SHORE: f64 = 0.45;
const OUTSKIRTS: f64 = 0.7;

/// The districts that are wished for. The middle comes first, then water, what lies in a direction between the four winds, in one of
/// these, and the outskirts, so that the narrower counts where two overlap.
pub(super) fn placed(wish: &FeatureWish, extent: Extent, seed: Seed) -> Vec<District> {
    let parts = parts(wish, seed);
    let rank = |(index, part): (usize, &Whereabouts)| match (&wish.districts[index].by, part) {
        (None, Whereabouts::Middle) => 0,
        (Some(_), _) => 1,
        (None, Whereabouts::Outskirts) => 4,
        (None, Whereabouts::Towards(side)) if side.is_between() => 2,
        _ => 3,
    };
    let mut order: Vec<usize> = (0..parts.len()).collect();
    order.sort_by_key(|index| rank((*index, &parts[*index])));
    let of = |index: usize| {
        let wished = &wish.districts[index];
        let side = wished.by.as_deref().and_then(|by| side_of(&wish.waters, by));
        District { kind: wished.kind, form: form(extent, parts[index], side) }
    };
    order.into_iter().map(of).collect()
}

/// Where each district lies: where nothing is said, what a middle is for in the middle if that is free, everything else in a
/// direction of which nobody spoke.
fn parts(wish: &FeatureWish, seed: Seed) -> Vec<Whereabouts> {
    use Compass::{East, North, NorthEast, NorthWest, South, SouthEast, SouthWest, West};
    let mut free = vec![East, North, West, South];
    let turns = seed.stream("citygen/settlement/districts").rng().below(free.len());
    free.rotate_left(turns);
    free.extend([NorthEast, SouthWest, NorthWest, SouthEast]);
    let mut free: Vec<Whereabouts> = free.into_iter().map(Whereabouts::Towards).collect();
    let mut parts: Vec<Whereabouts> = wish.districts.iter().map(|district| district.at).collect();
    free.retain(|part| !parts.contains(part));
    let mut free = free.into_iter();
    for (index, district) in wish.districts.iter().enumerate() {
        if district.at != Whereabouts::Anywhere || district.by.is_some() {
            continue;
        }
        let is_central = !matches!(district.kind, DistrictKind::Industrial | DistrictKind::Residential);
        parts[index] = if is_central && !parts.contains(&Whereabouts::Middle) {
            Whereabouts::Middle
        } else {
            free.next().unwrap_or(Whereabouts::Outskirts)
        };
    }
    parts
}

fn form(extent: Extent, part: Whereabouts, shore: Option<f64>) -> DistrictForm {
    let Extent { heart: center, radius } = extent;
    if let Some(heading) = shore {
        return DistrictForm::Side { center, heading, beyond: SHORE * radius };
    }
    match part {
        Whereabouts::Towards(side) => {
            let half_angle = if side.is_between() { FRAC_PI_8 } else { FRAC_PI_4 };
            DistrictForm::Sector { center, heading: side.heading(), half_angle, beyond: ASIDE * radius }
        }
        Whereabouts::Outskirts => {
            DistrictForm::Sector { center, heading: 0.0, half_angle: PI, beyond: OUTSKIRTS * radius }
        }
        Whereabouts::Anywhere | Whereabouts::Middle => DistrictForm::Disc { center, radius: MIDDLE * radius },
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Point2;
    use simworld_core::spec::{DistrictWish, Water};

    use super::*;

    fn wish(kind: DistrictKind, at: Whereabouts) -> DistrictWish {
        DistrictWish { kind, at, by: None }
    }

    #[test]
    fn the_narrower_comes_first_and_what_is_open_finds_a_free_part() {
        let districts = vec![
            wish(DistrictKind::Green, Whereabouts::Outskirts),
            wish(DistrictKind::Residential, Whereabouts::Towards(Compass::North)),
            wish(DistrictKind::Business, Whereabouts::Anywhere),
            wish(DistrictKind::Industrial, Whereabouts::Anywhere),
            DistrictWish {
                by: Some("lake".to_owned()),
                ..wish(DistrictKind::Shopping, Whereabouts::Anywhere)
            },
        ];
        let features = FeatureWish { districts, waters: vec![Water::Lake], ..FeatureWish::default() };
        let extent = Extent { heart: Point2::origin(), radius: 100.0 };
        for seed in 0..8 {
            let placed = placed(&features, extent, Seed(seed));
            let at = |x: f64, y: f64| {
                placed.iter().find(|one| one.form.holds(Point2::new(x, y))).map(|one| one.kind)
            };
            assert_eq!(at(0.0, 0.0), Some(DistrictKind::Business), "{placed:?}");
            assert_eq!(at(0.0, 60.0), Some(DistrictKind::Residential));
            assert_eq!(at(0.0, -60.0), Some(DistrictKind::Shopping), "the lake lies in the south");
            let industrial = placed.iter().filter(|one| one.kind == DistrictKind::Industrial);
            assert!(industrial.clone().all(|one| !one.form.holds(Point2::new(0.0, 60.0))));
            assert_eq!((industrial.count(), placed.len()), (1, 5));
        }
    }
}
