//! Whatever the block and the pattern: lots and greens are the block, to the square millimetre, none overlaps another,
//! every lot has a front to a street and an area within the bounds of its zone.

use proptest::prelude::*;
use simworld_citygen::block::{Block, Border};
use simworld_citygen::lot::{Land, LotConfig, LotStyle};
use simworld_citygen::occupancy;
use simworld_citygen::zoning::{Zoning, ZoningConfig};
use simworld_core::geometry::{Point2, direction};
use simworld_core::id::RoadId;
use simworld_core::net::Side;
use simworld_core::seed::Seed;

/// A star-shaped block of any number of corners, some of them turned in, not at the origin, some edges without streets.
fn blocks() -> impl Strategy<Value = Block> {
    let spokes = prop::collection::vec((25.0..140.0_f64, 0.2..1.0_f64, prop::bool::weighted(0.85)), 3..11);
    (spokes, -5000.0..5000.0_f64, -5000.0..5000.0_f64).prop_filter_map("not simple", |(spokes, x, y)| {
        let total: f64 = spokes.iter().map(|(_, angle, _)| angle).sum();
        let mut heading = 0.0;
        let mut corners = Vec::new();
        let mut borders = Vec::new();
        for (index, (length, angle, is_street)) in spokes.iter().enumerate() {
            heading += angle / total * std::f64::consts::TAU;
            corners.push(Point2::new(x, y) + direction(heading) * *length);
            let street = Border::street(RoadId::from_index(index), Side::Left);
            borders.push(if *is_street { street } else { Border::CORNER });
        }
        Block::closed(corners, borders)
    })
}

fn styles() -> impl Strategy<Value = LotStyle> {
    prop::sample::select(vec![LotStyle::ByZone, LotStyle::Offset, LotStyle::Skeleton, LotStyle::Recursive])
}

fn area(outline: &[Point2]) -> f64 {
    let origin = outline[0];
    outline.windows(2).map(|pair| (pair[0] - origin).perp(&(pair[1] - origin))).sum::<f64>() * 0.5
}

/// The outline moved inwards a little, so that neighbours that touch are told from neighbours that overlap.
fn shrunk(outline: &[Point2]) -> Vec<Point2> {
    let sum = outline.iter().fold(nalgebra::Vector2::zeros(), |sum, corner| sum + corner.coords);
    let middle = Point2::from(sum / outline.len() as f64);
    outline.iter().map(|corner| middle + (corner - middle) * (1.0 - 1e-6)).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if std::env::var_os("SIMWORLD_SOAK").is_some() { 20_000 } else { 300 }))]

    #[test]
    fn lots_and_greens_are_the_block(block in blocks(), style in styles(), seed in 0_u64..50) {
        let zoning = Zoning::new(&ZoningConfig { parks: 0.0, ..ZoningConfig::default() }, Seed(seed));
        let config = LotConfig { style, ..LotConfig::default() };
        let whole = block.area.expect("it is closed");
        let land = Land::of_block(block, &zoning, &config, Seed(seed));
        let lots = land.lots.iter().map(|lot| land.outline(lot));
        let greens = land.greens.iter().map(|green| land.green_outline(green));
        let parts: Vec<Vec<Point2>> = lots.chain(greens).map(<[Point2]>::to_vec).collect();
        let sum: f64 = parts.iter().map(|part| area(part)).sum();
        prop_assert!((sum - whole).abs() < 1e-6 * whole, "{sum} m² of {whole}");
        for (index, part) in parts.iter().enumerate() {
            // A park, or a block too small for lots, stays in one piece, which need not be convex: it is alone.
            for other in &parts[..index] {
                prop_assert!(!occupancy::overlap(&shrunk(part), &shrunk(other)), "{part:?} and {other:?} overlap");
            }
        }
        for lot in &land.lots {
            let size = config.size(lot.zone);
            prop_assert!((size.least_area..=size.most_area * (1.0 + 1e-9)).contains(&lot.area), "{} m²", lot.area);
            prop_assert!((lot.area - area(land.outline(lot))).abs() < 1e-6 * lot.area);
            let front = land.borders(lot)[0];
            prop_assert_eq!(front.as_street(), Some((lot.road, lot.side)));
            let outline = land.outline(lot);
            prop_assert!((outline[1] - outline[0]).norm() >= 4.0, "a front of {} m", (outline[1] - outline[0]).norm());
        }
    }
}

#[test]
fn a_block_of_streets_is_mostly_lots() {
    let corners = [(0.0, 0.0), (95.0, 4.0), (100.0, 90.0), (-4.0, 84.0)].map(|(x, y)| Point2::new(x, y));
    for (style, least) in [(LotStyle::Offset, 0.7), (LotStyle::Skeleton, 0.95), (LotStyle::Recursive, 0.7)] {
        let streets = (0..4).map(|road| Border::street(RoadId::from_index(road), Side::Left)).collect();
        let block = Block::closed(corners.to_vec(), streets).unwrap();
        let whole = block.area.unwrap();
        let zoning = Zoning::new(&ZoningConfig { parks: 0.0, ..ZoningConfig::default() }, Seed(3));
        let land = Land::of_block(block, &zoning, &LotConfig { style, ..LotConfig::default() }, Seed(3));
        let built: f64 = land.lots.iter().map(|lot| lot.area).sum();
        assert!(land.lots.len() >= 6, "{style:?} gives {} lots", land.lots.len());
        assert!(built > least * whole, "{style:?} leaves {:.0} of {whole:.0} m²", whole - built);
    }
}
