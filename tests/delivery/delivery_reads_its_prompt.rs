//! A script that knows nothing but its prompt and its schema works about as well as the policy after which it was written: prompts
//! tell what a courier needs to know, and what is offered can be done.

use simworld_agents::delivery::{DeliveryReport, PolicyKind};
use simworld_core::seed::Seed;
use simworld_examples::delivery::{
    Assembly, Brain, RunConfig, Thinkers, assemble, assemble_with, make_city, reader,
};

fn played(mut assembly: Assembly) -> (DeliveryReport, Option<Thinkers>) {
    while !assembly.episode.is_over() {
        assembly.episode.step().unwrap();
    }
    (assembly.episode.task().report().unwrap(), assembly.thinkers)
}

fn sum(report: &DeliveryReport, figure: fn(&simworld_agents::delivery::CourierRow) -> u32) -> u32 {
    report.couriers.iter().map(figure).sum()
}

#[test]
fn who_reads_its_prompt_delivers_about_as_much_as_who_is_told_all() {
    let mut config = RunConfig {
        steps: 5000,
        vehicles: 0,
        pedestrians: 0,
        policies: vec![Brain::Model],
        ..RunConfig::default()
    };
    config.model.thinking.latency = 1.0;
    let (city, _) = make_city(&config).unwrap();
    let thinkers = Thinkers::with_backend(&config.model, Seed(1), || Ok(reader())).unwrap();
    let (read, thinkers) = played(assemble_with(&config, &city, Seed(1), Some(thinkers)).unwrap());
    let usage = thinkers.unwrap().usage(config.steps);
    config.policies = vec![Brain::Policy(PolicyKind::ValueDensity)];
    let (told, _) = played(assemble(&config, &city, Seed(1)).unwrap());

    assert!(told.delivered >= 15, "{} delivered by the policy", told.delivered);
    let least = f64::from(told.delivered) * 0.7;
    assert!(f64::from(read.delivered) >= least, "{} of {} delivered", read.delivered, told.delivered);
    // Auctions that end before the answer comes are not offered, and nothing else is that cannot be done.
    let (refused, bids) = (sum(&read, |row| row.refused), sum(&read, |row| row.bids));
    assert!(refused * 20 <= bids, "{refused} refused beside {bids} bids");
    assert!(usage.requests * 50 <= usage.paper_requests, "{} requests", usage.requests);
}
