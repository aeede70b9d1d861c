//! Traffic against the figures that engineers trust: the measures of `simworld_traffic::validation`, which hold their own bands and
//! sources. `--example validate` prints them all.

use simworld_traffic::validation::{Effort, Figure, MEASURES};

/// All figures of a measure; all settings with `SIMWORLD_SOAK=1`.
fn figures(name: &str) -> Vec<Figure> {
    let measure = MEASURES.iter().find(|measure| measure.name == name).expect("the measure is listed");
    let effort = if std::env::var("SIMWORLD_SOAK").is_ok() { Effort::Whole } else { Effort::Short };
    let figures = (measure.run)(effort).expect("its set-up is sound");
    assert!(!figures.is_empty(), "{name} has figures");
    figures
}

/// Every figure of a measure is in its band.
fn holds(name: &str) {
    let figures = figures(name);
    for figure in &figures {
        println!("{figure}");
    }
    let off: Vec<&Figure> = figures.iter().filter(|figure| !figure.is_ok()).collect();
    assert!(off.is_empty(), "off: {off:#?}");
}

#[test]
fn a_queue_discharges_as_the_manual_says() {
    holds("queue discharge");
}

#[test]
fn a_queue_of_another_model_discharges_as_that_model_does() {
    holds("queue discharge, other models");
}

#[test]
fn who_decides_late_makes_waves_grow_as_the_theory_says() {
    holds("late decisions");
}

#[test]
fn who_sees_badly_does_not_drive_steadily() {
    holds("errors of drivers");
}

#[test]
fn flow_on_a_ring_is_that_of_the_model() {
    holds("ring");
}

#[test]
fn followers_keep_the_equilibrium_gap() {
    holds("equilibrium gap");
}

#[test]
fn platoons_are_as_stable_as_the_theory_says() {
    holds("platoon");
}

#[test]
fn delay_at_a_fixed_signal_is_websters() {
    holds("fixed signal");
}

#[test]
fn no_cycle_is_much_better_than_websters() {
    holds("Webster's cycle");
}

#[test]
fn a_green_wave_carries_a_platoon() {
    holds("green wave");
}

#[test]
fn actuated_greens_end_as_they_should() {
    holds("actuated signal");
}

#[test]
fn who_enters_a_roundabout_finds_gaps() {
    holds("roundabout");
}

#[test]
fn who_gives_way_takes_the_gaps_of_the_manual() {
    holds("gap acceptance");
}

#[test]
fn policies_that_look_do_better_under_uneven_demand() {
    holds("uneven demand");
}

#[test]
fn turning_shares_are_the_weights() {
    holds("turning shares");
}
