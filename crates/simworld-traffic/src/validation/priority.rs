//! Giving way: the capacity of a movement that waits for gaps, at a crossroads and into a roundabout.

use simworld_core::geometry::{Point2, direction};
use simworld_core::id::RoadId;
use simworld_core::net::{Control, CrossSection, LaneDirection, RoadClass, Street, StreetPlan};
use simworld_core::ops;

use super::streets::{CAR, StopLine, across, inner_lane, mean, traffic};
use super::{Effort, Figure, Figures, ValidationError};
use crate::{Flow, Leg, Route, Traffic};

const DT: f64 = 0.1;
/// Time before anybody counts, s.
const WARM_UP: f64 = 300.0;
const SPEED: f64 = 13.9;
const MANUAL: &str = "Highway Capacity Manual, two-way stop, over the gaps that there were: q e^(-q tc) / (1 - e^(-q tf)) if they are random";

/// A movement that gives way, with the base gaps of the manual.
struct Movement {
    name: &'static str,
    /// From this arm to that.
    way: (u32, u32),
    /// The streams with priority over it.
    rivals: &'static [(u32, u32)],
    /// Critical and follow-up gap, s.
    gaps: (f64, f64),
}

const MOVEMENTS: [Movement; 4] = [
    Movement { name: "left from the major road", way: (2, 1), rivals: &[(0, 2)], gaps: (4.1, 2.2) },
    Movement { name: "right from the minor road", way: (3, 0), rivals: &[(2, 0)], gaps: (6.2, 3.3) },
    Movement { name: "across from the minor road", way: (3, 1), rivals: &[(2, 0), (0, 2)], gaps: (6.5, 4.0) },
    Movement { name: "left from the minor road", way: (3, 2), rivals: &[(2, 0), (0, 2)], gaps: (7.1, 3.5) },
];

/// A major road from east to west, a minor one with stop signs from north to south.
fn crossroads() -> StreetPlan {
    let mut plan = StreetPlan::crossroads(320.0);
    plan.controls.insert(0, Control::Stop);
    for (arm, street) in plan.streets.iter_mut().enumerate() {
        street.speed_limit = Some(SPEED);
        street.class = if arm % 2 == 0 { RoadClass::Arterial } else { RoadClass::Local };
    }
    plan
}

/// What was seen of a queue that waits for gaps.
struct Observed {
    /// Flow with priority, veh/s.
    rivals: f64,
    /// Entries, veh/s.
    capacity: f64,
    /// Gaps between rivals, s, and how many entered in each.
    gaps: Vec<(f64, usize)>,
}

/// Lets a queue without end wait for gaps in the streams of others, at lines where both are counted.
fn observe(
    mut traffic: Traffic,
    way: &Route,
    flows: Vec<Flow>,
    lines: (StopLine, Vec<StopLine>),
    hours: f64,
) -> Result<Observed, ValidationError> {
    let (mut entries, mut rivals) = lines;
    for flow in flows {
        traffic.add_flow(flow)?;
    }
    let until = WARM_UP + hours * 3600.0;
    while traffic.seconds() < until {
        while traffic.outside() < 3 {
            traffic.insert(way.clone(), CAR)?;
        }
        traffic.step(DT);
        entries.look(&traffic);
        for line in &mut rivals {
            line.look(&traffic);
        }
    }
    let counted = |line: &StopLine| -> Vec<f64> {
        line.passed.iter().map(|pass| pass.1).filter(|time| *time > WARM_UP).collect()
    };
    let entered = counted(&entries);
    let mut times: Vec<f64> = rivals.iter().flat_map(counted).collect();
    times.sort_by(f64::total_cmp);
    let within = |pair: &[f64]| entered.iter().filter(|time| (pair[0]..pair[1]).contains(*time)).count();
    Ok(Observed {
        rivals: times.len() as f64 / (until - WARM_UP),
        capacity: entered.len() as f64 / (until - WARM_UP),
        gaps: times.windows(2).map(|pair| (pair[1] - pair[0], within(pair))).collect(),
    })
}

/// Critical and follow-up gap of a queue (Siegloch 1973): the mean gap that n use is t0 + n tf, and tc is t0 + tf / 2.
fn siegloch(gaps: &[(f64, usize)]) -> (f64, f64) {
    let most = gaps.iter().map(|gap| gap.1).max().unwrap_or(0);
    let points: Vec<(f64, f64)> = (1..=most.min(6))
        .filter_map(|n| {
            let used: Vec<f64> = gaps.iter().filter(|gap| gap.1 == n).map(|gap| gap.0).collect();
            // The mean gap that n use is half a follow-up gap above the least that they need.
            (used.len() >= 8).then(|| (n as f64, mean(used)))
        })
        .collect();
    let (x, y) = (mean(points.iter().map(|p| p.0)), mean(points.iter().map(|p| p.1)));
    let covariance: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    let variance: f64 = points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum();
    let follow_up = covariance / variance;
    let zero = y - follow_up * x;
    (zero + follow_up * 0.5, follow_up)
}

/// How many enter a second if each gap takes one as soon as it is critical, and another for every follow-up gap beyond. Over
/// gaps without memory this is the formula of the manual; those of vehicles that follow one another are more even.
fn entries(gaps: &[(f64, usize)], (critical, follow_up): (f64, f64)) -> f64 {
    let entries = |gap: f64| if gap < critical { 0.0 } else { 1.0 + ((gap - critical) / follow_up).floor() };
    gaps.iter().map(|gap| entries(gap.0)).sum::<f64>() / gaps.iter().map(|gap| gap.0).sum::<f64>()
}

pub(super) fn measure(effort: Effort) -> Figures {
    let mut figures = Vec::new();
    let hourly: &[f64] = effort.pick(&[400.0, 800.0], &[200.0, 400.0, 600.0, 800.0, 1000.0, 1200.0]);
    for movement in &MOVEMENTS {
        let mut all = Vec::new();
        for per_hour in hourly {
            let network = traffic(&crossroads(), 5)?;
            let share = per_hour / movement.rivals.len() as f64;
            let flow = |way: &(u32, u32)| Flow { kind: Some(CAR), ..Flow::new(across(way.0, way.1), share) };
            let flows = movement.rivals.iter().map(flow).collect();
            let line = |arm: u32| StopLine::new(inner_lane(&network, arm as usize));
            let lines = (line(movement.way.0), movement.rivals.iter().map(|way| line(way.0)).collect());
            let way = across(movement.way.0, movement.way.1);
            let seen = observe(network, &way, flows, lines, effort.pick(1.0, 4.0))?;
            let expected = entries(&seen.gaps, movement.gaps) * 3600.0;
            let name = format!("capacity, {}, {:.0} veh/h go first", movement.name, seen.rivals * 3600.0);
            figures.push(Figure::near(name, seen.capacity * 3600.0, expected, 0.1, "veh/h").cited(MANUAL));
            all.extend(seen.gaps);
        }
        let (critical, follow_up) = siegloch(&all);
        let source = "Highway Capacity Manual, base gaps; ours estimated after Siegloch 1973";
        let near = |name: String, value, of: f64| {
            Figure::within(name, value, (of - 0.3, of + 0.3), "s").cited(source)
        };
        figures.push(near(format!("critical gap, {}", movement.name), critical, movement.gaps.0));
        figures.push(near(format!("follow-up gap, {}", movement.name), follow_up, movement.gaps.1));
    }
    Ok(figures)
}

/// Four arms round a ring of one lane, driven counter-clockwise.
fn circle(radius: f64) -> StreetPlan {
    let mut plan = StreetPlan::default();
    let ring = plan.add_section(CrossSection::plain(1, 0, 4.5, 0.0));
    let corner = |eighth: usize| direction(std::f64::consts::FRAC_PI_4 * eighth as f64);
    plan.nodes.extend((0..4).map(|quarter| Point2::origin() + corner(2 * quarter) * radius));
    plan.streets.extend((0..4).map(|quarter| Street {
        section: ring,
        roundabout: true,
        via: vec![Point2::origin() + corner(2 * quarter + 1) * radius],
        ..Street::simple(quarter, (quarter + 1) % 4)
    }));
    plan.nodes.extend((0..4).map(|quarter| Point2::origin() + corner(2 * quarter) * (radius + 250.0)));
    plan.streets.extend((0..4).map(|quarter| Street::simple(quarter, 4 + quarter)));
    plan
}

pub(super) fn roundabout(effort: Effort) -> Figures {
    let inwards = |arm: u32| Leg::new(RoadId(4 + arm), LaneDirection::Backward);
    let outwards = |arm: u32| Leg::new(RoadId(4 + arm), LaneDirection::Forward);
    let ring = |arm: u32| Leg::new(RoadId(arm), LaneDirection::Forward);
    let mut figures = Vec::new();
    for per_hour in effort.pick(&[400.0][..], &[200.0, 400.0, 600.0, 800.0]) {
        let network = traffic(&circle(20.0), 5)?;
        // From the south past the eastern entry to the north; the queue goes in from the east and out to the north.
        let past = Route(vec![inwards(3), ring(3), ring(0), outwards(1)]);
        let way = Route(vec![inwards(0), ring(0), outwards(1)]);
        let lane = |leg: Leg| leg.lanes(network.network()).first().copied();
        let missing =
            || ValidationError::Nothing { measure: "roundabout", reason: "it has no lanes".to_owned() };
        let (entry, before) = (lane(inwards(0)).ok_or_else(missing)?, lane(ring(3)).ok_or_else(missing)?);
        let lines = (StopLine::new(entry), vec![StopLine::new(before)]);
        let flows = vec![Flow { kind: Some(CAR), ..Flow::new(past, *per_hour) }];
        let seen = observe(network, &way, flows, lines, effort.pick(1.0, 4.0))?;
        let expected = 1380.0 * ops::exp(-1.02e-3 * seen.rivals * 3600.0);
        let name = format!("capacity of an entry, {:.0} veh/h in the ring", seen.rivals * 3600.0);
        let source = "Highway Capacity Manual, 6th edition: 1380 e^(-0.00102 v), one lane";
        figures.push(Figure::near(name, seen.capacity * 3600.0, expected, 0.15, "veh/h").cited(source));
    }
    Ok(figures)
}
