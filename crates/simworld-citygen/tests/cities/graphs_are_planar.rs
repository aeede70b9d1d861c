//! Streets that touch without a node are refused, and both are named; whatever the sources of roads make is planar.

use simworld_citygen::graph::{FaceRef, GraphError, StreetGraph, StreetId};
use simworld_citygen::{Style, growth};
use simworld_core::geometry::Point2;
use simworld_core::net::{Street, StreetPlan};
use simworld_core::seed::Seed;

fn plan(nodes: &[(f64, f64)], streets: Vec<Street>) -> StreetPlan {
    StreetPlan {
        nodes: nodes.iter().map(|(x, y)| Point2::new(*x, *y)).collect(),
        streets,
        ..StreetPlan::default()
    }
}

fn touching(plan: &StreetPlan) -> Option<(u32, u32)> {
    match StreetGraph::of(plan) {
        Err(GraphError::Touching { first, second, .. }) => Some((first.0, second.0)),
        Ok(_) => None,
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn streets_that_cross_are_named() {
    let nodes = [(0.0, 0.0), (100.0, 0.0), (50.0, -50.0), (50.0, 50.0), (300.0, 0.0), (300.0, 90.0)];
    let streets = vec![Street::simple(4, 5), Street::simple(0, 1), Street::simple(2, 3)];
    let crossing = plan(&nodes, streets);
    assert_eq!(touching(&crossing), Some((1, 2)));
    let text = StreetGraph::of(&crossing).unwrap_err().to_string();
    assert!(text.contains("streets 1 and 2 touch at (50.00, 0.00)"), "{text}");
}

#[test]
fn streets_that_only_touch_are_named() {
    let tee = [(0.0, 0.0), (100.0, 0.0), (50.0, 0.0), (50.0, 50.0)];
    assert_eq!(touching(&plan(&tee, vec![Street::simple(0, 1), Street::simple(2, 3)])), Some((0, 1)));
    let on_top = [(0.0, 0.0), (100.0, 0.0), (50.0, 0.0)];
    assert_eq!(touching(&plan(&on_top, vec![Street::simple(0, 1), Street::simple(0, 2)])), Some((0, 1)));
}

#[test]
fn a_street_that_crosses_itself_is_named() {
    let via = [(100.0, 0.0), (100.0, 50.0), (50.0, 50.0)].map(|(x, y)| Point2::new(x, y)).to_vec();
    let knot = Street { via, ..Street::simple(0, 1) };
    assert_eq!(touching(&plan(&[(0.0, 0.0), (50.0, -50.0)], vec![knot.clone()])), Some((0, 0)));
    assert_eq!(touching(&plan(&[(0.0, 0.0), (50.0, 20.0)], vec![knot])), None);
}

#[test]
fn courses_may_bend_back_to_the_block_beside() {
    // A bay of streets inside a block: one block, with a dead end walked there and back.
    let mut grid = StreetPlan::grid(2, 2, 100.0);
    grid.nodes.push(Point2::new(50.0, 50.0));
    grid.streets.push(Street::simple(0, 4));
    let graph = StreetGraph::of(&grid).unwrap();
    let block = graph.blocks().next().unwrap();
    assert_eq!((graph.blocks().count(), block.len(), block.polygon().len()), (1, 6, 6));
    assert!((block.area() - 10_000.0).abs() < 1e-9);
    assert_eq!(graph.around(simworld_citygen::graph::NodeId(0)).count(), 3);
    assert!(graph.street(StreetId(9)).is_none());
}

#[test]
fn a_tree_has_no_block() {
    let graph = StreetGraph::of(&StreetPlan::crossroads(123.4)).unwrap();
    assert_eq!((graph.faces().count(), graph.blocks().count()), (1, 0));
    assert!(graph.faces().all(|face| face.is_outer() && face.area() == 0.0 && face.len() == 8));
}

#[test]
fn parts_without_connection_have_an_outer_face_each() {
    let mut two = StreetPlan::grid(2, 2, 100.0);
    let far = StreetPlan::grid(2, 2, 30.0);
    two.nodes.extend(far.nodes.iter().map(|at| Point2::new(at.x + 35.0, at.y + 35.0)));
    two.streets.extend(far.streets.iter().map(|street| Street {
        from: street.from + 4,
        to: street.to + 4,
        ..street.clone()
    }));
    let graph = StreetGraph::of(&two).unwrap();
    assert_eq!((graph.blocks().count(), graph.faces().filter(FaceRef::is_outer).count()), (2, 2));
}

#[test]
fn grown_streets_are_planar_and_connected() {
    let soak = std::env::var_os("SIMWORLD_SOAK").is_some();
    for seed in 0..if soak { 100_000 } else { 400 } {
        let style = Style::ALL[seed as usize % Style::ALL.len()];
        let config = style.roads(10 + (seed % 61) as u32);
        let plan = growth::grow(&config, Seed(seed));
        let graph = StreetGraph::of(&plan).unwrap_or_else(|error| panic!("{style}, seed {seed}: {error}"));
        let parts = graph.faces().filter(FaceRef::is_outer).count();
        assert_eq!(parts, 1, "{style}, seed {seed} is not connected");
        assert!(plan.streets.len() >= config.count as usize, "{style}, seed {seed} stopped early");
    }
}

#[test]
fn growth_that_took_back_nearly_all_goes_on() {
    // Its first rounds end in trees without a block, of which only one street is no dead end too many.
    let config = Style::Suburb.roads(11);
    assert!(growth::grow(&config, Seed(8663)).streets.len() >= 11);
}
