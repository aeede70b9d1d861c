//! The files that both read.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

use simworld_core::seed::Seed;
use simworld_traffic::sumo::SumoNet;
use simworld_traffic::{Leg, Router};

use super::run::output_of;
use super::{BesideError, Workload};

/// Edges of a route.
const EDGES: usize = 60;

/// Where they are.
pub(super) struct Files {
    pub(super) net: PathBuf,
    pub(super) routes: PathBuf,
}

/// The grid by netgenerate, and routes by random walks on it.
pub(super) fn make(workload: Workload, home: &Path, folder: &Path) -> Result<Files, BesideError> {
    std::fs::create_dir_all(folder)?;
    let name =
        |kind: &str| folder.join(format!("grid{}x{}.{kind}.xml", workload.junctions, workload.vehicles));
    let files = Files { net: name("net"), routes: name("rou") };
    let number = workload.junctions.to_string();
    let mut netgenerate = Command::new(home.join("bin").join("netgenerate"));
    netgenerate.args([
        "--grid",
        "--grid.number",
        &number,
        "--grid.length",
        "200",
        "--default.lanenumber",
        "2",
    ]);
    netgenerate.args([
        "--default-junction-type",
        "traffic_light",
        "--no-turnarounds",
        "true",
        "--seed",
        "42",
        "-o",
    ]);
    output_of("netgenerate", netgenerate.arg(&files.net))?;
    write_routes(workload, &files)?;
    Ok(files)
}

fn write_routes(workload: Workload, files: &Files) -> Result<(), BesideError> {
    let net = SumoNet::open(&files.net)?;
    let router = Router::new(&net.network);
    let mut rng = Seed(42).stream("examples/beside sumo").rng();
    let mut legs: Vec<Leg> = net
        .network
        .lanes
        .iter()
        .enumerate()
        .map(|(lane, _)| Leg::of(&net.network, simworld_core::id::LaneId(lane as u32)))
        .collect();
    legs.dedup();
    rng.shuffle(&mut legs);
    let mut out = BufWriter::new(File::create(&files.routes)?);
    writeln!(out, "<routes>")?;
    // As many on every edge, as far as that goes.
    for (vehicle, first) in legs.iter().cycle().take(workload.vehicles as usize).enumerate() {
        let mut edges = vec![net.names.edge(*first)];
        let mut leg = *first;
        while edges.len() < EDGES
            && let Some(next) = rng.choose(&router.after(leg).collect::<Vec<_>>()).copied()
        {
            leg = next;
            edges.push(net.names.edge(leg));
        }
        let edges = edges.join(" ");
        writeln!(out, r#"<vehicle id="{vehicle}" depart="0"><route edges="{edges}"/></vehicle>"#)?;
    }
    writeln!(out, "</routes>")?;
    out.flush()?;
    Ok(())
}
