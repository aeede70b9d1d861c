//! SUMO demand: any bytes are refused, or can be planned on a network or refused there.

use std::sync::LazyLock;

use simworld_core::seed::Seed;
use simworld_traffic::sumo::{SumoDemand, SumoNet};

static NET: LazyLock<SumoNet> = LazyLock::new(|| {
    let grid = include_bytes!("../../crates/simworld-traffic/tests/sumo/data/grid.net.xml");
    SumoNet::read(grid.as_slice()).expect("netgenerate wrote it")
});

pub(crate) fn check(data: &[u8]) {
    if let Ok(demand) = SumoDemand::read(data) {
        let _planned_or_refused = demand.schedule(&NET, Seed(1));
    }
}
