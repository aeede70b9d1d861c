//! A graph that was edited is the graph of its plan built from scratch, and a refused edit changes nothing.

use proptest::prelude::*;
use simworld_citygen::RoadConfig;
use simworld_citygen::graph::{Change, FaceId, FaceRef, GraphError, HalfEdge, NodeId, StreetGraph, StreetId};
use simworld_citygen::growth;
use simworld_core::geometry::Point2;
use simworld_core::net::{Street, StreetPlan};
use simworld_core::seed::Seed;

/// Few in a quick run, many with `SIMWORLD_SOAK=1`.
fn cases() -> u32 {
    if std::env::var_os("SIMWORLD_SOAK").is_some() { 5000 } else { 48 }
}

/// An edit by shares, so that it fits any graph.
#[derive(Clone, Debug)]
enum Edit {
    Add([(f64, f64); 3]),
    Move(f64, (f64, f64)),
    Remove(f64),
}

fn edits() -> impl Strategy<Value = Vec<Edit>> {
    let place = (-400.0..400.0, -400.0..400.0);
    let edit = prop_oneof![
        [place.clone(), place.clone(), place].prop_map(Edit::Add),
        (0.0..1.0, (-40.0..40.0, -40.0..40.0)).prop_map(|(which, by)| Edit::Move(which, by)),
        (0.0..1.0).prop_map(Edit::Remove),
    ];
    prop::collection::vec(edit, 1..12)
}

fn apply(graph: &mut StreetGraph, edit: &Edit) -> Result<Change, GraphError> {
    let pick = |share: f64, count: usize| (share * count as f64) as usize;
    match edit {
        Edit::Add(course) => graph.add_street(&course.map(|(x, y)| Point2::new(x, y)), &Street::simple(0, 0)),
        Edit::Move(which, (x, y)) => {
            let nodes: Vec<NodeId> = graph.nodes().collect();
            let node = nodes[pick(*which, nodes.len())];
            let at = graph.position(node).expect("the node is one of the graph's");
            graph.move_node(node, Point2::new(at.x + x, at.y + y))
        }
        Edit::Remove(which) => {
            let streets: Vec<StreetId> = graph.streets().collect();
            graph.remove_street(streets[pick(*which, streets.len())])
        }
    }
}

/// A point to the bit.
type Corner = (u64, u64);

/// Every walk as its corners to the bit, from the least one on, and all walks in order; with the area in cm².
fn walks(graph: &StreetGraph) -> Vec<(Vec<Corner>, i64)> {
    let mut walks: Vec<(Vec<Corner>, i64)> = graph
        .faces()
        .map(|face| {
            let corners: Vec<_> =
                face.polygon().iter().map(|point| (point.x.to_bits(), point.y.to_bits())).collect();
            let turned = (0..corners.len()).map(|by| [&corners[by..], &corners[..by]].concat()).min();
            (turned.expect("a walk has corners"), (face.area() * 1e4).round() as i64)
        })
        .collect();
    walks.sort();
    walks
}

/// Links lead there and back, every side has its face, and Euler's formula holds for every connected part.
fn check_links(graph: &StreetGraph) {
    let mut sides = 0;
    for street in graph.streets() {
        for half in [HalfEdge::along(street), HalfEdge::against(street)] {
            assert_eq!(graph.prev(graph.next(half)), half);
            assert_eq!(graph.origin(graph.next(half)), graph.origin(half.twin()));
            let face = graph.face(graph.face_of(half)).expect("every side has a face");
            assert!(face.ring().any(|other| other == half));
            sides += 1;
        }
    }
    assert_eq!(sides, graph.faces().map(|face| face.len()).sum::<usize>());
    let alone = graph.nodes().filter(|node| graph.around(*node).next().is_none()).count();
    let parts = graph.faces().filter(FaceRef::is_outer).count();
    let (nodes, streets, faces) =
        (graph.nodes().count() - alone, graph.streets().count(), graph.faces().count());
    assert_eq!(nodes + faces, streets + 2 * parts, "nodes - streets + faces = 2 for each part");
}

/// The walk of every face by its number.
fn numbered(graph: &StreetGraph) -> Vec<(FaceId, Vec<u32>)> {
    graph.faces().map(|face| (face.id(), face.ring().map(|half| half.0).collect())).collect()
}

fn check_edits(plan: &StreetPlan, edits: &[Edit]) {
    let mut graph = StreetGraph::of(plan).expect("the plan is planar");
    for edit in edits {
        if graph.streets().count() < 2 {
            return;
        }
        let (before, plan_before) = (numbered(&graph), graph.plan());
        let outcome = apply(&mut graph, edit);
        check_links(&graph);
        let after = numbered(&graph);
        if let Ok(change) = outcome {
            let rebuilt = StreetGraph::of(&graph.plan()).expect("what an edit leaves is planar");
            assert!(walks(&graph) == walks(&rebuilt), "another graph after {edit:?}");
            // All that differs was told.
            let kept = before.iter().filter(|(face, _)| change.faces_removed.binary_search(face).is_err());
            let old = after.iter().filter(|(face, _)| change.faces_added.binary_search(face).is_err());
            assert!(kept.eq(old), "a face changed and was not told");
        } else {
            assert!(before == after, "a refused edit changed faces: {edit:?}");
            assert!(plan_before == graph.plan(), "a refused edit changed streets: {edit:?}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: cases(), ..ProptestConfig::default() })]

    #[test]
    fn edited_grids_equal_rebuilt_ones(edits in edits()) {
        let mut plan = StreetPlan::grid(5, 5, 120.0);
        for node in &mut plan.nodes {
            *node -= simworld_core::geometry::Vector2::new(240.0, 240.0);
        }
        check_edits(&plan, &edits);
    }

    #[test]
    fn edited_cities_equal_rebuilt_ones(edits in edits(), seed in 0_u64..1000) {
        let plan = growth::grow(&RoadConfig { count: 60, ..RoadConfig::default() }, Seed(seed));
        check_edits(&plan, &edits);
    }
}

#[test]
fn what_is_added_and_removed_leaves_no_trace() {
    let plan = StreetPlan::grid(4, 4, 100.0);
    let mut graph = StreetGraph::of(&plan).unwrap();
    let course = [Point2::new(0.0, 0.0), Point2::new(-50.0, -50.0)];
    let change = graph.add_street(&course, &Street::simple(0, 0)).unwrap();
    assert_eq!((change.streets_added.len(), change.nodes_added.len()), (1, 1));
    assert_eq!(change.faces_removed.len(), 1, "only the outer face has another walk");
    let change = graph.remove_street(change.streets_added[0]).unwrap();
    assert_eq!(change.nodes_removed.len(), 1);
    assert_eq!(graph.plan(), plan);
}

#[test]
fn a_moved_node_changes_its_faces_alone() {
    let mut graph = StreetGraph::of(&StreetPlan::grid(5, 5, 100.0)).unwrap();
    let change = graph.move_node(NodeId(12), Point2::new(220.0, 190.0)).unwrap();
    assert_eq!((change.streets_changed.len(), change.nodes_changed.len()), (4, 5));
    assert_eq!((change.faces_removed.len(), change.faces_added.len()), (4, 4));
    let area: f64 = graph.blocks().map(|block| block.area()).sum();
    assert!((area - 160_000.0).abs() < 1e-6);
}
