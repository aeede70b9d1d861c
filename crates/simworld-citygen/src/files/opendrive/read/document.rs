//! From XML to roads: what is kept of each `road` and `junction`.

use std::collections::BTreeSet;

use roxmltree::{Document, Node};
use simworld_core::geometry::Point2;
use simworld_core::net::{CrossSection, RoadClass};

use super::error::{OpenDriveError, OpenDriveWarning};
use super::heights::{Elevation, Heights};
use super::lanes::{LaneKey, Lanes, Leads};
use super::{curve, parts};
use crate::GeoOrigin;

/// Speeds that mean something, m/s.
const SPEEDS: (f64, f64) = (1.0, 70.0);

/// What an end of a road is linked to.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Link {
    Junction(String),
    /// A road, and whether its end (or else its beginning).
    Road(String, bool),
    /// Another part of the same road, before or after it in the order of the file.
    Part,
}

/// A road as it was read, or the part of one that has the same lanes all along.
#[derive(Clone, Debug)]
pub(super) struct Road {
    pub(super) id: String,
    pub(super) name: String,
    /// The junction that it is a part of.
    pub(super) junction: Option<String>,
    /// At its beginning and end.
    pub(super) links: [Option<Link>; 2],
    pub(super) line: Vec<Point2>,
    /// Heights along it, its beginning and its end among them, m.
    pub(super) heights: Heights,
    pub(super) section: CrossSection,
    /// The lane of each strip of the cross-section, at its beginning and end.
    pub(super) lanes: [Vec<LaneKey>; 2],
    pub(super) class: RoadClass,
    pub(super) speed: Option<f64>,
}

/// All that is kept of a file.
#[derive(Clone, Debug, Default)]
pub(super) struct Roads {
    /// Those that are driven on, in the order of the file; the parts of one follow each other.
    pub(super) all: Vec<Road>,
    /// Which lane leads to which.
    pub(super) leads: Leads,
    /// The junctions with signals.
    pub(super) signalised: BTreeSet<String>,
    /// Whether traffic keeps left.
    pub(super) keeps_left: bool,
    pub(super) origin: Option<GeoOrigin>,
}

/// An attribute that is a finite number.
pub(super) fn number(node: Node<'_, '_>, name: &str) -> Option<f64> {
    node.attribute(name)?.trim().parse::<f64>().ok().filter(|number| number.is_finite())
}

/// The value at a place of the last cubic that begins before it, each in `a` to `d` from its own beginning.
pub(super) fn polynomial<'a>(
    records: impl Iterator<Item = Node<'a, 'a>>,
    start: &str,
    at: f64,
) -> Option<f64> {
    let mut value = None;
    for record in records {
        let from = number(record, start).unwrap_or(0.0);
        if value.is_some() && from > at {
            break;
        }
        let [a, b, c, d] = ["a", "b", "c", "d"].map(|name| number(record, name).unwrap_or(0.0));
        let x = (at - from).max(0.0);
        value = Some(a + x * (b + x * (c + x * d)));
    }
    value.filter(|value: &f64| value.is_finite())
}

pub(super) fn child<'a>(node: Node<'a, 'a>, name: &str) -> Option<Node<'a, 'a>> {
    node.children().find(|child| child.has_tag_name(name))
}

/// Reads a document.
pub(super) fn read(text: &str, warnings: &mut Vec<OpenDriveWarning>) -> Result<Roads, OpenDriveError> {
    let document = Document::parse(text)?;
    let root = document.root_element();
    if !root.has_tag_name("OpenDRIVE") {
        return Err(OpenDriveError::Foreign { found: root.tag_name().name().to_owned() });
    }
    let of = |name: &'static str| root.children().filter(move |child| child.has_tag_name(name));
    let keeps_left = |road: &Node<'_, '_>| road.attribute("rule") == Some("LHT");
    let reference = child(root, "header").and_then(|header| child(header, "geoReference"));
    let mut roads = Roads { origin: reference.and_then(origin), ..Roads::default() };
    let (mut known, mut lanes) = (BTreeSet::new(), Lanes::default());
    for node in of("road") {
        let Some(id) = node.attribute("id") else {
            warnings.push(OpenDriveWarning { road: None, what: "a road has no number; left out".to_owned() });
            continue;
        };
        if !known.insert(id) {
            warnings.push(OpenDriveWarning::of(id, "the number is used twice; the second was left out"));
            continue;
        }
        let number = lanes.add(node, id, keeps_left(&node));
        match road(node, (id, number), keeps_left(&node), warnings) {
            Ok(parts) => roads.all.extend(parts),
            // What is not driven on in a junction or beside it is no loss.
            Err("") => {}
            Err(what) => warnings.push(OpenDriveWarning::of(id, what)),
        }
    }
    for junction in of("junction") {
        lanes.join_over(junction, warnings);
        if let Some(id) = junction.attribute("id").filter(|_| child(junction, "controller").is_some()) {
            roads.signalised.insert(id.to_owned());
        }
    }
    roads.keeps_left = lanes.keep_left();
    roads.leads = lanes.leads(warnings);
    Ok(roads)
}

/// The parts of a road.
fn road(
    node: Node<'_, '_>,
    (id, number_in_file): (&str, u32),
    keeps_left: bool,
    warnings: &mut Vec<OpenDriveWarning>,
) -> Result<Vec<Road>, &'static str> {
    let plan_view = child(node, "planView").ok_or("has no course; left out")?;
    let line = curve::points(plan_view).ok_or("has no possible course; left out")?;
    let length = number(node, "length").unwrap_or(0.0).clamp(0.0, 1e6);
    let junction = node.attribute("junction").filter(|junction| *junction != "-1").map(str::to_owned);
    let lanes = child(node, "lanes").ok_or("has no lanes; left out")?;
    let nothing = if junction.is_some() { "" } else { "is nowhere driven on; left out" };
    let parts = parts::of(lanes, length, keeps_left);
    let last = parts.len().checked_sub(1).ok_or(nothing)?;
    if parts.windows(2).any(|pair| !pair[1].follows) {
        warnings.push(OpenDriveWarning::of(id, "is not driven on all along; that part was left out"));
    }
    let links = child(node, "link");
    let linked = |name| links.and_then(|links| child(links, name)).and_then(link);
    let elevation = Elevation::of(child(node, "elevationProfile"));
    let kind = child(node, "type");
    let is_motorway = kind.and_then(|kind| kind.attribute("type")) == Some("motorway");
    let road = |(rank, part): (usize, parts::Part)| {
        let (forward, backward) = part.section.driven();
        let class = match () {
            () if is_motorway => RoadClass::Highway,
            () if forward.max(backward) > 1 => RoadClass::Arterial,
            () => RoadClass::Local,
        };
        let follows = if part.follows { Some(Link::Part) } else { None };
        let lanes = part.lanes.map(|(section, lanes)| {
            let key = |lane| LaneKey { road: number_in_file, section, lane };
            lanes.into_iter().map(key).collect()
        });
        Road {
            id: id.to_owned(),
            name: node.attribute("name").unwrap_or_default().to_owned(),
            junction: junction.clone(),
            links: [
                if rank == 0 { linked("predecessor") } else { follows },
                if rank == last { linked("successor") } else { None },
            ],
            line: parts::slice(&line, length, (part.from, part.to)),
            heights: elevation.between((part.from, part.to), parts::scale(&line, length)),
            section: part.section,
            lanes,
            class,
            speed: kind.and_then(|kind| child(kind, "speed")).and_then(speed),
        }
    };
    let mut roads: Vec<Road> = parts.into_iter().enumerate().map(road).collect();
    for next in 1..roads.len() {
        let goes_on = roads[next].links[0] == Some(Link::Part);
        roads[next - 1].links[1] = goes_on.then_some(Link::Part);
    }
    Ok(roads)
}

pub(super) fn link(node: Node<'_, '_>) -> Option<Link> {
    let id = node.attribute("elementId")?.to_owned();
    match node.attribute("elementType")? {
        "junction" => Some(Link::Junction(id)),
        "road" => Some(Link::Road(id, node.attribute("contactPoint") == Some("end"))),
        _ => None,
    }
}

/// A speed limit, m/s.
fn speed(node: Node<'_, '_>) -> Option<f64> {
    let unit = match node.attribute("unit") {
        Some("km/h") => 1.0 / 3.6,
        Some("mph") => 0.44704,
        _ => 1.0,
    };
    let speed = number(node, "max")? * unit;
    (speed > 0.0).then(|| speed.clamp(SPEEDS.0, SPEEDS.1))
}

/// The origin of a transverse Mercator projection about the middle of the map.
fn origin(node: Node<'_, '_>) -> Option<GeoOrigin> {
    let text: String = node.children().filter_map(|child| child.text()).collect();
    let of = |name: &str| {
        let value = text.split_whitespace().find_map(|word| word.strip_prefix(name))?;
        value.parse::<f64>().ok().filter(|value| value.is_finite())
    };
    let is_about = text.contains("+proj=tmerc")
        && of("+x_0=").unwrap_or(0.0) == 0.0
        && of("+y_0=").unwrap_or(0.0) == 0.0;
    let (latitude, longitude) = (of("+lat_0=")?, of("+lon_0=")?);
    let is_somewhere = latitude.abs() <= 85.0 && longitude.abs() <= 180.0;
    (is_about && is_somewhere).then_some(GeoOrigin { latitude, longitude })
}
