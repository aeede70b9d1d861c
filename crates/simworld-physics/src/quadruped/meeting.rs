//! Which links of a quadruped meet one another: all but those on one joint, and thighs and trunk, between which hips have no solids.

use std::sync::Arc;

use simworld_core::ops;

use super::QuadrupedModel;
use super::articulation::THIGH;
use crate::apart::{Apart, Kinds};

/// The number of the trunk's solid; those of thigh and shank of each leg follow.
pub(super) const TRUNK: u16 = 0;

/// The number of the solids of a thigh (1) or a shank (2).
pub(super) fn number(leg: usize, link: usize) -> u16 {
    (2 * leg + link) as u16
}

impl QuadrupedModel {
    /// Which solids meet, if the engine has to ask. Where the hips are so wide that no thigh comes to the trunk, it need not.
    pub(super) fn apart(&self) -> Option<Arc<Apart>> {
        if self.thighs_are_clear() {
            return None;
        }
        let links = (0..4).map(|leg| (TRUNK, number(leg, 1))).collect();
        Some(Arc::new(Apart { solids: (0..9).map(|link| (link, Kinds::default())).collect(), links }))
    }

    /// A leg stays in a plane that turns about the first joint: by how much it passes the middle of the trunk.
    pub(super) fn thighs_are_clear(&self) -> bool {
        let [low, high] = self.limits[0];
        let turned = low.abs().max(high.abs()).min(std::f64::consts::PI);
        let plane = self.hip[1] * ops::cos(turned) + self.hip_offset;
        plane - THIGH * self.thigh > self.trunk_radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wide_hips_keep_the_thighs_off_the_trunk() {
        assert!(QuadrupedModel::default().apart().is_none());
        let narrow = QuadrupedModel { hip_offset: 0.02, ..QuadrupedModel::default() };
        let apart = narrow.apart().expect("the thighs begin within the trunk");
        assert!((0..4).all(|leg| apart.has(number(leg, 1), TRUNK) && !apart.has(number(leg, 2), TRUNK)));
        assert!(!apart.has(number(0, 1), number(1, 1)));
    }
}
