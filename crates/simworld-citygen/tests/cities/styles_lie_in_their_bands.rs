//! Every style lies in its band of street statistics, which real places set.

use simworld_citygen::{StreetStatistics, Style, growth};
use simworld_core::seed::Seed;

/// Middle values over fifty seeds.
fn medians(style: Style) -> StreetStatistics {
    let all: Vec<StreetStatistics> =
        (0..50).map(|seed| StreetStatistics::of(&growth::grow(&style.roads(900), Seed(seed)))).collect();
    let median = |value: &dyn Fn(&StreetStatistics) -> f64| {
        let mut values: Vec<f64> = all.iter().map(value).collect();
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    StreetStatistics {
        streets: 0,
        components: all.iter().map(|s| s.components).fold(0, usize::max),
        junctions: 0,
        mean_degree: median(&|s| s.mean_degree),
        dead_ends: median(&|s| s.dead_ends),
        three_way: median(&|s| s.three_way),
        four_way: median(&|s| s.four_way),
        median_length: median(&|s| s.median_length),
        mean_length: median(&|s| s.mean_length),
        circuity: median(&|s| s.circuity),
        orientation_order: median(&|s| s.orientation_order),
        intersection_density: median(&|s| s.intersection_density),
        area: median(&|s| s.area),
    }
}

#[test]
fn every_style_lies_in_its_band() {
    let mut outside = Vec::new();
    for style in Style::ALL {
        let found = medians(style);
        assert_eq!(found.components, 1, "{style}: streets hang together");
        for (name, value, range, inside) in style.band().check(&found) {
            println!("{style:>8} {name:<22} {value:8.3} in {range:?} {inside}");
            if !inside {
                outside.push(format!("{style}: {name} = {value:.3} is not in {range:?}"));
            }
        }
    }
    assert!(outside.is_empty(), "{outside:#?}");
}
