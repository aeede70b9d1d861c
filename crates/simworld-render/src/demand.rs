//! Which levels of detail of a body the views of a batch may show: what of it has to be dressed.
//!
//! Told by its ball and the eyes alone, for both backends and whoever culls: what these decide in whole numbers or in floats lies within the margins
//! here, so that a level may be named that nobody draws, and none is left out that somebody does.

use std::ops::Range;

use simworld_core::geometry::{Point3, Vector3};

use crate::batch::Projection;
use crate::look::Detail;
use crate::resident::Ball;
use crate::shadow::ShadowView;
use crate::sieve::SHADOW_SHARE;
use crate::view::{View, slack};

/// Of more views than these not each is asked for itself.
const FEW: usize = 4;
/// More maps of shadows than these are taken to lie everywhere.
const MOST_MAPS: usize = 8;
/// The share by which distances and pixels may be off: twelve bits of a size and of a reach, fifteen of a place.
const ROUGH: f64 = 3e-3;
/// What distances may be off beside that, m: whole steps of places.
const STEP: f64 = 0.25;
/// What a coordinate may lose in the floats of rays, as a share of itself.
const LOSS: f64 = 1e-6;
/// Cells of a crowd are as wide as balls of this radius, m, are seen in more than their farthest level.
const USUAL: f64 = 2.5;
/// Bounds of that width, m.
const WIDTHS: [f64; 2] = [4.0, 1e5];

/// What is asked of all views of a batch alike.
pub(crate) struct Manner {
    /// What has fewer pixels across its ball is not seen.
    pub min_pixels: f64,
    /// Whether everything is seen at its finest level.
    pub finest: bool,
    /// Whether rays are cast.
    pub is_cast: bool,
    /// Whether there is colour, and so light.
    pub in_color: bool,
    /// How far from the origin anybody is along an axis, m.
    pub widest: f64,
}

/// What a batch may show of whom.
#[derive(Default)]
pub(crate) struct Demand {
    /// Few views, each for itself.
    alone: Vec<Alone>,
    /// Many views, by their focal lengths.
    crowds: Vec<Crowd>,
    /// The eyes of crowds, crowd by crowd and cell by cell.
    spots: Vec<Spot>,
    /// Maps of shadows.
    maps: Vec<(Rule, ShadowView)>,
    /// What a coordinate may lose, as a share of itself, and the largest there is beside that of a ball, m.
    loss: f64,
    widest: f64,
}

/// What decides on levels beside the distance.
#[derive(Clone, Copy, Debug)]
struct Rule {
    /// The least and the greatest focal length, pixels; of parallel views pixels per metre.
    focals: [f64; 2],
    parallel: bool,
    finest: bool,
    min_pixels: f64,
    far: f64,
}

struct Alone {
    rule: Rule,
    view: View,
    /// Whether what lies beside the picture is not drawn. Rays may meet what hangs out of its ball.
    culls: bool,
}

/// Eyes of similar views, in cells of the ground.
struct Crowd {
    rule: Rule,
    /// Around all eyes.
    low: Point3,
    high: Point3,
    /// Of a cell, m.
    width: f64,
    /// Of the spots.
    run: Range<usize>,
}

struct Spot {
    cell: [i64; 2],
    at: Point3,
}

impl Demand {
    /// Takes in a batch: its views, and those of its shadow maps that may be drawn.
    pub(crate) fn gather(&mut self, views: &[View], shadows: &[Option<ShadowView>], manner: &Manner) {
        self.alone.clear();
        self.crowds.clear();
        self.spots.clear();
        self.maps.clear();
        self.loss = if manner.is_cast { LOSS } else { 0.0 };
        self.widest = views.iter().fold(manner.widest, |widest, view| widest.max(view.eye.coords.amax()));
        if views.len() <= FEW {
            let alone = |view: &View| Alone {
                rule: Rule::of_view(view, manner),
                view: view.clone(),
                culls: !manner.is_cast,
            };
            self.alone.extend(views.iter().map(alone));
        } else {
            self.gather_crowds(views, manner);
        }
        for shadow in shadows.iter().flatten() {
            if self.maps.len() > MOST_MAPS {
                break;
            }
            if !self.maps.iter().any(|(_, known)| known.key == shadow.key) {
                self.maps.push((Rule::of_map(shadow, manner.finest), shadow.clone()));
            }
        }
    }

    fn gather_crowds(&mut self, views: &[View], manner: &Manner) {
        for view in views {
            let rule = Rule::of_view(view, manner);
            match self.crowds.iter_mut().find(|crowd| crowd.rule.is_like(&rule)) {
                Some(crowd) => crowd.take_in(&rule, &view.eye),
                None => self.crowds.push(Crowd::of(rule, view.eye)),
            }
        }
        for crowd in &mut self.crowds {
            let first = self.spots.len();
            crowd.width = crowd.rule.reach(USUAL).clamp(WIDTHS[0], WIDTHS[1]);
            for view in views {
                if crowd.rule.is_like(&Rule::of_view(view, manner)) {
                    self.spots.push(Spot { cell: crowd.cell(&view.eye), at: view.eye });
                }
            }
            crowd.run = first..self.spots.len();
            self.spots[first..].sort_unstable_by_key(|spot| spot.cell);
        }
    }

    /// The levels of detail at which a body of that ball may be seen, as [`Detail::bit`]s; none if nobody can see it or its shadow.
    pub(crate) fn levels(&self, ball: &Ball) -> u8 {
        let of_views = self.alone.iter().fold(0, |levels, alone| levels | self.seen_alone(alone, ball));
        let of_all = self.crowds.iter().fold(of_views, |levels, crowd| levels | self.seen_by(crowd, ball));
        if of_all == Detail::EVERY { of_all } else { of_all | self.thrown(ball) }
    }

    fn seen_alone(&self, alone: &Alone, ball: &Ball) -> u8 {
        let away = ball.center - alone.view.eye;
        let distance = away.norm();
        // Twice what a sieve may let through beside the picture.
        let beside = ball.radius + 2.0 * slack(distance, ball.radius);
        if alone.culls && !alone.view.sees(&away, beside, 0.0) {
            return 0;
        }
        let margin = self.margin(ball, distance);
        alone.rule.levels(ball.radius, [distance - margin, distance + margin])
    }

    fn seen_by(&self, crowd: &Crowd, ball: &Ball) -> u8 {
        let rule = &crowd.rule;
        // Somebody of a crowd is always far away, as far as is known.
        let from =
            |distance: f64| rule.levels(ball.radius, [distance - self.margin(ball, distance), f64::INFINITY]);
        let levels = from(crowd.distance(&ball.center));
        if levels == 0 || levels == Detail::Far.bit() || rule.parallel || rule.finest {
            return levels;
        }
        // From there on only the farthest level is seen.
        let within = (rule.reach(ball.radius) + self.margin(ball, 0.0)) / (1.0 - ROUGH) * 1.001;
        from(self.nearest(crowd, &ball.center, within).min(within))
    }

    /// How far away the nearest eye of a crowd is, m; infinite, or any that is farther, if none is within so many metres.
    fn nearest(&self, crowd: &Crowd, at: &Point3, within: f64) -> f64 {
        let spots = &self.spots[crowd.run.clone()];
        let reach = Vector3::repeat(within);
        let ([west, south], [east, north]) = (crowd.cell(&(at - reach)), crowd.cell(&(at + reach)));
        let nearer = |least: f64, spot: &Spot| least.min((spot.at - at).norm_squared());
        if east.abs_diff(west) >= spots.len() as u64 {
            return spots.iter().fold(f64::INFINITY, nearer).sqrt();
        }
        let column = |least: f64, column: i64| {
            let first = spots.partition_point(|spot| spot.cell < [column, south]);
            spots[first..].iter().take_while(|spot| spot.cell <= [column, north]).fold(least, nearer)
        };
        (west..=east).fold(f64::INFINITY, column).sqrt()
    }

    /// At which levels it throws its shadow into maps.
    fn thrown(&self, ball: &Ball) -> u8 {
        let everywhere = self.maps.len() > MOST_MAPS;
        self.maps.iter().fold(0, |levels, (rule, shadow)| {
            let away = (ball.center - shadow.center).norm();
            let reaches = shadow.reaches(&ball.center, ball.radius + 2.0 * slack(away, ball.radius));
            if everywhere || reaches { levels | rule.levels(ball.radius, [0.0; 2]) } else { levels }
        })
    }

    /// By how much the distance of a ball may be told otherwise, m.
    fn margin(&self, ball: &Ball, distance: f64) -> f64 {
        let coordinates = self.widest + ball.center.coords.amax();
        STEP + ROUGH * (distance + ball.radius) + self.loss * coordinates
    }
}

impl Rule {
    fn of_view(view: &View, manner: &Manner) -> Self {
        // Whoever is too far away, or too small, still throws a shadow where rays look for the sun.
        let (min_pixels, far) = match (manner.is_cast, manner.in_color) {
            (true, true) => (0.0, f64::INFINITY),
            _ => (manner.min_pixels, view.far),
        };
        let parallel = view.projection == Projection::Parallel;
        let focal = view.intrinsics.fx.max(view.intrinsics.fy);
        Self { focals: [focal; 2], parallel, finest: manner.finest, min_pixels, far }
    }

    fn of_map(shadow: &ShadowView, finest: bool) -> Self {
        let focals = [SHADOW_SHARE / shadow.texel; 2];
        Self { focals, parallel: true, finest, min_pixels: 0.0, far: f64::INFINITY }
    }

    /// Whether a view may be of the same crowd: focal lengths of one octave.
    fn is_like(&self, other: &Self) -> bool {
        let octave = |rule: &Self| rule.focals[0].to_bits() >> (f64::MANTISSA_DIGITS - 1);
        self.parallel == other.parallel && octave(self) == octave(other)
    }

    /// The levels of a ball of that radius that is so far away, from the least to the greatest distance, m.
    fn levels(&self, radius: f64, [nearest, farthest]: [f64; 2]) -> u8 {
        let pixels = |focal: f64, distance: f64| {
            2.0 * radius * focal / if self.parallel { 1.0 } else { distance.max(radius).max(1e-9) }
        };
        let least = pixels(self.focals[0], farthest) * (1.0 - ROUGH);
        let most = pixels(self.focals[1], nearest) * (1.0 + ROUGH);
        if most < self.min_pixels || nearest - radius > self.far {
            return 0;
        }
        if self.finest {
            return Detail::Near.bit();
        }
        // A ball of the very size is large for the one and not for the other.
        let kinds = [radius < Detail::LARGE * 1.01, radius > Detail::LARGE * 0.99];
        let mut levels = 0;
        for ([middle, near], _) in Detail::thresholds().into_iter().zip(kinds).filter(|(_, may_be)| *may_be) {
            let bit = |detail: Detail, may_be: bool| if may_be { detail.bit() } else { 0 };
            levels |= bit(Detail::Far, least < middle);
            levels |= bit(Detail::Middle, most >= middle && least < near);
            levels |= bit(Detail::Near, most >= near);
        }
        levels
    }

    /// How far away a ball of that radius may be and be seen at another level than the farthest, m.
    fn reach(&self, radius: f64) -> f64 {
        let [[small, _], [large, _]] = Detail::thresholds();
        let pixels = if radius > Detail::LARGE * 1.01 { large } else { small };
        2.0 * radius * self.focals[1] * (1.0 + ROUGH) / pixels
    }
}

impl Crowd {
    fn of(rule: Rule, eye: Point3) -> Self {
        Self { rule, low: eye, high: eye, width: WIDTHS[0], run: 0..0 }
    }

    fn take_in(&mut self, rule: &Rule, eye: &Point3) {
        let [least, most] = self.rule.focals;
        self.rule.focals = [least.min(rule.focals[0]), most.max(rule.focals[1])];
        self.rule.far = self.rule.far.max(rule.far);
        (self.low, self.high) = (self.low.inf(eye), self.high.sup(eye));
    }

    fn cell(&self, at: &Point3) -> [i64; 2] {
        [at.x, at.y].map(|coordinate| (coordinate / self.width).floor() as i64)
    }

    /// How far it is to the box around all eyes, m; nobody's eye is nearer.
    fn distance(&self, at: &Point3) -> f64 {
        Vector3::from_fn(|axis, _| (self.low[axis] - at[axis]).max(at[axis] - self.high[axis]).max(0.0))
            .norm()
    }
}

#[cfg(test)]
mod tests;
