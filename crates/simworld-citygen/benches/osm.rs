//! Real places: reading OSM XML, and from what was read to streets and to the finished city.
//!
//! The extract is drawn here: a grid of named streets with houses, written as Overpass writes it. With `SIMWORLD_DATA`
//! naming a folder of extracts, those in it are measured too.

use std::fmt::Write;
use std::hint::black_box;
use std::io::Read;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use simworld_citygen::osm::{Place, PlaceOptions, StreetOptions};
use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

/// Junctions along each side of the grid.
const SIDE: i64 = 100;

/// A town as OSM XML, with the attributes that such files carry.
fn town() -> String {
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<osm version=\"0.6\">\n");
    let node = |text: &mut String, id: i64, x: f64, y: f64| {
        let (longitude, latitude) = (8.0 + x / 71_695.8, 50.0 + y / 111_229.0);
        writeln!(
            text,
            "  <node id=\"{id}\" lat=\"{latitude:.7}\" lon=\"{longitude:.7}\" version=\"3\" timestamp=\"2024-03-22T14:09:45Z\" changeset=\"11480240\" uid=\"378737\" user=\"somebody\"/>"
        )
        .expect("a string takes all");
    };
    for row in 0..SIDE {
        for column in 0..SIDE {
            let (x, y) = (column as f64 * 90.0, row as f64 * 80.0);
            node(&mut text, row * SIDE + column + 1, x, y);
            for (corner, (dx, dy)) in
                [(25.0, 25.0), (37.0, 25.0), (37.0, 36.0), (25.0, 36.0)].into_iter().enumerate()
            {
                node(&mut text, 1_000_000 + (row * SIDE + column) * 4 + corner as i64, x + dx, y + dy);
            }
        }
    }
    let way = |text: &mut String, id: i64, nodes: &[i64], tags: &str| {
        let mut references = String::new();
        for node in nodes {
            writeln!(references, "    <nd ref=\"{node}\"/>").expect("a string takes all");
        }
        writeln!(text, "  <way id=\"{id}\" version=\"2\" changeset=\"1\">\n{references}{tags}  </way>")
            .expect("a string takes all");
    };
    let street = "    <tag k=\"highway\" v=\"residential\"/>\n    <tag k=\"name\" v=\"Elm Street\"/>\n    <tag k=\"surface\" v=\"asphalt\"/>\n";
    for line in 0..SIDE {
        let along: Vec<i64> = (0..SIDE).map(|column| line * SIDE + column + 1).collect();
        let across: Vec<i64> = (0..SIDE).map(|row| row * SIDE + line + 1).collect();
        way(&mut text, line + 1, &along, street);
        way(&mut text, SIDE + line + 1, &across, street);
    }
    for house in 0..SIDE * SIDE {
        let first = 1_000_000 + house * 4;
        let tags = "    <tag k=\"building\" v=\"house\"/>\n    <tag k=\"building:levels\" v=\"2\"/>\n";
        way(&mut text, 10_000 + house, &[first, first + 1, first + 2, first + 3, first], tags);
    }
    text + "</osm>\n"
}

fn measure(criterion: &mut Criterion, name: &str, text: &[u8]) {
    let mut group = criterion.benchmark_group(format!("osm/{name}"));
    group.sample_size(20);
    group.throughput(Throughput::Bytes(text.len() as u64));
    group.bench_function("read XML", |bencher| {
        bencher.iter(|| Place::from_xml(black_box(text)).expect("an extract"));
    });
    let place = Place::from_xml(text).expect("an extract");
    let roads = place.plan(&StreetOptions::default()).0.streets.len();
    group.throughput(Throughput::Elements(roads as u64));
    group.bench_function("streets", |bencher| bencher.iter(|| place.plan(&StreetOptions::default())));
    group.bench_function("city", |bencher| {
        let (options, config) = (PlaceOptions::default(), CityConfig::default());
        bencher.iter(|| City::from_place(&place, &options, &config, Seed(1)).expect("a city"));
    });
    group.finish();
}

fn bench(criterion: &mut Criterion) {
    measure(criterion, "town of 10 000 houses", town().as_bytes());
    let Some(folder) = std::env::var_os("SIMWORLD_DATA") else { return };
    for name in ["monaco", "campo-grande"] {
        let path = std::path::Path::new(&folder).join(format!("{name}.osm.gz"));
        let Ok(file) = std::fs::File::open(path) else { continue };
        let mut text = Vec::new();
        flate2::read::MultiGzDecoder::new(file).read_to_end(&mut text).expect("an extract is whole");
        measure(criterion, name, &text);
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
