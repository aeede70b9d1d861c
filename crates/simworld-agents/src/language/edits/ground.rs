//! Rows, streets, areas and distances: what the words about them mean in the scene.

use std::ops::ControlFlow;

use simworld_core::geometry::{Point2, direction, yaw_of};
use simworld_core::id::{EntityId, IntersectionId, RoadId};
use simworld_core::net::{LaneDirection, RoadNetwork, polyline};
use simworld_core::passage::Passage;
use simworld_core::scene::{EntityKind, Relation};

use super::super::clause::{Choice, Count, Reference};
use super::super::lexicon::class;
use super::resolve::Finder;
use super::wish::{Anchor, Bearing, NewThing, StreetRef, Where, Wish};
use crate::editing::{Edit, EditError, Line, Sides, Spacing, Stand, called};

/// So many of a kind along something stand in a row.
pub(super) const ROW: u32 = 3;
/// So many around something stand in a circle, if it is no wider than this, m.
const RING: (u32, f64) = (4, 60.0);
/// Around what is no wider than this, m, things stand in a circle though nobody says how many.
const SMALL_RING: f64 = 8.0;
/// So many are a circle around a thing of which nobody says how many it has.
const RING_OF: u32 = 8;
/// Beside what is longer than the first, things of a row stand so far apart, m: street lamps do.
const WIDE: (f64, f64) = (60.0, 20.0);
/// The same of what is no shorter than the first.
const NARROW: (f64, f64) = (15.0, 5.0);
/// A street farther than this from a thing is not before, behind or beside it, m.
const STREET: f64 = 80.0;
/// The streets around a thing are those within, m.
const BLOCK: f64 = 250.0;
/// The farthest that a distance from a thing may be, m.
const FAR: f64 = 500.0;

impl Finder<'_> {
    // ---- rows ----

    /// Several things along something are a row.
    pub(super) fn lined_up(&self, things: &[NewThing], at: &[Where]) -> Result<Option<Edit>, EditError> {
        let ([thing], [line]) = (things, at) else { return Ok(None) };
        if thing.many {
            return self.lined_many(thing, line);
        }
        let is_row = match line {
            // "Four taxis on Oak Street" are parked there one by one: a row would keep them off the carriageway and at its kerb at once.
            Where::Along(Anchor::Street(..)) if self.drives(thing) => false,
            Where::Along(_)
            | Where::BothSides(_)
            | Where::Between(..)
            | Where::Compass(_, Anchor::Street(..)) => thing.count >= ROW,
            Where::Around(anchor @ Anchor::Thing(_)) => {
                let anchor = self.anchor(anchor, &[])?;
                let size = self
                    .scene
                    .entity(anchor)
                    .map_or(f64::INFINITY, |entity| entity.info.shape.size().xy().max());
                thing.count >= RING.0 && size <= RING.1
            }
            _ => false,
        };
        if is_row { self.row(thing, line, Spacing::Count(thing.count)).map(Some) } else { Ok(None) }
    }

    /// Whether a new thing is a vehicle.
    fn drives(&self, thing: &NewThing) -> bool {
        let catalogue = &self.stock.catalogue;
        let asset = self.made(thing).ok().and_then(|make| catalogue.get(catalogue.find(&make.asset)?));
        asset.is_some_and(|asset| asset.kind.is_vehicle())
    }

    /// Things of which nobody says how many: a row of them as wide as such rows are, or a circle.
    fn lined_many(&self, thing: &NewThing, line: &Where) -> Result<Option<Edit>, EditError> {
        let size = |anchor: &Anchor| -> Result<f64, EditError> {
            let anchor = self.anchor(anchor, &[])?;
            Ok(self.scene.entity(anchor).map_or(0.0, |entity| entity.info.shape.size().xy().max()))
        };
        let along = |length: f64| match length {
            long if long > WIDE.0 => Spacing::Every(WIDE.1),
            middling if middling > NARROW.0 => Spacing::Every(NARROW.1),
            _ => Spacing::Count(ROW),
        };
        let spacing = match line {
            Where::Along(Anchor::Street(..))
            | Where::BothSides(Anchor::Street(..))
            | Where::Compass(_, Anchor::Street(..)) => Spacing::Every(WIDE.1),
            Where::Along(anchor) => along(size(anchor)?),
            Where::Between(one, other) => {
                let place = |anchor: &Anchor| -> Result<Point2, EditError> {
                    let id = self.anchor(anchor, &[])?;
                    Ok(self.scene.entity(id).map_or(Point2::origin(), |entity| entity.planar()))
                };
                along((place(one)? - place(other)?).norm())
            }
            Where::Around(anchor @ Anchor::Thing(_)) if size(anchor)? <= SMALL_RING => {
                Spacing::Count(RING_OF)
            }
            Where::Around(anchor @ Anchor::Thing(_)) => along(size(anchor)? * 2.0),
            _ => return Ok(None),
        };
        self.row(thing, line, spacing).map(Some)
    }

    pub(super) fn row(&self, thing: &NewThing, line: &Where, spacing: Spacing) -> Result<Edit, EditError> {
        let line = match line {
            Where::Along(Anchor::Street(_, roads)) => {
                Line::Road { roads: roads.clone(), sides: Sides::Either }
            }
            Where::BothSides(Anchor::Street(_, roads)) => {
                Line::Road { roads: roads.clone(), sides: Sides::Both }
            }
            Where::Compass(compass, Anchor::Street(_, roads)) => {
                Line::RoadSide { roads: roads.clone(), heading: compass.heading() }
            }
            Where::Along(anchor) | Where::BothSides(anchor) => {
                Line::Along { anchor: self.anchor(anchor, &[])? }
            }
            Where::Between(one, other) => {
                Line::Between { one: self.anchor(one, &[])?, other: self.anchor(other, &[])? }
            }
            Where::Around(anchor) => Line::Around { anchor: self.anchor(anchor, &[])? },
            _ => {
                let what = "a row there".to_owned();
                return Err(EditError::Impossible {
                    what,
                    why: "say along or around what, or between what".to_owned(),
                });
            }
        };
        Ok(Edit::Row { make: self.made(thing)?, line, spacing })
    }

    // ---- conditions ----

    pub(super) fn given(
        &self,
        what: &Reference,
        (least, there): (u32, bool),
        then: &Wish,
    ) -> Result<Vec<Edit>, EditError> {
        let all = Reference { count: Count::All, ..what.clone() };
        let found = match self.candidates(&all) {
            Ok(found) => found,
            Err(EditError::NotFound { .. }) => Vec::new(),
            Err(error) => return Err(error),
        };
        if (found.len() >= least as usize) != there {
            let why = match found.first().and_then(|thing| self.scene.entity(*thing)) {
                Some(entity) => {
                    format!("nothing was changed: there is {} ({})", called(self.scene, &entity), entity.id)
                }
                None => format!("nothing was changed: there is no {}", what.text),
            };
            return Ok(vec![Edit::Leave { why }]);
        }
        // "If the truck is not red, paint it red": it is the truck, of whatever colour.
        let mut plain = all;
        plain.traits.paint = None;
        let it = || self.candidates(&plain).ok().filter(|found| found.len() == 1)?.first().copied();
        let focus = self.focus_on(found.first().copied().or_else(it));
        let view = super::view_of(self.scene, &focus);
        self.looking_with(&focus, view).edits(then)
    }

    /// Every second, third ... of all that fit, in the order in which they stand.
    pub(super) fn every_nth(&self, reference: &Reference, nth: u32) -> Result<Vec<EntityId>, EditError> {
        let all = self.in_a_row(&Reference { choice: Choice::Open, ..reference.clone() })?;
        let chosen = self.every_from(all, nth, reference.first);
        if chosen.is_empty() {
            let near = format!("there are fewer than {nth}");
            return Err(EditError::NotFound { wanted: reference.text.clone(), near });
        }
        Ok(chosen)
    }

    /// All that fit, from west to east or from south to north, whichever way they spread.
    pub(super) fn in_a_row(&self, reference: &Reference) -> Result<Vec<EntityId>, EditError> {
        let mut all = self.candidates(reference)?;
        let place = |id: &EntityId| self.scene.entity(*id).map_or(Point2::origin(), |entity| entity.planar());
        let spread = |pick: fn(&Point2) -> f64| {
            let values = || all.iter().map(|id| pick(&place(id)));
            values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
        };
        let is_wide = spread(|at| at.x) >= spread(|at| at.y);
        all.sort_by(|a, b| {
            let (a, b) = (place(a), place(b));
            if is_wide {
                a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y))
            } else {
                a.y.total_cmp(&b.y).then(a.x.total_cmp(&b.x))
            }
        });
        Ok(all)
    }

    // ---- places ----

    /// A place that has to do with the ground, or with a distance.
    pub(super) fn stand_on_ground(&self, place: &Where, moved: &[EntityId]) -> Result<Stand, EditError> {
        if let Where::By(Anchor::Street(_, roads))
        | Where::Around(Anchor::Street(_, roads))
        | Where::Edge(Anchor::Street(_, roads)) = place
        {
            return Ok(Stand::AlongRoad { roads: roads.clone() });
        }
        Ok(match place {
            Where::By(anchor) => {
                let anchor = self.anchor(anchor, moved)?;
                let relation = if self.is_ground(anchor) { Relation::Inside } else { Relation::NextTo };
                self.to(relation, anchor)?
            }
            Where::Around(anchor) => self.to(Relation::Near, self.anchor(anchor, moved)?)?,
            Where::Middle(anchor) => {
                let anchor = self.anchor(anchor, moved)?;
                if !self.is_ground(anchor) {
                    return self.to(Relation::Inside, anchor);
                }
                Stand::InMiddleOf { anchor }
            }
            Where::Edge(anchor) => Stand::AtEdgeOf { anchor: self.anchor(anchor, moved)? },
            Where::Block(anchor) => Stand::OnBlockOf { anchor: self.anchor(anchor, moved)? },
            Where::Offset(distance, bearing, anchor) => {
                let anchor = self.anchor(anchor, moved)?;
                check_distance(*distance)?;
                Stand::Offset { anchor, heading: self.heading(*bearing, anchor), distance: *distance }
            }
            Where::Apart(least, most, anchor) => {
                let anchor = self.anchor(anchor, moved)?;
                check_distance(*least)?;
                Stand::Apart { anchor, least: *least, most: *most }
            }
            Where::Junction(one, other, named) => {
                Stand::AtJunction { junction: self.junction(one, other, named)? }
            }
            _ => {
                let what = "to stand there".to_owned();
                return Err(EditError::Impossible { what, why: "name a thing or a place".to_owned() });
            }
        })
    }

    /// Whether a thing stands in a park.
    pub(super) fn is_in_park(&self, thing: EntityId) -> bool {
        let Some(entity) = self.scene.entity(thing) else { return false };
        let mut inside = false;
        let _ = self.scene.visit(entity.bounds, &mut |other| {
            inside |= class("park").holds(&other) && Relation::Inside.holds(&entity, &other);
            ControlFlow::Continue(())
        });
        inside
    }

    fn is_ground(&self, thing: EntityId) -> bool {
        self.scene.entity(thing).is_some_and(|entity| entity.kind == EntityKind::Ground)
    }

    /// Radians from east.
    fn heading(&self, bearing: Bearing, anchor: EntityId) -> f64 {
        let yaw = self.scene.entity(anchor).map_or(0.0, |entity| yaw_of(entity.pose));
        let turn = match bearing {
            Bearing::Compass(compass) => return compass.heading(),
            Bearing::Side(Relation::LeftOf) => std::f64::consts::FRAC_PI_2,
            Bearing::Side(Relation::Behind) => std::f64::consts::PI,
            Bearing::Side(Relation::RightOf) => -std::f64::consts::FRAC_PI_2,
            Bearing::Side(_) => 0.0,
        };
        simworld_core::ops::wrap_angle(yaw + turn)
    }

    /// Where two streets meet; of several places the nearest to the viewpoint.
    fn junction(&self, one: &[RoadId], other: &[RoadId], named: &str) -> Result<IntersectionId, EditError> {
        let missing = || {
            let near = "they do not meet".to_owned();
            EditError::NotFound { wanted: format!("corner of {named}"), near }
        };
        let network = self.scene.roads().ok_or_else(missing)?;
        let meets = |place: &IntersectionId| ends(network, other).any(|end| end == *place);
        let distance = |place: &IntersectionId| {
            let center =
                network.intersections.get(place.index()).map_or(Point2::origin(), |place| place.center);
            (center - self.focus.from).norm()
        };
        let found = ends(network, one)
            .filter(meets)
            .min_by(|a, b| distance(a).total_cmp(&distance(b)).then(a.cmp(b)));
        found.ok_or_else(missing)
    }

    // ---- streets ----

    pub(super) fn passage(&self, which: &[StreetRef], passage: Passage) -> Result<Edit, EditError> {
        let mut roads = Vec::new();
        for street in which {
            roads.extend(self.roads_of(street)?);
        }
        roads.sort_unstable();
        roads.dedup();
        Ok(Edit::SetPassage { roads, passage })
    }

    pub(super) fn roads_of(&self, street: &StreetRef) -> Result<Vec<RoadId>, EditError> {
        let missing = |wanted: &str, near: &str| {
            Err(EditError::NotFound { wanted: wanted.to_owned(), near: near.to_owned() })
        };
        let Some(network) = self.scene.roads() else { return missing("street", "this scene has none") };
        match street {
            StreetRef::Named { roads, between: None } => Ok(roads.clone()),
            StreetRef::Named { roads, between: Some([one, other]) } => {
                let (one, other) =
                    (self.junction(roads, one, "these")?, self.junction(roads, other, "these")?);
                let [from, to] = [one, other].map(|place| network.intersections[place.index()].center);
                let lies = |road: &RoadId| {
                    let line = &network.roads[road.index()].centerline;
                    let (middle, _) = polyline::at(line, polyline::length(line) * 0.5);
                    let along = to - from;
                    (0.0..=along.norm_squared()).contains(&(middle - from).dot(&along))
                };
                Ok(roads.iter().copied().filter(lies).collect())
            }
            StreetRef::Beyond { roads, compass, cross } => {
                let crossing = self.junction(roads, cross, "these")?;
                let from = network.intersections[crossing.index()].center;
                let way = direction(compass.heading());
                let lies = |road: &RoadId| {
                    let line = &network.roads[road.index()].centerline;
                    let (middle, _) = polyline::at(line, polyline::length(line) * 0.5);
                    (middle - from).dot(&way) > 0.0
                };
                let found: Vec<RoadId> = roads.iter().copied().filter(lies).collect();
                if found.is_empty() {
                    missing("such a piece of the street", "it ends there")
                } else {
                    Ok(found)
                }
            }
            StreetRef::Half(roads, compass) => Ok(half_of(network, roads, *compass)),
            StreetRef::To(relation, thing) => {
                self.road_beside(network, *relation, self.one(thing)?, &thing.text)
            }
            StreetRef::Around(thing) => self.roads_around(network, self.one(thing)?, &thing.text),
            StreetRef::Nearest => match nearest_road(network, self.focus.from, &|_| true) {
                Some(road) => Ok(vec![road]),
                None => missing("street", "there is none nearby"),
            },
            StreetRef::It if self.focus.roads.is_empty() => missing("street that is meant", "name it"),
            StreetRef::It => Ok(self.focus.roads.clone()),
            StreetRef::Closed => {
                let ids = (0..network.roads.len()).map(RoadId::from_index);
                let closed = |road: &RoadId| {
                    [LaneDirection::Forward, LaneDirection::Backward]
                        .iter()
                        .any(|way| self.scene.is_closed((*road, *way)))
                };
                let closed: Vec<RoadId> = ids.filter(closed).collect();
                if closed.is_empty() { missing("closed street", "all of them are open") } else { Ok(closed) }
            }
            StreetRef::Thing(thing) => {
                let found = self.one(thing)?;
                let label =
                    self.scene.entity(found).map_or_else(String::new, |entity| called(self.scene, &entity));
                let what = format!("to close or open {label} to traffic");
                Err(EditError::Impossible {
                    what,
                    why: "it is no street; name one, or say in front of what it runs".to_owned(),
                })
            }
            StreetRef::Unknown(name) => missing(name, "no street has that name"),
        }
    }

    /// The nearest street on that side of a thing.
    fn road_beside(
        &self,
        network: &RoadNetwork,
        relation: Relation,
        thing: EntityId,
        text: &str,
    ) -> Result<Vec<RoadId>, EditError> {
        let missing = || EditError::NotFound {
            wanted: format!("street {} {text}", Stand::To { relation, anchor: thing }.told(self.scene)),
            near: format!("none lies there within {STREET} m"),
        };
        let anchor = self.scene.entity(thing).ok_or_else(missing)?;
        let ahead = direction(self.heading(Bearing::Side(relation), thing));
        let has_side =
            matches!(relation, Relation::InFrontOf | Relation::Behind | Relation::LeftOf | Relation::RightOf);
        let on_side = |foot: Point2| {
            let way = foot - anchor.planar();
            // As much ahead as aside.
            !has_side || way.dot(&ahead) * std::f64::consts::SQRT_2 >= way.norm()
        };
        nearest_road(network, anchor.planar(), &on_side).map(|road| vec![road]).ok_or_else(missing)
    }

    /// The first street in each of the four directions from a thing.
    fn roads_around(
        &self,
        network: &RoadNetwork,
        thing: EntityId,
        text: &str,
    ) -> Result<Vec<RoadId>, EditError> {
        let missing = || EditError::NotFound {
            wanted: format!("street around {text}"),
            near: "there is none".to_owned(),
        };
        let from = self.scene.entity(thing).ok_or_else(missing)?.planar();
        let first = |turn: u32| {
            let to = from + direction(f64::from(turn) * std::f64::consts::FRAC_PI_2) * BLOCK;
            let crossed = network.roads.iter().enumerate().flat_map(|(index, road)| {
                let pieces = road.centerline.windows(2);
                pieces
                    .filter_map(move |piece| Some((polyline::crossing(from, to, piece[0], piece[1])?, index)))
            });
            let nearest = crossed.min_by(|a, b| a.0.0.total_cmp(&b.0.0).then(a.1.cmp(&b.1)));
            nearest.map(|(_, index)| RoadId::from_index(index))
        };
        let found: Vec<RoadId> = (0..4).filter_map(first).collect();
        if found.is_empty() { Err(missing()) } else { Ok(found) }
    }
}

/// The pieces of a street that lie on a side of its middle.
pub(super) fn half_of(
    network: &RoadNetwork,
    roads: &[RoadId],
    compass: super::super::compass::Compass,
) -> Vec<RoadId> {
    let way = direction(compass.heading());
    let middles: Vec<(RoadId, f64)> = roads
        .iter()
        .filter_map(|road| {
            let line = &network.roads.get(road.index())?.centerline;
            let (middle, _) = polyline::at(line, polyline::length(line) * 0.5);
            Some((*road, middle.coords.dot(&way)))
        })
        .collect();
    let least = middles.iter().map(|(_, far)| *far).fold(f64::INFINITY, f64::min);
    let most = middles.iter().map(|(_, far)| *far).fold(f64::NEG_INFINITY, f64::max);
    middles.into_iter().filter(|(_, far)| *far * 2.0 > least + most).map(|(road, _)| road).collect()
}

/// The junctions at which some roads end.
fn ends<'a>(network: &'a RoadNetwork, roads: &'a [RoadId]) -> impl Iterator<Item = IntersectionId> + 'a {
    roads.iter().filter_map(|road| network.roads.get(road.index())).flat_map(|road| [road.from, road.to])
}

/// The road nearest to a point whose nearest point passes a test, within a street's reach.
fn nearest_road(network: &RoadNetwork, point: Point2, fits: &dyn Fn(Point2) -> bool) -> Option<RoadId> {
    let mut best: Option<(f64, usize)> = None;
    for (index, road) in network.roads.iter().enumerate() {
        let far = road.centerline.iter().all(|at| (at.x - point.x).abs().min((at.y - point.y).abs()) > BLOCK);
        let Some(near) = (if far { None } else { polyline::closest(&road.centerline, &point) }) else {
            continue;
        };
        let (foot, _) = polyline::at(&road.centerline, near.station);
        if near.distance <= STREET && best.is_none_or(|(least, _)| near.distance < least) && fits(foot) {
            best = Some((near.distance, index));
        }
    }
    best.map(|(_, index)| RoadId::from_index(index))
}

fn check_distance(distance: f64) -> Result<(), EditError> {
    if distance <= FAR {
        return Ok(());
    }
    let what = format!("a place {distance:.0} m off");
    Err(EditError::Impossible { what, why: format!("name a thing within {FAR:.0} m of it") })
}
