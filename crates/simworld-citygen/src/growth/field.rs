//! Which way streets run at a place, and how densely people live there.

use std::f64::consts::FRAC_PI_2;

use simworld_core::geometry::Point2;
use simworld_core::seed::{Seed, Stream};

use crate::RoadConfig;
use crate::zoning::{RememberedNoise, ValueNoise, floor};

/// The layout of the land: two smooth fields.
#[derive(Clone, Debug)]
pub(super) struct Field {
    orientation: RememberedNoise,
    density: RememberedNoise,
    base: f64,
    turning: f64,
    radius: f64,
}

impl Field {
    pub(super) fn new(config: &RoadConfig, radius: f64, seed: Seed) -> Self {
        let stream = seed.stream("citygen/field");
        Self {
            orientation: remembered(stream.named("orientation"), config.patch, radius),
            density: remembered(stream.named("density"), radius.max(400.0) * 0.5, radius),
            base: stream.rng().uniform(-std::f64::consts::PI, std::f64::consts::PI),
            turning: config.turning,
            radius,
        }
    }

    /// The layout of land without end: its grain turns about east, and nothing is remote.
    pub(super) fn endless(config: &RoadConfig, seed: Seed) -> Self {
        let radius = f64::INFINITY;
        // What lies beside each other is asked for one after the other.
        let near = 10.0 * config.length;
        let stream = seed.stream("citygen/field");
        Self {
            orientation: remembered(stream.named("orientation"), config.patch, near),
            density: remembered(stream.named("density"), QUARTER, near),
            base: 0.0,
            turning: config.turning,
            radius,
        }
    }

    /// Radius of the land, m.
    pub(super) fn radius(&self) -> f64 {
        self.radius
    }

    /// What is to be known of a place; looked up once for all streets that begin there.
    pub(super) fn site(&mut self, at: Point2) -> Site {
        let grain = self.orientation(at);
        if self.radius.is_infinite() {
            return Site { grain, density: -0.1 + 1.2 * self.density.uniform_at(at), remoteness: 0.0 };
        }
        Site { grain, density: self.density(at), remoteness: at.coords.norm() }
    }

    /// The direction of the main streets at a place, radians.
    fn orientation(&mut self, at: Point2) -> f64 {
        // Without turning there is one grid, and nothing to look up.
        let turned = if self.turning > 0.0 { self.orientation.uniform_at(at) - 0.5 } else { 0.0 };
        self.base + 2.0 * self.turning * turned
    }

    /// How densely people live, in [0, 1]: less towards the edge, and in patches.
    fn density(&mut self, at: Point2) -> f64 {
        let centrality = (1.0 - at.coords.norm() / self.radius).clamp(0.0, 1.0);
        0.55 * centrality + 0.45 * self.density.at(at)
    }
}

/// A field that changes over `scale` m, and remembers about what lies along the edge of a town of that radius, m.
fn remembered(stream: Stream, scale: f64, radius: f64) -> RememberedNoise {
    RememberedNoise::new(ValueNoise::new(stream, scale), ((32.0 * radius / scale) as usize).clamp(16, 1024))
}

/// Distance over which the density of people changes on land without end, m.
const QUARTER: f64 = 500.0;

/// A place and what is to be known of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Site {
    /// The direction of the main streets, radians.
    pub(super) grain: f64,
    /// How densely people live, in [0, 1].
    pub(super) density: f64,
    /// Distance from the middle, m.
    pub(super) remoteness: f64,
}

impl Site {
    /// How far to turn from a heading to the nearest one that runs along the grain, or across it, radians.
    pub(super) fn turn_to_grain(&self, heading: f64) -> f64 {
        let quarters = (heading - self.grain) / FRAC_PI_2;
        (floor(quarters + 0.5) as f64 - quarters) * FRAC_PI_2
    }

    /// Whether a heading runs along the grain rather than across it.
    pub(super) fn runs_along(&self, heading: f64) -> bool {
        // Even quarters from an eighth of a turn before the grain on.
        floor((heading - self.grain) / FRAC_PI_2 + 0.5) % 2 == 0
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::ops::cos;

    use super::*;

    #[test]
    fn the_grain_is_an_eighth_of_a_turn_away_at_most() {
        let site = Site { grain: 0.7, density: 0.5, remoteness: 0.0 };
        for step in -100..100 {
            let heading = 0.1001 * f64::from(step);
            let turn = site.turn_to_grain(heading);
            assert!(turn.abs() <= 0.5 * FRAC_PI_2 + 1e-12);
            assert!((cos(4.0 * (heading + turn - site.grain)) - 1.0).abs() < 1e-9);
            let along = cos(heading - site.grain).abs() > std::f64::consts::FRAC_1_SQRT_2;
            assert_eq!(site.runs_along(heading), along, "{heading}");
        }
    }
}
