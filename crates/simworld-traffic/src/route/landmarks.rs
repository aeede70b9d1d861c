//! How long it takes at least from one leg to another, by the times from and to a few landmarks (Goldberg and Harrelson 2005, "Computing
//! the shortest path: A* search meets graph theory").

use super::Leg;
use super::legs::Legs;
use super::search::Searches;

/// One cache line a leg.
const COUNT: usize = 8;
/// By so much a time in `f32` may be too long, as a share of it, and more.
const ROUNDING: f32 = 1e-6;

/// By leg: the times from the ends of the landmarks to its own, and from its own to theirs, s; infinite where none leads there.
#[derive(Clone, Debug)]
pub(super) struct Landmarks(Vec<[[f32; COUNT]; 2]>);

impl Landmarks {
    /// Landmarks are legs between which one can drive both ways, each as far as can be from those before it.
    pub(super) fn new(legs: &Legs, searches: &Searches) -> Self {
        let before = legs.reversed();
        let onward = |from| times(legs.count(), searches, from, |leg| legs.after(leg));
        let backward = |to| times(legs.count(), searches, to, |leg| before.after(leg));
        let mut landmarks = Self(vec![[[f32::INFINITY; COUNT]; 2]; legs.count()]);
        let mut nearest = around(legs.count(), onward, backward);
        for number in 0..COUNT {
            let far = (0..nearest.len()).filter(|leg| nearest[*leg].is_finite());
            let Some(landmark) = far.max_by(|a, b| nearest[*a].total_cmp(&nearest[*b])) else { break };
            let landmark = Leg::from_index(landmark);
            for (leg, (from, to)) in onward(landmark).into_iter().zip(backward(landmark)).enumerate() {
                let [own_from, own_to] = &mut landmarks.0[leg];
                (own_from[number], own_to[number]) = (from, to);
                if nearest[leg].is_finite() {
                    nearest[leg] = nearest[leg].min(from);
                }
            }
        }
        landmarks
    }

    /// Time that it takes at least from the end of a leg to that of another, s; infinite if a landmark shows that none leads there.
    #[inline]
    pub(super) fn least(&self, from: Leg, to: Leg) -> f64 {
        let ([own_from, own_to], [to_from, to_to]) = (&self.0[from.index()], &self.0[to.index()]);
        let mut least = 0.0_f32;
        for number in 0..COUNT {
            // Where neither is reached that is no number, and says nothing.
            least = least.max(to_from[number] * (1.0 - ROUNDING) - own_from[number]);
            least = least.max(own_to[number] * (1.0 - ROUNDING) - to_to[number]);
        }
        f64::from(least)
    }
}

/// The times from the end of a leg to those of all, s.
fn times<'a>(
    count: usize,
    searches: &Searches,
    from: Leg,
    after: impl Fn(Leg) -> &'a [(Leg, f64)],
) -> Vec<f32> {
    searches.with(count, |search| {
        search.run((from, None, f64::INFINITY), after, |_, next| Some(next.1), |_| 0.0);
        let time = |leg| search.time(Leg::from_index(leg)).map_or(f32::INFINITY, |time| time as f32);
        (0..count).map(time).collect()
    })
}

/// The times from one leg to all to which one can drive and come back, of that leg of a few from which these are most; the others are infinite.
fn around(count: usize, onward: impl Fn(Leg) -> Vec<f32>, backward: impl Fn(Leg) -> Vec<f32>) -> Vec<f32> {
    let within = |from: usize| {
        let back = backward(Leg::from_index(from));
        let both = |(time, back): (f32, f32)| if back.is_finite() { time } else { f32::INFINITY };
        onward(Leg::from_index(from)).into_iter().zip(back).map(both).collect::<Vec<f32>>()
    };
    let reached = |times: &Vec<f32>| times.iter().filter(|time| time.is_finite()).count();
    (0..COUNT).map(|number| within(count * number / COUNT)).max_by_key(reached).unwrap_or_default()
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
        let landmarks = Landmarks::new(&legs, &searches);
        let (mut least, mut whole) = (0.0, 0.0);
        let all = (0..legs.count()).map(Leg::from_index);
        for from in all.clone() {
            for (to, time) in all.clone().zip(times(legs.count(), &searches, from, |leg| legs.after(leg))) {
                let bound = landmarks.least(from, to);
                assert!(bound <= f64::from(time) * (1.0 + 1e-6), "{from:?} to {to:?}: {bound} of {time}");
                if time.is_finite() {
                    (least, whole) = (least + bound, whole + f64::from(time));
                }
            }
        }
        assert!(least > 0.8 * whole, "{least} of {whole}");
    }
}
