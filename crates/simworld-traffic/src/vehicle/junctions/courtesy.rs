//! Courtesy: who has stood too long at his line for want of a turn is let in.
//!
//! Beside a stream without gaps one would stand for good. Those of it who have no leave yet leave the next turn to who has stood for ten minutes
//! and could go but for them, for a while: those who have leave clear the junction meanwhile, the others come to their lines, and who
//! stands at his line hinders nobody. Who gives way to none of those in his way is let in much sooner: where ways share a long
//! stretch, a stream holds it without end, each behind the one before, though all of them owe him the turn or as much as he owes them.

use super::junction::{has_room, may_pass, signal_allows};
use crate::vehicle::manager::{NONE, Vehicle};
use crate::vehicle::part::Part;
use crate::vehicle::scene::Scene;
use crate::vehicle::tracks::Tracks;
use crate::vehicle::tracks::conflicts::Conflict;

/// Who has stood for so long at his line is let in, s. Where it is done sooner, the room behind narrow junctions goes to those, and others
/// wait for longer than they did.
const OVERDUE: f64 = 600.0;
/// Who gives way to nobody who is in his way is let in after so long, s. After a minute already trips of a small city become fewer: the stream
/// has to leave a wide junction for each.
const OWED: f64 = 150.0;
/// For so long one is let in, and once in so many, s. Ways over wide junctions take half a minute.
const FOR: f64 = 60.0;
const EVERY: f64 = 180.0;

impl Part {
    /// Takes note of the first of a lane, who did not get leave, if he is to be let in now: he has stood too long, and could go but for
    /// those whose ways meet his own.
    pub(super) fn ask_courtesy(&mut self, scene: &Scene<'_>, vehicle: &Vehicle, distance: f64) {
        if vehicle.stood < OWED {
            return; // nearly everybody
        }
        let way = vehicle.next as usize;
        let gives_way = |conflict: &Conflict| conflict.yields && scene.junctions.is_held(conflict.way);
        let is_owed = !scene.tracks.conflicts[way].iter().any(gives_way);
        let is_let_in = is_time(vehicle.stood, is_owed)
            && vehicle.holding == NONE
            && vehicle.shift == 0.0
            && signal_allows(scene, way, vehicle, distance)
            && has_room(scene, way, vehicle);
        if is_let_in {
            self.work.let_in.push(vehicle.next);
        }
    }

    /// Whether a vehicle would not go before one who is let in. Who stands between near junctions goes first, and so does who is in a
    /// lock or has a siren on.
    pub(in crate::vehicle) fn lets_in(&self, scene: &Scene<'_>, vehicle: &Vehicle) -> bool {
        let Scene { tracks, .. } = scene;
        let way = vehicle.next;
        self.work.let_in.iter().all(|other| !meet(tracks, *other, way))
            || vehicle.holding != NONE
            || tracks.clusters.of(tracks, tracks.ways[way as usize].from, vehicle).is_some()
            || may_pass(scene, vehicle)
            || scene.sirens.is_on(vehicle.id)
    }
}

/// Whether one who has stood for so long, s, is let in now.
fn is_time(stood: f64, is_owed: bool) -> bool {
    let overdue = stood - if is_owed { OWED } else { OVERDUE };
    overdue >= 0.0 && overdue % EVERY < FOR
}

/// Whether two ways meet, for whoever goes there.
fn meet(tracks: &Tracks, one: u32, other: u32) -> bool {
    let way = one as usize;
    tracks.conflicts[way].iter().any(|conflict| conflict.way == other)
        || tracks.tight[way].contains(&other)
        || tracks.narrow[way].contains(&other)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::super::beside_a_stream::waits;
    use super::*;

    #[test]
    fn one_is_let_in_again_and_again_for_a_while() {
        for (first, is_owed) in [(OVERDUE, false), (OWED, true)] {
            let is_let_in =
                [-1.0, 0.0, FOR - 1.0, FOR, EVERY - 1.0, EVERY].map(|after| is_time(first + after, is_owed));
            assert_eq!(is_let_in, [false, true, true, false, false, true]);
        }
    }

    #[test]
    fn who_has_stood_too_long_beside_a_stream_without_gaps_is_let_in() {
        // So dense, and yet so fast, that there is no gap even for one in haste.
        for every in [22, 23] {
            let wait = waits(OVERDUE - 300.0, every, FRAC_PI_2, false);
            assert_eq!(wait.goes, None, "there are no gaps");
            assert!(wait.counters.crossings > 50, "the stream goes: {:?}", wait.counters);
            let wait = waits(OVERDUE - 40.0, every, FRAC_PI_2, false);
            let goes = wait.goes.expect("he is let in");
            assert!((40.0..40.0 + FOR).contains(&goes), "he goes after {goes} s");
            assert_eq!(wait.counters.forced_stops, 0);
        }
    }

    #[test]
    fn who_is_owed_his_turn_by_a_stream_without_gaps_is_let_in() {
        // Where streets meet at such angles, rad, those who cross share a long stretch.
        for (angle, every) in [(0.4, 15), (0.5, 25)] {
            let wait = waits(0.0, every, angle, true);
            let goes = wait.goes.expect("he is let in");
            assert!((OWED..OWED + FOR).contains(&goes), "he goes after {goes} s");
            assert!(wait.counters.crossings > 40, "the stream goes: {:?}", wait.counters);
            assert_eq!(wait.counters.forced_stops, 0);
        }
    }
}
