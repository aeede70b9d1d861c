//! Things by where they stand: beside, between, on a side, nearest to.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, Point3, direction};
use simworld_core::id::RoadId;
use simworld_core::net::polyline;
use simworld_core::scene::{EntityKind, EntityRef, Relation};
use simworld_core::seam::PlanError;

use super::clause::{Choice, Reference, Side, Spot, Stands, Target};
use super::compass::Compass;
use super::resolve::{Purpose, Ranked, View, sort};

/// Everything that stands in a relation to a thing is within this gap of it, m (see [`Relation::Near`]).
const RELATED: f64 = 30.0;
/// "Next to" where nothing is nearer, m: across a forecourt, not across a street.
const LOOSELY_NEXT: f64 = 8.0;
/// "Next to" among vehicles, m: the length of one more lies between.
const IN_A_ROW: f64 = 12.0;
/// The same of what is said to stand there and nothing is nearer, m.
const BY: f64 = 10.0;
/// A part of a thing, such as its door, is within this gap of it, m.
pub(super) const PART: f64 = 15.0;
/// How many things that fit a description are looked at for something beside them, nearest first.
const MOST_ANCHORS: usize = 256;
/// How far things in a direction of the compass are looked for, m.
const IN_DIRECTION: f64 = 300.0;
/// How far things to the left and right are looked for, m.
const BESIDE_ME: f64 = 150.0;
/// As far as the whole of a scene, m.
const EVERYWHERE: f64 = 5e4;
/// As far beyond the kerb as "on" a street, m.
const EDGE: f64 = 6.0;
/// Half the width of what counts as ahead or behind, as the sine of the angle: 45°.
const AHEAD: f64 = std::f64::consts::FRAC_1_SQRT_2;

impl View<'_> {
    /// Those that stand as they are said to, the best first.
    pub(super) fn related(
        &self,
        reference: &Reference,
        relation: &Stands,
        purpose: Purpose,
    ) -> Result<Vec<Ranked>, PlanError> {
        match relation {
            Stands::All(all) => self.in_all_ways(reference, all, purpose),
            Stands::Side(side) => Ok(self.on_side(reference, *side, purpose)),
            Stands::Compass(compass, of) => self.in_direction(reference, *compass, of.as_deref(), purpose),
            Stands::OnStreet(roads) => Ok(self.on_street(reference, roads, None, purpose)),
            Stands::SideOfStreet(compass, roads) => {
                Ok(self.on_street(reference, roads, Some(*compass), purpose))
            }
            Stands::Within(reach, anchor) => {
                let anchor = self.find(anchor, Purpose::Any)?;
                let half = anchor.info.shape.size().xy().norm() * 0.5;
                let mut found = self.around(reference, anchor.planar(), half + reach, purpose);
                found.retain(|(_, id)| {
                    let entity = self.scene.entity(*id).filter(|entity| entity.id != anchor.id);
                    entity.is_some_and(|entity| gap(&anchor, &entity) <= *reach)
                });
                Ok(found)
            }
            Stands::Beyond(reach, anchor) => {
                let anchor = self.find(anchor, Purpose::Any)?;
                let mut found = self.around(reference, anchor.planar(), self.range, purpose);
                found.retain(|(_, id)| {
                    let entity = self.scene.entity(*id).filter(|entity| entity.id != anchor.id);
                    entity.is_some_and(|entity| gap(&anchor, &entity) > *reach)
                });
                Ok(found)
            }
            Stands::Between(one, other) => self.between(reference, one, other, purpose),
            Stands::NearestTo(anchor, nearest) => {
                let anchor = self.find(anchor, Purpose::Any)?;
                let mut found = self.around(reference, anchor.planar(), self.range, purpose);
                for (rank, id) in &mut found {
                    let gap = self.scene.entity(*id).map_or(f64::INFINITY, |entity| gap(&anchor, &entity));
                    *rank = if *nearest { gap } else { -gap };
                }
                found.retain(|(_, id)| *id != anchor.id);
                sort(&mut found);
                Ok(found)
            }
            Stands::Of(whose) => {
                self.beside_any(reference, whose, purpose, &|entity, anchor| gap(anchor, entity) <= PART)
            }
            Stands::To(relation, anchor) => {
                // "The chair near the bin" is the one that stands next to a bin, if one does, and not any within a minute of the nearest.
                if *relation == Relation::Near {
                    let close = self.beside_any(reference, anchor, purpose, &|entity, anchor| {
                        gap(anchor, entity) <= LOOSELY_NEXT
                    })?;
                    if !close.is_empty() {
                        return Ok(close);
                    }
                }
                let strict = self.beside_any(reference, anchor, purpose, &|entity, anchor| {
                    relation.holds(entity, anchor)
                        || *relation == Relation::InFrontOf && is_before_door(entity, anchor)
                })?;
                if strict.is_empty() && matches!(relation, Relation::Behind | Relation::InFrontOf) {
                    let from = self.from;
                    return self.beside_any(reference, anchor, purpose, &|entity, anchor| {
                        is_seen_so(from, entity, anchor, *relation)
                    });
                }
                if strict.is_empty() && *relation == Relation::NextTo {
                    let loosely = self.beside_any(reference, anchor, purpose, &|entity, anchor| {
                        let in_a_row = entity.kind.is_vehicle() && anchor.kind.is_vehicle();
                        gap(anchor, entity) <= if in_a_row { IN_A_ROW } else { LOOSELY_NEXT }
                    })?;
                    // "The lamp by the red bench" presumes that there is one.
                    let definite = !reference.indefinite && loosely.is_empty();
                    return if definite {
                        self.beside_any(reference, anchor, purpose, &|entity, anchor| {
                            gap(anchor, entity) <= BY
                        })
                    } else {
                        Ok(loosely)
                    };
                }
                Ok(strict)
            }
        }
    }

    /// Whichever stand so in every way, the nearest first.
    fn in_all_ways(
        &self,
        reference: &Reference,
        all: &[Stands],
        purpose: Purpose,
    ) -> Result<Vec<Ranked>, PlanError> {
        let any = Reference { choice: Choice::Nearest, ..reference.clone() };
        let mut found: Option<Vec<Ranked>> = None;
        for one in all {
            let fits = self.related(&any, one, purpose)?;
            found = Some(match found {
                Some(so_far) => {
                    so_far.into_iter().filter(|(_, id)| fits.iter().any(|(_, other)| other == id)).collect()
                }
                None => fits,
            });
        }
        Ok(found.unwrap_or_default())
    }

    /// Those that stand in a relation to what the anchor may mean.
    fn beside_any(
        &self,
        reference: &Reference,
        anchor: &Reference,
        purpose: Purpose,
        holds: &dyn Fn(&EntityRef<'_>, &EntityRef<'_>) -> bool,
    ) -> Result<Vec<Ranked>, PlanError> {
        let mut anchors = self.candidates(anchor, Purpose::Any)?;
        if anchors.is_empty() {
            return Err(self.not_found(anchor, Purpose::Any));
        }
        if matches!(anchor.target, Target::Any(_))
            && anchor.choice == Choice::Open
            && anchor.relation.is_none()
        {
            // Any that has something beside it will do, however far: "the hospital near a museum".
            anchors = self.around(anchor, self.from, self.range, Purpose::Any);
        }
        let mut found: Vec<Ranked> = Vec::new();
        for anchor in anchors.iter().take(MOST_ANCHORS).filter_map(|(_, id)| self.scene.entity(*id)) {
            self.beside(reference, &anchor, purpose, holds, &mut found);
            // Unless the nearest or farthest is asked for, the first thing with something beside it is meant.
            if reference.choice == Choice::Open && !found.is_empty() {
                break;
            }
        }
        sort(&mut found);
        found.dedup_by_key(|(_, id)| *id);
        Ok(found)
    }

    /// Adds what stands in the relation to one anchor, with a figure by which to choose.
    fn beside(
        &self,
        reference: &Reference,
        anchor: &EntityRef<'_>,
        purpose: Purpose,
        holds: &dyn Fn(&EntityRef<'_>, &EntityRef<'_>) -> bool,
        found: &mut Vec<Ranked>,
    ) {
        let _ = self.scene.visit(&anchor.bounds.inflated(RELATED), &mut |entity| {
            if entity.id != anchor.id && self.fits(&entity, reference, purpose) && holds(&entity, anchor) {
                let rank = match reference.choice {
                    Choice::Open => gap(anchor, &entity),
                    _ => self.distance(&entity),
                };
                found.push((rank, entity.id));
            }
            ControlFlow::Continue(())
        });
    }

    /// Between the middles of two things, or not farther off the line than a third of its length; the nearest to the
    /// middle first.
    fn between(
        &self,
        reference: &Reference,
        one: &Reference,
        other: &Reference,
        purpose: Purpose,
    ) -> Result<Vec<Ranked>, PlanError> {
        let (one, other) = (self.find(one, Purpose::Any)?, self.find(other, Purpose::Any)?);
        let (from, along) = (one.planar(), other.planar() - one.planar());
        let length = along.norm();
        if length < 1e-6 {
            return Ok(Vec::new());
        }
        let way = along / length;
        let mut found = self.around(reference, from + along * 0.5, length * 0.5 + 1.0, purpose);
        for (rank, id) in &mut found {
            let Some(entity) = self.scene.entity(*id) else { continue };
            let offset = entity.planar() - from;
            let (forward, aside) = (offset.dot(&way), way.perp(&offset).abs());
            let is_between = forward > 0.0 && forward < length && aside <= (length / 3.0).max(2.0);
            *rank = if is_between {
                simworld_core::ops::hypot(forward - length * 0.5, aside)
            } else {
                f64::INFINITY
            };
        }
        found.retain(|(rank, id)| rank.is_finite() && *id != one.id && *id != other.id);
        sort(&mut found);
        Ok(found)
    }

    /// On the edge of a street, on either side or on the one that lies in a direction, the nearest first.
    fn on_street(
        &self,
        reference: &Reference,
        roads: &[RoadId],
        side: Option<Compass>,
        purpose: Purpose,
    ) -> Vec<Ranked> {
        let Some(network) = self.scene.roads() else { return Vec::new() };
        let mut found: Vec<Ranked> = Vec::new();
        for road in roads.iter().filter_map(|road| network.roads.get(road.index())) {
            let reach = road.width + EDGE;
            for piece in road.centerline.windows(2) {
                let region = Aabb::column_around(piece[0], 0.0).union(&Aabb::column_around(piece[1], 0.0));
                let _ = self.scene.visit(&region.inflated(reach), &mut |entity| {
                    let near = polyline::closest(piece, &entity.planar());
                    let beyond = near.is_some_and(|near| {
                        let kerb = if near.lateral >= 0.0 { road.left_kerb } else { road.right_kerb };
                        let (foot, _) = polyline::at(piece, near.station);
                        let is_there = |way: Compass| (entity.planar() - foot).dot(&way.step()) > 0.0;
                        near.distance - kerb <= EDGE && side.is_none_or(is_there)
                    });
                    if beyond && self.fits(&entity, reference, purpose) {
                        found.push((self.distance(&entity), entity.id));
                    }
                    ControlFlow::Continue(())
                });
            }
        }
        sort(&mut found);
        found.dedup_by_key(|(_, id)| *id);
        found
    }

    /// On a side of the agent, the nearest first; ahead and behind are half a turn wide where nothing is nearer to the
    /// middle.
    fn on_side(&self, reference: &Reference, side: Side, purpose: Purpose) -> Vec<Ranked> {
        let found = self.on_side_within(reference, side, purpose, AHEAD);
        if found.is_empty() { self.on_side_within(reference, side, purpose, 0.1) } else { found }
    }

    fn on_side_within(&self, reference: &Reference, side: Side, purpose: Purpose, width: f64) -> Vec<Ranked> {
        let ahead = direction(self.heading);
        let mut found = self.around(reference, self.from, BESIDE_ME.min(self.range), purpose);
        found.retain(|(_, id)| {
            let Some(entity) = self.scene.entity(*id) else { return false };
            let offset = entity.bounds.center().xy() - self.from;
            let way = offset / offset.norm().max(1e-9);
            let (forward, left) = (ahead.dot(&way), ahead.perp(&way));
            match side {
                Side::Left => left > 0.1,
                Side::Right => left < -0.1,
                Side::Ahead => forward >= width,
                Side::Behind => forward <= -width,
            }
        });
        found
    }

    /// In a direction from a thing, the nearest to that first; without one from the agent.
    fn in_direction(
        &self,
        reference: &Reference,
        compass: Compass,
        of: Option<&Reference>,
        purpose: Purpose,
    ) -> Result<Vec<Ranked>, PlanError> {
        let anchor = of.map(|of| self.find(of, Purpose::Any)).transpose()?;
        let from = anchor.as_ref().map_or(self.from, EntityRef::planar);
        let mut found = self.around(reference, from, IN_DIRECTION.min(self.range), purpose);
        for (rank, id) in &mut found {
            let lies = self.scene.entity(*id).filter(|entity| compass.holds(from, entity.planar()));
            *rank = match (&anchor, lies) {
                (Some(anchor), Some(entity)) => gap(anchor, &entity),
                (None, Some(_)) => *rank,
                (_, None) => f64::INFINITY,
            };
        }
        found.retain(|(rank, id)| rank.is_finite() && anchor.as_ref().is_none_or(|anchor| anchor.id != *id));
        sort(&mut found);
        Ok(found)
    }

    /// What fits within a distance of a point, the nearest to the agent first.
    fn around(&self, reference: &Reference, point: Point2, reach: f64, purpose: Purpose) -> Vec<Ranked> {
        let mut found: Vec<Ranked> = Vec::new();
        let everywhere = reach >= EVERYWHERE && self.of_index(reference, f64::INFINITY, purpose, &mut found);
        if everywhere {
            sort(&mut found);
            return found;
        }
        let _ = self.scene.visit(&Aabb::column_around(point, reach), &mut |entity| {
            if self.fits(&entity, reference, purpose) {
                found.push((self.distance(&entity), entity.id));
            }
            ControlFlow::Continue(())
        });
        sort(&mut found);
        found
    }
}

/// Whether it stands behind or before a thing for whoever looks from a place: what has no front of its own, or nothing
/// there, is seen so.
fn is_seen_so(from: Point2, entity: &EntityRef<'_>, anchor: &EntityRef<'_>, relation: Relation) -> bool {
    let (sight, way) = (anchor.planar() - from, entity.planar() - anchor.planar());
    let along = sight.dot(&way);
    let is_near = gap(anchor, entity) <= RELATED * 0.5;
    let aligned = along.abs() >= sight.norm() * way.norm() * AHEAD && way.norm() > 1e-6;
    is_near && aligned && if relation == Relation::Behind { along > 0.0 } else { along < 0.0 }
}

/// Whether it stands on the side of a house where its door is: that is the front of the house for whoever looks at it.
fn is_before_door(entity: &EntityRef<'_>, house: &EntityRef<'_>) -> bool {
    let Some(access) = house.access_point() else { return false };
    let (out, way) = (access.xy() - house.planar(), entity.planar() - house.planar());
    gap(house, entity) <= RELATED && way.dot(&out) >= way.norm() * out.norm() * AHEAD && out.norm() > 1e-6
}

/// From the footprint of a thing to the middle of another, or the other way about if that is less, m.
pub(super) fn gap(anchor: &EntityRef<'_>, entity: &EntityRef<'_>) -> f64 {
    let to_middle = anchor.info.shape.planar_distance(anchor.pose, &entity.planar());
    to_middle.min(entity.info.shape.planar_distance(entity.pose, &anchor.planar()))
}

/// A spot on that side of a thing, with room for a body; `None` for relations that name no side.
pub(super) fn spot_on_side(entity: &EntityRef<'_>, side: Spot, room: f64) -> Option<Point3> {
    let half = entity.info.shape.size() * 0.5;
    let (relation, apart) = match side {
        Spot::Beside(relation, apart) => (relation, apart),
        Spot::Compass(compass, apart) => {
            let step = compass.step();
            if let Some(apart) = apart {
                let spot = entity.planar() + step * apart;
                return Some(Point3::new(spot.x, spot.y, entity.position().z));
            }
            let corners = entity.obb().footprint().map(|corner| (corner - entity.planar()).dot(&step));
            let edge = corners.into_iter().fold(0.0, f64::max);
            let spot = entity.planar() + step * (edge + room);
            return Some(Point3::new(spot.x, spot.y, entity.position().z));
        }
    };
    if entity.kind == EntityKind::Door {
        return None; // before a door is at it
    }
    let room = apart.unwrap_or(room);
    let local = match relation {
        Relation::InFrontOf => Point3::new(half.x + room, 0.0, 0.0),
        Relation::Behind => Point3::new(-half.x - room, 0.0, 0.0),
        Relation::LeftOf => Point3::new(0.0, half.y + room, 0.0),
        Relation::RightOf => Point3::new(0.0, -half.y - room, 0.0),
        _ => return None,
    };
    Some(entity.pose * local)
}
