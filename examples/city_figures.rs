//! How fast cities are made and how much memory they take: every stage beside its bar, linear growth, two threads
//! against one.
//!
//! ```sh
//! cargo run --release --example city_figures
//! ```

use std::io::{self, Write};
use std::time::Instant;

use clap::Parser;
use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, Table};
use simworld_citygen::building;
use simworld_citygen::element::{self, Setting};
use simworld_citygen::growth;
use simworld_citygen::lot::Land;
use simworld_citygen::occupancy::Occupancy;
use simworld_citygen::tile::{TileConfig, TileId, TileSource};
use simworld_citygen::zoning::Zoning;
use simworld_citygen::{AllThreads, City, CityConfig, Style};
use simworld_core::hash::{StateDigest, StateHasher};
use simworld_core::id::WaypointId;
use simworld_core::net::{
    HierarchyScratch, NetworkConfig, RoadNetwork, Route, RouteHierarchy, StreetPlan, WaypointConfig,
    WaypointGraph,
};
use simworld_core::seed::Seed;

/// Measures how fast cities are made, stage by stage, and prints each rate beside its bar.
#[derive(Parser)]
struct Arguments {
    /// Streets of the largest growth; stages are measured on a tenth of it.
    #[arg(long, default_value_t = 1_000_000)]
    streets: u32,
    /// Style of the streets: grid, mixed, organic or suburb.
    #[arg(long, default_value = "mixed")]
    style: Style,
}

type Outcome<T> = Result<T, Box<dyn std::error::Error + Send + Sync>>;

fn main() -> Outcome<()> {
    let arguments = Arguments::parse();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header(["what", "measured", "bar"]);
    // First, while nothing else has taken memory.
    whole(&arguments, &mut table)?;
    one.install(|| -> Outcome<()> {
        growths(&arguments, &mut table)?;
        stages(&arguments, &mut table)
    })?;
    threads(&arguments, &mut table)?;
    if let Some(column) = table.column_mut(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    println!("{table}");
    println!("Stages on one core; the whole city on all of them.");
    Ok(())
}

#[expect(clippy::disallowed_methods, reason = "measuring is what this example is for")]
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed().as_secs_f64())
}

/// The least time of some runs: what else the machine did is not the subject.
fn best<T>(runs: u32, mut work: impl FnMut() -> T) -> (T, f64) {
    let (mut result, mut least) = timed(&mut work);
    for _ in 1..runs {
        drop(result);
        let (again, time) = timed(&mut work);
        (result, least) = (again, least.min(time));
    }
    (result, least)
}

fn rate(count: usize, seconds: f64) -> String {
    let rate = count as f64 / seconds;
    if rate >= 1e6 { format!("{:.2} M/s", rate / 1e6) } else { format!("{:.0} k/s", rate / 1e3) }
}

/// The configuration of a city of that many streets.
fn config(arguments: &Arguments, streets: u32) -> CityConfig {
    CityConfig { roads: arguments.style.roads(streets.max(10)), ..CityConfig::default() }
}

fn growths(arguments: &Arguments, table: &mut Table) -> Outcome<()> {
    for share in [100, 10, 1] {
        let roads = config(arguments, arguments.streets / share).roads;
        roads.validate()?;
        let (plan, time) = best(if share == 1 { 1 } else { 3 }, || growth::grow(&roads, Seed(1)));
        let count = plan.streets.len();
        table.add_row([
            format!("growth of {count} segments"),
            rate(count, time),
            "1 M/s at 100 k".to_owned(),
        ]);
    }
    Ok(())
}

fn stages(arguments: &Arguments, table: &mut Table) -> Outcome<()> {
    let (config, seed) = (config(arguments, arguments.streets / 10), Seed(1));
    let plan = growth::grow(&config.roads, seed);
    let (network, time) = best(3, || RoadNetwork::derive(&plan, &NetworkConfig::default()));
    let network = network?;
    let roads = network.roads.len();
    table.add_row(["lanes, junctions, turns, crosswalks, roads", &rate(roads, time), "100 k/s"]);
    let zoning = Zoning::new(&config.zoning, seed);
    let (taken, land_time) = best(3, || Occupancy::of_roads(&network));
    let (land, time) = best(3, || Land::of_network(&network, &zoning, &config.lots, seed, &taken));
    table.add_row(["lots".to_owned(), rate(land.lots.len(), time + land_time), "-".to_owned()]);
    let mut full = taken.clone();
    let (built, time) = best(3, || {
        full = taken.clone();
        building::build(&network, &land, &config.buildings, seed, &mut full)
    });
    table.add_row(["buildings placed, no overlap", &rate(built.len(), time), "1 M/s"]);
    furnished(&config, (&plan, &network, &zoning, &land), &built, &full, table);
    tiles(table)?;
    routes(arguments, table)
}

fn furnished(
    config: &CityConfig,
    (plan, network, zoning, land): (&StreetPlan, &RoadNetwork, &Zoning, &Land),
    buildings: &[building::Building],
    full: &Occupancy,
    table: &mut Table,
) {
    let setting = Setting { plan, network, zoning, land, buildings, within: None };
    let (elements, time) =
        best(3, || element::furnish(&setting, &config.elements, Seed(1), &mut full.clone()));
    table.add_row(["street elements", &rate(elements.len(), time), "3 M/s"]);
}

/// Routes over a town of about 100 000 waypoints.
fn routes(arguments: &Arguments, table: &mut Table) -> Outcome<()> {
    let plan = growth::grow(&arguments.style.roads(3800), Seed(1));
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default())?;
    let graph = WaypointGraph::walkable(&network, &WaypointConfig::default())?;
    let count = graph.waypoints().len();
    let (hierarchy, time) = timed(|| RouteHierarchy::new(graph));
    table.add_row([format!("{count} waypoints prepared"), format!("{time:.1} s"), "-".to_owned()]);
    let (mut scratch, mut route) = (HierarchyScratch::default(), Route::default());
    let mut rng = Seed(3).stream("figures/routes").rng();
    let mut times: Vec<f64> = (0..5000)
        .map(|_| {
            let (from, to) =
                (WaypointId::from_index(rng.below(count)), WaypointId::from_index(rng.below(count)));
            timed(|| hierarchy.route(from, to, &mut scratch, &mut route)).1
        })
        .collect();
    times.sort_by(f64::total_cmp);
    let median = format!("{:.1} µs", times[times.len() / 2] * 1e6);
    table.add_row(["a shortest route over them, median".to_owned(), median, "20 µs".to_owned()]);
    Ok(())
}

/// A complete tile of a city without end.
fn tiles(table: &mut Table) -> Outcome<()> {
    let source = TileSource::new(TileConfig::default(), Seed(4))?;
    let side = source.config().lattice.tile_side() / 1000.0;
    let ids: Vec<TileId> = (0..20).map(|index| TileId::new(index * 7, index * 3)).collect();
    let (made, time) = best(2, || source.tiles(&ids));
    made?;
    let each = format!("{:.1} ms", time / ids.len() as f64 * 1e3);
    table.add_row([format!("a tile of {:.2} km², complete", side * side), each, "5 ms".to_owned()]);
    Ok(())
}

/// What takes bytes and keeps a hash of them.
struct Fingerprint(StateHasher);

impl Write for Fingerprint {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.bytes(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// The hash of all that would be saved of a city: two cities are compared, and only one is held.
fn fingerprint(city: &City) -> Outcome<StateDigest> {
    let mut print = Fingerprint(StateHasher::new());
    city.write_to(&mut print)?;
    Ok(print.0.finish())
}

/// Times of the stages of a city, s.
fn staged(config: &CityConfig, seed: Seed) -> Outcome<[(&'static str, f64); 5]> {
    let (plan, growing) = timed(|| growth::grow(&config.roads, seed));
    let (network, deriving) = timed(|| RoadNetwork::derive_with(&plan, &config.network, &AllThreads));
    let network = network?;
    let zoning = Zoning::new(&config.zoning, seed);
    let ((land, mut taken), dividing) = timed(|| Land::beside_roads(&network, &zoning, &config.lots, seed));
    let (built, building) = timed(|| building::build(&network, &land, &config.buildings, seed, &mut taken));
    let setting = Setting {
        plan: &plan,
        network: &network,
        zoning: &zoning,
        land: &land,
        buildings: &built,
        within: None,
    };
    let (_, furnishing) = timed(|| element::furnish(&setting, &config.elements, seed, &mut taken));
    Ok([
        ("streets grown", growing),
        ("roads derived", deriving),
        ("land of roads, and lots", dividing),
        ("buildings", building),
        ("elements", furnishing),
    ])
}

/// A whole city on two threads against one, and each of its stages. Its streets are grown, which is serial by nature.
fn threads(arguments: &Arguments, table: &mut Table) -> Outcome<()> {
    let config = config(arguments, arguments.streets / 20);
    let (mut prints, mut times, mut stages, mut buildings) = (Vec::new(), Vec::new(), Vec::new(), 0);
    for count in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build()?;
        let (city, time) = best(2, || pool.install(|| City::generate(&config, Seed(2))));
        let city = city?;
        buildings = city.buildings.len();
        prints.push(fingerprint(&city)?);
        drop(city);
        times.push(time);
        stages.push(pool.install(|| staged(&config, Seed(2)))?);
    }
    let same = if prints[0] == prints[1] { "the same bits" } else { "OTHER BITS" };
    table.add_row([
        format!("grown city of {buildings} buildings on two threads, {same}"),
        format!("{:.2} times as fast", times[0] / times[1]),
        "1.7".to_owned(),
    ]);
    for ((stage, one), (_, two)) in stages[0].iter().zip(&stages[1]) {
        let measured = format!("{:.0} ms, {:.2} times as fast", one * 1e3, one / two);
        table.add_row([format!("  of it {stage}"), measured, "-".to_owned()]);
    }
    Ok(())
}

/// The most memory that this process has had, where the system tells.
fn peak_memory() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let kilobytes = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = kilobytes.trim().trim_end_matches(" kB").parse().ok()?;
    Some(format!("{:.2} GB", kilobytes * 1024.0 / 1e9))
}

fn add_peak(table: &mut Table) {
    let measured = peak_memory().unwrap_or_else(|| "unknown".to_owned());
    table.add_row(["  most memory so far".to_owned(), measured, "2 GB".to_owned()]);
}

/// A city of about a million buildings: made, saved, loaded; one at a time.
fn whole(arguments: &Arguments, table: &mut Table) -> Outcome<()> {
    let config = config(arguments, arguments.streets / 7);
    let (city, time) = timed(|| City::generate(&config, Seed(3)));
    let city = city?;
    let buildings = city.buildings.len();
    table.add_row([format!("city of {buildings} buildings"), format!("{time:.1} s"), "10 s".to_owned()]);
    add_peak(table);
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("whole.simcity");
    let (saved, time) = timed(|| city.save(&path));
    saved?;
    let megabytes = std::fs::metadata(&path)?.len() / 1_000_000;
    table.add_row([format!("saved, {megabytes} MB"), format!("{time:.1} s"), "4 s".to_owned()]);
    add_peak(table);
    let expected = fingerprint(&city)?;
    drop(city);
    let (loaded, time) = timed(|| City::load(&path));
    let same = if fingerprint(&loaded?)? == expected { "the same city" } else { "ANOTHER CITY" };
    table.add_row([format!("loaded, {same}"), format!("{time:.1} s"), "2 s".to_owned()]);
    add_peak(table);
    Ok(())
}
