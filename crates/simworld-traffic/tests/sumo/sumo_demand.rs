//! Demand in SUMO's files: every way of writing it departs when and where it says; what is broken is named.

use std::sync::Arc;

use proptest::prelude::*;
use simworld_core::seed::Seed;
use simworld_traffic::output::{Recorder, Syntax, TripInfo};
use simworld_traffic::sumo::{SumoDemand, SumoNet, SumoWay};
use simworld_traffic::vehicle::{CarFollowing, VehicleKind, standard_types};
use simworld_traffic::{Arrivals, Traffic, TrafficConfig};

const GRID: &str = include_str!("data/grid.net.xml");

const ROUTES: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<routes>
    <vType id="car" accel="2.6" length="5" minGap="2.5" tau="1" speedFactor="normc(1.1,0.05,0.2,2)"/>
    <vTypeDistribution id="mix">
        <vType id="coach" vClass="bus" length="14" probability="0.5"/>
        <vType id="lorry" vClass="truck" maxSpeed="20" probability="0.5"/>
    </vTypeDistribution>
    <route id="east" edges="A0B0 B0C0 C0C1"/>
    <route id="north" edges="A0A1 A1A2 A2B2"/>
    <routeDistribution id="either" routes="east north" probabilities="1 3"/>
    <vehicle id="first" type="car" route="east" depart="0.00"/>
    <vehicle id="second" depart="0:01:00"><route edges="A0A1 A1B1"/><stop lane="A0A1_1" duration="20"/></vehicle>
    <trip id="third" from="A0B0" to="B2A2" via="C1C2" depart="90" departPos="random"/>
    <vehicle id="bad" depart="1"><route edges="A0B0 C1C2"/></vehicle>
    <vehicle id="waits" depart="triggered"><route edges="A0B0"/></vehicle>
    <flow id="even" type="mix" route="north" begin="10" end="100" period="30"/>
    <flow id="hour" route="either" begin="0" end="60" vehsPerHour="360"/>
    <flow id="five" from="C0C1" to="C1C2" begin="0" end="50" number="5"/>
    <flow id="chance" begin="0" end="3600" probability="0.1"><route edges="C2B2 B2A2"/></flow>
    <flow id="exp" route="east" begin="0" end="3600" period="exp(0.05)"/>
    <person id="walker" depart="0"><walk edges="A0A1"/></person>
</routes>
"#;

fn grid() -> SumoNet {
    SumoNet::read(GRID.as_bytes()).unwrap()
}

fn read(xml: &str) -> SumoDemand {
    SumoDemand::read(xml.as_bytes()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn everything_is_read() {
    let demand = read(ROUTES);
    assert_eq!(demand.types.len(), 3);
    let car = demand.vehicle_type("car").unwrap();
    assert_eq!((car.speed_factor, car.speed_deviation, car.min_gap), (Some(1.1), Some(0.05), Some(2.5)));
    assert_eq!(demand.type_distributions[0].choices, [("coach".to_owned(), 0.5), ("lorry".to_owned(), 0.5)]);
    assert_eq!(demand.route_distributions[0].choices[1], ("north".to_owned(), 3.0));
    let departs: Vec<f64> = demand.vehicles.iter().map(|vehicle| vehicle.depart).collect();
    assert_eq!(departs, [0.0, 60.0, 90.0, 1.0]);
    assert!(matches!(&demand.vehicles[2].way, SumoWay::Trip { via, .. } if via == &["C1C2"]));
    let flow = |id: &str| demand.flows.iter().find(|flow| flow.id == id).unwrap().times;
    assert_eq!((flow("even").per_hour, flow("hour").per_hour, flow("five").per_hour), (120.0, 360.0, 360.0));
    assert_eq!((flow("five").number, flow("exp").arrivals), (5, Arrivals::Poisson));
    assert!((flow("exp").per_hour - 180.0).abs() < 1e-9 && (flow("chance").per_hour - 360.0).abs() < 1e-9);
    let warned: Vec<&str> = demand.warnings.iter().map(|warning| warning.id.as_str()).collect();
    assert_eq!(warned, ["departPos", "waits"], "{:?}", demand.warnings);
    assert_eq!((demand.vehicles[1].stops[0].duration, demand.persons[0].stages.len()), (20.0, 1));
}

/// Runs a demand for so long and returns the trips as tripinfo has them: id, scheduled.
fn trips(xml: &str, seconds: u32) -> Vec<(String, f64)> {
    let net = grid();
    let demand = read(xml);
    let (mut schedule, _) = demand.schedule(&net, Seed(4)).unwrap();
    let types = demand.vehicle_types();
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, types, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(net.network), &config, Seed(4)).unwrap();
    let mut recorder = Recorder::new(&traffic, net.names);
    let output = recorder.add(TripInfo::new(Vec::new(), Syntax::Csv).unwrap());
    for _ in 0..seconds * 10 {
        schedule.feed(&mut traffic).unwrap();
        traffic.step(0.1);
        schedule.name(&traffic, &mut recorder);
        recorder.observe(&traffic).unwrap();
    }
    assert_eq!(traffic.counters().entered, traffic.counters().arrived + traffic.vehicles().count() as u64);
    let csv = std::str::from_utf8(recorder.get(output).writer()).unwrap();
    csv.lines()
        .skip(1)
        .map(|line| {
            let fields: Vec<&str> = line.split(';').collect();
            let number = |place: usize| fields[place].parse::<f64>().unwrap();
            (fields[0].to_owned(), number(1) - number(5))
        })
        .collect()
}

#[test]
fn everybody_departs_by_name_when_the_file_says() {
    let trips = trips(ROUTES, 900);
    let of = |prefix: &str| {
        let mut own: Vec<&(String, f64)> = trips.iter().filter(|(id, _)| id.starts_with(prefix)).collect();
        own.sort_by(|a, b| a.1.total_cmp(&b.1));
        own
    };
    let scheduled =
        |prefix: &str| of(prefix).iter().map(|trip| (trip.1 * 10.0).round() / 10.0).collect::<Vec<f64>>();
    assert_eq!(scheduled("first"), [0.0]);
    assert_eq!(scheduled("second"), [60.0]);
    assert_eq!(scheduled("third"), [90.0]);
    assert_eq!(scheduled("even."), [10.0, 40.0, 70.0]);
    assert_eq!(scheduled("hour."), [0.0, 10.0, 20.0, 30.0, 40.0, 50.0]);
    assert_eq!(scheduled("five."), [0.0, 10.0, 20.0, 30.0, 40.0]);
    assert_eq!(of("five.")[4].0, "five.4");
    assert!(of("bad").is_empty() && of("waits").is_empty());
    // Poisson: 0.1 a second for 900 s is 90 with a deviation of 9.5; those of the last minutes are under way.
    let random = of("chance.").len();
    assert!((50..120).contains(&random), "{random}");
}

#[test]
fn types_are_rows_of_the_table_and_hostile_numbers_are_brought_into_range() {
    let types = read(ROUTES).vehicle_types();
    let standard = standard_types();
    let [car, coach, lorry] = &types[standard.len()..] else { panic!("three types of their own") };
    assert_eq!((car.kind, car.length, car.driver.gap, car.speed_factor), (VehicleKind::Car, 5.0, 2.5, 1.1));
    assert_eq!((coach.kind, coach.length, coach.width), (VehicleKind::Bus, 14.0, standard[3].width));
    assert_eq!((lorry.kind, lorry.driver.desired_speed), (VehicleKind::Truck, 20.0));
    let wild = r#"<routes><vType id="x" length="1e300" accel="0" decel="1e9" tau="0" speedFactor="0" speedDev="9"/></routes>"#;
    let config = TrafficConfig { types: read(wild).vehicle_types(), ..TrafficConfig::default() };
    config.validate().unwrap();
}

#[test]
fn what_cannot_be_driven_is_warned_of_and_what_is_not_there_is_refused() {
    let net = grid();
    let (_, warnings) = read(ROUTES).schedule(&net, Seed(1)).unwrap();
    assert_eq!(warnings.len(), 1);
    assert!(warnings[0].to_string().contains("vehicle `bad` was left out"), "{}", warnings[0]);
    let refused = |from: &str, to: &str| {
        let broken = ROUTES.replacen(from, to, 1);
        assert_ne!(broken, ROUTES);
        match SumoDemand::read(broken.as_bytes()) {
            Ok(demand) => demand.schedule(&net, Seed(1)).map(|_| ()).unwrap_err().to_string(),
            Err(error) => error.to_string(),
        }
    };
    assert!(refused("A0B0 B0C0", "A0B0 B0X0").contains("names edge `B0X0`"));
    assert!(refused(r#"route="east" depart"#, r#"route="west" depart"#).contains("names route `west`"));
    assert!(refused(r#"type="car""#, r#"type="tank""#).contains("names type `tank`"));
    assert!(refused(r#"depart="90""#, r#"depart="soon""#).contains("is no time"));
    assert!(refused(r#"period="30""#, r#"period="0""#).contains("not more than 0"));
    assert!(refused(r#" period="30""#, "").contains("give period"));
    assert!(refused(r#" route="east" depart"#, " depart").contains("give a route"));
    assert!(refused("</routes>", "").contains("ends too early"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    /// Whatever stands there is refused or can be planned.
    #[test]
    fn hostile_files_never_panic(
        places in prop::collection::vec((0.0..1.0_f64, "[0-9a-zA-Z:_,.<>\"&()e/-]{1,6}"), 1..6)
    ) {
        let net = SumoNet::read(GRID.as_bytes()).unwrap();
        let mut xml = ROUTES.as_bytes().to_vec();
        for (share, text) in places {
            let at = ((xml.len() - 8) as f64 * share) as usize;
            xml[at..at + text.len()].copy_from_slice(text.as_bytes());
        }
        if let Ok(demand) = SumoDemand::read(xml.as_slice()) {
            let _planned_or_refused = demand.schedule(&net, Seed(1));
        }
    }
}

#[test]
fn car_following_models_are_those_of_the_file() {
    let text = r#"<routes>
        <vType id="k" carFollowModel="Krauss" sigma="0.3"/>
        <vType id="d" carFollowModel="Krauss"/>
        <vType id="i" carFollowModel="IDM"/>
        <vType id="a" carFollowModel="ACC"/>
        <vType id="w" carFollowModel="Wiedemann"/>
        <vType id="n"/>
        <vType id="h" carFollowModel="Krauss" sigma="7"/>
    </routes>"#;
    let demand = read(text);
    let rows = demand.vehicle_types();
    let models: Vec<CarFollowing> = rows[standard_types().len()..].iter().map(|row| row.model).collect();
    let krauss = |sigma| CarFollowing::Krauss { sigma };
    let own = CarFollowing::Idm;
    let acc = CarFollowing::Acc { coolness: 0.99 };
    assert_eq!(models, [krauss(0.3), krauss(0.5), CarFollowing::Idm, acc, own, own, krauss(1.0)]);
    let [warning] = &demand.warnings[..] else { panic!("one warning: {:?}", demand.warnings) };
    assert!(warning.to_string().contains("`w`"), "{warning}");
    TrafficConfig { types: rows, ..TrafficConfig::default() }.validate().unwrap();
}
