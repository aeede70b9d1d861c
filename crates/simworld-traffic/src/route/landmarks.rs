//! How long it takes at least from one leg to another, by the times from and to a few landmarks (Goldberg and Harrelson 2005, "Computing
//! the shortest path: A* search meets graph theory").

use super::Leg;
use super::legs::Legs;
use super::search::Searches;

const COUNT: usize = 4;
/// By so much a time in `f32` may be too long, as a share of it, and more.
const ROUNDING: f32 = 1e-6;

/// Landmarks of a network, and how long it takes from and to them by the delays of a moment. All of it follows from those.
#[derive(Clone, Debug, Default)]
pub(crate) struct Landmarks {
    /// Legs between which one can drive both ways, each as far as can be from those before it.
    places: Vec<Leg>,
    /// By leg: those that lead to it.
    before: Legs,
    /// By leg: the times from the ends of the landmarks to its own, and from its own to theirs, s; infinite where none leads there.
    times: Vec<[[f32; COUNT]; 2]>,
    /// Whether these are by the delays of now.
    is_fresh: bool,
}

impl PartialEq for Landmarks {
    /// Memory is no state.
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Landmarks {
    /// Says that delays are others now.
    pub(crate) fn forget(&mut self) {
        self.is_fresh = false;
    }

    /// Finds out how long it takes, if the delays are others than when it was last asked: every leg takes so much longer than when it is free, s.
    pub(super) fn see(&mut self, legs: &Legs, searches: &Searches, delay: impl Fn(Leg) -> f64) {
        if self.is_fresh {
            return;
        }
        if self.times.len() != legs.count() {
            self.before = legs.reversed();
            self.times = vec![[[f32::INFINITY; COUNT]; 2]; legs.count()];
            self.places = places(legs, &self.before, searches);
        }
        let times = self.times.as_mut_slice();
        for (number, landmark) in self.places.iter().enumerate() {
            let onward = |_, next: (Leg, f64)| next.1 + delay(next.0);
            let backward = |leg, before: (Leg, f64)| before.1 + delay(leg);
            tree(legs, searches, *landmark, onward, |leg, time| times[leg][0][number] = time as f32);
            tree(&self.before, searches, *landmark, backward, |leg, time| {
                times[leg][1][number] = time as f32;
            });
        }
        self.is_fresh = true;
    }

    /// Time that it takes at least from the end of a leg to that of another, s; infinite if a landmark shows that none leads there.
    #[inline]
    pub(super) fn least(&self, from: Leg, to: Leg) -> f64 {
        let ([own_from, own_to], [to_from, to_to]) = (&self.times[from.index()], &self.times[to.index()]);
        let mut least = 0.0_f32;
        for number in 0..COUNT {
            // Where neither is reached that is no number, and says nothing.
            least = least.max(to_from[number] * (1.0 - ROUNDING) - own_from[number]);
            least = least.max(own_to[number] * (1.0 - ROUNDING) - to_to[number]);
        }
        f64::from(least)
    }
}

/// The times from the end of a leg to those of all, s, one by one; infinite where it does not lead.
fn tree(
    legs: &Legs,
    searches: &Searches,
    from: Leg,
    cost: impl Fn(Leg, (Leg, f64)) -> f64,
    mut each: impl FnMut(usize, f64),
) {
    searches.with(legs.count(), |search| {
        let cost = |leg, next| Some(cost(leg, next));
        search.run((from, None, f64::INFINITY), |leg| legs.after(leg), cost, |_| 0.0);
        for leg in 0..legs.count() {
            each(leg, search.time(Leg::from_index(leg)).unwrap_or(f64::INFINITY));
        }
    });
}

/// Chooses landmarks by the times when all is free.
fn places(legs: &Legs, before: &Legs, searches: &Searches) -> Vec<Leg> {
    let mut nearest = around(legs, before, searches);
    let mut places = Vec::new();
    while places.len() < COUNT {
        let within = (0..nearest.len()).filter(|leg| nearest[*leg].is_finite());
        let Some(far) = within.max_by(|a, b| nearest[*a].total_cmp(&nearest[*b])) else { break };
        places.push(Leg::from_index(far));
        tree(
            legs,
            searches,
            Leg::from_index(far),
            |_, next| next.1,
            |leg, time| {
                if nearest[leg].is_finite() {
                    nearest[leg] = nearest[leg].min(time);
                }
            },
        );
    }
    places
}

/// The times from one leg to all to which one can drive and come back, of that leg of a few of which there are most; the others are infinite.
fn around(legs: &Legs, before: &Legs, searches: &Searches) -> Vec<f64> {
    const TRIED: usize = 8;
    let within = |number: usize| {
        let from = Leg::from_index(legs.count() * number / TRIED);
        let mut times = vec![f64::INFINITY; legs.count()];
        tree(legs, searches, from, |_, next| next.1, |leg, time| times[leg] = time);
        tree(
            before,
            searches,
            from,
            |_, next| next.1,
            |leg, back| {
                if back.is_infinite() {
                    times[leg] = back;
                }
            },
        );
        times
    };
    let reached = |times: &Vec<f64>| times.iter().filter(|time| time.is_finite()).count();
    (0..TRIED).map(within).max_by_key(reached).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};

    use super::*;

    #[test]
    fn no_way_is_quicker_and_most_are_known_well() {
        let plan = StreetPlan::grid(7, 6, 90.0);
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("it is a plan");
        let (legs, searches) = (Legs::new(&network), Searches::default());
        let slow =
            |leg: Leg| if leg.index().is_multiple_of(3) { 7.0 * (leg.index() % 5) as f64 } else { 0.0 };
        let mut landmarks = Landmarks::default();
        landmarks.see(&legs, &searches, |_| 0.0);
        landmarks.forget();
        landmarks.see(&legs, &searches, slow);
        let (mut least, mut whole) = (0.0, 0.0);
        let all = (0..legs.count()).map(Leg::from_index);
        for from in all.clone() {
            tree(
                &legs,
                &searches,
                from,
                |_, next| next.1 + slow(next.0),
                |to, time| {
                    let bound = landmarks.least(from, Leg::from_index(to));
                    assert!(bound <= time * (1.0 + 1e-9), "{from:?} to {to}: {bound} of {time}");
                    if time.is_finite() {
                        (least, whole) = (least + bound, whole + time);
                    }
                },
            );
        }
        assert!(least > 0.7 * whole, "{least} of {whole}");
    }
}
