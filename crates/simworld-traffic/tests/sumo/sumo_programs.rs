//! Signals whose programs follow their vehicles: greens last as long as somebody comes, within the bounds of the file.

use std::sync::Arc;

use simworld_core::hash::StateHash;
use simworld_core::id::IntersectionId;
use simworld_core::seed::Seed;
use simworld_traffic::signal::FixedTime;
use simworld_traffic::sumo::{SumoDemand, SumoError, SumoNet};
use simworld_traffic::{Traffic, TrafficConfig};

const GRID: &str = include_str!("data/grid.net.xml");

/// Bounds of all long greens, s.
const BOUNDS: (f64, f64) = (7.0, 40.0);

/// The grid with actuated programs: long greens have bounds, all other phases last as before.
fn actuated() -> String {
    let lines = GRID.lines().map(|line| {
        let is_long = ["42", "37"].iter().any(|green| line.contains(&format!("<phase duration=\"{green}\"")));
        if is_long { line.replace("<phase ", &bounded()) } else { line.to_owned() }
    });
    lines.collect::<Vec<_>>().join("\n").replace(r#"type="static""#, r#"type="actuated""#)
}

/// The beginning of a phase with bounds.
fn bounded() -> String {
    format!("<phase minDur=\"{}\" maxDur=\"{}\" ", BOUNDS.0, BOUNDS.1)
}

/// How long each stage of the junction A0 showed green, s, and which it was, while a demand drives for ten minutes.
fn greens(net: &str, demand: &str) -> Vec<(usize, f64)> {
    let net = SumoNet::read(net.as_bytes()).unwrap();
    assert!(net.warnings.is_empty(), "{:?}", net.warnings);
    let demand = SumoDemand::read(demand.as_bytes()).unwrap();
    let (mut schedule, _) = demand.schedule(&net, Seed(2)).unwrap();
    let is_a0 = |index: &usize| net.names.junction(IntersectionId::from_index(*index)) == "A0";
    let place = (0..net.network.intersections.len()).find(is_a0).unwrap();
    let plan = net.network.intersections[place].signals.unwrap() as usize;
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, join_nearer: 0.0, ..TrafficConfig::default() };
    let programs = net.programs.clone();
    let mut traffic = Traffic::new(Arc::new(net.network), &config, Seed(2)).unwrap();
    traffic.set_policy(Box::new(programs));
    let mut greens = Vec::new();
    let mut before = traffic.stage(plan).unwrap();
    for _ in 0..6000 {
        schedule.feed(&mut traffic).unwrap();
        traffic.step(0.1);
        let shown = traffic.stage(plan).unwrap();
        if !before.is_ending && (shown.is_ending || shown.stage != before.stage) {
            greens.push((before.stage, before.elapsed));
        }
        before = shown;
    }
    greens
}

const NOBODY: &str = "<routes/>";

#[test]
fn a_green_for_which_nobody_comes_is_the_shortest() {
    let greens = greens(&actuated(), NOBODY);
    assert!(greens.len() > 50, "{greens:?}");
    // The first stage, the second with its people, and the second alone, which has no bounds and lasts 5 s.
    let expected = [BOUNDS.0, BOUNDS.0, 5.0];
    for (stage, shown) in &greens {
        assert!((shown - expected[*stage]).abs() < 0.25, "stage {stage} showed {shown} s: {greens:?}");
    }
}

#[test]
fn a_green_for_which_vehicles_come_goes_on_and_ends_at_its_longest() {
    let flow = |id: u32, per_hour: u32| {
        format!(
            r#"<flow id="{id}" begin="0" end="600" vehsPerHour="{per_hour}"><route edges="A1A0 A0B0"/></flow>"#
        )
    };
    let shown = |flows: &str| {
        let greens = greens(&actuated(), &format!("<routes>{flows}</routes>"));
        let mean = |stage: usize| {
            let of_stage: Vec<f64> =
                greens.iter().filter(|green| green.0 == stage).map(|green| green.1).collect();
            of_stage.iter().sum::<f64>() / of_stage.len() as f64
        };
        assert!(greens.iter().all(|green| green.1 < BOUNDS.1 + 0.25), "{greens:?}");
        let longest = greens.iter().map(|green| green.1).fold(0.0, f64::max);
        (mean(0), mean(1), longest)
    };
    let (light, heavy) = (shown(&flow(0, 200)), shown(&format!("{}{}", flow(0, 1800), flow(1, 1800))));
    // One of the two stages serves who turns from A1 to B0, the other nobody.
    let (served, idle) = if heavy.0 > heavy.1 { (heavy.0, heavy.1) } else { (heavy.1, heavy.0) };
    assert!((idle - BOUNDS.0).abs() < 0.25, "nobody asks for {idle} s");
    assert!(served > 3.0 * BOUNDS.0, "a queue is served for {served} s");
    assert!(heavy.2 > BOUNDS.1 - 0.25, "the longest green is of {} s", heavy.2);
    assert!(light.0.max(light.1) < served - 10.0, "few vehicles are served for {light:?} s");
}

#[test]
fn programs_by_the_clock_are_fixed_time() {
    let run = |by_file: bool| {
        let net = SumoNet::read(GRID.as_bytes()).unwrap();
        let programs = net.programs.clone();
        assert_eq!(programs.actuated(), 0);
        let mut traffic = Traffic::new(Arc::new(net.network), &TrafficConfig::default(), Seed(6)).unwrap();
        if by_file {
            traffic.set_policy(Box::new(programs));
        } else {
            traffic.set_policy(Box::new(FixedTime));
        }
        for _ in 0..1500 {
            traffic.step(0.1);
        }
        traffic.digest()
    };
    assert_eq!(run(true), run(false));
}

#[test]
fn gaps_and_bounds_are_read_or_refused() {
    let first = r#"<phase duration="42" state="GGrrr"/>"#;
    let with = |phase: &str| {
        SumoNet::read(actuated().replacen(&first.replace("<phase ", &bounded()), phase, 1).as_bytes())
    };
    let broken = with(r#"<phase duration="42" minDur="9" maxDur="8" state="GGrrr"/>"#);
    assert!(matches!(broken, Err(SumoError::Attribute { attribute: "minDur", .. })), "{broken:?}");
    let broken = with(r#"<phase duration="42" minDur="-1" state="GGrrr"/>"#);
    assert!(broken.unwrap_err().to_string().contains("minDur"));
    // With a gap of a minute every green that once had somebody goes on to its end.
    let patient = actuated().replace(
        r#"<tlLogic id="A0" type="actuated" programID="0" offset="0">"#,
        r#"<tlLogic id="A0" type="actuated" programID="0" offset="0"><param key="max-gap" value="60"/>"#,
    );
    let flow = r#"<routes><flow id="f" begin="0" end="600" vehsPerHour="200"><route edges="A1A0 A0B0"/></flow></routes>"#;
    let longest = |net: &str| greens(net, flow).iter().map(|green| green.1).fold(0.0, f64::max);
    assert!(longest(&patient) > BOUNDS.1 - 0.25 && longest(&actuated()) < BOUNDS.1 - 5.0);
}
