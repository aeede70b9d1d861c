//! Junctions: which connecting road goes on from which lane, and who controls them.

use std::io::{self, Write};

use simworld_core::net::SignalPlan;

use super::Roads;

impl<'a> Roads<'a> {
    /// The signal plan of an intersection: plans are listed in the order of intersections.
    fn plan_of(&self, intersection: usize) -> Option<&'a SignalPlan> {
        let plans = &self.network.signals;
        let index = plans.binary_search_by_key(&intersection, |plan| plan.intersection.index()).ok()?;
        Some(&plans[index])
    }

    pub(super) fn junction(&self, index: usize, out: &mut impl Write) -> io::Result<()> {
        let place = &self.network.intersections[index];
        if place.connections.is_empty() {
            return Ok(());
        }
        let number = self.junction_number(index);
        writeln!(out, r#"<junction name="" id="{number}">"#)?;
        for (rank, id) in place.connections.iter().enumerate() {
            let connection = &self.network.connections[id.index()];
            let road = self.network.lanes[connection.from.index()].road;
            let lane = self.layouts[road.index()].of_lane(&self.network.roads[road.index()], connection.from);
            writeln!(
                out,
                r#"<connection id="{rank}" incomingRoad="{}" connectingRoad="{}" contactPoint="start"><laneLink from="{lane}" to="{}"/></connection>"#,
                road.0,
                self.connecting(id.index()),
                self.layouts[road.index()].rule.along().1
            )?;
        }
        // Of two that meet, the one that gives way has low priority; each pair of connecting roads once.
        for id in &place.connections {
            for rival in &self.network.connections[id.index()].yields_to {
                writeln!(
                    out,
                    r#"<priority high="{}" low="{}"/>"#,
                    self.connecting(rival.index()),
                    self.connecting(id.index())
                )?;
            }
        }
        if let Some(plan) = self.plan_of(index) {
            for (sequence, group) in self.shown(plan).into_iter().enumerate() {
                writeln!(out, r#"<controller id="{}" type="0" sequence="{sequence}"/>"#, group.0)?;
            }
        }
        writeln!(out, "</junction>")
    }
}
