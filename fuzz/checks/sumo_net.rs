//! SUMO networks: any bytes are refused or give a network that holds together.

use simworld_traffic::sumo::SumoNet;

pub(crate) fn check(data: &[u8]) {
    if let Ok(read) = SumoNet::read(data) {
        assert_eq!(read.network.check(), Ok(()));
    }
}
