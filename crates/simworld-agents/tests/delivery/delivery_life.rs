//! An order from post to door, alone, shared, late and unwanted; purchases; exhaustion.

use std::sync::Arc;

use crate::delivery_common::{Town, quiet, simulation, world};
use simworld_agents::asynchronous::{AsynchronousConfig, AsynchronousEpisode, FreeMind, Pace};
use simworld_agents::delivery::{
    Account, BatteryConfig, Cents, CourierAction, CourierMind, DeliveryConfig, DeliveryTask, Errand, OrderId,
    Persona, PolicyKind, Power, Shopping, Split, Stage,
};
use simworld_agents::episode::{Agent, Episode};
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::mind::Silent;
use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;
use simworld_core::net::{
    NetworkConfig, RoadNetwork, Route, RouteScratch, Street, StreetPlan, WaypointConfig, WaypointGraph,
};
use simworld_core::scene::{EntityKind, Role, Scene, World};
use simworld_core::seam::Task;
use simworld_core::seed::Seed;

pub(crate) const ORDER: OrderId = OrderId(0);

fn purse(town: &Town, courier: usize) -> Cents {
    town.task.ledger().unwrap().balance(Account::Courier(courier))
}

/// Courier 0 wins the only order at its ceiling less a dollar; what it will be paid.
pub(crate) fn win(town: &mut Town) -> Cents {
    let price = town.task.orders()[0].ceiling - Cents(100);
    town.act(0, CourierAction::BidOrder { order: ORDER, price }).unwrap();
    town.until("order_awarded", 20);
    price
}

fn pick_up(town: &mut Town) {
    town.act(0, CourierAction::PickUpOrder { order: ORDER }).unwrap();
    town.until("order_picked_up", 1500);
}

#[test]
fn an_order_is_won_carried_and_paid() {
    let mut town = Town::new(quiet(), 1, 1);
    let pay = win(&mut town);
    assert!(
        town.act(0, CourierAction::DeliverOrder { order: ORDER }).is_err(),
        "it is still at the restaurant"
    );
    pick_up(&mut town);
    town.step(&[]);
    let held = town.simulation.world().attached(town.couriers[0], Role::Held).expect("a parcel in hand");
    assert_eq!(town.simulation.world().entity(held).unwrap().kind, EntityKind::Parcel);
    town.act(0, CourierAction::DeliverOrder { order: ORDER }).unwrap();
    town.until("order_delivered", 2500);
    assert!((town.outcome.rewards[0] - pay.dollars()).abs() < 1e-9, "{:?}", town.outcome);
    assert_eq!(purse(&town, 0), Cents(10_000) + pay);
    assert_eq!(town.task.ledger().unwrap().balance(Account::Platform), Cents(100));
    assert_eq!(town.task.ledger().unwrap().balance(Account::Escrow), Cents::ZERO);
    assert!(town.simulation.world().entity(held).is_none(), "the parcel went into the house");
    let report = town.task.report().unwrap();
    assert_eq!((report.delivered, report.awarded, report.couriers[0].late), (1, 1, 0));
    assert!(report.couriers[0].energy > 5.0 && report.completion_time > 10.0);
}

#[test]
fn one_who_dawdles_is_paid_less_and_never_less_than_half() {
    let mut town = Town::new(quiet(), 1, 1);
    let pay = win(&mut town);
    for _ in 0..2500 {
        town.step(&[]);
    }
    pick_up(&mut town);
    town.act(0, CourierAction::DeliverOrder { order: ORDER }).unwrap();
    town.until("order_delivered", 2500);
    assert_eq!(purse(&town, 0), Cents(10_000) + pay.times(0.5));
}

#[test]
fn an_order_nobody_wants_expires_without_payment() {
    let mut town = Town::new(quiet(), 1, 1);
    town.until("order_expired", 15);
    assert!(matches!(town.task.orders()[0].stage, Stage::Expired));
    assert_eq!(town.task.ledger().unwrap().balance(Account::Customers), Cents::ZERO);
}

#[test]
fn the_lowest_bid_wins_and_nothing_above_the_ceiling_is_taken() {
    let mut town = Town::new(quiet(), 3, 1);
    let ceiling = town.task.orders()[0].ceiling;
    let bid = |price| CourierAction::BidOrder { order: ORDER, price };
    assert!(town.act(0, bid(ceiling + Cents(1))).is_err());
    assert!(town.act(0, bid(Cents::ZERO)).is_err());
    town.act(0, bid(ceiling)).unwrap();
    town.act(1, bid(Cents(500))).unwrap();
    town.act(2, bid(Cents(700))).unwrap();
    town.until("order_awarded", 20);
    let Stage::Awarded(awarded) = &town.task.orders()[0].stage else { panic!("not awarded") };
    assert_eq!((awarded.courier, awarded.pay), (1, Cents(500)));
    assert!(town.act(2, bid(Cents(300))).is_err(), "the auction is over");
}

fn share_with(split: Split, bounty: Cents) -> (Town, Cents) {
    let mut config = quiet();
    config.sharing.split = split;
    let mut town = Town::new(config, 2, 1);
    let pay = win(&mut town);
    pick_up(&mut town);
    town.act(0, CourierAction::ShareOrder { order: ORDER, meet: None, bounty }).unwrap();
    town.act(1, CourierAction::GoToMeetPoint { order: ORDER }).unwrap();
    assert_eq!(town.count("share_accepted"), 1);
    town.act(0, CourierAction::GoToMeetPoint { order: ORDER }).unwrap();
    town.until("handed_over", 2500);
    let Stage::Carried(carried) = &town.task.orders()[0].stage else { panic!("not carried") };
    assert_eq!(carried.carrier, 1);
    let parcel = carried.parcel.expect("the world shows the parcel");
    let bond = *town.simulation.world().entity(parcel).unwrap().attachment.unwrap();
    assert_eq!(bond.parent, town.couriers[1], "the parcel changed hands");
    assert!(town.act(0, CourierAction::DeliverOrder { order: ORDER }).is_err());
    town.act(1, CourierAction::DeliverOrder { order: ORDER }).unwrap();
    town.until("order_delivered", 2500);
    (town, pay)
}

fn paid(town: &Town) -> Cents {
    let Stage::Delivered(delivered) = &town.task.orders()[0].stage else { panic!("not delivered") };
    assert_eq!((delivered.courier, delivered.first), (1, Some(0)));
    delivered.paid
}

#[test]
fn a_shared_order_pays_both() {
    let (town, _) = share_with(Split::Distance, Cents::ZERO);
    let paid = paid(&town);
    let gains = [purse(&town, 0) - Cents(10_000), purse(&town, 1) - Cents(10_000)];
    assert_eq!(gains[0] + gains[1], paid);
    assert!(gains[0] > Cents::ZERO, "{gains:?}");
    let (town, _) = share_with(Split::Equal, Cents::ZERO);
    assert_eq!(purse(&town, 0) - Cents(10_000), self::paid(&town).times(0.5));
}

#[test]
fn a_bounty_waits_in_escrow_and_goes_to_the_second() {
    let (town, _) = share_with(Split::Bounty, Cents(300));
    assert_eq!(purse(&town, 1), Cents(10_300));
    assert_eq!(purse(&town, 0), Cents(9_700) + paid(&town));
}

#[test]
fn a_cancelled_offer_gives_the_bounty_back() {
    let mut config = quiet();
    config.sharing.split = Split::Bounty;
    let mut town = Town::new(config, 2, 1);
    win(&mut town);
    town.act(0, CourierAction::ShareOrder { order: ORDER, meet: None, bounty: Cents(300) }).unwrap();
    assert_eq!(purse(&town, 0), Cents(9_700));
    town.act(1, CourierAction::GoToMeetPoint { order: ORDER }).unwrap();
    town.act(0, CourierAction::CancelShareOrder { order: ORDER }).unwrap();
    assert_eq!(purse(&town, 0), Cents(10_000));
    assert_eq!(town.task.view(town.couriers[1]).unwrap().errand(), Errand::Idle);
}

#[test]
fn a_scooter_is_paid_mounted_and_fast() {
    let mut town = Town::new(quiet(), 1, 1);
    town.act(0, CourierAction::PurchaseScooter).unwrap();
    assert_eq!(purse(&town, 0), Cents::ZERO);
    town.until("scooter_mounted", 5);
    assert!(town.act(0, CourierAction::PurchaseScooter).is_err(), "one is enough");
    win(&mut town);
    let before = town.task.view(town.couriers[0]).unwrap().energy();
    town.act(0, CourierAction::PickUpOrder { order: ORDER }).unwrap();
    for _ in 0..10 {
        town.step(&[]);
    }
    let speed = town.simulation.world().entity(town.couriers[0]).unwrap().twist.ground_speed();
    assert!((speed - 25.0 / 3.6).abs() < 0.01, "{speed}");
    let spent = before - town.task.view(town.couriers[0]).unwrap().energy();
    assert!(spent < 0.1, "{spent}");
}

#[test]
fn an_exhausted_courier_stops_until_it_drank() {
    let mut config = quiet();
    config.energy.walking = 5.0;
    let mut town = Town::new(config, 1, 1);
    win(&mut town);
    town.act(0, CourierAction::PickUpOrder { order: ORDER }).unwrap();
    town.until("courier_exhausted", 400);
    let at = town.simulation.world().entity(town.couriers[0]).unwrap().planar();
    assert!(town.act(0, CourierAction::PickUpOrder { order: ORDER }).is_err());
    for _ in 0..20 {
        town.step(&[]);
    }
    let now = town.simulation.world().entity(town.couriers[0]).unwrap().planar();
    assert!((now - at).norm() < 0.3, "it stands");
    town.act(0, CourierAction::PurchaseDrinks).unwrap();
    assert_eq!((town.count("courier_recovered"), purse(&town, 0)), (1, Cents(9_500)));
    town.act(0, CourierAction::PickUpOrder { order: ORDER }).unwrap();
}

#[test]
fn rest_alone_brings_an_exhausted_courier_back() {
    let mut config = quiet();
    (config.energy.walking, config.energy.rest) = (5.0, 1.0);
    let mut town = Town::new(config, 1, 1);
    win(&mut town);
    town.act(0, CourierAction::PickUpOrder { order: ORDER }).unwrap();
    town.until("courier_exhausted", 400);
    town.until("courier_recovered", 210);
}

#[test]
fn at_the_store_means_going_there() {
    let mut config = quiet();
    config.prices.shopping = Shopping::AtStore;
    let mut town = Town::new(config, 1, 1);
    town.act(0, CourierAction::PurchaseScooter).unwrap();
    assert_eq!(purse(&town, 0), Cents(10_000), "not there yet");
    town.until("scooter_bought", 600);
    assert_eq!(purse(&town, 0), Cents::ZERO);
}

/// Ground speed of the first courier, m/s.
pub(crate) fn speed(town: &Town) -> f64 {
    town.simulation.world().entity(town.couriers[0]).unwrap().twist.ground_speed()
}

#[test]
fn an_empty_scooter_is_pushed_to_the_station_and_charged_for_money() {
    let mut config = quiet();
    // Enough for some twenty metres.
    config.battery = BatteryConfig { power: Power::Battery, capacity: 0.25, ..BatteryConfig::default() };
    config.initial_money = Cents(20_000);
    let mut town = Town::new(config, 1, 1);
    assert!(town.act(0, CourierAction::SwapBattery).is_err(), "there is no scooter yet");
    town.act(0, CourierAction::PurchaseScooter).unwrap();
    town.until("scooter_mounted", 5);
    assert!(town.act(0, CourierAction::SwapBattery).is_err(), "it is full");
    win(&mut town);
    town.act(0, CourierAction::PickUpOrder { order: ORDER }).unwrap();
    town.until("battery_empty", 100);
    let row = town.task.report().unwrap().couriers[0].clone();
    assert!((row.power - 0.25).abs() < 1e-9, "{} Wh of 0.25 were used", row.power);
    let view = town.task.view(town.couriers[0]).unwrap();
    assert!(view.is_dragging() && !view.is_riding() && view.charge() == Some(0.0));
    let energy = view.energy();
    for _ in 0..10 {
        town.step(&[]);
    }
    assert!((speed(&town) - 0.9).abs() < 1e-9, "{} m/s", speed(&town));
    let spent = energy - town.task.view(town.couriers[0]).unwrap().energy();
    // Half as much again as 112.5 + 112.5 · 0.9² W take for a second, of which 333 W are 0.14 a second.
    let expected = 0.14 * (112.5 + 112.5 * 0.81) / 333.0 * 1.5;
    assert!((spent - expected).abs() < 0.1 * expected, "{spent} for a second of pushing");
    let pushed = town.simulation.world().attached(town.couriers[0], Role::Part).expect("a hand at its bar");
    assert_eq!(town.simulation.world().entity(pushed).unwrap().kind, EntityKind::Scooter);

    let before = purse(&town, 0);
    town.act(0, CourierAction::SwapBattery).unwrap();
    town.until("battery_swapped", 2000);
    assert_eq!(before - purse(&town, 0), Cents(200));
    town.until("scooter_mounted", 5);
    town.act(0, CourierAction::PickUpOrder { order: ORDER }).unwrap();
    town.step(&[]);
    town.step(&[]);
    assert!(speed(&town) > 6.0, "{} m/s", speed(&town));
    assert!(town.task.view(town.couriers[0]).unwrap().charge().unwrap() < 1.0);
}

#[test]
fn couriers_are_told_of_what_is_near_and_wake_for_it_alone() {
    let mut config = quiet();
    config.orders.told_within = 100.0;
    config.orders.initial = 8;
    config.orders.hunger_rate = 1.0;
    config.orders.per_customer_hour = 20.0;
    let mut town = Town::new(config, 4, 1);
    for _ in 0..300 {
        let posted = town.count("order_posted");
        let before: Vec<u64> =
            town.couriers.iter().map(|id| town.task.view(*id).unwrap().notices()).collect();
        town.step(&[]);
        for (who, seen) in town.couriers.iter().zip(before) {
            let view = town.task.view(*who).unwrap();
            let told: Vec<OrderId> = view.open_orders().map(|order| order.id).collect();
            let near = |order: &&simworld_agents::delivery::Order| {
                let open = matches!(order.stage, Stage::Open(_));
                open && (order.pickup.xy() - view.position()).norm() <= 100.0
            };
            let expected: Vec<OrderId> =
                town.task.orders().iter().filter(near).map(|order| order.id).collect();
            assert_eq!(told, expected);
            let new = town.task.orders().iter().filter(near).any(|order| order.id.index() >= posted);
            assert!(!new || view.notices() > seen, "what is new and near wakes");
        }
    }
    assert!(
        town.task.orders().iter().any(|order| (order.pickup.x - 66.0).abs() < 1.0),
        "both restaurants sell"
    );
}

#[test]
fn the_time_runs_out() {
    let mut config = quiet();
    config.steps = 3;
    let mut town = Town::new(config, 1, 1);
    town.step(&[]);
    town.step(&[]);
    assert!(!town.outcome.truncated);
    town.step(&[]);
    assert!(town.outcome.truncated && !town.outcome.terminated);
    assert!(town.task.metrics().iter().all(|metric| metric.value.is_finite()));
}

/// The town with couriers and two streets that meet in a corner: from the restaurants the way to the homes is along them.
fn town_with_streets(couriers: usize) -> (World, Vec<EntityId>, RoadNetwork) {
    let nodes = [(-150.0, 0.0), (150.0, 0.0), (150.0, -200.0)].map(|(x, y)| Point2::new(x, y)).to_vec();
    let streets = vec![Street::simple(0, 1), Street::simple(1, 2)];
    let plan = StreetPlan { nodes, streets, ..StreetPlan::default() };
    let roads = RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap();
    let (mut world, ids) = world(couriers);
    world.set_roads(Arc::new(roads.clone()));
    (world, ids, roads)
}

/// Grown roads make routes longer than the straight line, never shorter.
#[test]
fn routes_follow_sidewalks_where_there_are_roads() {
    let mut config = quiet();
    config.orders.initial = 30;
    let straight = Town::new(config.clone(), 1, 1);
    let (world, couriers, _) = town_with_streets(1);
    let town = Town::within(world, couriers, config, 1);
    let mut longer = 0;
    for (order, other) in town.task.orders().iter().zip(straight.task.orders()) {
        assert!(order.route >= other.route - 1e-9, "{} < {}", order.route, other.route);
        longer += usize::from(order.route > other.route + 1.0);
    }
    assert!(longer > 10, "{longer}");
}

/// As long as a dispatcher would allow: for the ways that there are, not for those that birds have.
#[test]
fn the_time_allowed_is_for_the_way_along_sidewalks() {
    let mut config = quiet();
    config.orders.initial = 12;
    config.capacity = 12;
    let (world, ids, roads) = town_with_streets(1);
    let graph = WaypointGraph::walkable(&roads, &WaypointConfig::default()).unwrap();
    let mut town = Town::within(world, ids, config.clone(), 1);
    let bid = |id| (0, CourierAction::BidOrder { order: OrderId(id), price: Cents(500) }.into());
    town.step(&(0..12).map(bid).collect::<Vec<_>>());
    let here = town.task.view(town.couriers[0]).unwrap().position();
    town.until("order_awarded", 20);
    let mut detours = 0;
    for order in town.task.orders() {
        let Stage::Awarded(awarded) = &order.stage else { continue };
        let there = order.pickup.xy();
        let (from, to) = (graph.nearest(here).unwrap(), graph.nearest(there).unwrap());
        let mut route = Route::default();
        assert!(graph.route(from, to, &mut RouteScratch::default(), &mut route));
        let (first, last) = (graph.waypoint(from).position, graph.waypoint(to).position);
        let walk = (first - here).norm() + route.length + (last - there).norm();
        detours += usize::from(walk > (there - here).norm() + 10.0);
        let allowed = awarded.due - awarded.tick as f64 * 0.1;
        let expected = config.orders.allowance * (walk + order.route) / config.orders.allowance_speed;
        assert!((allowed - expected).abs() < 1e-6, "{allowed:.1} s for {expected:.1} s");
    }
    assert!(detours > 0, "some way is longer than the straight line");
}

/// Couriers without minds of their own, in the town.
fn staffed(couriers: usize) -> (Episode<DeliveryTask>, Vec<EntityId>) {
    let (world, ids) = world(couriers);
    let agent = |id: &EntityId| Agent {
        id: *id,
        mind: Box::new(Silent) as Box<_>,
        planner: Box::new(GrammarPlanner::default()) as Box<_>,
        executor: Box::new(RuleExecutor::straight()) as Box<_>,
    };
    let agents = ids.iter().map(agent).collect();
    let mut config = DeliveryConfig::default();
    config.orders.hunger_rate = 1.0;
    config.auction.window = 1.0;
    let task = DeliveryTask::new(config).unwrap();
    let mut episode = Episode::new(simulation(world, &ids), task, agents, Seed(4)).unwrap();
    episode.set_trail_interval(1);
    (episode, ids)
}

#[test]
fn couriers_at_their_own_pace_deliver_and_the_run_replays() {
    let (episode, ids) = staffed(3);
    let mind = |(index, id): (usize, &EntityId)| -> (EntityId, FreeMind<DeliveryTask>) {
        let stream = Seed(8).stream("minds").indexed(index as u64);
        (*id, Box::new(CourierMind::new(PolicyKind::ALL[0], Persona::default(), stream)))
    };
    let minds = ids.iter().enumerate().map(mind).collect();
    let config =
        AsynchronousConfig { pace: Pace::RealTime { factor: 400.0 }, ..AsynchronousConfig::default() };
    let mut run = AsynchronousEpisode::new(episode, minds, config, DeliveryTask::clone).unwrap();
    let mut delivered = 0;
    for _ in 0..40_000 {
        run.step().unwrap();
        delivered = run.episode().task().report().map_or(0, |report| report.delivered);
        if delivered > 1 {
            break;
        }
    }
    let (live, _) = run.finish();
    assert!(delivered > 1, "{:?}", live.task().report());
    live.task().audit().unwrap();

    let recording = live.recording();
    let (mut again, _) = staffed(3);
    for _ in 0..live.simulation().world().clock().tick().0 {
        again.replay_step(&recording).unwrap();
    }
    assert_eq!(again.trail(), recording.trail);
    assert_eq!(again.task().report(), live.task().report());
}
