//! How orders that were read are done several times, or until something happens.

use simworld_core::action::StepDirection;

use super::clause::{Clause, Reference, Test};

/// The last order, or all of the group if the last one is not a thing that one does twice in a row.
pub(super) fn repeat(clauses: &mut Vec<Clause>, group: usize, times: u32, all: bool) {
    let last_alone = !all && clauses.last().is_some_and(Clause::is_repeatable);
    let from = if last_alone { clauses.len() - 1 } else { group.min(clauses.len()) };
    let body: Vec<Clause> = clauses.drain(from..).collect();
    match &body[..] {
        [Clause::Until { test: Test::Never, body }] => {
            clauses.push(Clause::Repeat { times, body: body.clone() });
        }
        _ if times == 1 => clauses.extend(body),
        [Clause::Halfway { .. }] => clauses.push(Clause::Repeat { times, body: to_and_fro(body) }),
        [Clause::Photo { of, times: 1 }] => clauses.push(Clause::Photo { of: of.clone(), times }),
        _ => clauses.push(Clause::Repeat { times, body }),
    }
}

/// What goes on until something happens: waiting needs no order, and a step forward is the first of many.
pub(super) fn body_of(clause: Option<Clause>) -> Vec<Clause> {
    match clause {
        None | Some(Clause::Wait { .. } | Clause::Stop) => Vec::new(),
        Some(Clause::Step { direction: StepDirection::Forward, .. }) => vec![Clause::Forward],
        Some(Clause::Repeat { times: 1, body }) => body,
        Some(clause) => to_and_fro(vec![clause]),
    }
}

/// "Run between the fountain and the statue three times": from one to the other, and not to the middle so often.
fn to_and_fro(body: Vec<Clause>) -> Vec<Clause> {
    match &body[..] {
        [Clause::Halfway { from: Some(from), to, pace }] => {
            let go = |to: &Reference| Clause::Go { to: to.clone(), side: None, pace: *pace, within: None };
            vec![go(from), go(to)]
        }
        _ => body,
    }
}

/// The same again and again, with so many seconds after each.
pub(super) fn over_and_over(mut body: Vec<Clause>, seconds: f64) -> Clause {
    // What was to be done for a while or until something holds is done so at these intervals.
    if let [Clause::Until { test, body: inner }] = &mut body[..] {
        inner.push(Clause::Wait { seconds });
        return Clause::Until { test: test.clone(), body: std::mem::take(inner) };
    }
    body.push(Clause::Wait { seconds });
    Clause::Until { test: Test::Never, body }
}
