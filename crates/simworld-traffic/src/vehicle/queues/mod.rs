//! Queues: the vehicles of lanes and ways in memory, and what others than their drivers see of them.
//!
//! Each part of the network keeps its vehicles [front to back](slabs) on each track. Beside the queues stand the [room](storage) that they
//! take, their [ends](tail), bodies that are in a lane but [not in its queue](ghosts), and who is [about to pass](claims) a crossing.

pub(super) mod claims;
pub(super) mod ghosts;
pub(super) mod path;
pub(super) mod slabs;
pub(super) mod storage;
pub(super) mod tail;
pub(super) mod tally;
