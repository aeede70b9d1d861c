//! What an order means in view of those behind it: "take the chair and sit down" carries no chair away.

use super::clause::{Clause, Grip, Manner, Pace, Reference, Target};

/// What is done instead of an order, because of the orders that follow it.
pub(super) fn in_view_of(clause: &Clause, later: &[Clause]) -> Option<Vec<Clause>> {
    if let Clause::Drop { what: Some(what), at: Some(to), manner: Manner::Deliver } = clause
        && later.first().is_some_and(hands_over)
    {
        return Some(vec![Clause::Take { what: what.clone(), to: None, grip: Grip::Lift }, going(to)]);
    }
    // "Go by the canteen and get a coffee": by it is where it is bought.
    if let Clause::Past { what, pace } = clause
        && let Some(Clause::Buy { at: None, .. }) = later.first()
    {
        return Some(vec![Clause::Go { to: what.clone(), side: None, pace: *pace, within: None }]);
    }
    let Clause::Take { what, to, grip } = clause else { return None };
    match (to, later.first()) {
        // A seat or a door that is chosen is not carried away.
        (None, Some(Clause::Sit { on })) if on.as_ref().is_none_or(is_it) => {
            Some(vec![Clause::Mention { what: what.clone() }])
        }
        (None, Some(Clause::Door { what: door, .. })) if door.as_ref().is_none_or(is_it) => {
            Some(vec![Clause::Mention { what: what.clone() }])
        }
        // What is brought to somebody and handed over later is not let go of before.
        (Some(to), _) if later.iter().any(hands_over) => {
            Some(vec![Clause::Take { what: what.clone(), to: None, grip: *grip }, going(to)])
        }
        _ => None,
    }
}

fn going(to: &Reference) -> Clause {
    Clause::Go { to: to.clone(), side: None, pace: Pace::Usual, within: None }
}

fn is_it(reference: &Reference) -> bool {
    matches!(reference.target, Target::It | Target::There)
}

/// Whether what "it" stands for is given or put somewhere.
fn hands_over(clause: &Clause) -> bool {
    match clause {
        Clause::Give { what, .. } | Clause::Throw { what, .. } => what.as_ref().is_none_or(is_it),
        Clause::Drop { what, at, manner } => {
            *manner != Manner::Deliver && what.as_ref().is_none_or(is_it) && at.as_ref().is_none_or(is_it)
        }
        _ => false,
    }
}
