//! The report of a run on the terminal.

use comfy_table::presets::UTF8_HORIZONTAL_ONLY;
use comfy_table::{CellAlignment, Table};
use simworld_traffic::Traffic;
use simworld_traffic::look::{JunctionDelay, LevelOfService};

use super::Watched;

/// The figures of a run, as a table to read.
pub fn report(traffic: &Traffic, watched: &Watched) -> String {
    let mut table = Table::new();
    table.load_style(UTF8_HORIZONTAL_ONLY);
    for (name, value) in movement(watched).into_iter().chain(trips(watched)).chain(counts(traffic)) {
        table.add_row(vec![name, value]);
    }
    if let Some(column) = table.column_mut(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    format!("{table}\n{}", services(watched))
}

type Row = (String, String);

fn row(name: &str, value: impl Into<String>) -> Row {
    (name.to_owned(), value.into())
}

fn movement(watched: &Watched) -> Vec<Row> {
    let totals = watched.recorder.totals();
    vec![
        row("time watched", format!("{:.0} min", totals.seconds / 60.0)),
        row("distance driven", format!("{:.0} vehicle-km", totals.distance / 1000.0)),
        row("mean speed", format!("{:.1} km/h", totals.mean_speed() * 3.6)),
        row("delay", format!("{:.0} s/km", totals.delay_per_km())),
        row("stops", format!("{:.2} /km", totals.stops_per_km())),
    ]
}

fn trips(watched: &Watched) -> Vec<Row> {
    let mut delays: Vec<f64> = watched.trips.iter().map(simworld_traffic::Trip::delay).collect();
    if delays.is_empty() {
        return Vec::new();
    }
    delays.sort_by(f64::total_cmp);
    let share = |share: f64| delays[((delays.len() - 1) as f64 * share) as usize];
    let distance: f64 = watched.trips.iter().map(|trip| trip.distance).sum();
    vec![
        row("trips ended", delays.len().to_string()),
        row("mean length of a trip", format!("{:.2} km", distance / 1000.0 / delays.len() as f64)),
        row("delay of a trip, median", format!("{:.0} s", share(0.5))),
        row("delay of a trip, nine in ten below", format!("{:.0} s", share(0.9))),
    ]
}

fn counts(traffic: &Traffic) -> Vec<Row> {
    let counters = traffic.counters();
    let count = |name: &str, value: u64| row(name, value.to_string());
    vec![
        count("vehicles at the end", traffic.vehicles().count() as u64),
        count("waiting outside", traffic.outside() as u64),
        count(
            "pedestrians",
            traffic.pedestrians().iter().filter(|walker| walker.is_present()).count() as u64,
        ),
        count("junctions crossed", counters.crossings),
        count("lane changes", counters.lane_changes),
        count("vehicles that had stood for three minutes", counters.long_waits),
        count("steps at red, too late to stop", counters.dilemmas),
        count("stops by more than the brakes", counters.forced_stops),
        count("routes found anew", counters.rerouted),
    ]
}

/// How many junctions are in each class.
fn services(watched: &Watched) -> String {
    let used: Vec<LevelOfService> =
        watched.recorder.junctions().iter().filter(|j| j.vehicles >= 5).map(JunctionDelay::service).collect();
    let count = |class: LevelOfService| used.iter().filter(|own| **own == class).count();
    let classes: Vec<String> =
        LevelOfService::ALL.into_iter().map(|class| format!("{class} {}", count(class))).collect();
    format!("level of service of {} junctions: {}", used.len(), classes.join(", "))
}
