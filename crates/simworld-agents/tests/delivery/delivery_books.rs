//! Whatever couriers try, money is conserved at every step and every order is in one state; and the same seed does
//! the same, also across a snapshot.

use crate::delivery_common::{Town, world};
use proptest::prelude::*;
use simworld_agents::delivery::{
    Account, AuctionRule, BatteryConfig, Bid, Cents, CourierAction, DeliveryConfig, DeliveryTask, Ledger,
    OrderId, Persona, PolicyKind, Power, Shopping, Split,
};
use simworld_agents::mind::Mind;
use simworld_core::command::Command;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point2, Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{EntityKind, World};
use simworld_core::seam::{Task, TaskError, TaskOutput};
use simworld_core::seed::{Seed, StreamRng};
use simworld_core::testing::check_task;
use simworld_core::value::Value as Fact;

pub(crate) fn busy() -> DeliveryConfig {
    let mut config = DeliveryConfig::default();
    config.orders.per_customer_hour = 60.0;
    config.auction.window = 3.0;
    config.energy.walking = 0.5;
    config
}

/// The books as the events tell them.
fn told(town: &Town, purse: Cents) -> Ledger {
    let mut ledger = Ledger::new(town.couriers.len(), purse);
    for event in &town.log {
        let EventKind::Task { name, data, .. } = &event.kind else { continue };
        if name == "money_moved" {
            let amount = Cents::from_dollars(data["amount"].as_f64().unwrap()).unwrap();
            ledger.pay(account(town, &data["from"]), account(town, &data["to"]), amount).unwrap();
        }
    }
    ledger
}

fn account(town: &Town, name: &Fact) -> Account {
    match name {
        Fact::Entity(id) => Account::Courier(town.couriers.iter().position(|who| who == id).unwrap()),
        Fact::Text(words) => match words.as_str() {
            "escrow" => Account::Escrow,
            "platform" => Account::Platform,
            "shops" => Account::Shops,
            _ => Account::Customers,
        },
        other => panic!("{other} is no account"),
    }
}

fn any_action() -> impl Strategy<Value = Intent> {
    let order = (0..12u32).prop_map(OrderId);
    let number = prop_oneof![Just(f64::NAN), Just(1e300), -50.0..50.0];
    prop_oneof![
        4 => (order.clone(), -100i64..2500).prop_map(|(order, price)| {
            CourierAction::BidOrder { order, price: Cents(price) }.into()
        }),
        3 => order.clone().prop_map(|order| CourierAction::PickUpOrder { order }.into()),
        3 => order.clone().prop_map(|order| CourierAction::DeliverOrder { order }.into()),
        2 => (order.clone(), any::<bool>(), -1e4..1e4, 0i64..500).prop_map(|(order, at, x, bounty)| {
            let meet = at.then(|| Point2::new(x, 0.0));
            CourierAction::ShareOrder { order, meet, bounty: Cents(bounty) }.into()
        }),
        1 => order.clone().prop_map(|order| CourierAction::CancelShareOrder { order }.into()),
        2 => order.clone().prop_map(|order| CourierAction::GoToMeetPoint { order }.into()),
        1 => Just(CourierAction::PurchaseScooter.into()),
        1 => Just(CourierAction::PurchaseDrinks.into()),
        1 => number.clone().prop_map(|speed| CourierAction::AdjustSpeed { speed }.into()),
        1 => number.prop_map(|x| Intent::call("bid_order").arg("order", 0_i64).arg("price", x)),
        1 => Just(Intent::Words("bring me home".to_owned())),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// `Town::step` audits the books after every step.
    #[test]
    fn the_books_balance_whatever_couriers_try(
        split in prop_oneof![Just(Split::Distance), Just(Split::Equal), Just(Split::Bounty)],
        script in prop::collection::vec((0usize..3, any_action(), 0usize..25), 1..60),
    ) {
        let mut config = busy();
        config.sharing.split = split;
        let purse = config.initial_money;
        let mut town = Town::new(config, 3, 5);
        for (courier, intent, pause) in script {
            town.step(&[(courier, intent)]);
            for _ in 0..pause {
                town.step(&[]);
            }
        }
        prop_assert_eq!(Some(&told(&town, purse)), town.task.ledger());
    }

    /// Against a search of all bids, written anew from the words of the rules.
    #[test]
    fn an_auction_is_what_its_rule_says(
        bids in prop::collection::vec((1i64..40, 0u64..4), 1..12),
        ceiling in 40i64..60,
        draw in any::<u64>(),
    ) {
        let bids: Vec<Bid> = bids
            .iter()
            .enumerate()
            .map(|(courier, (price, tick))| Bid { courier, price: Cents(*price), tick: *tick })
            .collect();
        let ceiling = Cents(ceiling);
        let mut rng = Seed(draw).stream("test/lots").rng();
        let mut sorted = bids.clone();
        sorted.sort_by_key(|bid| (bid.price, bid.tick));
        let first = AuctionRule::FirstPrice.auction().award(ceiling, &bids, &mut rng).unwrap();
        let second = AuctionRule::Vickrey.auction().award(ceiling, &bids, &mut rng).unwrap();
        for award in [&first, &second] {
            let winner = bids[award.bid];
            prop_assert_eq!((winner.price, winner.tick), (sorted[0].price, sorted[0].tick));
        }
        prop_assert_eq!(first.pay, sorted[0].price);
        prop_assert_eq!(second.pay, sorted.get(1).map_or(ceiling, |bid| bid.price));
        // To ask for another price than one's own never pays in a Vickrey auction.
        let gain = |asked: i64, rng: &mut StreamRng| {
            let mut others = bids.clone();
            others[0].price = Cents(asked);
            let award = AuctionRule::Vickrey.auction().award(ceiling, &others, rng).unwrap();
            if award.bid == 0 { award.pay.0 - bids[0].price.0 } else { 0 }
        };
        let (lower, higher) = (gain(bids[0].price.0 - 1, &mut rng), gain(bids[0].price.0 + 3, &mut rng));
        let honest = gain(bids[0].price.0, &mut rng);
        prop_assert!(lower <= honest && higher <= honest, "{} and {} against {}", lower, higher, honest);
        let softmin = AuctionRule::Softmin { temperature: 0.1 }.auction();
        let award = softmin.award(ceiling, &bids, &mut rng).unwrap();
        prop_assert_eq!(award.pay, bids[award.bid].price);
    }

    #[test]
    fn any_settings_are_refused_or_played(
        steps in prop_oneof![1u64..100, any::<u64>()],
        capacity in 0u32..5,
        money in any::<i64>(),
        sane in prop::collection::vec(0.2f64..1.0, 8),
        (which, wild) in (0usize..16, any::<f64>()),
        at_store in any::<bool>(),
    ) {
        let mut numbers = sane;
        if let Some(number) = numbers.get_mut(which) {
            *number = wild; // in half of the cases all are in range
        }
        let mut config = DeliveryConfig { steps, capacity, ..DeliveryConfig::default() };
        config.initial_money = if which == 9 { Cents(money) } else { Cents(money.rem_euclid(20_000)) };
        config.orders.hunger_rate = numbers[0];
        config.orders.least_factor = numbers[1];
        config.energy.rest = numbers[2];
        config.energy.body = numbers[3] * 100.0;
        config.speed.slowest = numbers[4];
        config.prices.volatility = numbers[5];
        config.auction.window = numbers[6];
        config.auction.rule = AuctionRule::Softmin { temperature: numbers[7] };
        config.prices.shopping = if at_store { Shopping::AtStore } else { Shopping::Anywhere };
        if config.validate().is_ok() {
            let mut town = Town::new(config, 2, 1);
            play(&mut town, &mut minds(2), 50);
        } else {
            prop_assert!(DeliveryTask::new(config).is_err());
        }
    }

    #[test]
    fn foreign_bytes_are_refused_without_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let mut task = DeliveryTask::new(DeliveryConfig::default()).unwrap();
        let _ = task.restore(&bytes);
        let mut mind = minds(1).remove(0);
        let _ = mind.restore(&bytes);
    }
}

pub(crate) fn minds(count: usize) -> Vec<Box<dyn Mind<DeliveryTask>>> {
    let stream = Seed(3).stream("test/minds");
    let kind = |index: usize| PolicyKind::ALL[index % 12];
    let bold = Persona { openness: 0.8, agreeableness: 1.0, ..Persona::default() };
    (0..count).map(|index| kind(index).mind(bold, stream.indexed(index as u64))).collect()
}

pub(crate) fn play(town: &mut Town, minds: &mut [Box<dyn Mind<DeliveryTask>>], steps: usize) {
    for _ in 0..steps {
        let mut intents = Vec::new();
        for (index, mind) in minds.iter_mut().enumerate() {
            let mut wanted = Vec::new();
            let who = town.couriers[index];
            mind.decide(&town.task, town.simulation.world(), who, &mut wanted).unwrap();
            intents.extend(wanted.into_iter().map(|intent| (index, intent)));
        }
        town.step(&intents);
    }
}

/// How often each bid wins, against the sums of the formula.
#[test]
fn softmin_draws_by_its_weights() {
    let prices = [500, 520, 560, 700];
    let bids: Vec<Bid> = prices
        .iter()
        .enumerate()
        .map(|(courier, price)| Bid { courier, price: Cents(*price), tick: 0 })
        .collect();
    let temperature = 0.5;
    let weights =
        prices.map(|price| simworld_core::ops::exp(-(f64::from(price as i32) / 100.0) / temperature));
    let whole: f64 = weights.iter().sum();
    let auction = AuctionRule::Softmin { temperature }.auction();
    let (mut wins, draws) = ([0.0; 4], 20_000_u32);
    for draw in 0..draws {
        let mut rng = Seed(5).stream("test/softmin").indexed(u64::from(draw)).rng();
        wins[auction.award(Cents(1000), &bids, &mut rng).unwrap().bid] += 1.0;
    }
    for (won, weight) in wins.iter().zip(weights) {
        let share = weight / whole;
        let deviation = (share * (1.0 - share) / f64::from(draws)).sqrt();
        assert!((won / f64::from(draws) - share).abs() < 4.5 * deviation, "{wins:?} against {weights:?}");
    }
}

/// Any action, about any order, at any price.
fn at_random(rng: &mut StreamRng, orders: usize) -> Intent {
    let latest = orders.saturating_sub(rng.below(12) + 1);
    let order = OrderId(latest as u32);
    let bounty = Cents(if rng.chance(0.3) { rng.below(400) as i64 } else { 0 });
    match rng.below(24) {
        0..8 => CourierAction::BidOrder { order, price: Cents(rng.below(2500) as i64 - 50) }.into(),
        8..11 => CourierAction::PickUpOrder { order }.into(),
        11..14 => CourierAction::DeliverOrder { order }.into(),
        14 | 15 => CourierAction::ShareOrder { order, meet: None, bounty }.into(),
        16 => CourierAction::CancelShareOrder { order }.into(),
        17 | 18 => CourierAction::GoToMeetPoint { order }.into(),
        19 => CourierAction::PurchaseScooter.into(),
        20 => CourierAction::PurchaseDrinks.into(),
        21 => CourierAction::SwapBattery.into(),
        22 => CourierAction::AdjustSpeed { speed: rng.uniform(-1.0, 9.0) }.into(),
        _ => Intent::call("bid_order").arg("order", 0_i64).arg("price", f64::NAN),
    }
}

/// Things go missing, bodies are moved, plans fail.
fn fault(town: &mut Town, rng: &mut StreamRng) {
    let kinds = [EntityKind::Parcel, EntityKind::Scooter];
    let world = town.simulation.world();
    let things: Vec<EntityId> =
        world.iter().filter(|thing| kinds.contains(&thing.kind)).map(|thing| thing.id).collect();
    let courier = *rng.choose(&town.couriers).unwrap();
    match rng.below(3) {
        0 => {
            if let Some(id) = rng.choose(&things) {
                town.simulation.submit(Command::Remove { id: *id });
            }
        }
        1 => {
            let pose = pose_facing(Point3::new(rng.uniform(-90.0, 90.0), rng.uniform(-90.0, 60.0), 0.0), 0.0);
            town.simulation.submit(Command::Move { id: courier, pose });
        }
        _ => town.fail_plan(courier),
    }
}

/// `Town::step` audits money and lists of orders after every step. A million ticks under `SIMWORLD_SOAK=1`.
#[test]
fn the_books_balance_for_a_million_ticks_of_random_policies_and_faults() {
    let (towns, ticks) = if std::env::var_os("SIMWORLD_SOAK").is_some() { (50, 20_000) } else { (2, 5000) };
    let mut ended = [0, 0, 0];
    for seed in 0..towns {
        let mut config = busy();
        config.orders.per_customer_hour = 2.0;
        config.sharing.split = [Split::Distance, Split::Equal, Split::Bounty][seed as usize % 3];
        config.orders.told_within = if seed % 2 == 0 { 1e6 } else { 120.0 };
        config.battery = BatteryConfig { power: Power::Battery, capacity: 2.0, ..BatteryConfig::default() };
        config.steps = ticks + 1;
        let mut town = Town::new(config, 6, seed);
        let mut rng = Seed(seed).stream("test/random").rng();
        let mut players = minds(3);
        for _ in 0..ticks {
            let mut intents = Vec::new();
            for (index, mind) in players.iter_mut().enumerate() {
                let mut wanted = Vec::new();
                mind.decide(&town.task, town.simulation.world(), town.couriers[index], &mut wanted).unwrap();
                intents.extend(wanted.into_iter().map(|intent| (index, intent)));
            }
            for index in 3..6 {
                if rng.chance(0.05) {
                    intents.push((index, at_random(&mut rng, town.task.orders().len())));
                }
            }
            if rng.chance(0.005) {
                fault(&mut town, &mut rng);
            }
            town.step(&intents);
            town.log.clear();
        }
        let report = town.task.report().unwrap();
        ended[0] += report.delivered;
        ended[1] += report.expired;
        ended[2] += report.couriers.iter().map(|row| row.handed_over).sum::<u32>();
    }
    println!(
        "{} ticks: {} delivered, {} expired, {} handed over",
        towns * ticks,
        ended[0],
        ended[1],
        ended[2]
    );
    assert!(ended[0] > 10 && ended[1] > 0, "{ended:?}");
}

#[test]
fn policies_deliver_and_balance_the_books() {
    let mut town = Town::new(DeliveryConfig::default(), 12, 7);
    play(&mut town, &mut minds(12), 5000);
    let report = town.task.report().unwrap();
    println!("{:#?}", town.task.metrics());
    for (row, kind) in report.couriers.iter().zip(PolicyKind::ALL) {
        println!(
            "{kind:>18} {:>8} won {} delivered {} refused {}",
            row.profit, row.won, row.delivered, row.refused
        );
    }
    assert!(report.delivered >= 12, "{} delivered", report.delivered);
    assert!(report.delivered * 10 >= report.awarded * 6, "{} of {}", report.delivered, report.awarded);
    let refused: u32 = report.couriers.iter().map(|row| row.refused).sum();
    assert!(refused <= 20, "{refused} of their own intents were refused");
    let bids = |kind| report.couriers[PolicyKind::ALL.iter().position(|k| *k == kind).unwrap()].bids;
    assert!(bids(PolicyKind::NearlyInactive) < bids(PolicyKind::Lowballer));
}

#[test]
fn the_same_seed_does_the_same_and_another_does_not() {
    let run = |seed| {
        let mut town = Town::new(busy(), 4, seed);
        play(&mut town, &mut minds(4), 600);
        (town.log, town.task.save())
    };
    assert_eq!(run(7), run(7));
    assert_ne!(run(7).0, run(8).0);
}

#[test]
fn a_saved_episode_goes_on_as_if_it_had_not_stopped() {
    let mut town = Town::new(busy(), 4, 7);
    let mut players = minds(4);
    play(&mut town, &mut players, 400);
    let (saved, brains) = (town.save(), players.iter().map(Mind::save).collect::<Vec<_>>());
    play(&mut town, &mut players, 400);

    let mut resumed = Town::resume(busy(), 4, saved);
    let mut others = minds(4);
    for (mind, saved) in others.iter_mut().zip(&brains) {
        assert!(mind.restore(saved));
    }
    play(&mut resumed, &mut others, 400);
    assert_eq!(resumed.task.save(), town.task.save());
    assert!(town.log.ends_with(&resumed.log));
    let mut other = DeliveryTask::new(DeliveryConfig::default()).unwrap();
    assert!(!other.restore(&town.task.save()), "saved under other settings");
}

#[test]
fn the_task_conforms() {
    let (world, couriers) = world(3);
    check_task(|| Box::new(DeliveryTask::new(busy()).unwrap()), &world, &couriers);
}

#[test]
fn a_scene_without_restaurants_is_refused_with_a_hint() {
    let (_, couriers) = world(1);
    let mut task = DeliveryTask::new(DeliveryConfig::default()).unwrap();
    let error = task.reset(&World::new(), &couriers, Seed(1), &mut TaskOutput::default()).unwrap_err();
    assert!(matches!(&error, TaskError::Scene { missing, .. } if missing == "restaurant"), "{error}");
}
