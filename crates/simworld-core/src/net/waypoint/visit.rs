//! petgraph's visit traits, so that its algorithms run on a waypoint graph as it is.

use petgraph::visit::{
    Data, EdgeRef, GraphBase, GraphProp, IntoEdgeReferences, IntoEdges, IntoNeighbors, IntoNodeIdentifiers,
    NodeCount, NodeIndexable, VisitMap, Visitable,
};

use super::{WaypointEdge, WaypointGraph};
use crate::id::WaypointId;

/// An edge with the waypoint it leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgeReference<'a> {
    from: WaypointId,
    index: usize,
    edge: &'a WaypointEdge,
}

impl EdgeRef for EdgeReference<'_> {
    type NodeId = WaypointId;
    type EdgeId = usize;
    type Weight = f64;

    fn source(&self) -> WaypointId {
        self.from
    }

    fn target(&self) -> WaypointId {
        self.edge.to
    }

    fn weight(&self) -> &f64 {
        &self.edge.length
    }

    fn id(&self) -> usize {
        self.index
    }
}

impl GraphBase for WaypointGraph {
    type EdgeId = usize;
    type NodeId = WaypointId;
}

impl Data for WaypointGraph {
    type NodeWeight = super::Waypoint;
    type EdgeWeight = f64;
}

impl GraphProp for WaypointGraph {
    type EdgeType = petgraph::Directed;
}

impl NodeCount for WaypointGraph {
    fn node_count(&self) -> usize {
        self.waypoints.len()
    }
}

impl NodeIndexable for WaypointGraph {
    fn node_bound(&self) -> usize {
        self.waypoints.len()
    }

    fn to_index(&self, waypoint: WaypointId) -> usize {
        waypoint.index()
    }

    fn from_index(&self, index: usize) -> WaypointId {
        WaypointId::from_index(index)
    }
}

/// The waypoints seen by a traversal.
#[derive(Clone, Debug, Default)]
pub struct Seen(Vec<bool>);

impl VisitMap<WaypointId> for Seen {
    fn visit(&mut self, waypoint: WaypointId) -> bool {
        !std::mem::replace(&mut self.0[waypoint.index()], true)
    }

    fn is_visited(&self, waypoint: &WaypointId) -> bool {
        self.0[waypoint.index()]
    }

    fn unvisit(&mut self, waypoint: WaypointId) -> bool {
        std::mem::replace(&mut self.0[waypoint.index()], false)
    }
}

impl Visitable for WaypointGraph {
    type Map = Seen;

    fn visit_map(&self) -> Seen {
        Seen(vec![false; self.waypoints.len()])
    }

    fn reset_map(&self, map: &mut Seen) {
        map.0.clear();
        map.0.resize(self.waypoints.len(), false);
    }
}

impl IntoNodeIdentifiers for &WaypointGraph {
    type NodeIdentifiers = std::iter::Map<std::ops::Range<usize>, fn(usize) -> WaypointId>;

    fn node_identifiers(self) -> Self::NodeIdentifiers {
        (0..self.waypoints.len()).map(WaypointId::from_index)
    }
}

impl<'a> IntoNeighbors for &'a WaypointGraph {
    type Neighbors = std::iter::Map<std::slice::Iter<'a, WaypointEdge>, fn(&WaypointEdge) -> WaypointId>;

    fn neighbors(self, waypoint: WaypointId) -> Self::Neighbors {
        self.edges(waypoint).iter().map(|edge| edge.to)
    }
}

impl<'a> IntoEdgeReferences for &'a WaypointGraph {
    type EdgeRef = EdgeReference<'a>;
    type EdgeReferences = std::vec::IntoIter<EdgeReference<'a>>;

    fn edge_references(self) -> Self::EdgeReferences {
        let all: Vec<EdgeReference<'a>> =
            self.node_identifiers().flat_map(|from| self.edges_from(from)).collect();
        all.into_iter()
    }
}

impl<'a> IntoEdges for &'a WaypointGraph {
    type Edges = std::vec::IntoIter<EdgeReference<'a>>;

    fn edges(self, waypoint: WaypointId) -> Self::Edges {
        self.edges_from(waypoint).collect::<Vec<_>>().into_iter()
    }
}

impl WaypointGraph {
    fn edges_from(&self, from: WaypointId) -> impl Iterator<Item = EdgeReference<'_>> {
        let first = self.starts[from.index()] as usize;
        WaypointGraph::edges(self, from).iter().enumerate().map(move |(rank, edge)| EdgeReference {
            from,
            index: first + rank,
            edge,
        })
    }
}
