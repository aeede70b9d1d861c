//! How fast cities are made and how much memory they take: every stage beside its bar, linear growth, two threads
//! against one. Each group of rows is measured in a process of its own, as a program has it that makes one city: memory that
//! another one left in pieces is not the subject.
//!
//! ```sh
//! cargo run --release --example city_figures
//! ```

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Instant;

use clap::{Parser, ValueEnum};
use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, Table};
use simworld_citygen::block::Block;
use simworld_citygen::building;
use simworld_citygen::edit::{CityEdit, CityEditor};
use simworld_citygen::element::{self, Setting};
use simworld_citygen::growth;
use simworld_citygen::lot::Land;
use simworld_citygen::occupancy::Occupancy;
use simworld_citygen::osm::{Fill, Place, PlaceOptions, StreetOptions};
use simworld_citygen::tile::{TileConfig, TileId, TileSource};
use simworld_citygen::zoning::Zoning;
use simworld_citygen::{AllThreads, City, CityConfig, Style};
use simworld_core::hash::{StateDigest, StateHasher};
use simworld_core::id::{RoadId, WaypointId};
use simworld_core::net::{
    HierarchyScratch, NetworkConfig, RoadNetwork, Route, RouteHierarchy, StreetPlan, WaypointConfig,
    WaypointGraph,
};
use simworld_core::seed::Seed;
use simworld_examples::city::as_extract;

/// Measures how fast cities are made, stage by stage, and prints each rate beside its bar.
#[derive(Parser)]
struct Arguments {
    /// Streets of the largest growth; stages are measured on a tenth of it.
    #[arg(long, default_value_t = 1_000_000)]
    streets: u32,
    /// Style of the streets: grid, mixed, organic or suburb.
    #[arg(long, default_value = "mixed")]
    style: Style,
    /// OSM XML, not compressed, of the real place; without it, a grown town is written as such.
    #[arg(long)]
    osm: Option<PathBuf>,
    /// One group of rows alone.
    #[arg(long, value_enum)]
    only: Option<Group>,
    /// Rows as fields between tabs, without a table.
    #[arg(long, hide = true)]
    fields: bool,
}

/// So many streets of a kind are taken away, one after the other.
const EDITS: usize = 25;

/// Rows that are measured in one process.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Group {
    /// A city of a million buildings: made, saved, loaded.
    Whole,
    /// Streets by growth, three sizes.
    Growth,
    /// Every stage on one core, and routes.
    Stages,
    /// Tiles of a city without end.
    Tiles,
    /// A real place: OSM XML to the finished city, on one core.
    Place,
    /// Two threads against one.
    Threads,
    /// Streets taken out of a city and put back, on one core.
    Edits,
}

/// What was measured, each beside its bar.
#[derive(Default)]
struct Rows(Vec<[String; 3]>);

impl Rows {
    fn add_row(&mut self, row: [impl Into<String>; 3]) {
        self.0.push(row.map(Into::into));
    }

    fn table(&self) -> Table {
        let mut table = Table::new();
        table.load_style(UTF8_FULL_CONDENSED);
        table.set_header(["what", "measured", "bar"]);
        table.add_rows(&self.0);
        if let Some(column) = table.column_mut(1) {
            column.set_cell_alignment(CellAlignment::Right);
        }
        table
    }
}

type Outcome<T> = Result<T, Box<dyn std::error::Error + Send + Sync>>;

fn main() -> Outcome<()> {
    let arguments = Arguments::parse();
    let mut rows = Rows::default();
    if let Some(group) = arguments.only {
        measure(group, &arguments, &mut rows)?;
    } else {
        for group in Group::value_variants() {
            in_own_process(*group, &arguments, &mut rows)?;
        }
    }
    if arguments.fields {
        rows.0.iter().for_each(|row| println!("{}", row.join("\t")));
    } else {
        println!("{}", rows.table());
        println!("Stages on one core; the whole city on all of them.");
    }
    Ok(())
}

fn measure(group: Group, arguments: &Arguments, rows: &mut Rows) -> Outcome<()> {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    match group {
        Group::Whole => whole(arguments, rows),
        Group::Growth => one.install(|| growths(arguments, rows)),
        Group::Stages => one.install(|| stages(arguments, rows)),
        Group::Tiles => one.install(|| tiles(rows)),
        Group::Place => one.install(|| place(arguments, rows)),
        Group::Threads => threads(arguments, rows),
        Group::Edits => one.install(|| edits(arguments, rows)),
    }
}

/// Has another process of this program measure a group.
fn in_own_process(group: Group, arguments: &Arguments, rows: &mut Rows) -> Outcome<()> {
    let name = group.to_possible_value().map(|value| value.get_name().to_owned()).unwrap_or_default();
    eprintln!("measuring: {name}");
    let mut command = Command::new(std::env::current_exe()?);
    command
        .args(["--fields", "--only", &name, "--streets", &arguments.streets.to_string()])
        .args(["--style", &arguments.style.to_string()]);
    if let Some(path) = &arguments.osm {
        command.arg("--osm").arg(path);
    }
    let output = command.stderr(Stdio::inherit()).output()?;
    if !output.status.success() {
        return Err(format!("the rows of {name} were not measured: {}", output.status).into());
    }
    for line in String::from_utf8(output.stdout)?.lines() {
        let fields: Vec<&str> = line.split('\t').collect();
        let row = <[&str; 3]>::try_from(fields).map_err(|_| format!("no row of {name}: {line}"))?;
        rows.add_row(row);
    }
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

fn growths(arguments: &Arguments, rows: &mut Rows) -> Outcome<()> {
    for share in [100, 10, 1] {
        let roads = config(arguments, arguments.streets / share).roads;
        roads.validate()?;
        let (plan, time) = best(if share == 1 { 1 } else { 3 }, || growth::grow(&roads, Seed(1)));
        let count = plan.streets.len();
        rows.add_row([format!("growth of {count} segments"), rate(count, time), "1 M/s at 100 k".to_owned()]);
    }
    Ok(())
}

fn stages(arguments: &Arguments, rows: &mut Rows) -> Outcome<()> {
    let (config, seed) = (config(arguments, arguments.streets / 10), Seed(1));
    let plan = growth::grow(&config.roads, seed);
    let (network, time) = best(3, || RoadNetwork::derive(&plan, &NetworkConfig::default()));
    let network = network?;
    let roads = network.roads.len();
    rows.add_row(["lanes, junctions, turns, crosswalks, roads", &rate(roads, time), "100 k/s"]);
    let zoning = Zoning::new(&config.zoning, seed);
    let (taken, land_time) = best(3, || Occupancy::of_roads(&network));
    let (land, time) = best(3, || Land::of_network(&network, &zoning, &config.lots, seed, &taken));
    rows.add_row(["lots".to_owned(), rate(land.lots.len(), time + land_time), "-".to_owned()]);
    // Copies are no part of building.
    let mut copies = vec![taken.clone(); 3];
    let mut full = taken;
    let (built, time) = best(3, || {
        full = copies.pop().unwrap_or_default();
        building::build(&network, &land, &config.buildings, seed, &mut full)
    });
    rows.add_row(["buildings placed, no overlap", &rate(built.len(), time), "1 M/s"]);
    furnished(&config, (&plan, &network, &zoning, &land), &built, &full, rows);
    routes(arguments, rows)
}

fn furnished(
    config: &CityConfig,
    (plan, network, zoning, land): (&StreetPlan, &RoadNetwork, &Zoning, &Land),
    buildings: &[building::Building],
    full: &Occupancy,
    rows: &mut Rows,
) {
    let setting = Setting { plan, network, zoning, land, buildings, within: None };
    let (elements, time) =
        best(3, || element::furnish(&setting, &config.elements, Seed(1), &mut full.clone()));
    rows.add_row(["street elements", &rate(elements.len(), time), "3 M/s"]);
}

/// Routes over a town of about 100 000 waypoints.
fn routes(arguments: &Arguments, rows: &mut Rows) -> Outcome<()> {
    let plan = growth::grow(&arguments.style.roads(3800), Seed(1));
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default())?;
    let graph = WaypointGraph::walkable(&network, &WaypointConfig::default())?;
    let count = graph.waypoints().len();
    let (hierarchy, time) = timed(|| RouteHierarchy::new(graph));
    rows.add_row([format!("{count} waypoints prepared"), format!("{time:.1} s"), "-".to_owned()]);
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
    rows.add_row(["a shortest route over them, median".to_owned(), median, "20 µs".to_owned()]);
    Ok(())
}

/// A complete tile of a city without end.
fn tiles(rows: &mut Rows) -> Outcome<()> {
    let source = TileSource::new(TileConfig::default(), Seed(4))?;
    let side = source.config().lattice.tile_side() / 1000.0;
    let ids: Vec<TileId> = (0..20).map(|index| TileId::new(index * 7, index * 3)).collect();
    let (made, time) = best(3, || source.tiles(&ids));
    made?;
    let each = format!("{:.1} ms", time / ids.len() as f64 * 1e3);
    rows.add_row([format!("a tile of {:.2} km², complete", side * side), each, "5 ms".to_owned()]);
    Ok(())
}

/// Streets that are taken out of cities of two sizes and put back: within them, and at the open land around them.
fn edits(arguments: &Arguments, rows: &mut Rows) -> Outcome<()> {
    for streets in [arguments.streets / 1000, arguments.streets / 33] {
        let city = City::generate(&config(arguments, streets), Seed(3))?;
        let roads = city.network.roads.len();
        let open: BTreeSet<usize> = Block::of_network(&city.network)
            .iter()
            .filter(|block| block.area.is_none())
            .flat_map(|block| block.borders.iter().filter_map(|border| border.as_street()))
            .map(|(road, _)| road.index())
            .collect();
        let mut editor = CityEditor::new(city);
        for (is_open, place) in [(false, "within"), (true, "at the edge of")] {
            let like_it =
                (0..roads).map(|step| step * 7919 % roads).filter(|road| open.contains(road) == is_open);
            let mut times = Vec::new();
            for road in like_it.take(EDITS) {
                let remove = CityEdit::RemoveStreet(RoadId::from_index(road));
                let (undo, time) = timed(|| editor.apply(&remove));
                // Some would leave a piece of a street too short to be one.
                if let Ok(undo) = undo {
                    times.push(time);
                    editor.put(undo)?;
                }
            }
            times.sort_by(f64::total_cmp);
            let median = times.get(times.len() / 2).map_or(f64::NAN, |time| time * 1e3);
            let what = format!("a street {place} {roads} taken away, median of {}", times.len());
            rows.add_row([what, format!("{median:.1} ms"), "-".to_owned()]);
        }
    }
    Ok(())
}

/// A real place from its XML, with nothing but what its map has, and with the rest generated.
fn place(arguments: &Arguments, rows: &mut Rows) -> Outcome<()> {
    let text = match &arguments.osm {
        Some(path) => fs::read_to_string(path)
            .map_err(|error| format!("{}: {error}; it has to be OSM XML, not compressed", path.display()))?,
        None => as_extract(&City::generate(&config(arguments, arguments.streets / 100), Seed(6))?),
    };
    let megabytes = text.len() as f64 / 1e6;
    let (read, time) = best(5, || Place::from_xml(text.as_bytes()));
    let read = read?;
    let rate_of = format!("{:.0} MB/s", megabytes / time);
    rows.add_row([format!("{megabytes:.0} MB of OSM XML read"), rate_of, "100 MB/s".to_owned()]);
    let (planned, time) =
        best(5, || RoadNetwork::derive(&read.plan(&StreetOptions::default()).0, &NetworkConfig::default()));
    let roads = planned?.roads.len();
    rows.add_row([format!("  its {roads} roads, with lanes"), rate(roads, time), "-".to_owned()]);
    for (fill, what, bar) in
        [(Fill::Never, "as the map has it", "50 k roads/s"), (Fill::WhereMissing, "the rest generated", "-")]
    {
        let options = PlaceOptions { buildings: fill, elements: fill, ..PlaceOptions::default() };
        let (city, time) = best(5, || {
            let place = Place::from_xml(text.as_bytes())?;
            Outcome::Ok(City::from_place(&place, &options, &CityConfig::default(), Seed(1))?.0)
        });
        let city = city?;
        let (roads, buildings) = (city.network.roads.len(), city.buildings.len());
        let what = format!("OSM XML to the finished city, {what}: {roads} roads, {buildings} buildings");
        rows.add_row([what, rate(roads, time), bar.to_owned()]);
    }
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
fn threads(arguments: &Arguments, rows: &mut Rows) -> Outcome<()> {
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
    rows.add_row([
        format!("grown city of {buildings} buildings on two threads, {same}"),
        format!("{:.2} times as fast", times[0] / times[1]),
        "1.7".to_owned(),
    ]);
    for ((stage, one), (_, two)) in stages[0].iter().zip(&stages[1]) {
        let measured = format!("{:.0} ms, {:.2} times as fast", one * 1e3, one / two);
        rows.add_row([format!("  of it {stage}"), measured, "-".to_owned()]);
    }
    Ok(())
}

/// The most memory that this process has had, where the system tells.
fn peak_memory() -> Option<String> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let kilobytes = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = kilobytes.trim().trim_end_matches(" kB").parse().ok()?;
    Some(format!("{:.2} GB", kilobytes * 1024.0 / 1e9))
}

fn add_peak(rows: &mut Rows) {
    let measured = peak_memory().unwrap_or_else(|| "unknown".to_owned());
    rows.add_row(["  most memory so far".to_owned(), measured, "2 GB".to_owned()]);
}

/// A city of about a million buildings: made, saved, loaded; one at a time.
fn whole(arguments: &Arguments, rows: &mut Rows) -> Outcome<()> {
    let config = config(arguments, arguments.streets / 7);
    let (city, time) = timed(|| City::generate(&config, Seed(3)));
    let city = city?;
    let buildings = city.buildings.len();
    rows.add_row([format!("city of {buildings} buildings"), format!("{time:.1} s"), "10 s".to_owned()]);
    add_peak(rows);
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("whole.simcity");
    let (saved, time) = timed(|| city.save(&path));
    saved?;
    let megabytes = fs::metadata(&path)?.len() / 1_000_000;
    rows.add_row([format!("saved, {megabytes} MB"), format!("{time:.1} s"), "4 s".to_owned()]);
    add_peak(rows);
    let expected = fingerprint(&city)?;
    drop(city);
    let (loaded, time) = timed(|| City::load(&path));
    let same = if fingerprint(&loaded?)? == expected { "the same city" } else { "ANOTHER CITY" };
    rows.add_row([format!("loaded, {same}"), format!("{time:.1} s"), "2 s".to_owned()]);
    add_peak(rows);
    Ok(())
}
