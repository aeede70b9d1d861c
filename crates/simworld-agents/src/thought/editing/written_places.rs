//! Places and lines as a model answers them.

use std::ops::ControlFlow;

use serde_json::{Value, json};
use simworld_core::geometry::{Aabb, Point2};
use simworld_core::id::{EntityId, RoadId};
use simworld_core::scene::{EntityRef, Relation};

use super::super::unsayable::Unsayable;
use super::bearings::{compass_of, is_same, side_of};
use super::written::{Writer, hundredths};
use crate::editing::{Line, Sides, Stand};

/// Points that are nearer to each other are the same, m.
const SAME: f64 = 1e-9;

impl Writer<'_> {
    /// Places that all hold, of something that stands somewhere already if it is moved.
    pub(super) fn places(
        &mut self,
        stands: &[Stand],
        moved: Option<EntityId>,
    ) -> Result<Vec<Value>, Unsayable> {
        stands.iter().map(|stand| self.place(stand, stands, moved)).collect()
    }

    fn place(&mut self, stand: &Stand, all: &[Stand], moved: Option<EntityId>) -> Result<Value, Unsayable> {
        Ok(match stand {
            Stand::To { relation, anchor } => {
                let is = relation_name(*relation)?;
                json!({ "is": is, "of": self.anchor(*anchor)? })
            }
            Stand::Between { one, other } => {
                json!({ "is": "between", "of": self.anchor(*one)?, "and": self.anchor(*other)? })
            }
            Stand::AcrossFrom { anchor } => json!({ "is": "across_from", "of": self.anchor(*anchor)? }),
            Stand::Along { anchor } => json!({ "is": "along", "of": self.anchor(*anchor)? }),
            Stand::AtCornerOf { anchor } => json!({ "is": "at_corner_of", "of": self.anchor(*anchor)? }),
            Stand::OnBlockOf { anchor } => json!({ "is": "on_block_of", "of": self.anchor(*anchor)? }),
            Stand::InMiddleOf { anchor } => json!({ "is": "in_middle_of", "of": self.anchor(*anchor)? }),
            Stand::AtEdgeOf { anchor } => json!({ "is": "at_edge_of", "of": self.anchor(*anchor)? }),
            Stand::Towards { heading, anchor } => {
                let side = compass_of(*heading).ok_or_else(|| Unsayable::new("a side between the winds"))?;
                json!({ "is": "on_side_of", "of": self.anchor(*anchor)?, "side": side })
            }
            Stand::Offset { anchor, heading, distance } => self.offset(*anchor, *heading, *distance)?,
            Stand::Apart { anchor, least, most } => {
                let (least, most) = (hundredths(*least), hundredths(*most));
                json!({ "is": "apart_from", "of": self.anchor(*anchor)?, "least": least, "most": most })
            }
            Stand::AlongRoad { roads } => {
                json!({ "is": "along_street", "streets": self.streets(roads)? })
            }
            Stand::OnSide { roads, heading } => {
                let side = self.side_of_street(roads, *heading)?;
                json!({ "is": "on_side_of_street", "streets": self.streets(roads)?, "side": side })
            }
            Stand::AtJunction { junction } => {
                let ways = self.ways.as_ref();
                let ways = ways.ok_or_else(|| Unsayable::new("a junction of a scene without streets"))?;
                let name = ways.junction(*junction);
                self.used.junctions.insert(name.clone(), *junction);
                json!({ "is": "at_junction", "junction": name })
            }
            Stand::At { point } => self.at(*point, moved)?,
            Stand::Around { point } => self.around(*point, all)?,
        })
    }

    /// So far in a direction of the compass or to a side of the thing; in any other by whole degrees.
    fn offset(&mut self, anchor: EntityId, heading: f64, distance: f64) -> Result<Value, Unsayable> {
        let distance = hundredths(distance);
        let side = compass_of(heading).or_else(|| side_of(heading, anchor, self.asked.scene));
        let of = self.anchor(anchor)?;
        if let Some(side) = side {
            return Ok(json!({ "is": "offset_to_side", "of": of, "distance": distance, "side": side }));
        }
        let degrees = simworld_core::ops::wrap_angle(heading).to_degrees().round() as i64;
        Ok(json!({ "is": "offset", "of": of, "distance": distance, "degrees": degrees }))
    }

    /// A point: where something stands, so far from where the moved thing is, or by its coordinates.
    fn at(&mut self, point: Point2, moved: Option<EntityId>) -> Result<Value, Unsayable> {
        if let Some(thing) = self.standing_at(point) {
            return Ok(json!({ "is": "in_place_of", "of": self.anchor(thing)? }));
        }
        let from = moved.and_then(|moved| self.asked.scene.entity(moved)).map(|entity| entity.planar());
        if let (Some(moved), Some(from)) = (moved, from) {
            let way = point - from;
            let is_whole = |metres: f64| (metres * 100.0 - (metres * 100.0).round()).abs() < 1e-6;
            if is_whole(way.x) && is_whole(way.y) {
                let (east, north) = (hundredths(way.x), hundredths(way.y));
                let of = self.thing(moved)?;
                return Ok(json!({ "is": "shifted", "of": of, "east": east, "north": north }));
            }
        }
        Ok(json!({ "is": "at", "east": hundredths(point.x), "north": hundredths(point.y) }))
    }

    /// The first thing that stands exactly there.
    fn standing_at(&self, point: Point2) -> Option<EntityId> {
        let mut found: Option<EntityId> = None;
        let region = Aabb::column_around(point, 0.01);
        let _ = self.asked.scene.visit(&region, &mut |entity: EntityRef<'_>| {
            let is_there = (entity.planar() - point).norm() < SAME;
            if is_there && found.is_none_or(|first| entity.id < first) {
                found = Some(entity.id);
            }
            ControlFlow::Continue(())
        });
        found
    }

    /// Around a point: where one looks from, the end of a street that the thing stands along, or by its coordinates.
    fn around(&mut self, point: Point2, all: &[Stand]) -> Result<Value, Unsayable> {
        if point == self.asked.from {
            return Ok(json!({ "is": "here" }));
        }
        for stand in all {
            if let Stand::AlongRoad { roads } = stand
                && let Some(side) = self.end_of_street(roads, point)
            {
                let streets = self.streets(roads)?;
                return Ok(json!({ "is": "end_of_street", "streets": streets, "side": side }));
            }
        }
        Ok(json!({ "is": "around", "east": hundredths(point.x), "north": hundredths(point.y) }))
    }

    /// On which side of a street its end lies that is this point.
    fn end_of_street(&self, roads: &[RoadId], point: Point2) -> Option<&'static str> {
        let [one, other] = self.ways.as_ref()?.ends(roads)?;
        let (from, to) = if one == point { (other, one) } else { (one, other) };
        if to != point {
            return None;
        }
        // Of the four winds the one that leads most of the way there.
        let way = to - from;
        let heading = if way.x.abs() >= way.y.abs() {
            if way.x > 0.0 { 0.0 } else { std::f64::consts::PI }
        } else if way.y > 0.0 {
            std::f64::consts::FRAC_PI_2
        } else {
            -std::f64::consts::FRAC_PI_2
        };
        compass_of(heading)
    }

    fn side_of_street(&self, roads: &[RoadId], heading: f64) -> Result<&'static str, Unsayable> {
        let left = self.ways.as_ref().and_then(|ways| ways.left(roads));
        let is = |turn: f64| left.is_some_and(|left| is_same(left + turn, heading));
        let own = || match (is(0.0), is(std::f64::consts::PI)) {
            (true, _) => Some("left"),
            (_, true) => Some("right"),
            _ => None,
        };
        compass_of(heading).or_else(own).ok_or_else(|| Unsayable::new("that side of a street"))
    }

    pub(super) fn line(&mut self, line: &Line) -> Result<Value, Unsayable> {
        Ok(match line {
            Line::Road { roads, sides } => {
                let is = if *sides == Sides::Both { "both_sides_of_street" } else { "along_street" };
                json!({ "is": is, "streets": self.streets(roads)? })
            }
            Line::RoadSide { roads, heading } => {
                let side = self.side_of_street(roads, *heading)?;
                json!({ "is": "on_side_of_street", "streets": self.streets(roads)?, "side": side })
            }
            Line::Along { anchor } => json!({ "is": "along", "of": self.anchor(*anchor)? }),
            Line::Around { anchor } => json!({ "is": "around", "of": self.anchor(*anchor)? }),
            Line::Between { one, other } => {
                json!({ "is": "between", "of": self.anchor(*one)?, "and": self.anchor(*other)? })
            }
        })
    }
}

fn relation_name(relation: Relation) -> Result<&'static str, Unsayable> {
    Ok(match relation {
        Relation::NextTo => "next_to",
        Relation::Near => "near",
        Relation::FarFrom => "far_from",
        Relation::InFrontOf => "in_front_of",
        Relation::Behind => "behind",
        Relation::LeftOf => "left_of",
        Relation::RightOf => "right_of",
        Relation::OnTopOf => "on_top_of",
        Relation::Inside => "inside",
        other => return Err(Unsayable::new(format!("the relation {other:?}"))),
    })
}
