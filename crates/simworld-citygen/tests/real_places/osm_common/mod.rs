//! Real extracts, where they are at hand, and small ones written by hand.

use std::fmt::Write as _;
use std::path::PathBuf;

use simworld_citygen::osm::Place;

/// The folder of the real extracts, which `SIMWORLD_DATA` names.
fn folder() -> Option<PathBuf> {
    std::env::var_os("SIMWORLD_DATA").map(PathBuf::from)
}

/// A real extract; says so where it is not there.
pub(crate) fn real(file: &str) -> Option<Place> {
    let path = folder().map(|folder| folder.join(file)).filter(|path| path.exists());
    let Some(path) = path else {
        println!("skipped: {file} is not at hand; set SIMWORLD_DATA to the folder of the extracts");
        return None;
    };
    Some(Place::read(&path).expect("a real extract is read"))
}

/// All real extracts that are there.
#[allow(dead_code)]
pub(crate) fn all_real() -> Vec<(&'static str, Place)> {
    const FILES: [&str; 10] = [
        "campo-grande.osm.gz",
        "helsinki.osm.pbf",
        "leeds_cycleway.osm.gz",
        "monaco.osm.gz",
        "montlake_roundabout.osm.gz",
        "neukolln.osm.gz",
        "northgate_dual_carriageway.osm.gz",
        "quad_intersection.osm.gz",
        "seattle_slip_lane.osm.gz",
        "tiny_roundabout.osm.gz",
    ];
    FILES.into_iter().filter_map(|file| Some((file, real(file)?))).collect()
}

/// An extract written by hand: points in metres about a place at 50° north, 8° east, and ways over them.
#[derive(Default)]
#[allow(dead_code)]
pub(crate) struct Sketch {
    body: String,
    ways: i64,
}

#[allow(dead_code)]
impl Sketch {
    /// A node, its number from 1, at metres east and north, with tags.
    pub(crate) fn node(mut self, id: i64, (x, y): (f64, f64), tags: &[(&str, &str)]) -> Self {
        // Metres a degree at 50° north, WGS 84.
        let (longitude, latitude) = (8.0 + x / 71_695.8, 50.0 + y / 111_229.0);
        self.push(format_args!("<node id=\"{id}\" lat=\"{latitude:.7}\" lon=\"{longitude:.7}\">"));
        self.tags(tags);
        self.body += "</node>\n";
        self
    }

    /// A way over nodes, numbered from 1001.
    pub(crate) fn way(mut self, nodes: &[i64], tags: &[(&str, &str)]) -> Self {
        self.ways += 1;
        self.push(format_args!("<way id=\"{}\">", 1000 + self.ways));
        for node in nodes {
            self.push(format_args!("<nd ref=\"{node}\"/>"));
        }
        self.tags(tags);
        self.body += "</way>\n";
        self
    }

    /// A relation of ways, and of nodes up to 1000, with their roles.
    pub(crate) fn relation(mut self, id: i64, members: &[(i64, &str)], tags: &[(&str, &str)]) -> Self {
        self.push(format_args!("<relation id=\"{id}\">"));
        for (way, role) in members {
            // Node numbers are below those of ways.
            let kind = if *way <= 1000 { "node" } else { "way" };
            self.push(format_args!("<member type=\"{kind}\" ref=\"{way}\" role=\"{role}\"/>"));
        }
        self.tags(tags);
        self.body += "</relation>\n";
        self
    }

    fn push(&mut self, text: std::fmt::Arguments<'_>) {
        self.body.write_fmt(text).expect("a string takes all");
    }

    fn tags(&mut self, tags: &[(&str, &str)]) {
        for (key, value) in tags {
            self.push(format_args!("<tag k=\"{key}\" v=\"{value}\"/>"));
        }
    }

    /// The document.
    pub(crate) fn xml(&self) -> String {
        format!("<?xml version=\"1.0\"?>\n<osm version=\"0.6\">\n{}</osm>\n", self.body)
    }

    /// The place.
    pub(crate) fn place(&self) -> Place {
        Place::from_xml(self.xml().as_bytes()).expect("a sketch is an extract")
    }
}
