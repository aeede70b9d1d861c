//! The judge of rows, streets, areas and distances: by coordinates alone, without anything that the editor uses.

use simworld_core::geometry::{Point2, Vector2, direction, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::net::LaneDirection;
use simworld_core::ops::{atan2, wrap_angle};
use simworld_core::scene::Scene;

use super::relations::Footprint;
use super::{Judge, Rest, place_of};
use crate::city::{STREETS, piece, road_at};

/// Half a carriageway of the quarter, and as far beyond it as "on" a street, m.
const KERB: f64 = 3.5;
const EDGE: f64 = 6.3;
/// The quarter's streets are so long, m.
const LENGTH: f64 = 200.0;

impl Judge<'_> {
    /// `row ASSET SPACING|xN road KEY [both] | along KEY | between A B | around KEY`.
    pub(super) fn row(&self, told: &str, rest: &mut Rest) -> Result<(), String> {
        let mut words: Vec<&str> = told.split_whitespace().collect();
        let is_any = words[0] == "any";
        let name = if is_any { format!("any {}", words.remove(1)) } else { words[0].to_owned() };
        words.remove(0);
        let row: Vec<EntityId> =
            rest.added.iter().copied().filter(|id| self.is_made(*id, &name, 1.0)).collect();
        rest.added.retain(|id| !row.contains(id));
        let spacing = words.remove(0);
        let count = spacing.strip_prefix('x').map(|count| count.parse().expect("a count"));
        let every: Option<f64> = spacing.parse().ok();
        if count.is_some_and(|count: usize| count != row.len()) {
            return Err(format!("{} in the row", row.len()));
        }
        if words[0] == "around" {
            return self.ring(&row, self.id(words[1]), every);
        }
        let along: Vec<(f64, f64)> = row.iter().map(|id| self.along(*id, &words)).collect();
        let length = match words[0] {
            "road" => LENGTH,
            "along" => self.sides(self.id(words[1])).0 * 2.0,
            _ => (place_of(self.after, self.id(words[1])) - place_of(self.after, self.id(words[2]))).norm(),
        };
        let sides: Vec<Vec<(f64, f64)>> = if words.last() == Some(&"both") {
            let side = |left: bool| along.iter().copied().filter(|at| (at.1 > 0.0) == left).collect();
            vec![side(true), side(false)]
        } else {
            vec![along]
        };
        for side in sides {
            self.line(&words, side, length, every)?;
        }
        Ok(())
    }

    /// Whether stations and distances off a line are those of a row.
    fn line(
        &self,
        words: &[&str],
        mut row: Vec<(f64, f64)>,
        length: f64,
        every: Option<f64>,
    ) -> Result<(), String> {
        row.sort_by(|a, b| a.0.total_cmp(&b.0));
        if row.windows(2).any(|pair| pair[0].1.signum() != pair[1].1.signum() && pair[0].1.abs() > 0.3) {
            return Err(format!("it is on both sides: {row:?}"));
        }
        let least = row.iter().map(|at| at.1).fold(f64::INFINITY, f64::min);
        let most = row.iter().map(|at| at.1).fold(f64::NEG_INFINITY, f64::max);
        let off = match words[0] {
            "road" => (KERB, KERB + EDGE),
            "along" => {
                let wide = self.sides(self.id(words[1])).1;
                (wide, wide + 5.0)
            }
            _ => (0.0, (length / 3.0).max(2.0)),
        };
        if words[0] == "between" && most - least > 0.3 {
            return Err(format!("it is not straight: {row:?}"));
        }
        if let Some(at) =
            row.iter().find(|at| !(off.0..=off.1).contains(&at.1.abs()) || at.0 < -1.0 || at.0 > length + 1.0)
        {
            return Err(format!("{at:?} is off the line"));
        }
        let gaps: Vec<f64> = row.windows(2).map(|pair| pair[1].0 - pair[0].0).collect();
        let even = |gap: &f64, step: f64, many: bool| {
            let times = if many { (gap / step).round().max(1.0) } else { 1.0 };
            (gap - times * step).abs() <= 0.25 * step
        };
        // Nothing stands within what the row is between.
        let free = if words[0] == "between" { length - self.within(words[1], words[2]) } else { length };
        let Some(step) = every else {
            let mean = gaps.iter().sum::<f64>() / gaps.len().max(1) as f64;
            let odd = gaps.iter().find(|gap| !even(gap, mean, false));
            // A row fills what it is along.
            let fills = mean * row.len() as f64 >= free * 0.6;
            return if odd.is_some() || !fills { Err(format!("it is uneven: {row:?}")) } else { Ok(()) };
        };
        let room = (free / step + 1e-6).floor();
        if (row.len() as f64) < room * 0.6 || row.len() as f64 > room + 1.0 {
            return Err(format!("{} where there is room for {room}", row.len()));
        }
        let odd = gaps.iter().find(|gap| !even(gap, step, true));
        odd.map_or(Ok(()), |gap| Err(format!("{gap:.1} m from one to the next, and not {step}: {row:?}")))
    }

    /// How much of the line from the middle of a thing to that of another is within either of them, m.
    fn within(&self, one: &str, other: &str) -> f64 {
        let [one, other] = [one, other].map(|key| self.id(key));
        let way = (place_of(self.after, other) - place_of(self.after, one)).normalize();
        let reach = |id: EntityId| Footprint::of(self.after, id).expect("it is there").reach(way);
        reach(one) + reach(other)
    }

    /// How far along its line a thing stands, and how far to the left of it, m.
    fn along(&self, thing: EntityId, words: &[&str]) -> (f64, f64) {
        let at = place_of(self.after, thing);
        match words[0] {
            "road" => {
                let (.., goes_east, line) = street(words[1]);
                if goes_east { (at.x, at.y - line) } else { (at.y, line - at.x) }
            }
            "along" => {
                let (anchor, (long, _)) = (self.id(words[1]), self.sides(self.id(words[1])));
                let (ahead, way) = (self.long_way(anchor), at - place_of(self.after, anchor));
                (way.dot(&ahead) + long, ahead.perp(&way))
            }
            "between" => {
                let [one, other] = [words[1], words[2]].map(|key| place_of(self.after, self.id(key)));
                let ahead = (other - one).normalize();
                ((at - one).dot(&ahead), ahead.perp(&(at - one)))
            }
            other => panic!("no line {other}"),
        }
    }

    /// Half of the long and of the short side of a thing, m.
    fn sides(&self, thing: EntityId) -> (f64, f64) {
        let size = self.after.entity(thing).expect("it is there").info.shape.size();
        (size.x.max(size.y) * 0.5, size.x.min(size.y) * 0.5)
    }

    fn long_way(&self, thing: EntityId) -> Vector2 {
        let entity = self.after.entity(thing).expect("it is there");
        let size = entity.info.shape.size();
        direction(yaw_of(entity.pose) + if size.x >= size.y { 0.0 } else { std::f64::consts::FRAC_PI_2 })
    }

    fn ring(&self, row: &[EntityId], anchor: EntityId, every: Option<f64>) -> Result<(), String> {
        let middle = place_of(self.after, anchor);
        let ways: Vec<Vector2> = row.iter().map(|id| place_of(self.after, *id) - middle).collect();
        let (least, most) = ways
            .iter()
            .map(Vector2::norm)
            .fold((f64::INFINITY, 0.0_f64), |(low, high), radius| (low.min(radius), high.max(radius)));
        let mut angles: Vec<f64> = ways.iter().map(|way| atan2(way.y, way.x)).collect();
        angles.sort_by(f64::total_cmp);
        let step = std::f64::consts::TAU / row.len() as f64;
        let is_even = (0..angles.len()).all(|rank| {
            let next = angles[(rank + 1) % angles.len()];
            (wrap_angle(next - angles[rank] - step)).abs() <= 0.25 * step
        });
        // One every so many metres, without those for which there is no room, as in any row.
        let wide = std::f64::consts::TAU * most;
        let is_spaced = every.is_some_and(|every| {
            let room = (wide / every).round();
            let step = std::f64::consts::TAU / room;
            let fits = (0..angles.len()).all(|rank| {
                let gap =
                    (angles[(rank + 1) % angles.len()] - angles[rank]).rem_euclid(std::f64::consts::TAU);
                (gap - (gap / step).round() * step).abs() <= 0.25 * step
            });
            fits && row.len() as f64 >= room * 0.6
        });
        // Around what is large the circle is as large.
        let (long, deep) = self.sides(anchor);
        let limit = (simworld_core::ops::hypot(long, deep) + 16.0).max(30.0);
        if most - least < 0.3 && most < limit && (is_even || is_spaced) {
            Ok(())
        } else {
            Err(format!("no ring: {ways:?}"))
        }
    }

    // ---- streets ----

    pub(super) fn passages(&self, keys: &[&str], is_closed: bool, rest: &mut Rest) -> Result<(), String> {
        for key in keys {
            let road = road_at(self.after, piece(key));
            for leg in [(road, LaneDirection::Forward), (road, LaneDirection::Backward)] {
                let Some(index) = rest.passages.iter().position(|changed| *changed == leg) else {
                    return Err(format!("nothing was done to {key}"));
                };
                rest.passages.remove(index);
                if self.after.is_closed(leg) != is_closed {
                    return Err(format!("{key} is not as asked"));
                }
            }
        }
        Ok(())
    }

    // ---- areas and distances ----

    pub(super) fn stands_on_ground(&self, thing: EntityId, relation: &str, keys: &[&str]) -> bool {
        let at = place_of(self.after, thing);
        let anchor = || self.id(keys[0]);
        let footprint = |id: EntityId| Footprint::of(self.after, id).expect("it is there");
        let gap = || footprint(anchor()).gap(&footprint(thing));
        let number =
            |rank: usize| -> f64 { keys[rank].parse().unwrap_or_else(|_| panic!("no number {keys:?}")) };
        match relation {
            "road" => {
                let (.., goes_east, line) = street(keys[0]);
                let (along, off) = if goes_east { (at.x, at.y - line) } else { (at.y, at.x - line) };
                (0.0..=LENGTH).contains(&along) && (KERB..=KERB + EDGE).contains(&off.abs())
            }
            "junction" => {
                let (one, other) = (street(keys[0]), street(keys[1]));
                let (x, y) = if one.2 { (other.3, one.3) } else { (one.3, other.3) };
                let off = at - Point2::new(x, y);
                off.norm() <= 21.0 && off.x.abs() > KERB && off.y.abs() > KERB
            }
            "off" => {
                let way = at - place_of(self.after, anchor());
                let yaw = yaw_of(self.after.entity(anchor()).expect("it is there").pose).to_degrees();
                let degrees = match keys[2] {
                    "east" => 0.0,
                    "northeast" => 45.0,
                    "north" => 90.0,
                    "west" => 180.0,
                    "south" => -90.0,
                    "front" => yaw,
                    "left" => yaw + 90.0,
                    "back" => yaw + 180.0,
                    "right" => yaw - 90.0,
                    other => panic!("no direction {other}"),
                };
                let turned = wrap_angle(atan2(way.y, way.x) - f64::to_radians(degrees));
                (gap() - number(1)).abs() <= 0.4 + 0.05 * number(1) && turned.abs() <= 0.14
            }
            "gap" => (gap() - number(1)).abs() <= 0.6,
            "within" => gap() <= number(1) + 0.3,
            "beyond" => gap() >= number(1) - 0.6,
            "block" => {
                let block = |point: Point2| ((point.x / 100.0).floor(), (point.y / 100.0).floor());
                block(at) == block(place_of(self.after, anchor()))
            }
            "middle" => (at - place_of(self.after, anchor())).norm() <= 3.6,
            "edge" => footprint(anchor()).depth(at).abs() <= 2.2,
            other => panic!("no relation {other}"),
        }
    }
}

fn street(key: &str) -> (&'static str, &'static str, bool, f64) {
    STREETS.into_iter().find(|street| street.0 == key).unwrap_or_else(|| panic!("no street {key}"))
}
