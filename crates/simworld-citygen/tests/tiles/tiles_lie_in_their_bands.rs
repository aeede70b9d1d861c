//! Tiles of every style lie in its band of street statistics, but for what is named here.

use simworld_citygen::tile::{TileConfig, TileId, TileSource};
use simworld_citygen::{StreetStatistics, Style};
use simworld_core::seed::Seed;

/// What is known to lie outside, and how far at most: the middle value over windows of 4 km².
const OUTSIDE: [(Style, &str, std::ops::RangeInclusive<f64>); 2] =
    [(Style::Grid, "four-way", 0.32..=0.35), (Style::Suburb, "circuity", 1.05..=1.08)];

/// Every statistic with its middle value over some windows.
fn medians(style: Style) -> Vec<(&'static str, f64, bool)> {
    let windows: Vec<StreetStatistics> = (0..24)
        .map(|seed| {
            let source = TileSource::new(TileConfig::of_style(style), Seed(seed)).expect("styles are valid");
            let window = source.window(TileId::new(0, 0), TileId::new(1, 1)).expect("it is near");
            StreetStatistics::of(&window.plan())
        })
        .collect();
    let band = style.band();
    (0..8)
        .map(|rank| {
            let mut rows: Vec<_> = windows.iter().map(|window| band.check(window)[rank].clone()).collect();
            rows.sort_by(|a, b| a.1.total_cmp(&b.1));
            let (name, value, range, _) = rows[rows.len() / 2].clone();
            (name, value, range.contains(&value))
        })
        .collect()
}

#[test]
fn tiles_of_every_style_lie_in_its_band() {
    let mut faults = Vec::new();
    for style in Style::ALL {
        for (name, value, is_inside) in medians(style) {
            println!("{style:>8} {name:<22} {value:8.3} {is_inside}");
            let known = OUTSIDE.iter().find(|(known, what, _)| *known == style && *what == name);
            if !is_inside && !known.is_some_and(|(_, _, range)| range.contains(&value)) {
                faults.push(format!("{style}: {name} = {value:.3}"));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}
