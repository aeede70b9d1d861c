//! Edits a city while it stands: a new avenue, a street that goes, a junction that moves, a museum and a bench. Prints what
//! each edit touched and how long it took against making the whole city anew, draws the map before and after, and takes
//! everything back.
//!
//! `cargo run --release --example edits -- --style mixed --roads 1000 --out edits`

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use clap::Parser;
use comfy_table::{Table, presets::UTF8_FULL_CONDENSED};
use simworld_citygen::block::Border;
use simworld_citygen::building::Building;
use simworld_citygen::edit::{CityEdit, CityEditor, CityPatch, NewStreet};
use simworld_citygen::element::Element;
use simworld_citygen::map::MapDrawing;
use simworld_citygen::{City, CityConfig, Style};
use simworld_core::geometry::Point2;
use simworld_core::id::{IntersectionId, RoadId};
use simworld_core::net::{CrossSection, RoadClass, polyline};
use simworld_core::scene::{EntityKind, Place, Shape};
use simworld_core::seed::Seed;

/// Edits a city, prints what each edit touched and how long it took, and draws the map before and after.
#[derive(Parser)]
struct Args {
    /// grid, mixed, organic or suburb
    #[arg(long, default_value_t = Style::Mixed)]
    style: Style,
    /// Number of streets, from 20 to 1 000 000
    #[arg(long, default_value_t = 1000, value_parser = clap::value_parser!(u32).range(20..=1_000_000))]
    roads: u32,
    /// Seed of the city
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// Folder for the maps
    #[arg(long, default_value = "edits")]
    out: PathBuf,
}

type Outcome<T> = Result<T, Box<dyn Error>>;

fn main() -> Outcome<()> {
    let args = Args::parse();
    simworld_examples::folder::make_folder(&args.out)?;
    let config = CityConfig { roads: args.style.roads(args.roads), ..CityConfig::default() };
    let (city, whole) = timed(|| City::generate(&config, Seed(args.seed)));
    let city = city?;
    println!(
        "a {} city of {} roads and {} buildings, made in {:.0} ms",
        args.style,
        city.network.roads.len(),
        city.buildings.len(),
        whole * 1e3
    );
    std::fs::write(args.out.join("before.svg"), city.svg())?;
    let mut editor = CityEditor::new(city.clone());
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header(["edit", "roads", "buildings", "elements", "took", "of the whole"]);
    let mut undos = Vec::new();
    let mut marks = Vec::new();
    for (name, wanted) in WORKS {
        let Some((at, undo, seconds)) = first_possible(&mut editor, *wanted) else {
            table.add_row([*name, "nowhere possible in this city"]);
            continue;
        };
        table.add_row([
            (*name).to_owned(),
            undo.network.roads.set.len().to_string(),
            undo.buildings.set.len().to_string(),
            undo.elements.set.len().to_string(),
            format!("{:.2} ms", seconds * 1e3),
            format!("1 / {:.0}", whole / seconds),
        ]);
        undos.push(undo);
        marks.push((*name, at));
    }
    println!(
        "{table}\nroads, buildings and elements: how many an edit changed, took away or gave another number"
    );
    let mut map = MapDrawing::of(editor.city());
    for (name, at) in &marks {
        map = map.marker(at, "#c0392b", name);
    }
    std::fs::write(args.out.join("after.svg"), map.to_string())?;
    for undo in undos.into_iter().rev() {
        editor.put(undo)?;
    }
    let same = editor.into_city() == city;
    println!(
        "all taken back: {}",
        if same { "the city is as it was, to the bit" } else { "the city differs" }
    );
    println!("{}, {}", args.out.join("before.svg").display(), args.out.join("after.svg").display());
    if same { Ok(()) } else { Err("an undo left something behind".into()) }
}

/// Edits of one kind, and where each is, from the middle of the city outwards.
type Work = fn(&City, Point2) -> Vec<(Point2, CityEdit)>;

const WORKS: &[(&str, Work)] = &[
    ("an avenue", avenue),
    ("a street less", street_less),
    ("a junction moved", junction_moved),
    ("a museum", museum),
    ("a bench", bench),
];

/// Carries out the first edit of a kind that the city allows.
fn first_possible(editor: &mut CityEditor, work: Work) -> Option<(Point2, CityPatch, f64)> {
    let (low, high) = editor.city().network.bounds()?;
    let mut edits = work(editor.city(), nalgebra::center(&low, &high));
    edits.truncate(200);
    edits.into_iter().find_map(|(at, edit)| {
        let (done, seconds) = timed(|| editor.apply(&edit));
        done.ok().map(|undo| (at, undo, seconds))
    })
}

/// Some things of a city, those nearest to a point first.
fn outwards(count: usize, from: Point2, at: impl Fn(usize) -> Point2) -> Vec<(usize, Point2)> {
    let mut all: Vec<(usize, Point2)> = (0..count).map(|index| (index, at(index))).collect();
    all.sort_by(|a, b| (a.1 - from).norm_squared().total_cmp(&(b.1 - from).norm_squared()));
    all
}

fn avenue(city: &City, middle: Point2) -> Vec<(Point2, CityEdit)> {
    let places = &city.network.intersections;
    let near = outwards(places.len(), middle, |index| places[index].center);
    let pairs = near.iter().take(40).flat_map(|(_, a)| near.iter().take(40).map(move |(_, b)| (*a, *b)));
    pairs
        .filter(|(a, b)| (b - a).norm() > 250.0)
        .map(|(a, b)| {
            let street = NewStreet {
                class: RoadClass::Arterial,
                section: CrossSection::two_way(2, 2),
                name: Some("New Avenue".to_owned()),
                ..NewStreet::local([a, b])
            };
            (nalgebra::center(&a, &b), CityEdit::AddStreet(street))
        })
        .collect()
}

fn street_less(city: &City, middle: Point2) -> Vec<(Point2, CityEdit)> {
    let roads = &city.network.roads;
    let at = |road: usize| {
        polyline::at(&roads[road].centerline, polyline::length(&roads[road].centerline) * 0.5).0
    };
    let near = outwards(roads.len(), middle, at);
    near.into_iter()
        .skip(30)
        .map(|(road, at)| (at, CityEdit::RemoveStreet(RoadId::from_index(road))))
        .collect()
}

fn junction_moved(city: &City, middle: Point2) -> Vec<(Point2, CityEdit)> {
    let places = &city.network.intersections;
    let near = outwards(places.len(), middle, |index| places[index].center);
    near.into_iter()
        .skip(25)
        .map(|(index, at)| {
            let to = at + simworld_core::geometry::Vector2::new(14.0, 9.0);
            (at, CityEdit::MoveIntersection { intersection: IntersectionId::from_index(index), to })
        })
        .collect()
}

/// A museum where it has room: most land of a city is taken, so small ones are tried beside every house.
fn museum(city: &City, middle: Point2) -> Vec<(Point2, CityEdit)> {
    let near = outwards(city.buildings.len(), middle, |index| city.buildings[index].center);
    near.into_iter()
        .map(|(index, at)| {
            let house = &city.buildings[index];
            let behind = at - simworld_core::geometry::direction(house.facing) * (house.depth * 0.5 + 9.0);
            let museum = Building {
                place: Place::Museum,
                name: Some("Museum of the New".to_owned()),
                center: behind,
                width: 12.0,
                depth: 10.0,
                footprint: simworld_citygen::building::Footprint::Rectangle,
                storeys: 2,
                ..house.clone()
            };
            (behind, CityEdit::AddBuilding(Box::new(museum)))
        })
        .collect()
}

fn bench(city: &City, middle: Point2) -> Vec<(Point2, CityEdit)> {
    let walks = &city.network.sidewalks;
    let at = |walk: usize| polyline::at(&walks[walk].path, polyline::length(&walks[walk].path) * 0.4).0;
    let near = outwards(walks.len(), middle, at);
    near.into_iter()
        .map(|(_, position)| {
            let shape = Shape::cuboid(0.6, 1.8, 0.85);
            let bench =
                Element { kind: EntityKind::Bench, position, facing: 0.0, shape, along: Border::LAND };
            (position, CityEdit::AddElement(bench))
        })
        .collect()
}

#[allow(clippy::disallowed_methods, reason = "times are for the report only")]
fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let done = work();
    (done, start.elapsed().as_secs_f64())
}
