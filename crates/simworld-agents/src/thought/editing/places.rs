//! Places and lines of an answer.

use serde_json::Value;
use simworld_core::geometry::{Point2, Vector2, direction, yaw_of};
use simworld_core::scene::Relation;

use super::answer::{Answer, items, metres, number};
use super::bearings::{by_compass, by_side};
use super::ways::Ways;
use crate::editing::{Line, Sides, Stand};

impl Answer<'_> {
    pub(super) fn places(&self, edit: &Value) -> Result<Vec<Stand>, String> {
        items(edit, "places").iter().map(|place| self.place(place)).collect()
    }

    fn place(&self, place: &Value) -> Result<Stand, String> {
        let is = place["is"].as_str().unwrap_or_default();
        if let Some(stand) = self.point(is, place).transpose()? {
            return Ok(stand);
        }
        let anchor = || self.anchor(place, "of");
        let to = |relation| Ok(Stand::To { relation, anchor: anchor()? });
        Ok(match is {
            "between" => {
                let (one, other) = (anchor()?, self.anchor(place, "and")?);
                if one == other {
                    return Err("nothing is between a thing and itself".to_owned());
                }
                Stand::Between { one, other }
            }
            "offset" => Stand::Offset {
                anchor: anchor()?,
                heading: number(place, "degrees").to_radians(),
                distance: metres(place, "distance"),
            },
            "offset_to_side" => Stand::Offset {
                anchor: anchor()?,
                heading: self.side(place)?,
                distance: metres(place, "distance"),
            },
            "on_side_of" => Stand::Towards { heading: self.side(place)?, anchor: anchor()? },
            "apart_from" => {
                Stand::Apart { anchor: anchor()?, least: metres(place, "least"), most: metres(place, "most") }
            }
            "along_street" => Stand::AlongRoad { roads: self.streets(place)? },
            "on_side_of_street" => {
                Stand::OnSide { roads: self.streets(place)?, heading: self.side_of_street(place)? }
            }
            "at_junction" => {
                let name = place["junction"].as_str().unwrap_or_default();
                let junction = self.known.junctions.get(name).copied();
                Stand::AtJunction { junction: junction.ok_or_else(|| format!("{name:?} do not meet"))? }
            }
            "along" => Stand::Along { anchor: anchor()? },
            "at_corner_of" => Stand::AtCornerOf { anchor: anchor()? },
            "across_from" => Stand::AcrossFrom { anchor: anchor()? },
            "on_block_of" => Stand::OnBlockOf { anchor: anchor()? },
            "in_middle_of" => Stand::InMiddleOf { anchor: anchor()? },
            "at_edge_of" => Stand::AtEdgeOf { anchor: anchor()? },
            "next_to" => return to(Relation::NextTo),
            "near" => return to(Relation::Near),
            "far_from" => return to(Relation::FarFrom),
            "in_front_of" => return to(Relation::InFrontOf),
            "behind" => return to(Relation::Behind),
            "left_of" => return to(Relation::LeftOf),
            "right_of" => return to(Relation::RightOf),
            "on_top_of" => return to(Relation::OnTopOf),
            "inside" => return to(Relation::Inside),
            other => return Err(format!("{other:?} is no place")),
        })
    }

    /// A place that is a point, if it is one.
    fn point(&self, is: &str, place: &Value) -> Option<Result<Stand, String>> {
        let plane = |east: &str, north: &str| Vector2::new(metres(place, east), metres(place, north));
        let of = |field: &str| self.anchor(place, field).and_then(|id| self.entity(id));
        let point = match is {
            "here" => return Some(Ok(Stand::Around { point: self.asked.from })),
            "around" => return Some(Ok(Stand::Around { point: Point2::from(plane("east", "north")) })),
            "end_of_street" => return Some(self.end_of_street(place)),
            "at" => Ok(Point2::from(plane("east", "north"))),
            "in_place_of" => of("of").map(|thing| thing.planar()),
            "shifted" => of("of").map(|thing| thing.planar() + plane("east", "north")),
            "shifted_as_turned" => of("of").map(|thing| {
                let (ahead, by) = (direction(yaw_of(thing.pose)), plane("forward", "left"));
                thing.planar() + ahead * by.x + Vector2::new(-ahead.y, ahead.x) * by.y
            }),
            "nearer" => of("of").and_then(|thing| {
                let (from, to) = (thing.planar(), of("to")?.planar());
                let (way, far) = (to - from, (to - from).norm());
                // Where both stand on one spot, no way leads from the one to the other.
                Ok(if far > 1e-6 { from + way * (metres(place, "distance") / far) } else { from })
            }),
            "halfway" => of("of").and_then(|thing| {
                let from = thing.planar();
                Ok(from + (of("to")?.planar() - from) * 0.5)
            }),
            _ => return None,
        };
        Some(point.map(|point| Stand::At { point }))
    }

    /// The end of a street that lies in a direction.
    fn end_of_street(&self, place: &Value) -> Result<Stand, String> {
        let roads = self.streets(place)?;
        let ends = self.asked.scene.roads().and_then(|network| Ways::of(network).ends(&roads));
        let [one, other] = ends.ok_or("that street does not run from one place to another")?;
        let way = direction(self.side(place)?);
        let far = |point: Point2| point.coords.dot(&way);
        // A street that runs east has no north end.
        if (far(one) - far(other)).abs() * 2.0 < (one - other).norm() {
            return Err("that street has no end on that side: it runs the other way".to_owned());
        }
        Ok(Stand::Around { point: if far(one) > far(other) { one } else { other } })
    }

    /// A direction of the compass, or a side of the thing that is named, radians from east.
    fn side(&self, place: &Value) -> Result<f64, String> {
        let name = place["side"].as_str().unwrap_or_default();
        if let Some(heading) = by_compass(name) {
            return Ok(heading);
        }
        let anchor = self.anchor(place, "of")?;
        self.entity(anchor)?;
        by_side(name, anchor, self.asked.scene).ok_or_else(|| format!("{name:?} is no side"))
    }

    /// A side of a street, radians from east.
    fn side_of_street(&self, place: &Value) -> Result<f64, String> {
        let name = place["side"].as_str().unwrap_or_default();
        if let Some(heading) = by_compass(name) {
            return Ok(heading);
        }
        let roads = self.streets(place)?;
        let left = self.asked.scene.roads().and_then(|network| Ways::of(network).left(&roads));
        let left = left.ok_or_else(|| format!("{name:?} is no side of a street"))?;
        Ok(if name == "left" { left } else { left + std::f64::consts::PI })
    }

    pub(super) fn line(&self, line: &Value) -> Result<Line, String> {
        let of = || self.anchor(line, "of");
        Ok(match line["is"].as_str().unwrap_or_default() {
            "along" => Line::Along { anchor: of()? },
            "around" => Line::Around { anchor: of()? },
            "between" => Line::Between { one: of()?, other: self.anchor(line, "and")? },
            "along_street" => Line::Road { roads: self.streets(line)?, sides: Sides::Either },
            "both_sides_of_street" => Line::Road { roads: self.streets(line)?, sides: Sides::Both },
            "on_side_of_street" => {
                Line::RoadSide { roads: self.streets(line)?, heading: self.side_of_street(line)? }
            }
            other => return Err(format!("{other:?} is no line")),
        })
    }
}
