//! Stops and people in SUMO's demand: buses halt where the file says, people walk to them, ride, and walk on.

use std::sync::Arc;

use simworld_core::hash::StateHash;
use simworld_core::seed::Seed;
use simworld_traffic::sumo::{SumoDemand, SumoError, SumoNet, SumoStage};
use simworld_traffic::{Schedule, Traffic, TrafficConfig, Whereabouts};

const GRID: &str = include_str!("data/grid.net.xml");

const DEMAND: &str = r#"<additional>
    <busStop id="west" lane="A0B0_1" startPos="60" endPos="80"/>
    <busStop id="east" lane="C0C1_1" startPos="40" endPos="60" lines="7"/>
    <vType id="coach" vClass="bus" length="12"/>
    <route id="seven" edges="A0B0 B0C0 C0C1 C1C2">
        <stop busStop="west" duration="20"/>
        <stop busStop="east" duration="15" until="120"/>
    </route>
    <vehicle id="other" depart="0" type="coach" line="8"><route edges="A0B0 B0C0"/><stop busStop="west" duration="10"/></vehicle>
    <flow id="bus" type="coach" route="seven" line="7" begin="60" end="400" period="150"/>
    <vehicle id="van" depart="30"><route edges="A0A1 A1A2"/><stop lane="A0A1_1" endPos="-20" duration="40"/></vehicle>
    <vehicle id="lost" depart="500"><route edges="A0A1 A1A2"/><stop lane="C0C1_1" duration="40"/></vehicle>
    <person id="rides" depart="5">
        <walk from="A0B0" busStop="west"/>
        <ride busStop="east" lines="7"/>
        <walk to="C1C2" arrivalPos="50"/>
    </person>
    <person id="walks" depart="0"><walk edges="A0A1 A1A2"/><stop lane="A1A2_1" duration="30"/><walk to="A0A1"/></person>
    <person id="waits" depart="0"><ride from="A0B0" to="C0C1" lines="none"/></person>
    <personFlow id="many" begin="0" end="10" period="5"><walk edges="A0A1"/></personFlow>
</additional>"#;

fn read(xml: &str) -> SumoDemand {
    SumoDemand::read(xml.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

fn start(demand: &SumoDemand) -> (Traffic, Schedule, usize) {
    let net = SumoNet::read(GRID.as_bytes()).unwrap();
    let (schedule, warnings) = demand.schedule(&net, Seed(4)).unwrap();
    let config = TrafficConfig {
        vehicles: 0,
        pedestrians: 0,
        types: demand.vehicle_types(),
        ..TrafficConfig::default()
    };
    (Traffic::new(Arc::new(net.network), &config, Seed(4)).unwrap(), schedule, warnings.len())
}

#[test]
fn buses_halt_and_people_get_in_and_out() {
    let demand = read(DEMAND);
    assert_eq!((demand.bus_stops.len(), demand.route_stops.len(), demand.persons.len()), (2, 2, 3));
    assert!(matches!(&demand.persons[0].stages[1], SumoStage::Ride { lines, .. } if *lines == ["7"]));
    assert!(demand.warnings.is_empty(), "{:?}", demand.warnings);
    assert_eq!((demand.person_flows.len(), demand.person_flows[0].times.per_hour), (1, 720.0));
    let (mut traffic, mut schedule, warned) = start(&demand);
    assert_eq!(warned, 1, "the stop that is not on the way");
    let (mut riding, mut halted) = (Vec::new(), 0);
    for step in 0..9000 {
        schedule.feed(&mut traffic).unwrap();
        traffic.step(0.1);
        let people = schedule.people();
        if people.riding > 0 && riding.is_empty() {
            riding.push(step);
            // Who rides with the 7 gets into it, not into the one that halts there before.
            assert!(traffic.seconds() > 60.0, "at {} s", traffic.seconds());
        }
        if people.riding == 0 && riding.len() == 1 {
            riding.push(step);
        }
        halted = halted.max(traffic.halting().count());
    }
    let people = schedule.people();
    assert_eq!(people, Whereabouts { waiting: 1, arrived: 4, ..Whereabouts::default() }, "{people:?}");
    assert_eq!(riding.len(), 2, "one got in and out");
    assert!(f64::from(riding[1]) * 0.1 > 120.0, "nobody is there before the timetable says: {riding:?}");
    let counters = traffic.counters();
    // Three buses of the flow with two stops each, the other bus and the van.
    assert_eq!((counters.halts, counters.missed_stops), (8, 0), "{counters:?}");
    assert_eq!((counters.walkers_entered, counters.walkers_left), (6, 6), "{counters:?}");
    assert_eq!(counters.arrived, counters.entered, "{counters:?}");
    assert!(halted >= 1);
}

/// People who go along two sides of the grid, past both stops of the 7, along one side, and with a mode that there is not.
const TRIPS: &str = r#"<additional>
    <busStop id="west" lane="A0B0_1" startPos="20" endPos="40"/>
    <busStop id="east" lane="C1C2_1" startPos="40" endPos="60"/>
    <vType id="coach" vClass="bus" length="12"/>
    <route id="seven" edges="A0B0 B0C0 C0C1 C1C2"><stop busStop="west" duration="20"/><stop busStop="east" duration="15"/></route>
    <flow id="bus" type="coach" route="seven" line="7" begin="0" end="1200" period="60"/>
    <personFlow id="far" begin="10" end="1000" number="5" period="40"><personTrip from="A0B0" to="C1C2" modes="public"/></personFlow>
    <personFlow id="afoot" begin="10" end="90" period="40"><personTrip from="A0B0" to="C1C2"/><stop lane="C1C2_0" duration="20"/></personFlow>
    <person id="near" depart="15"><personTrip from="A0B0" to="B0B1" modes="public"/></person>
    <person id="hails" depart="20"><personTrip from="A0B0" to="A0A1" modes="taxi"/></person>
</additional>"#;

#[test]
fn trips_take_the_line_where_it_is_quicker_than_walking() {
    let demand = read(TRIPS);
    let warned: Vec<&str> = demand.warnings.iter().map(|warning| warning.id.as_str()).collect();
    assert_eq!(warned, ["personTrip"], "who takes a taxi");
    let (mut traffic, mut schedule, _) = start(&demand);
    let (mut rides, mut before) = (0, 0);
    for _ in 0..9000 {
        schedule.feed(&mut traffic).unwrap();
        traffic.step(0.1);
        let riding = schedule.people().riding;
        rides += riding.saturating_sub(before);
        before = riding;
    }
    assert_eq!(rides, 5, "those who go far and may ride");
    let people = schedule.people();
    assert_eq!(
        people,
        Whereabouts { arrived: 9, ..Whereabouts::default() },
        "{:?}",
        schedule.stranded().collect::<Vec<_>>()
    );
}

#[test]
fn who_is_stranded_has_a_name() {
    // The bus does not halt where they want to get out.
    let demand = read(&DEMAND.replace(
        r#"<ride from="A0B0" to="C0C1" lines="none"/>"#,
        r#"<walk from="A0B0" busStop="west"/><ride to="C1C2" lines="7"/>"#,
    ));
    let (mut traffic, mut schedule, _) = start(&demand);
    for _ in 0..6000 {
        schedule.feed(&mut traffic).unwrap();
        traffic.step(0.1);
    }
    assert_eq!(schedule.stranded().collect::<Vec<_>>(), ["waits"]);
    assert_eq!(schedule.people().stranded, 1);
}

#[test]
fn the_same_seed_gives_the_same_people() {
    let run = || {
        let (mut traffic, mut schedule, _) = start(&read(DEMAND));
        for _ in 0..2500 {
            schedule.feed(&mut traffic).unwrap();
            traffic.step(0.1);
        }
        (traffic.digest(), schedule.people())
    };
    assert_eq!(run(), run());
}

#[test]
fn what_is_broken_is_named() {
    let net = SumoNet::read(GRID.as_bytes()).unwrap();
    let refused = |xml: &str| {
        let read = SumoDemand::read(xml.as_bytes());
        read.and_then(|demand| demand.schedule(&net, Seed(1)).map(|_| ())).expect_err(xml).to_string()
    };
    let person = |stages: &str| format!(r#"<routes><person id="p" depart="0">{stages}</person></routes>"#);
    assert!(refused(&person(r#"<walk from="A0B0" busStop="nowhere"/>"#)).contains("nowhere"));
    assert!(refused(&person(r#"<walk edges="A0B0 nowhere"/>"#)).contains("nowhere"));
    assert!(refused(&person(r#"<ride lines="7"/>"#)).contains("to"));
    assert!(refused(&person(r#"<walk to="A0B0"/>"#)).contains("from"), "it does not say from where");
    assert!(refused(&person(r#"<personTrip from="A0B0"/>"#)).contains("to"));
    assert!(refused(&person(r#"<personTrip to="A0B0"/>"#)).contains("from"));
    let flow = |times: &str| {
        format!(r#"<routes><personFlow id="f" {times}><walk edges="A0A1"/></personFlow></routes>"#)
    };
    assert!(refused(&flow("begin=\"9\" end=\"5\" period=\"1\"")).contains("end"));
    assert!(refused(&flow("begin=\"0\"")).contains("period"));
    assert!(refused(&person(r#"<stop duration="x" edge="A0B0"/>"#)).contains("duration"));
    let vehicle =
        r#"<routes><vehicle id="v" depart="0"><route edges="A0B0"/><stop lane="no_0"/></vehicle></routes>"#;
    let error = SumoDemand::read(vehicle.as_bytes()).unwrap().schedule(&net, Seed(1)).map(|_| ());
    assert!(matches!(error, Err(SumoError::Dangling { what: "lane", .. })), "{error:?}");
}
