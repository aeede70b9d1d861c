//! Signal plans as `tlLogic`: one letter a link.

use std::io::{self, Write};

use simworld_core::net::{Aspect, Phase, RoadNetwork, SignalGroup, SignalPlan};

use super::junctions::Junction;
use crate::files::xml::Two;

pub(super) fn write(network: &RoadNetwork, junctions: &[Junction], out: &mut impl Write) -> io::Result<()> {
    for plan in &network.signals {
        let Some(junction) = junctions.get(plan.intersection.index()) else { continue };
        write_plan(network, plan, junction, out)?;
    }
    Ok(())
}

fn write_plan(
    network: &RoadNetwork,
    plan: &SignalPlan,
    junction: &Junction,
    out: &mut impl Write,
) -> io::Result<()> {
    // SUMO's offset says when a cycle begins, ours how much of it is over at time zero.
    let offset = (plan.cycle() - plan.offset).rem_euclid(plan.cycle().max(1e-9));
    writeln!(
        out,
        r#"<tlLogic id="j{}" type="static" programID="0" offset="{}">"#,
        plan.intersection.0,
        Two(offset)
    )?;
    for phase in &plan.phases {
        let state: String = letters(network, junction, phase).collect();
        writeln!(out, r#"<phase duration="{}" state="{state}"/>"#, Two(phase.duration))?;
    }
    writeln!(out, "</tlLogic>")
}

fn letters<'a>(
    network: &'a RoadNetwork,
    junction: &'a Junction,
    phase: &'a Phase,
) -> impl Iterator<Item = char> + 'a {
    let vehicles = junction.links.iter().map(|id| {
        let connection = &network.connections[id.index()];
        let gives_way = !connection.yields_to.is_empty() || !connection.crossings.is_empty();
        letter(phase, connection.signal, gives_way)
    });
    let walkers = junction.crossings.iter().map(|id| {
        // SUMO has no yellow for walkers: who sees it must not set out.
        match letter(phase, network.crossings[id.index()].signal, false) {
            'y' => 'r',
            other => other,
        }
    });
    vehicles.chain(walkers)
}

/// `G` goes, `g` goes but gives way, `y` and `r` as they say, `O` has no signal.
fn letter(phase: &Phase, group: Option<SignalGroup>, gives_way: bool) -> char {
    match group.map(|group| phase.aspect(group)) {
        None => 'O',
        Some(Aspect::Red) => 'r',
        Some(Aspect::Yellow) => 'y',
        Some(Aspect::Green) if gives_way => 'g',
        Some(Aspect::Green) => 'G',
    }
}
