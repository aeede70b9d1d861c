//! Paths of the hierarchy weigh what those of a full search weigh, whatever part of the graph is in the table.

use proptest::prelude::*;

use super::*;

/// The least weights between all pairs (Floyd and Warshall 1962); the greatest number where there is no way.
fn all_weights(nodes: usize, edges: &[WeightedEdge]) -> Vec<Vec<u64>> {
    let mut weights = vec![vec![u64::MAX; nodes]; nodes];
    for (node, row) in weights.iter_mut().enumerate() {
        row[node] = 0;
    }
    for edge in edges {
        let known = &mut weights[edge.from as usize][edge.to as usize];
        *known = edge.weight.min(*known);
    }
    for over in 0..nodes {
        for from in 0..nodes {
            for to in 0..nodes {
                let around = weights[from][over].saturating_add(weights[over][to]);
                weights[from][to] = weights[from][to].min(around);
            }
        }
    }
    weights
}

/// Edges lead on from one to the next, from one node to another; what they weigh.
fn walk(edges: &[WeightedEdge], path: &[u32], from: u32, to: u32) -> u64 {
    let (mut at, mut weight) = (from, 0);
    for index in path {
        let edge = edges[*index as usize];
        assert_eq!(edge.from, at, "{path:?}");
        (at, weight) = (edge.to, weight + edge.weight);
    }
    assert_eq!(at, to, "{path:?}");
    weight
}

fn check(nodes: usize, edges: &[WeightedEdge], places: usize) {
    let weights = all_weights(nodes, edges);
    let hierarchy = Hierarchy::with_table(nodes, edges, places);
    assert_eq!(hierarchy, Hierarchy::with_table(nodes, edges, places));
    let mut scratch = HierarchyScratch::default();
    for (from, row) in weights.iter().enumerate() {
        for (to, weight) in row.iter().enumerate() {
            let ends = [from as u32, to as u32];
            let found = hierarchy.shortest(&[(ends[0], 5)], &[(ends[1], 7)], &mut scratch);
            let expected =
                (*weight < u64::MAX).then(|| ShortestPath { weight: weight + 12, start: 0, end: 0 });
            assert_eq!(found, expected, "{from} to {to}");
            if found.is_some() {
                assert_eq!(walk(edges, scratch.edges(), ends[0], ends[1]), *weight);
            }
        }
    }
    check_choices(&weights, edges, &hierarchy, &mut scratch);
}

/// Of several beginnings and ends, the pair is taken that makes the whole cheapest.
fn check_choices(
    weights: &[Vec<u64>],
    edges: &[WeightedEdge],
    hierarchy: &Hierarchy,
    scratch: &mut HierarchyScratch,
) {
    let nodes = weights.len() as u32;
    for shift in 0..nodes {
        let starts = [(shift, 40), ((shift + 1) % nodes, 0), (nodes + 3, 0)];
        let ends = [((shift * 3) % nodes, 15), ((shift + 2) % nodes, 20)];
        let sum = |start: &(u32, u64), end: &(u32, u64)| {
            weights[start.0 as usize][end.0 as usize].saturating_add(start.1 + end.1)
        };
        let pairs = starts[..2].iter().flat_map(|start| ends.iter().map(move |end| sum(start, end)));
        let least = pairs.min().filter(|weight| *weight < u64::MAX);
        let found = hierarchy.shortest(&starts, &ends, scratch);
        assert_eq!(found.map(|path| path.weight), least);
        if let Some(path) = found {
            let (start, end) = (starts[path.start], ends[path.end]);
            let walked = walk(edges, scratch.edges(), start.0, end.0);
            assert_eq!(walked + start.1 + end.1, path.weight);
        }
    }
}

proptest! {
    #[test]
    fn paths_are_the_shortest(
        nodes in 1_usize..40,
        edges in proptest::collection::vec((0_u32..40, 0_u32..40, 0_u64..60, any::<bool>()), 0..120),
        places in 0_usize..45,
    ) {
        let count = nodes as u32;
        let mut all = Vec::new();
        for (from, to, weight, both) in edges {
            let (from, to) = (from % count, to % count);
            all.push(WeightedEdge { from, to, weight });
            if both {
                all.push(WeightedEdge { from: to, to: from, weight });
            }
        }
        check(nodes, &all, places);
    }

    #[test]
    fn paths_across_a_grid_are_the_shortest(
        weights in proptest::collection::vec(1_u64..30, 4 * 81),
        places in 0_usize..81,
    ) {
        let edges: Vec<WeightedEdge> = (0..81_u32)
            .flat_map(|node| {
                let (x, y) = (node % 9, node / 9);
                let right = (x < 8).then_some((node, node + 1));
                let up = (y < 8).then_some((node, node + 9));
                [right, up].into_iter().flatten()
            })
            .flat_map(|(from, to)| [(from, to), (to, from)])
            .zip(&weights)
            .map(|((from, to), weight)| WeightedEdge { from, to, weight: *weight })
            .collect();
        check(81, &edges, places);
    }
}

#[test]
fn what_cannot_be_is_left_out() {
    let edge = |from, to, weight| WeightedEdge { from, to, weight };
    let edges = [edge(0, 9, 1), edge(1, 1, 1), edge(0, 1, u64::MAX - 1), edge(1, 2, 5)];
    for places in [0, 3] {
        let hierarchy = Hierarchy::with_table(3, &edges, places);
        let mut scratch = HierarchyScratch::default();
        let mut weight =
            |from, to| hierarchy.shortest(&[(from, 0)], &[(to, 0)], &mut scratch).map(|path| path.weight);
        assert_eq!(weight(0, 1), Some(u64::MAX - 1));
        assert_eq!((weight(0, 2), weight(1, 2), weight(0, 9), weight(2, 0)), (None, Some(5), None, None));
    }
    let none = Hierarchy::new(0, &edges);
    assert_eq!(none.shortest(&[(0, 0)], &[(0, 0)], &mut HierarchyScratch::default()), None);
}
