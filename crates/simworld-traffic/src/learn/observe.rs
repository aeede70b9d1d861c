//! What an agent sees of its junction.

use simworld_core::seam::{Space, SpaceValue};

use super::JunctionState;

/// Says what an agent sees of its junction.
pub trait SignalObserver {
    /// The space of the observations of a junction; it depends on its lanes and stages alone.
    fn space(&self, junction: &JunctionState) -> Space;

    /// What is seen now.
    fn observe(&self, junction: &JunctionState) -> SpaceValue;
}

/// The observation of sumo-rl: the stage as one number of one and zeros, whether its shortest green is over, then the
/// density and then the queue of every lane that leads to the junction, each in [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DensityAndQueue;

impl SignalObserver for DensityAndQueue {
    fn space(&self, junction: &JunctionState) -> Space {
        let entries = junction.stages + 1 + 2 * junction.incoming.len();
        Space::bounded(0.0, 1.0, vec![entries])
    }

    fn observe(&self, junction: &JunctionState) -> SpaceValue {
        let flag = |is: bool| if is { 1.0 } else { 0.0 };
        let stages = (0..junction.stages).map(|stage| flag(stage == junction.stage));
        let densities = junction.incoming.iter().map(super::LaneState::density);
        let queues = junction.incoming.iter().map(super::LaneState::queue);
        let may_change = std::iter::once(flag(junction.may_change));
        SpaceValue::Box(stages.chain(may_change).chain(densities).chain(queues).collect())
    }
}
