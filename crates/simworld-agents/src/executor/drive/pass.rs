//! Past what stands in the way: on the left where there is room and nobody comes, else by other roads.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, Vector2, direction, yaw_of};
use simworld_core::net::polyline;
use simworld_core::scene::{EntityRef, Scene};

use super::watch::{Obstacle, Own};
use super::{Driving, smooth};
use crate::lanes::{beside, lane_at};

/// Room to the side of what one passes, m.
const BESIDE: f64 = 0.7;
/// The farthest that one goes to the left, m: not more than the lane of those who come towards one.
const MOST_ASIDE: f64 = 4.5;
/// Length over which one goes out to the left and back again, m.
const RAMP: f64 = 8.0;
/// Those who come towards one have to be farther away than this, m.
const ONCOMING: f64 = 60.0;
/// How far one backs to have room to pull out, m.
const BACK: f64 = 5.0;

impl Driving {
    /// Tries something: backs for room, bends the path round it, or takes other roads; if nothing helps, waits on.
    pub(super) fn get_past(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        obstacle: &Obstacle,
    ) {
        if !obstacle.stands {
            return;
        }
        let aside = obstacle.left + own.half_width + BESIDE;
        let room = obstacle.begin - own.half_length - self.station;
        let (begin, end) = (obstacle.begin - own.half_length - RAMP, obstacle.end + own.half_length + RAMP);
        if aside <= MOST_ASIDE && self.is_clear(scene, own, begin, end, aside) {
            if room < RAMP * 0.75 && !somebody_behind(scene, own, &self.path, self.station) {
                self.backing = BACK;
            }
            self.bend(begin.max(self.station - BACK), end, aside);
        } else if self.tries.is_multiple_of(2)
            && let Some(network) = scene.roads()
        {
            let (point, heading) = polyline::at(&self.path, obstacle.begin);
            let blocked = lane_at(network, point, Some(heading))
                .and_then(|on| beside(network, on.lane).first().copied());
            let mut closed = self.closed.clone();
            closed.extend(blocked);
            if let Ok(found) = Self::new(scene, vehicle, own, self.goal, closed) {
                *self = Self { tries: self.tries, ..found };
            }
        }
    }

    /// Moves the path to the left between two stations.
    fn bend(&mut self, begin: f64, end: f64, aside: f64) {
        const STEP: f64 = 1.0;
        let (begin, length) = (begin.max(0.0), polyline::length(&self.path));
        let end = end.min(length);
        let mut bent = polyline::slice(&self.path, 0.0, begin);
        let count = ((end - begin) / STEP).ceil().max(1.0) as u32;
        for step in 1..=count {
            let along = (end - begin) * f64::from(step) / f64::from(count);
            let out =
                smooth((along / RAMP).min(1.0)) * smooth(((end - begin - along) / RAMP).clamp(0.0, 1.0));
            let (point, heading) = polyline::at(&self.path, begin + along);
            bent.push(point + left_of(heading) * (aside * out));
        }
        bent.extend(polyline::slice(&self.path, end, length).into_iter().skip(1));
        // What lies beyond is as much farther away as the way round is longer.
        let longer = polyline::length(&bent) - length;
        for line in self.lines.iter_mut().filter(|line| line.station >= end) {
            line.station += longer;
        }
        for (limit, _) in self.limits.iter_mut().filter(|(limit, _)| *limit >= end) {
            *limit += longer;
        }
        self.path = bent;
    }

    /// Whether the way round is free of things, and nobody comes towards one on it.
    fn is_clear(&self, scene: &dyn Scene, own: &Own<'_>, begin: f64, end: f64, aside: f64) -> bool {
        let middle: Vec<Point2> = polyline::slice(&self.path, begin, end + ONCOMING);
        let (corridor, beyond) = (
            polyline::offset(&polyline::slice(&self.path, begin, end), aside),
            polyline::offset(&middle, aside),
        );
        let mut clear = true;
        let reach = polyline::length(&middle);
        let _ = scene.visit(&Aabb::column_around(own.at, reach), &mut |other| {
            if own.ids.contains(&other.id) || other.attachment.is_some() || !other.is_solid() {
                return ControlFlow::Continue(());
            }
            let corners = other.obb().footprint();
            let in_way = corners.iter().any(|corner| {
                let near = polyline::closest(&corridor, corner);
                near.is_some_and(|near| near.distance < own.half_width + BESIDE * 0.5)
            });
            let towards = other.kind.is_vehicle() && other.twist.ground_speed() > 0.5 && {
                let near = polyline::closest(&beyond, &other.planar());
                near.is_some_and(|near| {
                    let along = direction(polyline::at(&beyond, near.station).1);
                    near.distance < 2.0 && along.dot(&direction(yaw_of(other.pose))) < 0.0
                })
            };
            clear = !in_way && !towards;
            if clear { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        clear
    }
}

fn left_of(heading: f64) -> Vector2 {
    let ahead = direction(heading);
    Vector2::new(-ahead.y, ahead.x)
}

/// Whether anything stands in the few metres behind a vehicle on its path.
pub(super) fn somebody_behind(scene: &dyn Scene, own: &Own<'_>, path: &[Point2], station: f64) -> bool {
    let ahead = direction(polyline::at(path, station).1);
    let reach = own.half_length + 2.0;
    let mut found = false;
    let _ = scene.visit(&Aabb::column_around(own.at, reach), &mut |other| {
        let is_other = !own.ids.contains(&other.id) && other.attachment.is_none() && other.is_solid();
        found = is_other
            && other.obb().footprint().iter().any(|corner| {
                let offset = corner - own.at;
                let (along, across) = (offset.dot(&ahead), ahead.perp(&offset));
                (-reach..0.0).contains(&along) && across.abs() < own.half_width + 0.2
            });
        if found { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    found
}
