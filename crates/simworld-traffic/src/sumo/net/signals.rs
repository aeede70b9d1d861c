//! Signal programs as fixed plans: one an intersection, links with the same aspects in one group.

use std::borrow::Cow;
use std::collections::BTreeMap;

use simworld_core::id::IntersectionId;
use simworld_core::net::{Aspect, Phase, SignalGroup};

use super::build::Build;
use super::order::{Order, is_stage};
use super::programs::{Extends, Program};
use super::raw::{Logic, LogicPhase, Raw};
use super::walk::Walk;
use super::ways::Way;
use crate::signal::{Branches, DelayDetector};
use crate::sumo::{SumoError, SumoWarning};

/// SUMO's `max-gap`, s, where the file says nothing.
const LONGEST_GAP: f64 = 3.0;
/// SUMO's `detectorRange`, m, where the file says nothing.
const RANGE: f64 = 100.0;
/// SUMO's `minTimeLoss`, s, where the file says nothing.
const LEAST_LOSS: f64 = 1.0;
/// Phases of a program at most that name those that follow: for each, all others may be looked at.
const MOST_NAMED: usize = 512;

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
            if !matches!(logic.kind.as_str(), "static" | "actuated" | "delay_based" | "") {
                let reason = format!("is {}: here it runs by the clock until it gets a policy", logic.kind);
                self.warnings.push(SumoWarning::new("tlLogic", &logic.id, reason));
            }
            self.check_phases(logic)?;
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
        let mut places: BTreeMap<&str, usize> = BTreeMap::new();
        for (_, id) in links.keys() {
            *places.entry(id).or_default() += 1;
        }
        for (id, count) in places.into_iter().filter(|(_, count)| *count > 1) {
            if logics.get(id).is_some_and(|logic| logic.is_actuated()) {
                let reason = format!("is of {count} junctions: each of them follows its own vehicles");
                self.warnings.push(SumoWarning::new("tlLogic", id, reason));
            }
        }
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
        let numbers: Vec<usize> = shown(logic).map(|(number, _)| number).collect();
        let Some(order) = self.order(logic, &numbers, &phases) else { return Ok(()) };
        let mut phases: Vec<Phase> = order.phases.iter().map(|phase| phases[*phase].clone()).collect();
        let others = phases.split_off(order.cycle);
        let (count, offset) = (groups.len() as u32, order.offset);
        let first = self.builder.add_signals(place, count, offset, phases);
        if logic.is_actuated() {
            let numbers: Vec<usize> = order.phases.iter().map(|phase| numbers[*phase]).collect();
            self.add_program(logic, place, (&order, &numbers), others);
        }
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

    /// Checks the phases that a program names, and warns of what its phases wait for beside gaps and bounds.
    fn check_phases(&mut self, logic: &Logic) -> Result<(), SumoError> {
        let count = logic.phases.len();
        if count > MOST_NAMED && logic.phases.iter().any(|phase| !phase.next.is_empty()) {
            let (what, limit) = ("phases of a signal that name those that follow", MOST_NAMED as u64);
            return Err(SumoError::TooMuch { what, limit });
        }
        for (number, phase) in logic.phases.iter().enumerate() {
            if let Some(lost) = phase.next.iter().find(|next| **next >= count) {
                return Err(SumoError::Attribute {
                    element: "tlLogic".to_owned(),
                    id: logic.id.clone(),
                    attribute: "next",
                    reason: format!("of phase {number} names phase {lost}: the last is {}", count - 1).into(),
                });
            }
        }
        if logic.is_actuated() && logic.phases.iter().any(|phase| phase.has_conditions) {
            let reason =
                "has conditions of its own for the ends of phases: they end by gaps and bounds alone";
            self.warnings.push(SumoWarning::new("tlLogic", &logic.id, reason));
        }
        Ok(())
    }

    /// The order of the phases of a program; `None` if it never shows green alone.
    fn order(&mut self, logic: &Logic, numbers: &[usize], phases: &[Phase]) -> Option<Order> {
        let mut warn = |reason: Cow<'static, str>| {
            let warning = SumoWarning::new("tlLogic", &logic.id, reason);
            // A signal of several junctions has one program.
            if !self.warnings.contains(&warning) {
                self.warnings.push(warning);
            }
        };
        let without = "never shows green alone: the junction goes without signals";
        if phases.is_empty() {
            warn(without.into());
            return None;
        }
        let order = Order::of(logic, numbers, phases);
        if !order.phases[..order.cycle].iter().any(|phase| is_stage(&phases[*phase])) {
            warn(without.into());
            return None;
        }
        let lists = [(&order.unreached, "follow no other"), (&order.only_first, "come at the start alone")];
        for (places, what) in lists.into_iter().filter(|(places, _)| !places.is_empty()) {
            let numbers: Vec<String> = places.iter().map(|place| numbers[*place].to_string()).collect();
            warn(format!("has phases that {what}: {} are left out", numbers.join(", ")).into());
        }
        Some(order)
    }

    /// Takes up the program of a plan, which was added last, that follows its vehicles.
    fn add_program(
        &mut self,
        logic: &Logic,
        place: IntersectionId,
        (order, numbers): (&Order, &[usize]),
        mut others: Vec<Phase>,
    ) {
        let Some(plan) = self.builder.network().signals.last() else { return };
        let first = plan.groups.first().map_or(0, |group| group.0);
        for group in others.iter_mut().flat_map(|phase| phase.green.iter_mut().chain(&mut phase.yellow)) {
            group.0 += first;
        }
        let bounds = numbers.iter().map(|number| logic.phases[*number].bounds).collect();
        let mut program = Program::new(extends(logic), bounds);
        if order.has_choice() {
            let branches = Branches { phases: others, next: order.next.clone() };
            if let Some(phase) = program.choose(plan, branches, logic.inactive) {
                let number = numbers[phase];
                let reason =
                    format!("goes on with phase {number} for ever: no other green is reached from it");
                self.warnings.push(SumoWarning::new("tlLogic", &logic.id, reason));
            }
        }
        self.programs.add(place, program);
    }
}

/// What lets a phase of a program go on.
fn extends(logic: &Logic) -> Extends {
    if logic.kind == "actuated" {
        return Extends::Gap(logic.longest_gap.unwrap_or(LONGEST_GAP));
    }
    let (range, least) = (logic.range.unwrap_or(RANGE), logic.least_loss.unwrap_or(LEAST_LOSS));
    Extends::Delay(DelayDetector { range, least }, logic.goes_beyond)
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
