//! What time is worth to a courier, how fast it walks for it, and whether work can be done in time.

use simworld_core::exertion::Exertion;

use crate::delivery::{CourierView, HeldOrder};

/// Share of its length, measured straight or along sidewalks, by which a walk takes longer than at full speed: waits at
/// crossings, ways round corners. Measured on the default city: couriers cover 0.7 to 0.85 of it.
const HINDRANCE: f64 = 1.25;
/// Share of a ceiling that an order usually brings; measured on the default city, where all twelve policies bid.
const USUAL_SHARE: f64 = 0.55;

/// What an order usually brings, $.
pub(super) fn usual_pay(view: &CourierView<'_>) -> f64 {
    let orders = &view.config().orders;
    let ceiling = orders.base.dollars() + orders.per_kilometre.dollars() * orders.radius / 1000.0;
    ceiling * (orders.least_factor + orders.greatest_factor) * 0.5 * USUAL_SHARE
}

/// What an order usually takes at a speed, s: the way to a restaurant and the way to a home.
pub(super) fn usual_time(view: &CourierView<'_>, speed: f64) -> f64 {
    1.5 * view.config().orders.radius * HINDRANCE / speed
}

/// The walking speed at which a metre costs least, time and energy together, m/s.
///
/// A second is worth `w` = usual pay / usual time, so a metre at speed v costs w / v of time beside what it takes of drinks. The
/// cost of walking has one lowest point over speed and jumps where one begins to run, from where on faster is cheaper: the
/// speeds of a grid are compared, and the fastest walk.
pub(super) fn brisk(view: &CourierView<'_>) -> f64 {
    /// Speeds that are compared.
    const SPEEDS: u32 = 24;
    let limits = &view.config().speed;
    let unit = view.drink_price().dollars() / view.config().prices.drink_energy;
    let worth = usual_pay(view) / usual_time(view, 0.5 * (limits.walking + limits.fastest));
    let cost = |speed: f64| worth / speed + unit * view.per_metre(speed);
    let step = (limits.fastest - limits.walking) / f64::from(SPEEDS);
    let grid = (0..=SPEEDS).map(|index| limits.walking + step * f64::from(index));
    let fastest_walk = Exertion::change_to_running().clamp(limits.walking, limits.fastest);
    let cheaper = |a: &f64, b: &f64| cost(*a).total_cmp(&cost(*b));
    grid.chain([fastest_walk]).min_by(cheaper).unwrap_or(limits.walking)
}

/// The speed at which a courier works, m/s.
pub(super) fn working_speed(view: &CourierView<'_>) -> f64 {
    if view.is_riding() { view.speed() } else { brisk(view) }
}

/// How long a way takes who works at a speed, s.
pub(super) fn time_at(speed: f64, length: f64) -> f64 {
    length * HINDRANCE / speed.max(0.1)
}

/// How long a way takes, s.
pub(super) fn time_for(view: &CourierView<'_>, length: f64) -> f64 {
    time_at(working_speed(view), length)
}

/// What is left to walk for the orders in hand, m.
pub(super) fn backlog(view: &CourierView<'_>) -> f64 {
    let left = |held: HeldOrder| held.distance + if held.carried { 0.0 } else { held.route };
    view.held_orders().map(left).sum()
}

/// What there may be to walk for the orders that it has bid for, of those that take bids, m.
pub(super) fn pending(view: &CourierView<'_>) -> f64 {
    view.own_bids().map(|order| order.approach + order.route).sum()
}
