//! Which way streets run at a place, and how densely people live there.

use simworld_core::geometry::Point2;
use simworld_core::ops::wrap_angle;
use simworld_core::seed::Seed;

use crate::RoadConfig;
use crate::zoning::ValueNoise;

/// The layout of the land: two smooth fields.
#[derive(Clone, Debug)]
pub(super) struct Field {
    orientation: ValueNoise,
    density: ValueNoise,
    base: f64,
    turning: f64,
    radius: f64,
}

impl Field {
    pub(super) fn new(config: &RoadConfig, radius: f64, seed: Seed) -> Self {
        let stream = seed.stream("citygen/field");
        Self {
            orientation: ValueNoise::new(stream.named("orientation"), config.patch),
            density: ValueNoise::new(stream.named("density"), radius.max(400.0) * 0.5),
            base: stream.rng().uniform(-std::f64::consts::PI, std::f64::consts::PI),
            turning: config.turning,
            radius,
        }
    }

    /// Radius of the land, m.
    pub(super) fn radius(&self) -> f64 {
        self.radius
    }

    /// The direction of the main streets at a place, radians.
    pub(super) fn orientation(&self, at: Point2) -> f64 {
        // Without turning there is one grid, and nothing to look up.
        let turned = if self.turning > 0.0 { self.orientation.uniform_at(at) - 0.5 } else { 0.0 };
        self.base + 2.0 * self.turning * turned
    }

    /// The heading nearest to a wish that runs along the field, or across it.
    pub(super) fn aligned(&self, at: Point2, wish: f64) -> f64 {
        let quarter = std::f64::consts::FRAC_PI_2;
        let grid = self.orientation(at);
        let turns = (wrap_angle(wish - grid) / quarter).round();
        grid + turns * quarter
    }

    /// How densely people live, in [0, 1]: less towards the edge, and in patches.
    pub(super) fn density(&self, at: Point2) -> f64 {
        let centrality = (1.0 - at.coords.norm() / self.radius).clamp(0.0, 1.0);
        0.55 * centrality + 0.45 * self.density.at(at)
    }
}
