//! What a walker tries when it does not get on: a step aside, a way round what stands there, another way.

use simworld_core::scene::{EntityRef, Scene};

use super::super::RuleExecutor;
use super::super::ground::{Ground, MARGINS};
use super::{Arrival, EVASION, Footing, Leg, Navigation};

impl RuleExecutor {
    /// Tries something else after standing for too long: first a step aside, then a way round what is here, then another way.
    pub(super) fn unstick(
        &mut self,
        scene: &dyn Scene,
        me: &EntityRef<'_>,
        way: &mut Navigation,
    ) -> Option<Arrival> {
        /// So many times as often as in one place it gives up in all.
        const CIRCLES: u32 = 3;
        let here = me.planar();
        way.stuck += 1;
        way.jams += 1;
        way.idle = 0.0;
        way.least = f64::INFINITY;
        self.state.told_speed = None; // somebody may have told the body to stop
        if way.stuck > self.config.attempts || way.jams > CIRCLES * self.config.attempts {
            return Some(Arrival::Lost(format!("stuck at ({:.1}, {:.1})", here.x, here.y)));
        }
        way.evading = EVASION;
        // By the jams in all: of those in one place some are forgiven on the way, and one resort would come again and again.
        match way.jams % 3 {
            2 if !way.crossing_begun && way.lead_round(scene, me) => {
                way.evading = 0.0;
                self.rerouted = Some("it goes round what stands in the way");
            }
            0 => self.take_another_way(scene, me, way),
            _ => {}
        }
        None
    }

    /// Goes on by a way that does not come to where it is stuck, if there is one.
    fn take_another_way(&mut self, scene: &dyn Scene, me: &EntityRef<'_>, way: &mut Navigation) {
        let mut shut = std::mem::take(&mut way.shut);
        let leg = way.legs[way.next];
        let ends = self.ways.as_ref().and_then(|ways| {
            let nearest = ways.nearest(leg.point)?;
            (ways.waypoint(nearest).position == leg.point).then_some(nearest)
        });
        shut.extend(ends.filter(|end| !shut.contains(end)));
        let legs = self.find_way(scene, me, way.goal, &shut);
        let (stuck, jams) = (way.stuck, way.jams);
        *way = Navigation { stuck, jams, shut, ..Navigation::along(legs, way.goal) };
        self.rerouted = Some("it was stuck, and looks for another way");
    }
}

impl Navigation {
    /// Puts a way over the ground, round what stands there now, before the next place on a walkway at which nothing stands; false if
    /// there is none.
    fn lead_round(&mut self, scene: &dyn Scene, me: &EntityRef<'_>) -> bool {
        let here = me.planar();
        let last = self.legs.len() - 1;
        for next in self.next..=last {
            let leg = self.legs[next];
            if leg.footing != Footing::Walkway && next < last {
                continue;
            }
            if leg.crossing.is_some() {
                return false;
            }
            let Some(ground) = Ground::between(scene, me, (here, leg.point), MARGINS[0]) else {
                return false;
            };
            if next < last && !ground.is_free(leg.point) {
                continue;
            }
            let Some((_, mut points)) = ground.way(here, &[leg.point]) else { return false };
            points.pop();
            self.legs.splice(self.next..next, points.into_iter().map(Leg::open));
            return true;
        }
        false
    }
}
