//! What an edit changed.

use super::{FaceId, NodeId, StreetId};

/// What an edit changed: all that hangs on these, and only that, is to be derived anew. Each list is ascending.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Change {
    /// Streets that are new.
    pub streets_added: Vec<StreetId>,
    /// Streets whose course is another one.
    pub streets_changed: Vec<StreetId>,
    /// Streets that are gone; their numbers may be given again by a later edit.
    pub streets_removed: Vec<StreetId>,
    /// Nodes that are new.
    pub nodes_added: Vec<NodeId>,
    /// Nodes that moved, or have other streets than before.
    pub nodes_changed: Vec<NodeId>,
    /// Nodes that are gone.
    pub nodes_removed: Vec<NodeId>,
    /// Faces that are gone. A number in both lists was given again.
    pub faces_removed: Vec<FaceId>,
    /// Faces that are new.
    pub faces_added: Vec<FaceId>,
}
