//! Every class of vehicles does what vehicles of its kind are known to do.

use simworld_physics::VehicleClass;
use simworld_physics::proving::measure;

#[test]
fn every_class_keeps_its_bands() {
    let mut off = Vec::new();
    for class in VehicleClass::ALL {
        for figure in measure(*class).expect("sound data") {
            let mark = if figure.holds() { " " } else { "*" };
            println!(
                "{mark} {class:10} {:44} {:8.3} [{}, {}]",
                figure.name, figure.value, figure.low, figure.high
            );
            if !figure.holds() {
                off.push(format!("{class}: {} = {:.3}", figure.name, figure.value));
            }
        }
    }
    assert!(off.is_empty(), "{off:#?}");
}
