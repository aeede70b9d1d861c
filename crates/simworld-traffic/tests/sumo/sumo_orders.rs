//! Signals whose phases name those that follow: by the clock the first of them, and whichever vehicles ask for.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::id::IntersectionId;
use simworld_core::net::Aspect;
use simworld_core::seed::Seed;
use simworld_traffic::sumo::{SumoDemand, SumoError, SumoNet};
use simworld_traffic::{Traffic, TrafficConfig};

const GRID: &str = include_str!("data/grid.net.xml");

/// The grid with another program at A0: links 0 and 1 lead from A1 to B0, 2 and 3 back, and people cross by 4.
fn grid(attributes: &str, phases: &[&str]) -> String {
    let begin = GRID.find(r#"<tlLogic id="A0""#).unwrap();
    let end = begin + GRID[begin..].find("</tlLogic>").unwrap();
    let phases = phases.iter().fold(String::new(), |all, phase| all + &format!("<phase {phase}/>"));
    format!(r#"{}<tlLogic id="A0" programID="0" {attributes}>{phases}{}"#, &GRID[..begin], &GRID[end..])
}

fn read(attributes: &str, phases: &[&str]) -> SumoNet {
    SumoNet::read(grid(attributes, phases).as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

fn refused(attributes: &str, phases: &[&str]) -> SumoError {
    SumoNet::read(grid(attributes, phases).as_bytes()).map(|_| ()).unwrap_err()
}

fn warnings(net: &SumoNet) -> Vec<String> {
    net.warnings.iter().map(ToString::to_string).collect()
}

/// What links 0, 2 and 4 show in the middle of every second.
fn shown(net: SumoNet, demand: &str, seconds: usize) -> Vec<String> {
    let demand = SumoDemand::read(demand.as_bytes()).unwrap();
    let (mut schedule, _) = demand.schedule(&net, Seed(2)).unwrap();
    let SumoNet { network, names, programs, .. } = net;
    let lane = |name: &str| names.lane_id(name).unwrap();
    let way = |from: &str, to: &str| {
        let found = network.connections.iter().find(|way| (way.from, way.to) == (lane(from), lane(to)));
        found.unwrap().signal.unwrap().index()
    };
    let is_a0 = |place: &IntersectionId| names.junction(*place) == "A0";
    let crossing = network.crossings.iter().find(|crossing| is_a0(&crossing.intersection)).unwrap();
    let groups = [way("A1A0_1", "A0B0_1"), way("B0A0_1", "A0A1_1"), crossing.signal.unwrap().index()];
    let config = TrafficConfig {
        vehicles: 0,
        pedestrians: 0,
        join_nearer: 0.0,
        types: demand.vehicle_types(),
        ..TrafficConfig::default()
    };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(2)).unwrap();
    traffic.set_policy(Box::new(programs));
    let letter = |aspect: Aspect| match aspect {
        Aspect::Green => 'G',
        Aspect::Yellow => 'y',
        Aspect::Red => 'r',
    };
    let mut shown = Vec::new();
    for step in 0..10 * seconds {
        schedule.feed(&mut traffic).unwrap();
        traffic.step(0.1);
        if step % 10 == 4 {
            shown.push(groups.iter().map(|group| letter(traffic.signals()[*group])).collect());
        }
    }
    shown
}

/// How often each state began, and for how many seconds in all it was shown.
fn counted(shown: &[String]) -> BTreeMap<&str, (usize, usize)> {
    let mut counts: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for (index, state) in shown.iter().enumerate() {
        let count = counts.entry(state).or_default();
        count.0 += usize::from(index == 0 || shown[index - 1] != *state);
        count.1 += 1;
    }
    counts
}

const NOBODY: &str = "<routes/>";

/// A phase that comes once, three that never come, and a cycle of 1, 2, 5 and 7.
const CLOCK: [&str; 8] = [
    r#"duration="4" state="rrrrr""#,
    r#"duration="10" state="GGrrr""#,
    r#"duration="3" state="yyrrr" next="5""#,
    r#"duration="8" state="rrrrG""#,
    r#"duration="2" state="rrrrr""#,
    r#"duration="12" state="rrGGr" next="7 3""#,
    r#"duration="5" state="rryyr""#,
    r#"duration="3" state="rryyr" next="1""#,
];

#[test]
fn by_the_clock_the_first_that_is_named_follows() {
    // The letters of a cycle, and where in it one is when it begins after the first phase.
    let cycle = [("Grr", 10), ("yrr", 3), ("rGr", 12), ("ryr", 3)];
    let cycle: Vec<&str> = cycle.iter().flat_map(|(state, count)| vec![*state; *count]).collect();
    // The offset finds the first phase by the clock of all phases of the file. Then: when phase 1 begins, s, which phases come at the
    // start alone, and which never.
    for (offset, begins, first, never) in [
        (0, 4, "0", "3, 4, 6"),
        (-2, 2, "0", "3, 4, 6"),
        (3, 3, "", "0, 3, 4, 6"),
        (-6, 28 - 2, "", "0, 3, 4, 6"),
        (-29, 28 - 13 - 2, "", "0, 3, 4, 6"),
        (-46, 1, "", "0, 3, 4, 6"),
        (-20, 5 + 2 + 28 - 13, "3, 4", "0, 6"),
    ] {
        let net = read(&format!(r#"type="static" offset="{offset}""#), &CLOCK);
        assert_eq!(net.programs.actuated(), 0);
        let mut wanted = vec![format!("tlLogic `A0` has phases that follow no other: {never} are left out")];
        if !first.is_empty() {
            wanted.insert(
                0,
                format!("tlLogic `A0` has phases that come at the start alone: {first} are left out"),
            );
        }
        assert_eq!(warnings(&net), wanted, "offset {offset}");
        let shown = shown(net, NOBODY, 120);
        for (second, state) in shown.iter().enumerate().skip(8) {
            let expected = cycle[(second + 28 - begins) % 28];
            assert_eq!(state, expected, "offset {offset}, second {second}: {shown:?}");
        }
    }
}

#[test]
fn phases_that_are_not_there_are_refused_by_name() {
    for (next, what) in [("9", "phase 9"), ("1 8", "phase 8"), ("-1", "no number"), ("a", "no number")] {
        let mut phases = CLOCK;
        let phase = format!(r#"duration="3" state="yyrrr" next="{next}""#);
        phases[2] = &phase;
        let error = refused(r#"type="static" offset="0""#, &phases);
        assert!(matches!(error, SumoError::Attribute { attribute: "next", .. }), "{error:?}");
        assert!(error.to_string().contains(what), "{error}");
    }
    // A number of the file, though phases without duration are left out.
    let phases = [
        r#"duration="10" state="GGrrr" next="1""#,
        r#"duration="0" state="yyrrr" next="3""#,
        r#"duration="9" state="rrrrG""#,
        r#"duration="3" state="yyrrr" next="5""#,
        r#"duration="0" state="rrrrr""#,
        r#"duration="8" state="rrGGr" next="0""#,
    ];
    let shown = shown(read(r#"type="static" offset="0""#, &phases), NOBODY, 42);
    let counts = counted(&shown);
    assert_eq!(counts.into_iter().collect::<Vec<_>>(), [("Grr", (2, 20)), ("rGr", (2, 16)), ("yrr", (2, 6))]);
    // Only yellow comes again and again.
    let net = read(
        r#"type="static" offset="0""#,
        &[r#"duration="10" state="GGGGr""#, r#"duration="3" state="yyyyr" next="1""#],
    );
    assert!(warnings(&net).iter().any(|warning| warning.contains("without signals")), "{:?}", net.warnings);
}

#[test]
fn a_green_that_comes_again_after_its_own_red_does_come_again() {
    let phases =
        [r#"duration="10" state="GGGGr""#, r#"duration="3" state="yyyyr""#, r#"duration="7" state="rrrrr""#];
    for kind in ["static", "actuated"] {
        let net = read(&format!(r#"type="{kind}" offset="0""#), &phases);
        assert!(net.warnings.is_empty(), "{:?}", net.warnings);
        let shown = shown(net, NOBODY, 100);
        let expected = [("GGr", (5, 50)), ("rrr", (5, 35)), ("yyr", (5, 15))];
        assert_eq!(counted(&shown).into_iter().collect::<Vec<_>>(), expected, "{kind}: {shown:?}");
    }
}

/// Stages for A1, for B0 and for people, each of which may be followed by both others.
const CHOICE: [&str; 9] = [
    r#"minDur="5" maxDur="25" duration="9" state="GGrrr" next="1 3""#,
    r#"duration="3" state="yyrrr" next="2""#,
    r#"minDur="5" maxDur="25" duration="9" state="rrGGr" next="5 6""#,
    r#"duration="3" state="yyrrr" next="4""#,
    r#"duration="8" state="rrrrG" next="7 8""#,
    r#"duration="3" state="rryyr" next="4""#,
    r#"duration="3" state="rryyr" next="0""#,
    r#"duration="2" state="rrrrr" next="0""#,
    r#"duration="2" state="rrrrr" next="2""#,
];

const ACTUATED: &str = r#"type="actuated" offset="0""#;

fn flow(id: &str, edges: &str, per_hour: u32) -> String {
    format!(r#"<flow id="{id}" begin="0" end="900" vehsPerHour="{per_hour}"><route edges="{edges}"/></flow>"#)
}

#[test]
fn vehicles_choose_the_phase_that_follows() {
    let net = || read(ACTUATED, &CHOICE);
    assert!(net().warnings.is_empty(), "{:?}", net().warnings);
    // Nobody: the first that are named, each for its shortest time; 5, 3, 5, 3, 8 and 2 s.
    let alone = shown(net(), NOBODY, 26 * 10);
    let counts = counted(&alone);
    let states = ["Grr", "yrr", "rGr", "ryr", "rrG", "rrr"];
    let seconds = [5, 3, 5, 3, 8, 2];
    for (state, seconds) in states.iter().zip(seconds) {
        let (times, all) = counts[state];
        assert!((9..=11).contains(&times) && all.abs_diff(seconds * times) <= 10, "{state}: {counts:?}");
    }
    // What SUMO 1.28.0 shows with these files from 60 s to 600 s and in all of 900 s, with vehicles on the lane with most room: times and
    // seconds of green for A1, B0 and people.
    let both = |b: u32, a: u32| format!("{}{}", flow("f", "B0A0 A0A1", b), flow("g", "A1A0 A0B0", a));
    for (flows, from, until, sumo) in [
        (flow("f", "B0A0 A0A1", 500), 60, 600, [(0, 0), (27, 198), (27, 210)]),
        (flow("f", "B0A0 A0A1", 1200), 60, 600, [(0, 0), (16, 339), (16, 123)]),
        (both(600, 400), 0, 900, [(50, 284), (49, 322), (0, 0)]),
        (both(1200, 600), 0, 900, [(27, 203), (27, 538), (0, 0)]),
    ] {
        let shown = shown(net(), &format!("<routes>{flows}</routes>"), until);
        let counts = counted(&shown[from..]);
        for (state, (times, seconds)) in ["Grr", "rGr", "rrG"].into_iter().zip(sumo) {
            let ours = counts.get(state).copied().unwrap_or_default();
            let is_near =
                ours.0.abs_diff(times) <= 1 + times / 10 && ours.1.abs_diff(seconds) <= 8 + seconds / 10;
            assert!(is_near, "{state} {ours:?}, SUMO's {times} and {seconds}: {counts:?}");
        }
    }
}

#[test]
fn a_phase_that_names_itself_first_goes_on_for_nobody() {
    let mut phases = CHOICE;
    phases[0] = r#"minDur="5" maxDur="25" duration="9" state="GGrrr" next="0 1 3""#;
    let rests = shown(read(ACTUATED, &phases), NOBODY, 200);
    assert_eq!(counted(&rests).into_iter().collect::<Vec<_>>(), [("Grr", (1, 200))]);
    let flow = format!("<routes>{}</routes>", flow("f", "B0A0 A0A1", 60));
    let shown = shown(read(ACTUATED, &phases), &flow, 900);
    let counts = counted(&shown);
    assert!((8..=15).contains(&counts["rGr"].0), "once for each vehicle: {counts:?}");
    assert!(counts["Grr"].1 > 300, "and it rests again: {counts:?}");
}

#[test]
fn odd_choices_are_told_of() {
    let mut phases = CHOICE;
    phases[7] = r#"duration="2" state="rrrrr" next="7""#;
    phases[8] = r#"duration="2" state="rrrrr" next="8""#;
    let net = read(ACTUATED, &phases);
    assert!(warnings(&net).iter().any(|warning| warning.contains("without signals")), "{:?}", net.warnings);
    phases = CHOICE;
    phases[3] = r#"duration="3" state="yyrrr" next="7""#;
    phases[5] = r#"duration="3" state="rryyr" next="0""#;
    let net = read(ACTUATED, &phases);
    assert!(warnings(&net).iter().any(|warning| warning.contains("no other: 4, 8")), "{:?}", net.warnings);
    phases[0] = r#"minDur="5" maxDur="25" duration="9" state="GGrrr" next="1 4""#;
    phases[7] = r#"duration="2" state="rrrrr" next="7""#;
    phases[4] = r#"duration="8" state="rrrrG" next="7 7""#;
    let net = read(ACTUATED, &phases);
    assert!(warnings(&net).iter().any(|warning| warning.contains("phase 4 for ever")), "{:?}", net.warnings);
    phases = CHOICE;
    phases[2] = r#"minDur="5" duration="9" state="rrGGr" next="5 6" earlyTarget="x""#;
    let net = read(ACTUATED, &phases);
    assert!(warnings(&net).iter().any(|warning| warning.contains("conditions")), "{:?}", net.warnings);
    // The corner A2 has as many links.
    let shared = grid(ACTUATED, &CHOICE).replace(r#"tl="A2""#, r#"tl="A0""#);
    let net = SumoNet::read(shared.as_bytes()).unwrap();
    assert!(warnings(&net).iter().any(|warning| warning.contains("is of 2 junctions")), "{:?}", net.warnings);
    let many: Vec<String> = (0..600)
        .map(|phase| {
            format!(r#"duration="9" state="GGrrr" next="{} {}""#, (phase + 1) % 600, (phase + 2) % 600)
        })
        .collect();
    let many: Vec<&str> = many.iter().map(String::as_str).collect();
    assert!(matches!(refused(ACTUATED, &many), SumoError::TooMuch { limit: 512, .. }));
}

/// Stages for A1 and for B0 that go on while somebody has lost time.
fn delayed(parameters: &str) -> SumoNet {
    let attributes =
        format!(r#"type="delay_based" offset="0">{parameters}<phase duration="0" state="rrrrr"/"#);
    let phases = [
        r#"minDur="5" maxDur="25" duration="9" state="GGrrr""#,
        r#"duration="3" state="yyrrr""#,
        r#"minDur="5" maxDur="25" duration="9" state="rrGGr""#,
        r#"duration="3" state="rryyr""#,
    ];
    let net = read(&attributes, &phases);
    assert!(net.warnings.is_empty(), "{:?}", net.warnings);
    assert_eq!(net.programs.actuated(), 1);
    net
}

#[test]
fn a_green_goes_on_for_those_who_have_lost_time() {
    let both = |b: u32, a: u32| format!("{}{}", flow("f", "B0A0 A0A1", b), flow("g", "A1A0 A0B0", a));
    let beyond = r#"<param key="extendMaxDur" value="true"/>"#;
    // What SUMO 1.28.0 shows with these files in 900 s: times and seconds of green for A1 and B0.
    for (parameters, flows, sumo) in [
        ("", String::new(), [(17, 404), (16, 400)]),
        ("", flow("f", "B0A0 A0A1", 500), [(25, 125), (25, 625)]),
        ("", both(600, 400), [(57, 282), (56, 282)]),
        ("", both(1200, 600), [(47, 235), (47, 383)]),
        (beyond, String::new(), [(1, 900), (0, 0)]),
        (beyond, flow("f", "B0A0 A0A1", 500), [(1, 5), (1, 892)]),
        (beyond, both(600, 100), [(26, 130), (26, 617)]),
    ] {
        let shown = shown(delayed(parameters), &format!("<routes>{flows}</routes>"), 900);
        let counts = counted(&shown);
        for (state, (times, seconds)) in ["Grr", "rGr"].into_iter().zip(sumo) {
            let ours = counts.get(state).copied().unwrap_or_default();
            let is_near =
                ours.0.abs_diff(times) <= 1 + times / 10 && ours.1.abs_diff(seconds) <= 10 + seconds / 10;
            assert!(
                is_near,
                "{parameters} {flows} {state} {ours:?}, SUMO's {times} and {seconds}: {counts:?}"
            );
        }
    }
}
