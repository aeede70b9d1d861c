//! How slopes and stairs slow somebody down.

use serde::{Deserialize, Serialize};
use simworld_core::ops;

/// Speed on stairs as a share of that on the level, upwards and downwards.
const UPSTAIRS: f64 = 0.35;
const DOWNSTAIRS: f64 = 0.5;
/// A rise or drop of the soles in one substep beyond this is a step, m; slopes of 45° rise less in the way of one.
const STEP: f64 = 0.08;
/// Two steps within this way are stairs, m: treads are 0.25 to 0.35 m deep. A kerb alone slows nobody down.
const TREADS: f64 = 0.6;
/// Way over which the grade is averaged, m: less than a step.
const SMOOTHING: f64 = 0.4;
/// Who was stopped by a riser makes up for so many substeps at most, by so much more of a way at a time.
const STALLED: f64 = 3.0;
const CATCHING_UP: f64 = 0.5;
/// Below this grade the ground is level.
const LEVEL: f64 = 0.01;

/// What somebody has walked on lately.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct Pace {
    /// Rise over way, averaged.
    grade: f64,
    /// Way since the last step, m.
    since_step: f64,
    /// Which way the last step went, if it was less than two treads ago.
    last: Option<Flight>,
    /// The stairs that it is on.
    stairs: Option<Flight>,
    /// Way that was told and not gone since the last step, m, and what of it is made up for after that.
    stalled: f64,
    owed: f64,
}

/// Which way stairs lead.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum Flight {
    Up,
    Down,
}

impl Pace {
    /// The speed that one keeps here, as a share of that on the level: on stairs as above, and on slopes by Tobler's hiking
    /// function 6 exp(-3.5 |grade + 0.05|) km/h (Three Presentations on Geographical Analysis and Modeling, 1993), in
    /// relation to the level.
    pub(super) fn share(&self) -> f64 {
        match self.stairs {
            Some(Flight::Up) => UPSTAIRS,
            Some(Flight::Down) => DOWNSTAIRS,
            None if self.grade.abs() < LEVEL => 1.0,
            None => ops::exp(-3.5 * ((self.grade + 0.05).abs() - 0.05)),
        }
    }

    /// The share of a way in the plane that the character controller has to be told so that one comes as far: it lays the way along a
    /// slope, where its cosine is lost twice, and stops in front of each riser for a substep or two.
    pub(super) fn told(&self, way: f64) -> f64 {
        if self.stairs.is_some() {
            self.catching_up(way)
        } else if self.grade.abs() < LEVEL {
            1.0
        } else {
            1.0 + self.grade * self.grade
        }
    }

    /// The part of that for stairs.
    pub(super) fn catching_up(&self, way: f64) -> f64 {
        if self.stairs.is_some() { 1.0 + (self.owed / way.max(1e-9)).min(CATCHING_UP) } else { 1.0 }
    }

    /// Takes in what the controller made of a way in the plane, m.
    pub(super) fn keep_up(&mut self, told: f64, way: f64) {
        self.owed = (self.owed - (way - told).max(0.0)).max(0.0);
        self.stalled = (self.stalled + (told - way).max(0.0)).min(STALLED * told);
    }

    /// Takes in the way of a substep over what does not move, m.
    pub(super) fn go(&mut self, way: f64, rise: f64) {
        if way <= 0.0 {
            return;
        }
        self.since_step += way;
        if self.since_step > TREADS {
            (self.last, self.stairs) = (None, None);
            (self.stalled, self.owed) = (0.0, 0.0);
        }
        let grade = if rise.abs() > STEP.max(way * 1.1) {
            let flight = if rise > 0.0 { Flight::Up } else { Flight::Down };
            self.stairs = self.last.filter(|last| *last == flight);
            self.last = Some(flight);
            self.since_step = 0.0;
            self.owed = std::mem::take(&mut self.stalled);
            0.0
        } else {
            rise / way
        };
        self.grade += (grade - self.grade) * (way / (way + SMOOTHING));
        if self.grade.abs() < 1e-6 {
            self.grade = 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walked(steps: impl IntoIterator<Item = (f64, f64)>) -> Pace {
        let mut pace = Pace::default();
        for (way, rise) in steps {
            pace.go(way, rise);
        }
        pace
    }

    #[test]
    fn stairs_slow_down_and_kerbs_do_not() {
        let flight = |rise: f64| walked((0..40).map(|i| (0.05, if i % 6 == 5 { rise } else { 0.0 })));
        assert_eq!(flight(0.17).share(), 0.35);
        assert_eq!(flight(-0.17).share(), 0.5);
        assert_eq!(walked([(0.05, 0.0), (0.05, 0.15), (0.05, 0.0)]).share(), 1.0);
        let beyond = (0..40).map(|i| (0.05, if i % 6 == 5 && i < 20 { 0.17 } else { 0.0 }));
        assert_eq!(walked(beyond).share(), 1.0, "over, they are forgotten");
    }

    #[test]
    fn slopes_slow_down_by_tobler() {
        let on = |grade: f64| walked((0..200).map(|_| (0.05, 0.05 * grade))).share();
        assert!((on(0.2) - ops::exp(-3.5f64 * 0.2)).abs() < 0.01);
        assert!((on(-0.05) - ops::exp(3.5f64 * 0.05)).abs() < 0.01, "fastest a little downhill");
        assert!((on(-0.3) - ops::exp(-3.5f64 * 0.2)).abs() < 0.01);
        assert_eq!(on(0.0), 1.0);
    }
}
