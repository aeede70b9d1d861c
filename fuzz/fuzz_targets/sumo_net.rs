//! SUMO networks: any bytes are refused or give a network that holds together.

#![no_main]

use libfuzzer_sys::fuzz_target;
use simworld_traffic::sumo::SumoNet;

fuzz_target!(|data: &[u8]| {
    if let Ok(read) = SumoNet::read(data) {
        assert_eq!(read.network.check(), Ok(()));
    }
});
