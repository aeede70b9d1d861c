//! Arrows on lanes and signs that forbid turns hold in the network of a real place.
#![cfg(feature = "osm")]

use crate::osm_common::Sketch;
use simworld_citygen::osm::{OsmId, StreetOptions, Warning};
use simworld_core::net::{NetworkConfig, RoadNetwork, Turn};

/// A crossroads; way 1001 arrives from the west, 1002 leads east, 1003 north, 1004 south.
fn crossroads(west: &[(&str, &str)]) -> Sketch {
    let street = [("highway", "secondary")];
    Sketch::default()
        .node(1, (0.0, 0.0), &[])
        .node(2, (-150.0, 0.0), &[])
        .node(3, (150.0, 0.0), &[])
        .node(4, (0.0, 150.0), &[])
        .node(5, (0.0, -150.0), &[])
        .way(&[2, 1], west)
        .way(&[1, 3], &street)
        .way(&[1, 4], &street)
        .way(&[1, 5], &street)
}

/// The turns from each lane that arrives from the west, from left to right, and the warnings.
fn turns(sketch: &Sketch) -> (Vec<Vec<Turn>>, Vec<Warning>) {
    let (plan, warnings) = sketch.place().plan(&StreetOptions::default());
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a crossroads is built");
    let street =
        plan.streets.iter().position(|street| plan.nodes[street.from].x < -100.0).expect("it is there");
    let turns = |lane: &simworld_core::id::LaneId| {
        let ways = &network.lanes[lane.index()].outgoing;
        let mut turns: Vec<Turn> = ways.iter().map(|way| network.connections[way.index()].turn).collect();
        turns.sort_unstable();
        turns.dedup();
        turns
    };
    (network.roads[street].forward.iter().map(turns).collect(), warnings)
}

const THREE: [(&str, &str); 3] = [("highway", "secondary"), ("oneway", "yes"), ("lanes", "3")];

#[test]
fn lanes_lead_where_their_arrows_point() {
    let with = |arrows| [&THREE[..], &[("turn:lanes", arrows)]].concat();
    let (plain, _) = turns(&crossroads(&THREE));
    assert_eq!(plain[1], [Turn::Straight], "the middle lane goes straight on");
    let (lanes, warnings) = turns(&crossroads(&with("left|left;through|right")));
    assert_eq!(lanes[0], [Turn::Left]);
    assert!(lanes[1].contains(&Turn::Straight) && !lanes[1].contains(&Turn::Right), "{lanes:?}");
    assert_eq!(lanes[2], [Turn::Right]);
    assert_eq!(warnings, []);
    // Arrows that do not fit the lanes are told and left out.
    let (lanes, warnings) = turns(&crossroads(&with("left|right")));
    assert_eq!(lanes, plain);
    assert!(warnings[0].to_string().contains("way 1001: 2 arrows for 3 lanes"), "{warnings:?}");
}

#[test]
fn arrows_stand_before_the_junction_at_the_end_of_their_way() {
    let tags = [&THREE[..], &[("turn:lanes", "left|through|right")]].concat();
    // The way passes a side street before it ends.
    let sketch = Sketch::default()
        .node(1, (0.0, 0.0), &[])
        .node(2, (-300.0, 0.0), &[])
        .node(3, (-150.0, 0.0), &[])
        .node(4, (-150.0, 120.0), &[])
        .node(5, (150.0, 0.0), &[])
        .node(6, (0.0, 150.0), &[])
        .node(7, (0.0, -150.0), &[])
        .way(&[2, 3, 1], &tags)
        .way(&[3, 4], &[("highway", "residential")])
        .way(&[1, 5], &[("highway", "secondary")])
        .way(&[6, 1, 7], &[("highway", "secondary")]);
    let (plan, _) = sketch.place().plan(&StreetOptions::default());
    let arrows: Vec<(f64, usize)> =
        plan.streets.iter().map(|street| (plan.nodes[street.to].x, street.turns.forward.len())).collect();
    assert!(arrows.iter().all(|(x, count)| *count == 0 || (x - 75.0).abs() < 1.0), "{arrows:?}");
    assert_eq!(arrows.iter().filter(|(_, count)| *count == 3).count(), 1);
}

fn sign(sketch: Sketch, kind: &str, members: &[(i64, &str)]) -> Sketch {
    sketch.relation(9, members, &[("type", "restriction"), ("restriction", kind)])
}

#[test]
fn forbidden_turns_are_not_made() {
    let street = [("highway", "secondary")];
    let members = [(1001, "from"), (1, "via"), (1003, "to")];
    let all = [Turn::Straight, Turn::Right, Turn::Left];
    let allowed = |kind: &str| turns(&sign(crossroads(&street), kind, &members)).0[0].clone();
    let without = |gone: Turn| all.into_iter().filter(|turn| *turn != gone).collect::<Vec<Turn>>();
    let (mut plain, _) = turns(&crossroads(&street));
    plain[0].sort_unstable();
    assert_eq!(plain[0].len(), 3);
    for (kind, gone) in
        [("no_left_turn", Turn::Left), ("no_right_turn", Turn::Right), ("no_straight_on", Turn::Straight)]
    {
        let mut left = without(gone);
        left.sort_unstable();
        assert_eq!(allowed(kind), left, "{kind}");
    }
    for (kind, only) in [
        ("only_left_turn", Turn::Left),
        ("only_right_turn", Turn::Right),
        ("only_straight_on", Turn::Straight),
    ] {
        assert_eq!(allowed(kind), [only], "{kind}");
    }
    // Others than cars may be meant, and the sign may stand on another street.
    let exempt = crossroads(&street).relation(
        9,
        &members,
        &[("type", "restriction"), ("restriction", "no_left_turn"), ("except", "bicycle;motorcar")],
    );
    assert_eq!(turns(&exempt).0, plain);
    let other = sign(crossroads(&street), "no_left_turn", &[(1002, "from"), (1, "via"), (1003, "to")]);
    assert_eq!(turns(&other).0, plain);
}

#[test]
fn signs_that_cannot_be_read_are_told() {
    let street = [("highway", "secondary")];
    for (kind, members, part) in [
        ("no_left_turn", &[(1001, "from"), (1002, "via"), (1003, "to")][..], "goes over a way"),
        ("no_left_turn", &[(1001, "from"), (1003, "to")], "has no node"),
        ("no_dancing", &[(1001, "from"), (1, "via"), (1003, "to")], "of a kind that is not known"),
    ] {
        let (lanes, warnings) = turns(&sign(crossroads(&street), kind, members));
        assert_eq!(lanes[0].len(), 3, "{part}");
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(warnings[0].what.contains(part) && warnings[0].element == Some(OsmId::Relation(9)));
    }
}

/// A carriageway each way along x, 14 m apart, and a street across both; `wide` m from the middle one to the other.
fn dual_carriageway(wide: f64) -> Sketch {
    let along = [("highway", "primary"), ("oneway", "yes"), ("lanes", "2"), ("name", "Ring")];
    Sketch::default()
        .node(1, (0.0, 0.0), &[])
        .node(2, (0.0, wide), &[])
        .node(3, (-200.0, 0.0), &[])
        .node(4, (200.0, 0.0), &[])
        .node(5, (-200.0, wide), &[])
        .node(6, (200.0, wide), &[])
        .node(7, (0.0, -150.0), &[])
        .node(8, (0.0, wide + 150.0), &[])
        .way(&[3, 1], &along)
        .way(&[1, 4], &along)
        .way(&[6, 2], &along)
        .way(&[2, 5], &along)
        .way(&[7, 1], &[("highway", "residential")])
        .way(&[1, 2], &[("highway", "residential")])
        .way(&[2, 8], &[("highway", "residential")])
}

#[test]
fn a_turn_over_a_crossover_is_one_of_its_junction() {
    // From the southern street over the crossover into the carriageway to the west: a left turn of the whole junction.
    let members = [(1005, "from"), (1006, "via"), (1004, "to")];
    let lefts = |sketch: &Sketch| {
        let (plan, warnings) = sketch.place().plan(&StreetOptions::default());
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a sketch can be built");
        let from = |way: &&simworld_core::net::Connection| {
            let lane = &network.lanes[way.from.index()];
            way.turn == Turn::Left && lane.path[0].y < -50.0 - 14.0 * 0.5
        };
        (network.connections.iter().filter(from).count(), warnings)
    };
    let (plain, warnings) = lefts(&dual_carriageway(14.0));
    assert!(plain > 0 && warnings.is_empty(), "{plain} {warnings:?}");
    let (left, warnings) = lefts(&sign(dual_carriageway(14.0), "no_left_turn", &members));
    assert_eq!((left, warnings.len()), (0, 0), "{warnings:?}");
    // Where the crossover is a street by itself a plan cannot say it.
    let (_, warnings) = lefts(&sign(dual_carriageway(90.0), "no_left_turn", &members));
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert!(warnings[0].what.contains("goes over a way") && warnings[0].element == Some(OsmId::Relation(9)));
}

#[test]
fn dead_ends_have_the_turning_circles_of_the_map() {
    let street = [("highway", "residential")];
    let sketch = |kind: &str| {
        Sketch::default()
            .node(1, (0.0, 0.0), &[])
            .node(2, (-150.0, 0.0), &[("highway", kind)])
            .node(3, (150.0, 0.0), &[])
            .node(4, (0.0, 150.0), &[])
            .way(&[2, 1, 3], &street)
            .way(&[1, 4], &street)
            .place()
    };
    for (kind, circles) in [("turning_circle", 1), ("turning_loop", 1), ("crossing", 0)] {
        let (plan, _) = sketch(kind).plan(&StreetOptions::default());
        let found = plan
            .streets
            .iter()
            .flat_map(|street| [(street.from, street.turning[0]), (street.to, street.turning[1])]);
        let found: Vec<(usize, f64)> = found.filter(|(_, radius)| *radius > 0.0).collect();
        assert_eq!(found.len(), circles, "{kind}: {found:?}");
        assert!(found.iter().all(|(node, _)| plan.nodes[*node].x < -100.0), "{kind}");
        let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a tee is built");
        let built = network.intersections.iter().filter(|place| place.turning.is_some()).count();
        assert_eq!(built, circles, "{kind}");
    }
}
