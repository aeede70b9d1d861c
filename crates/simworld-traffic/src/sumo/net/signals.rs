//! Signal programs as fixed plans: one an intersection, links with the same aspects in one group.

use std::collections::BTreeMap;

use simworld_core::id::IntersectionId;
use simworld_core::net::{Aspect, Phase, SignalGroup};

use super::build::Build;
use super::raw::{Logic, LogicPhase, Raw};
use super::walk::Walk;
use super::ways::Way;
use crate::sumo::{SumoError, SumoWarning};

/// Who obeys a link; vehicles come first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Governed {
    Way(usize),
    Walk(usize),
}

/// A group: whether it is one of people, and its aspects, a phase each.
type Column = (bool, Vec<Aspect>);

impl Build {
    /// Gives every intersection with signals its plan.
    pub(super) fn add_signals(&mut self, raw: &Raw, ways: &[Way], walks: &[Walk]) -> Result<(), SumoError> {
        let mut logics: BTreeMap<&str, &Logic> = BTreeMap::new();
        for logic in &raw.logics {
            if logics.contains_key(logic.id.as_str()) {
                let reason = format!("has another program `{}`: the first is shown", logic.program);
                self.warnings.push(SumoWarning::new("tlLogic", &logic.id, reason));
                continue;
            }
            if !matches!(logic.kind.as_str(), "static" | "actuated" | "") {
                let reason = format!("is {}: here it runs by the clock until it gets a policy", logic.kind);
                self.warnings.push(SumoWarning::new("tlLogic", &logic.id, reason));
            }
            logics.insert(&logic.id, logic);
        }
        let mut links: BTreeMap<(IntersectionId, &str), Vec<(Governed, usize)>> = BTreeMap::new();
        let governed =
            ways.iter().enumerate().map(|(index, way)| (Governed::Way(index), way.place, &way.light)).chain(
                walks
                    .iter()
                    .enumerate()
                    .map(|(index, walk)| (Governed::Walk(index), walk.place, &walk.light)),
            );
        for (who, place, light) in governed {
            if let Some((id, link)) = light {
                links.entry((place, id)).or_default().push((who, *link));
            }
        }
        let mut last = None;
        for ((place, id), links) in links {
            let Some(logic) = logics.get(id) else {
                let (element, what) = ("connection", "signal");
                return Err(SumoError::Dangling { element, id: String::new(), what, target: id.to_owned() });
            };
            if last == Some(place) {
                let reason = "is a second signal at its junction: its links go without";
                self.warnings.push(SumoWarning::new("tlLogic", id, reason));
                continue;
            }
            last = Some(place);
            self.add_plan(logic, place, &links, (ways, walks))?;
        }
        Ok(())
    }

    fn add_plan(
        &mut self,
        logic: &Logic,
        place: IntersectionId,
        links: &[(Governed, usize)],
        (ways, walks): (&[Way], &[Walk]),
    ) -> Result<(), SumoError> {
        // A link that is off in each phase has no light.
        let is_off = |link: usize| {
            let mut letters = logic.phases.iter().map(|phase| phase.state.get(link));
            letters.all(|letter| matches!(letter, Some(b'O')))
        };
        let lit = || links.iter().filter(|(_, link)| !is_off(*link));
        let mut columns: Vec<Column> = Vec::new();
        for (who, link) in lit() {
            columns.push((matches!(who, Governed::Walk(_)), column(logic, *link)?));
        }
        // In the order of their first links, people last.
        let mut groups: Vec<&Column> = Vec::new();
        for people in [false, true] {
            for own in columns.iter().filter(|column| column.0 == people) {
                if !groups.contains(&own) {
                    groups.push(own);
                }
            }
        }
        let phases = phases(logic, &groups);
        let is_stage = |phase: &Phase| !phase.green.is_empty() && phase.yellow.is_empty();
        if !phases.iter().any(is_stage) {
            let reason = "never shows green alone: the junction goes without signals";
            self.warnings.push(SumoWarning::new("tlLogic", &logic.id, reason));
            return Ok(());
        }
        if logic.kind == "actuated" {
            let bounds = shown(logic).map(|(_, phase)| phase.bounds).collect();
            self.programs.add(place, logic.longest_gap, bounds);
        }
        let cycle: f64 = phases.iter().map(|phase| phase.duration).sum();
        // A positive offset delays the program; here it is the time into the cycle at the start.
        let offset = (-logic.offset).rem_euclid(cycle);
        let first = self.builder.add_signals(place, groups.len() as u32, offset, phases);
        for ((who, _), own) in lit().zip(&columns) {
            let Some(rank) = groups.iter().position(|group| *group == own) else { continue };
            let group = SignalGroup(first.0 + rank as u32);
            match who {
                Governed::Way(index) => self.builder.set_signal(ways[*index].id, group),
                Governed::Walk(index) => self.builder.set_crossing_signal(walks[*index].id, group),
            }
        }
        Ok(())
    }
}

/// What a link shows in each phase.
fn column(logic: &Logic, link: usize) -> Result<Vec<Aspect>, SumoError> {
    let shown = |phase: &LogicPhase| {
        let letter = phase.state.get(link).ok_or_else(|| SumoError::Attribute {
            element: "tlLogic".to_owned(),
            id: logic.id.clone(),
            attribute: "state",
            reason: format!("has no letter for link {link}: give one a link").into(),
        })?;
        Ok(match letter {
            b'G' | b'g' | b'o' | b'O' => Aspect::Green,
            b'y' | b'Y' => Aspect::Yellow,
            // Red, red and yellow, and the arrow at which one must stop first.
            _ => Aspect::Red,
        })
    };
    logic.phases.iter().map(shown).collect()
}

/// The phases that are shown, with their numbers: those without duration are left out.
fn shown(logic: &Logic) -> impl Iterator<Item = (usize, &LogicPhase)> {
    logic.phases.iter().enumerate().filter(|(_, phase)| phase.duration > 0.0)
}

/// The phases with groups counted from zero.
fn phases(logic: &Logic, groups: &[&Column]) -> Vec<Phase> {
    shown(logic)
        .map(|(index, phase)| {
            let showing = |aspect: Aspect| {
                let shows = groups.iter().enumerate().filter(move |(_, group)| group.1[index] == aspect);
                shows.map(|(rank, _)| SignalGroup(rank as u32)).collect()
            };
            Phase { duration: phase.duration, green: showing(Aspect::Green), yellow: showing(Aspect::Yellow) }
        })
        .collect()
}
