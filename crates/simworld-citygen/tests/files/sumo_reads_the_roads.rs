//! The SUMO network is whole: every reference leads somewhere, and SUMO's own programs take it without complaint where
//! they are installed.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use roxmltree::Document;
use simworld_citygen::{City, CityConfig, Style};
use simworld_core::seed::Seed;

/// Cities of all styles in turn; from four on large enough for highways.
fn city(seed: u64) -> City {
    let style = Style::ALL[seed as usize % 4];
    let roads = style.roads(if seed < 4 { 30 } else { 420 });
    City::generate(&CityConfig { roads, ..CityConfig::default() }, Seed(seed)).expect("styles are valid")
}

fn xml(city: &City) -> String {
    let mut text = Vec::new();
    city.write_sumo(&mut text).expect("memory takes all");
    String::from_utf8(text).expect("XML is UTF-8")
}

#[test]
fn every_reference_leads_somewhere() {
    for seed in 0..6 {
        let text = xml(&city(seed));
        let document = Document::parse(&text).unwrap();
        let ids = |tag: &str| -> BTreeSet<&str> {
            let nodes = document.descendants().filter(|node| node.has_tag_name(tag));
            nodes.filter_map(|node| node.attribute("id")).collect()
        };
        let (edges, lanes, junctions) = (ids("edge"), ids("lane"), ids("junction"));
        for node in document.descendants() {
            let attribute = |name| node.attribute(name).unwrap_or_else(|| panic!("{name} of {node:?}"));
            match node.tag_name().name() {
                "edge" if node.attribute("function").is_none() => {
                    assert!(junctions.contains(attribute("from")) && junctions.contains(attribute("to")));
                }
                "junction" => {
                    for lane in attribute("incLanes").split(' ').chain(attribute("intLanes").split(' ')) {
                        assert!(lane.is_empty() || lanes.contains(lane), "{lane}");
                    }
                }
                "connection" => {
                    let (from, to) = (attribute("from"), attribute("to"));
                    assert!(edges.contains(from) && edges.contains(to), "{from} {to}");
                    for (edge, lane) in [(from, attribute("fromLane")), (to, attribute("toLane"))] {
                        assert!(lanes.contains(format!("{edge}_{lane}").as_str()), "{edge}_{lane}");
                    }
                }
                _ => {}
            }
        }
    }
}

#[test]
fn right_of_way_is_consistent() {
    let text = xml(&city(1));
    let document = Document::parse(&text).unwrap();
    let mut rows = 0;
    for junction in document.descendants().filter(|node| node.has_tag_name("junction")) {
        let requests: Vec<(&[u8], &[u8])> = junction
            .children()
            .filter(|node| node.has_tag_name("request"))
            .map(|node| {
                (node.attribute("response").unwrap().as_bytes(), node.attribute("foes").unwrap().as_bytes())
            })
            .collect();
        let count = requests.len();
        for (row, (response, foes)) in requests.iter().enumerate() {
            rows += 1;
            assert_eq!((response.len(), foes.len()), (count, count));
            for column in 0..count {
                let bit = |bits: &[u8]| bits[count - 1 - column] == b'1';
                assert!(!bit(response) || bit(foes), "one gives way only to whom one meets");
                let back = requests[column].1[count - 1 - row] == b'1';
                assert_eq!(bit(foes), back, "who meets is met");
            }
        }
    }
    assert!(rows > 100);
}

#[test]
fn signals_have_a_letter_a_link() {
    let text = xml(&city(1));
    let document = Document::parse(&text).unwrap();
    let mut seen = 0;
    for logic in document.descendants().filter(|node| node.has_tag_name("tlLogic")) {
        let id = logic.attribute("id");
        let links = document.descendants().filter(|node| node.attribute("tl") == id).count();
        let green: Vec<&str> = logic.children().filter_map(|phase| phase.attribute("state")).collect();
        assert!(green.iter().all(|state| state.len() == links), "{id:?}");
        for link in 0..links {
            assert!(
                green.iter().any(|state| state[link..].starts_with(['g', 'G'])),
                "{id:?} {link} never goes"
            );
        }
        seen += 1;
    }
    assert!(seen > 3);
}

/// Runs a program of SUMO and says what it complained about; `None` where it is not installed.
fn complaints(program: &str, arguments: &[&str], folder: &Path) -> Option<String> {
    let output = Command::new(program).args(arguments).current_dir(folder).output().ok()?;
    let text = String::from_utf8_lossy(&output.stderr);
    // Where SUMO's own files lie is no matter of ours, and streets may bend, at junctions and between.
    let is_fair = |line: &&str| {
        !["SUMO_HOME", "Speed of straight connection", "Found sharp turn"]
            .iter()
            .any(|fair| line.contains(fair))
    };
    let text: String = text.lines().filter(is_fair).collect();
    Some(if output.status.success() { text } else { format!("{program} failed: {text}") })
}

/// Cars and people from roads to roads all over the city.
fn trips(city: &City) -> String {
    let mut text = String::from("<routes>");
    let roads = city.network.roads.len();
    for index in 0..roads.min(20) {
        let (from, to) = (index, (index * 7 + 3) % roads);
        let trip = format!(r#"<trip id="t{index}" depart="{index}" from="r{from}" to="-r{to}"/>"#);
        let walk = format!(r#"<walk from="-r{from}" to="r{to}"/>"#);
        text.push_str(&trip);
        let person = format!(r#"<person id="p{index}" depart="{index}">{walk}</person>"#);
        text.push_str(&person);
    }
    text + "</routes>"
}

#[test]
fn sumo_itself_takes_it() {
    let folder = tempfile::tempdir().unwrap();
    for seed in [0, 2, 3, 5] {
        let city = city(seed);
        std::fs::write(folder.path().join("city.net.xml"), xml(&city)).unwrap();
        std::fs::write(folder.path().join("city.rou.xml"), trips(&city)).unwrap();
        let convert = ["-s", "city.net.xml", "-o", "again.net.xml"];
        let Some(converted) = complaints("netconvert", &convert, folder.path()) else {
            eprintln!("skipped: netconvert is not installed");
            return;
        };
        assert_eq!(converted, "", "netconvert, seed {seed}");
        let run = [
            "-n",
            "city.net.xml",
            "-r",
            "city.rou.xml",
            "--no-step-log",
            "--duration-log.disable",
            "--end",
            "90",
        ];
        assert_eq!(complaints("sumo", &run, folder.path()).unwrap_or_default(), "", "sumo, seed {seed}");
    }
}
