//! People who walk together.

use simworld_core::geometry::Vector2;
use simworld_core::seed::StreamRng;

use super::Pedestrian;

/// Mean of the Poisson distribution of which sizes of groups are those of two and more, on a weekday (Moussaïd, Perozo,
/// Garnier, Helbing and Theraulaz 2010).
const SIZES: f64 = 0.83;
/// Distance between those who walk abreast, m: they lean to one another (the same: 0.6 to 0.8 m).
pub(super) const ABREAST: f64 = 0.65;
/// Who is farther off is not waited for, m.
const LOST: f64 = 15.0;
/// How much faster one walks for each metre that the others are ahead, as a share, and the bounds of it.
const HASTE: f64 = 0.4;
const FASTEST: f64 = 0.2;
const SLOWEST: f64 = -0.7;

/// How many walk together, two to four: a Poisson draw beyond one.
pub(super) fn size(rng: &mut StreamRng) -> u32 {
    let weights = [SIZES / 2.0, SIZES * SIZES / 6.0, SIZES * SIZES * SIZES / 24.0];
    2 + rng.weighted(&weights).unwrap_or(0) as u32
}

/// Share of parties, of two to four, among parties and those alone, for a share of the walkers to be in parties.
pub(super) fn share_of_parties(in_groups: f64) -> f64 {
    let weights = [SIZES / 2.0, SIZES * SIZES / 6.0, SIZES * SIZES * SIZES / 24.0];
    let mean = weights.iter().zip(2..).map(|(weight, size)| weight * f64::from(size)).sum::<f64>()
        / weights.iter().sum::<f64>();
    in_groups / (in_groups + (1.0 - in_groups) * mean)
}

/// How fast one walks to stay with one's party, as a share of one's free speed: faster behind the others, and more slowly
/// ahead of them.
pub(super) fn pace(me: &Pedestrian, walkers: &[Pedestrian], along: Vector2) -> f64 {
    let first = me.party as usize;
    let members = walkers.get(first..first + 1 + usize::from(me.companions)).unwrap_or_default();
    let (mut sum, mut count) = (0.0, 0.0);
    for other in members.iter().filter(|other| other.party == me.party && other.is_present()) {
        let offset = other.position - me.position;
        if offset.norm_squared() < LOST * LOST {
            sum += offset.dot(&along);
            count += 1.0;
        }
    }
    // One is oneself among them.
    let behind = if count > 0.0 { sum / count } else { 0.0 };
    1.0 + (HASTE * behind).clamp(SLOWEST, FASTEST)
}
