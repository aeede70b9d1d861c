//! How fast people walk by age and sex.

use serde::{Deserialize, Serialize};
use simworld_core::seed::StreamRng;

use crate::TrafficConfig;

/// A person's sex, as far as walking speeds tell them apart.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Sex {
    /// Women and girls.
    #[default]
    Female,
    /// Men and boys.
    Male,
}

/// Mean free speed by age, years and m/s (Weidmann 1993, *Transporttechnik der Fussgänger*, speed over age).
const BY_AGE: [(f64, f64); 14] = [
    (5.0, 0.78),
    (10.0, 1.18),
    (15.0, 1.49),
    (20.0, 1.63),
    (25.0, 1.58),
    (30.0, 1.55),
    (40.0, 1.50),
    (50.0, 1.42),
    (60.0, 1.27),
    (65.0, 1.18),
    (70.0, 1.06),
    (75.0, 0.91),
    (80.0, 0.69),
    (90.0, 0.35),
];
/// Mean free speed of everybody, of women and of men, m/s (the same).
const MEAN: f64 = 1.34;
const BY_SEX: [f64; 2] = [1.27, 1.41];
/// First year of each band of ages, and the year after the last.
const BANDS: [u8; 7] = [6, 15, 25, 50, 65, 80, 90];
/// Part of the spread that is a person's own at least, the rest being age and sex.
const OWN: f64 = 0.3;

/// Mean free speed at an age, m/s.
pub(super) fn speed_at(age: f64) -> f64 {
    let after = BY_AGE.partition_point(|(year, _)| *year <= age).clamp(1, BY_AGE.len() - 1);
    let ((a, low), (b, high)) = (BY_AGE[after - 1], BY_AGE[after]);
    low + (high - low) * ((age - a) / (b - a)).clamp(0.0, 1.0)
}

/// Draws people whose speeds have the mean and the deviation of the configuration, and differ by age and sex as measured.
#[derive(Clone, Debug)]
pub(super) struct Profiles {
    ages: [f64; 6],
    mean: f64,
    deviation: f64,
    /// Mean speed by age and sex over the ages of the configuration, m/s.
    of_all: f64,
    /// How much of the differences by age and sex is kept, and what is a person's own, m/s.
    kept: f64,
    own: f64,
}

/// Somebody drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Profile {
    pub(super) age: u8,
    pub(super) sex: Sex,
    /// m/s.
    pub(super) free_speed: f64,
}

fn by_age_and_sex(age: u8, sex: usize) -> f64 {
    speed_at(f64::from(age) + 0.5) * BY_SEX[sex] / MEAN
}

impl Profiles {
    pub(super) fn new(config: &TrafficConfig) -> Self {
        let ages = config.people.ages;
        let (mut weight, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for (band, of_band) in ages.iter().enumerate() {
            let years = BANDS[band]..BANDS[band + 1];
            let of_one = of_band / (2.0 * years.len() as f64);
            for (age, sex) in years.flat_map(|age| [(age, 0), (age, 1)]) {
                let speed = by_age_and_sex(age, sex);
                weight += of_one;
                sum += of_one * speed;
                squares += of_one * speed * speed;
            }
        }
        // The weights are checked to have a positive sum.
        let of_all = sum / weight;
        let (mean, deviation) = (config.walking_speed, config.walking_deviation);
        let by_class = (squares / weight - of_all * of_all).max(0.0).sqrt() * mean / of_all;
        let most = deviation * (1.0 - OWN * OWN).sqrt();
        let kept = if by_class > most { most / by_class } else { 1.0 };
        let own = (deviation * deviation - (by_class * kept) * (by_class * kept)).max(0.0).sqrt();
        Self { ages, mean, deviation, of_all, kept, own }
    }

    pub(super) fn draw(&self, rng: &mut StreamRng) -> Profile {
        let band = rng.weighted(&self.ages).unwrap_or(0);
        let years = usize::from(BANDS[band + 1] - BANDS[band]);
        let age = BANDS[band] + rng.below(years) as u8;
        let sex = usize::from(rng.chance(0.5));
        let of_class = 1.0 + self.kept * (by_age_and_sex(age, sex) / self.of_all - 1.0);
        let (low, high) = ((self.mean - 3.0 * self.deviation).max(0.4), self.mean + 3.0 * self.deviation);
        let free_speed = rng.normal(self.mean * of_class, self.own).clamp(low, high);
        Profile { age, sex: [Sex::Female, Sex::Male][sex], free_speed }
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;

    /// `RiMEA` 7: speeds are those of the ages; mean and deviation of all are those asked for (our tolerance: 3 %).
    #[test]
    fn speeds_follow_age_and_sex() {
        let config = TrafficConfig::default();
        let profiles = Profiles::new(&config);
        let mut rng = Seed(5).stream("profiles").rng();
        let drawn: Vec<Profile> = (0..60_000).map(|_| profiles.draw(&mut rng)).collect();
        let mean = |people: &mut dyn Iterator<Item = &Profile>| {
            let (sum, count) = people.fold((0.0, 0.0), |(sum, count), p| (sum + p.free_speed, count + 1.0));
            sum / count
        };
        let all = mean(&mut drawn.iter());
        assert!((all / 1.34 - 1.0).abs() < 0.03, "{all} m/s");
        let squares = drawn.iter().map(|p| (p.free_speed - all) * (p.free_speed - all)).sum::<f64>();
        let deviation = (squares / drawn.len() as f64).sqrt();
        assert!((deviation / 0.26 - 1.0).abs() < 0.05, "{deviation} m/s");
        let of_ages = |low, high| mean(&mut drawn.iter().filter(|p| (low..high).contains(&p.age)));
        // Relative to all, as the curve is relative to its mean, within the 5 % that the clamping takes.
        for (low, high) in [(10, 11), (20, 25), (30, 35), (45, 50), (60, 65), (72, 76)] {
            let expected =
                (low..high).map(|age| speed_at(f64::from(age) + 0.5)).sum::<f64>() / f64::from(high - low);
            let share = 1.0 + profiles.kept * (expected / profiles.of_all - 1.0);
            let off = of_ages(low, high) / (all * share) - 1.0;
            assert!(off.abs() < 0.05, "ages {low} to {high}: {off}");
        }
        let [women, men] =
            [Sex::Female, Sex::Male].map(|sex| mean(&mut drawn.iter().filter(|p| p.sex == sex)));
        let expected = 1.0 + profiles.kept * (1.41 / 1.27 - 1.0);
        assert!((men / women / expected - 1.0).abs() < 0.02, "{women} and {men} m/s");
    }
}
