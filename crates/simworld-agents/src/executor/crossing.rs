//! When to begin to cross a road.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2};
use simworld_core::id::CrossingId;
use simworld_core::net::Aspect;
use simworld_core::scene::{EntityRef, Scene};

/// Gap in time before a vehicle that one needs beyond the crossing itself, s.
const MARGIN: f64 = 1.5;
/// How far one looks for vehicles at a crossing without signals, m.
const SIGHT: f64 = 60.0;
/// A vehicle slower than this stands, m/s.
const STANDING: f64 = 0.3;
/// Half the width that a vehicle and a person need to pass, m.
const PASSAGE: f64 = 2.5;

/// Whether to begin: on walk where there is a signal, in a gap where there is none; never into a vehicle that stands on the
/// strip.
pub(super) fn may_begin(
    scene: &dyn Scene,
    me: &EntityRef<'_>,
    id: CrossingId,
    to: Point2,
    speed: f64,
) -> bool {
    let Some(crossing) = scene.roads().and_then(|roads| roads.crossings.get(id.index())) else { return true };
    let duration = (crossing.end - crossing.start).norm() / speed.max(0.1);
    match crossing.signal {
        Some(group) => {
            scene.signals().get(group.index()) == Some(&Aspect::Green) && is_clear(scene, me, to, 0.0)
        }
        None => is_clear(scene, me, to, duration + MARGIN),
    }
}

/// Whether no vehicle is on the way to a point, nor will come across it within so many seconds.
fn is_clear(scene: &dyn Scene, me: &EntityRef<'_>, to: Point2, seconds: f64) -> bool {
    let (from, along) = (me.planar(), to - me.planar());
    let length = along.norm();
    if length < 1e-6 {
        return true;
    }
    let ahead = along / length;
    let sight = if seconds > 0.0 { SIGHT } else { length };
    let mut clear = true;
    let _ = scene.visit(&Aabb::column_around(from + along * 0.5, sight), &mut |other| {
        if !other.kind.is_vehicle() || other.attachment.is_some() {
            return ControlFlow::Continue(());
        }
        let velocity = other.twist.linear.xy();
        let reach = other.info.shape.size().x * 0.5 + PASSAGE;
        // The vehicle's way in the time, in steps short enough not to jump over the strip.
        let time = if velocity.norm() < STANDING { 0.0 } else { seconds };
        let steps = (velocity.norm() * time / reach).ceil().max(1.0) as u32;
        let meets = (0..=steps).any(|step| {
            let then = other.planar() + velocity * (time * f64::from(step) / f64::from(steps)) - from;
            let (forward, aside) = (then.dot(&ahead), ahead.perp(&then));
            let half_width = if velocity.norm() < STANDING { 1.2 } else { reach };
            (-0.5..=length + 0.5).contains(&forward) && aside.abs() < half_width
        });
        if meets {
            clear = false;
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    clear
}
