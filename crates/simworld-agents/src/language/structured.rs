//! Orders as data: calls and blocks of calls to a plan, by the same rules as sentences.

use std::collections::BTreeMap;

use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seam::{Condition, Plan, PlanError};
use simworld_core::value::Value;

use super::clause::{Clause, Test};
use super::draft::Draft;
use super::names::Names;
use super::resolve::View;
use super::{AmbiguityPolicy, RANGE, call};

/// One call of [`GrammarPlanner::calls`](super::GrammarPlanner::calls), or a block of orders.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Order {
    /// A call.
    Call { name: &'static str, args: BTreeMap<String, Value> },
    /// One thing or another.
    If { condition: Condition, then: Vec<Self>, otherwise: Vec<Self> },
    /// Several times.
    Repeat { times: u32, orders: Vec<Self> },
    /// Over and over until it holds; without orders, waiting.
    Until { condition: Condition, orders: Vec<Self> },
}

/// The plan of orders that are given in this sequence.
pub(crate) fn plan_orders(orders: &[Order], scene: &dyn Scene, who: EntityId) -> Result<Plan, PlanError> {
    let me = scene.entity(who).ok_or(PlanError::Missing { id: who })?;
    let view = View::new(scene, &me, AmbiguityPolicy::Nearest);
    let names = Names::new(scene, me.planar(), RANGE);
    let clauses = clauses(orders, &names, &view)?;
    let mut draft = Draft::new(view, &me);
    draft.add_all(&clauses)?;
    Ok(draft.finish())
}

fn clauses(orders: &[Order], names: &Names<'_>, view: &View<'_>) -> Result<Vec<Clause>, PlanError> {
    orders.iter().map(|order| clause(order, names, view)).collect()
}

fn clause(order: &Order, names: &Names<'_>, view: &View<'_>) -> Result<Clause, PlanError> {
    let inner = |orders: &[Order]| clauses(orders, names, view);
    let test = |condition: &Condition| Test::Stated(condition.clone());
    Ok(match order {
        Order::Call { name, args } => call::read(name, args, names, view)?,
        Order::If { condition, then, otherwise } => {
            Clause::If { test: test(condition), then: inner(then)?, otherwise: inner(otherwise)? }
        }
        Order::Repeat { times, orders } => Clause::Repeat { times: *times, body: inner(orders)? },
        Order::Until { condition, orders } => Clause::Until { test: test(condition), body: inner(orders)? },
    })
}
