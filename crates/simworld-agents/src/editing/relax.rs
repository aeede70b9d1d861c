//! What would be possible where nothing has room as it was asked: looked for by the solver, and never guessed.

use std::cmp::Ordering;
use std::f64::consts::{FRAC_PI_2, PI};

use simworld_core::geometry::{Point2, direction, planar, yaw_of};
use simworld_core::id::{EntityId, RoadId};
use simworld_core::net::polyline;
use simworld_core::scene::{Relation, Scene};
use simworld_core::seed::Stream;

use super::edit::Stand;
use super::land::Streets;
use super::place::Placer;
use super::placing::Candidate;
use super::solid::Solid;
use super::stand::{FAR_SIDE, NEAR, Subject};

/// A gap that is still beside something, but not next to it, m.
const BESIDE: f64 = 15.0;
/// "Far from" something is looked for up to here, m.
const FARTHEST: f64 = 300.0;
/// By so much a distance that was said is stretched.
const STRETCHES: [f64; 3] = [1.5, 2.0, 3.0];
/// So far around what was named it is looked for elsewhere, m.
const AROUND: [f64; 2] = [80.0, 200.0];
/// In so many directions.
const WAYS: u32 = 8;
/// So many places are told.
const TOLD: usize = 4;
/// Of a street so many pieces are looked at.
const PIECES: usize = 6;

/// What has room where that which was asked for has none. It was found by the solver, in this order: the first that there is.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Relaxed {
    /// The same with a greater gap or reach.
    Wider {
        /// How it would stand.
        stands: Vec<Stand>,
        /// Where, m.
        at: Point2,
    },
    /// Near what it was to stand to.
    Near {
        /// How it would stand.
        stands: Vec<Stand>,
        /// Where, m.
        at: Point2,
    },
    /// In no such relation.
    Elsewhere {
        /// Where, m.
        at: Point2,
    },
    /// Fewer in the row.
    Fewer {
        /// The most that fit.
        count: u32,
        /// How far apart they would stand, m.
        spacing: f64,
    },
    /// Some places of the row, at which no row of fewer stands evenly.
    Free {
        /// Where, m.
        at: Vec<Point2>,
    },
    /// Nothing was found.
    Nothing,
}

impl Relaxed {
    /// What was found, in words.
    pub fn told(&self, scene: &dyn Scene) -> String {
        match self {
            Self::Wider { stands, at } | Self::Near { stands, at } => {
                let told: Vec<String> = stands.iter().map(|stand| stand.told(scene)).collect();
                format!("there is room {}, at ({:.1}, {:.1})", told.join(" and "), at.x, at.y)
            }
            Self::Elsewhere { at } => {
                format!("there is room elsewhere, at ({:.1}, {:.1})", at.x, at.y)
            }
            Self::Fewer { count: 1, .. } => "one alone would fit there".to_owned(),
            Self::Fewer { count, spacing } => {
                format!("a row of {count} would fit, one every {spacing:.1} m")
            }
            Self::Free { at } => {
                let told: Vec<String> =
                    at.iter().take(TOLD).map(|at| format!("({:.1}, {:.1})", at.x, at.y)).collect();
                let more = if at.len() > TOLD { " and others" } else { "" };
                format!("there is room for {} of them, at {}{more}", at.len(), told.join(", "))
            }
            Self::Nothing => "nothing else was found that would do".to_owned(),
        }
    }
}

/// What would be possible instead for a thing that has no room where it is to stand.
pub(super) fn relaxed(
    placer: &Placer<'_>,
    subject: Subject<'_>,
    stands: &[Stand],
    stream: Stream,
) -> Relaxed {
    let search = Search { placer, subject, stream: stream.named("relaxed") };
    for (rank, stands) in wider_all(stands, placer.scene).into_iter().enumerate() {
        if let Some(at) = search.room(&stands, rank as u64) {
            return Relaxed::Wider { stands, at };
        }
    }
    for (rank, stands) in near_all(stands, placer).into_iter().enumerate() {
        if let Some(at) = search.room(&stands, 100 + rank as u64) {
            return Relaxed::Near { stands, at };
        }
    }
    search.elsewhere(stands).map_or(Relaxed::Nothing, |at| Relaxed::Elsewhere { at })
}

/// A search for one thing.
struct Search<'a> {
    placer: &'a Placer<'a>,
    subject: Subject<'a>,
    stream: Stream,
}

impl Search<'_> {
    /// A place where all of this holds.
    fn room(&self, stands: &[Stand], rank: u64) -> Option<Point2> {
        let placing = self.placer.place(self.subject, (0, 1), stands, self.stream.indexed(rank));
        placing.pose().map(|pose| planar(&pose))
    }

    /// A place in no relation: around what was named, around the viewpoint, and farther off. What was to be far from something is far
    /// from it there too.
    fn elsewhere(&self, stands: &[Stand]) -> Option<Point2> {
        let Placer { scene, streets, from, lifted, load } = *self.placer;
        let middle = stands.iter().find_map(|stand| middle_of(stand, self.placer)).unwrap_or(from);
        let ring = |reach: f64| {
            (0..WAYS).map(move |way| middle + direction(f64::from(way) * 2.0 * PI / f64::from(WAYS)) * reach)
        };
        let far: Vec<Stand> = stands.iter().filter_map(off).collect();
        let fits = |candidate: &&Candidate| {
            let solid = Solid { pose: candidate.pose, shape: self.subject.info.shape };
            let holds = |stand: &Stand| stand.would_hold(scene, streets, self.subject, &solid);
            candidate.score().is_some() && far.iter().all(holds)
        };
        let around = [middle, from].into_iter().chain(AROUND.into_iter().flat_map(ring));
        around.enumerate().find_map(|(rank, from)| {
            let placer = Placer { scene, streets, from, lifted, load };
            let placing = placer.place(self.subject, (0, 1), &[], self.stream.indexed(200 + rank as u64));
            let fitting = placing.candidates.iter().filter(fits);
            let best = fitting.max_by(|a, b| a.score().partial_cmp(&b.score()).unwrap_or(Ordering::Equal));
            best.map(|found| planar(&found.pose))
        })
    }
}

/// All ways to let one of the relations reach farther, while the others hold as they were asked for.
fn wider_all(stands: &[Stand], scene: &dyn Scene) -> Vec<Vec<Stand>> {
    let mut all = Vec::new();
    for (index, stand) in stands.iter().enumerate() {
        for wider in wider(stand, scene) {
            let mut set = stands.to_vec();
            set.splice(index..=index, wider);
            all.push(set);
        }
    }
    all
}

/// The same relation with a greater gap or reach, if it has one: the least first.
fn wider(stand: &Stand, scene: &dyn Scene) -> Vec<Vec<Stand>> {
    let apart = |anchor: EntityId, least: f64, most: f64| Stand::Apart { anchor, least, most };
    match stand {
        Stand::To { relation: Relation::NextTo, anchor } => vec![vec![apart(*anchor, 0.0, BESIDE)]],
        Stand::To { relation: Relation::Near, anchor } => {
            [2.0, 4.0].map(|times| vec![apart(*anchor, NEAR, NEAR * times)]).into()
        }
        Stand::To { relation: Relation::FarFrom, anchor } => {
            vec![vec![stand.clone(), apart(*anchor, NEAR * 2.0, FARTHEST)]]
        }
        Stand::To { relation, anchor } => {
            let side = side_of(*relation).zip(scene.entity(*anchor));
            let farther = side.map(|(side, entity)| {
                let heading = yaw_of(entity.pose) + side;
                vec![Stand::Towards { heading, anchor: *anchor }, apart(*anchor, NEAR, FAR_SIDE)]
            });
            farther.into_iter().collect()
        }
        Stand::Offset { anchor, heading, distance } => {
            let farther =
                |times: f64| Stand::Offset { anchor: *anchor, heading: *heading, distance: distance * times };
            STRETCHES.map(|times| vec![farther(times)]).into()
        }
        Stand::Apart { anchor, least, most } => {
            STRETCHES.map(|times| vec![apart(*anchor, *least, most * times)]).into()
        }
        // The other side of the street.
        Stand::OnSide { roads, .. } => vec![vec![Stand::AlongRoad { roads: roads.clone() }]],
        _ => Vec::new(),
    }
}

/// To which side of a thing a relation leads, radians from where it looks.
const fn side_of(relation: Relation) -> Option<f64> {
    match relation {
        Relation::InFrontOf => Some(0.0),
        Relation::LeftOf => Some(FRAC_PI_2),
        Relation::Behind => Some(PI),
        Relation::RightOf => Some(-FRAC_PI_2),
        _ => None,
    }
}

/// Near what each of the relations is to. What keeps off something goes on to hold, for near it is its contrary.
fn near_all(stands: &[Stand], placer: &Placer<'_>) -> Vec<Vec<Stand>> {
    let far: Vec<Stand> = stands.iter().filter_map(off).collect();
    let all = stands.iter().flat_map(|stand| near(stand, placer)).map(|near| {
        let mut set = vec![near];
        set.extend(far.iter().cloned());
        set
    });
    all.filter(|set| set != stands).collect()
}

/// Near the thing, the junction, the street or the point that a relation is to; nothing where that is its contrary, or means another
/// thing: what is to stand on a table is of no use beside it.
fn near(stand: &Stand, placer: &Placer<'_>) -> Vec<Stand> {
    if keeps_off(stand) || is_of_part(stand) {
        return Vec::new();
    }
    if let Some(anchor) = stand.anchor() {
        return vec![Stand::To { relation: Relation::Near, anchor }];
    }
    match (stand, placer.streets) {
        (Stand::AlongRoad { roads } | Stand::OnSide { roads, .. }, Some(streets)) => {
            roads.iter().take(PIECES).map(|road| Stand::Around { point: half_way(streets, *road) }).collect()
        }
        _ => middle_of(stand, placer).map(|point| Stand::Around { point }).into_iter().collect(),
    }
}

/// What is left of a relation that keeps off a thing, where the rest of what was asked for is given up: that it does.
fn off(stand: &Stand) -> Option<Stand> {
    match stand {
        Stand::To { relation: Relation::FarFrom, .. } => Some(stand.clone()),
        Stand::Apart { anchor, least, most } if *least >= NEAR => {
            Some(Stand::Apart { anchor: *anchor, least: *least, most: most.max(FARTHEST) })
        }
        _ => None,
    }
}

/// Whether a relation asks for a distance, to which what is near is the contrary.
fn keeps_off(stand: &Stand) -> bool {
    off(stand).is_some() || matches!(stand, Stand::Offset { distance, .. } if *distance >= NEAR)
}

/// Whether a relation is to a part of a thing, on or in which the other is to stand.
const fn is_of_part(stand: &Stand) -> bool {
    matches!(
        stand,
        Stand::InMiddleOf { .. } | Stand::To { relation: Relation::OnTopOf | Relation::Inside, .. }
    )
}

/// Where the thing, the junction, the street or the point is that a relation is to, m.
fn middle_of(stand: &Stand, placer: &Placer<'_>) -> Option<Point2> {
    if let Some(anchor) = stand.anchor() {
        return placer.scene.entity(anchor).map(|entity| entity.planar());
    }
    match stand {
        Stand::At { point } | Stand::Around { point } => Some(*point),
        Stand::AtJunction { junction } => {
            let places = &placer.streets?.network().intersections;
            places.get(junction.index()).map(|place| place.center)
        }
        Stand::AlongRoad { roads } | Stand::OnSide { roads, .. } => {
            Some(half_way(placer.streets?, *roads.first()?))
        }
        _ => None,
    }
}

fn half_way(streets: &Streets, road: RoadId) -> Point2 {
    let line = &streets.road(road).centerline;
    polyline::at(line, polyline::length(line) * 0.5).0
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::geometry::{Point3, pose_facing};
    use simworld_core::id::IntersectionId;
    use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};

    use super::*;

    /// A crossroads with a bench beside it.
    fn crossroads() -> (World, Streets, EntityId) {
        let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default()).unwrap();
        let mut world = World::new();
        let pose = pose_facing(Point3::new(30.0, 12.0, 0.0), 0.0);
        let bench = EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.85));
        let bench = world.spawn(bench).unwrap();
        (world, Streets::of(&Arc::new(network)), bench)
    }

    fn all_near(stand: Stand) -> Vec<Vec<Stand>> {
        let (world, streets, _) = crossroads();
        let placer =
            Placer { scene: &world, streets: Some(&streets), from: Point2::origin(), lifted: &[], load: &[] };
        near_all(&[stand], &placer)
    }

    #[test]
    fn near_a_street_is_around_the_middle_of_each_of_its_pieces() {
        let (_, streets, _) = crossroads();
        let roads: Vec<RoadId> = (0..2).map(RoadId::from_index).collect();
        let around: Vec<Vec<Stand>> =
            roads.iter().map(|road| vec![Stand::Around { point: half_way(&streets, *road) }]).collect();
        assert_eq!(all_near(Stand::AlongRoad { roads: roads.clone() }), around);
        assert_eq!(all_near(Stand::OnSide { roads, heading: 0.0 }), around);
    }

    #[test]
    fn near_a_junction_is_around_it() {
        let (_, streets, _) = crossroads();
        for (index, place) in streets.network().intersections.iter().enumerate() {
            let junction = IntersectionId::from_index(index);
            let around = vec![vec![Stand::Around { point: place.center }]];
            assert_eq!(all_near(Stand::AtJunction { junction }), around);
        }
    }

    #[test]
    fn near_is_offered_for_nothing_to_which_it_is_the_contrary() {
        let (.., anchor) = crossroads();
        for stand in [
            Stand::To { relation: Relation::FarFrom, anchor },
            Stand::To { relation: Relation::OnTopOf, anchor },
            Stand::To { relation: Relation::Inside, anchor },
            Stand::InMiddleOf { anchor },
            Stand::Apart { anchor, least: 50.0, most: 60.0 },
            Stand::Offset { anchor, heading: 0.0, distance: 80.0 },
            // It was tried.
            Stand::To { relation: Relation::Near, anchor },
        ] {
            assert_eq!(all_near(stand.clone()), Vec::<Vec<Stand>>::new(), "{stand:?}");
        }
        let near = vec![vec![Stand::To { relation: Relation::Near, anchor }]];
        assert_eq!(all_near(Stand::AtCornerOf { anchor }), near);
    }

    #[test]
    fn what_keeps_off_a_thing_goes_on_to_where_another_is_given_up() {
        let (world, streets, anchor) = crossroads();
        let placer =
            Placer { scene: &world, streets: Some(&streets), from: Point2::origin(), lifted: &[], load: &[] };
        let far = Stand::To { relation: Relation::FarFrom, anchor };
        let point = Point2::new(90.0, 40.0);
        let sets = near_all(&[Stand::At { point }, far.clone()], &placer);
        assert_eq!(sets, [vec![Stand::Around { point }, far]]);
    }

    #[test]
    fn a_distance_that_was_said_is_stretched_and_the_other_side_of_a_street_is_a_side() {
        let (world, _, anchor) = crossroads();
        let offset = |distance| Stand::Offset { anchor, heading: 1.0, distance };
        let farther = [15.0, 20.0, 30.0].map(|distance| vec![offset(distance)]);
        assert_eq!(wider(&offset(10.0), &world), farther);
        let roads = vec![RoadId::from_index(0)];
        let either = vec![vec![Stand::AlongRoad { roads: roads.clone() }]];
        assert_eq!(wider(&Stand::OnSide { roads, heading: 0.0 }, &world), either);
        assert!(wider(&Stand::To { relation: Relation::OnTopOf, anchor }, &world).is_empty());
    }

    #[test]
    fn a_long_way_along_a_street_that_is_full_leads_somewhere_else() {
        let (world, streets, anchor) = crossroads();
        let placer =
            Placer { scene: &world, streets: Some(&streets), from: Point2::origin(), lifted: &[], load: &[] };
        let bench = world.entity(anchor).unwrap();
        let subject = Subject { id: None, kind: bench.kind, info: bench.info };
        let search =
            Search { placer: &placer, subject, stream: simworld_core::seed::Seed(3).stream("tests") };
        let at = search.elsewhere(&[Stand::AlongRoad { roads: vec![RoadId::from_index(0)] }]).unwrap();
        assert!(
            (at - half_way(&streets, RoadId::from_index(0))).norm() <= 45.0,
            "around the street first: {at}"
        );
    }
}
