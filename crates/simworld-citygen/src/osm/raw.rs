//! What an extract holds, as it stands in the file: nodes, ways and relations in flat arrays.

use super::error::OsmError;
use super::tags::{TagRange, TagStore, Tags};

/// Most elements of each kind that are read: 16 bytes a node, 4 to 8 a reference, so that memory stays below 2 GB.
const MOST_NODES: usize = 40_000_000;
const MOST_WAYS: usize = 8_000_000;
const MOST_REFERENCES: usize = 80_000_000;
const MOST_RELATIONS: usize = 1_000_000;
const MOST_MEMBERS: usize = 20_000_000;
/// The greatest coordinates, tenths of microdegrees.
const FARTHEST: [i32; 2] = [1_800_000_000, 900_000_000];

/// A node that the extract does not hold.
pub(super) const MISSING: u32 = u32::MAX;

/// A line or an area.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub(super) id: i64,
    start: u32,
    count: u32,
    tags: TagRange,
}

/// A group of ways; of other members only the node over which a turn goes is kept.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relation {
    pub(super) id: i64,
    start: u32,
    count: u32,
    tags: TagRange,
}

/// An element in a relation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Member {
    /// The number of the way, or of the node if the role says so.
    pub(super) number: i64,
    pub(super) role: Role,
}

/// What an element is in a relation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// A way that bounds an area, or is there for any other reason.
    Outer,
    /// A way that bounds a hole.
    Inner,
    /// The way from which a turn is governed.
    From,
    /// The way into which it is governed.
    To,
    /// A way over which it goes.
    Over,
    /// The node at which it is governed.
    At,
}

impl Role {
    /// That of a way or node by its word; `None` for members that mean nothing here.
    pub(super) fn of(word: &[u8], is_way: bool) -> Option<Self> {
        match (word, is_way) {
            (b"inner", true) => Some(Self::Inner),
            (b"from", true) => Some(Self::From),
            (b"to", true) => Some(Self::To),
            (b"via", true) => Some(Self::Over),
            (_, true) => Some(Self::Outer),
            (b"via", false) => Some(Self::At),
            (_, false) => None,
        }
    }
}

/// All that an extract holds.
#[derive(Clone, Debug, Default)]
pub(super) struct Raw {
    ids: Vec<i64>,
    /// Longitude and latitude, tenths of microdegrees.
    at: Vec<[i32; 2]>,
    /// Nodes with tags, ascending.
    tagged: Vec<(u32, TagRange)>,
    ways: Vec<Way>,
    references: Vec<i64>,
    /// The references as indices of nodes, once the file is read.
    nodes_of_ways: Vec<u32>,
    relations: Vec<Relation>,
    members: Vec<Member>,
    pub(super) tags: TagStore,
    /// Elements whose numbers were no numbers.
    pub(super) unreadable: u64,
}

fn too_much<T>(what: &'static str, limit: usize) -> Result<T, OsmError> {
    Err(OsmError::TooMuch { what, limit: limit as u64 })
}

impl Raw {
    /// Adds a node; its tags are those since the mark.
    pub(super) fn add_node(&mut self, id: i64, at: [i32; 2], mark: u32) -> Result<(), OsmError> {
        if self.ids.len() >= MOST_NODES {
            return too_much("nodes", MOST_NODES);
        }
        if at[0].unsigned_abs() > FARTHEST[0].unsigned_abs()
            || at[1].unsigned_abs() > FARTHEST[1].unsigned_abs()
        {
            self.unreadable += 1;
            return Ok(());
        }
        let tags = self.tags.since(mark);
        if tags.count > 0 {
            self.tagged.push((self.ids.len() as u32, tags));
        }
        self.ids.push(id);
        self.at.push(at);
        Ok(())
    }

    /// Adds a way with those nodes; its tags are those since the mark.
    pub(super) fn add_way(&mut self, id: i64, nodes: &[i64], mark: u32) -> Result<(), OsmError> {
        if self.ways.len() >= MOST_WAYS {
            return too_much("ways", MOST_WAYS);
        }
        if self.references.len() + nodes.len() > MOST_REFERENCES {
            return too_much("nodes of ways", MOST_REFERENCES);
        }
        let start = self.references.len() as u32;
        self.references.extend_from_slice(nodes);
        self.ways.push(Way { id, start, count: nodes.len() as u32, tags: self.tags.since(mark) });
        Ok(())
    }

    /// Adds a relation of those ways; its tags are those since the mark.
    pub(super) fn add_relation(&mut self, id: i64, members: &[Member], mark: u32) -> Result<(), OsmError> {
        if self.relations.len() >= MOST_RELATIONS {
            return too_much("relations", MOST_RELATIONS);
        }
        if self.members.len() + members.len() > MOST_MEMBERS {
            return too_much("members of relations", MOST_MEMBERS);
        }
        let start = self.members.len() as u32;
        self.members.extend_from_slice(members);
        self.relations.push(Relation { id, start, count: members.len() as u32, tags: self.tags.since(mark) });
        Ok(())
    }

    /// Looks up what ways refer to, once everything is read.
    ///
    /// # Errors
    /// No node at all.
    pub(super) fn finish(mut self) -> Result<Self, OsmError> {
        if self.ids.is_empty() {
            return Err(OsmError::Empty);
        }
        if !self.ids.is_sorted() {
            self.sort_nodes();
        }
        let found =
            self.references.iter().map(|id| self.ids.binary_search(id).map_or(MISSING, |index| index as u32));
        self.nodes_of_ways = found.collect();
        self.references = Vec::new();
        if !self.ways.is_sorted_by_key(|way| way.id) {
            self.ways.sort_by_key(|way| way.id);
        }
        Ok(self)
    }

    fn sort_nodes(&mut self) {
        let mut order: Vec<u32> = (0..self.ids.len() as u32).collect();
        order.sort_by_key(|index| self.ids[*index as usize]);
        let mut ranks = vec![0; order.len()];
        for (rank, index) in order.iter().enumerate() {
            ranks[*index as usize] = rank as u32;
        }
        self.ids = order.iter().map(|index| self.ids[*index as usize]).collect();
        self.at = order.iter().map(|index| self.at[*index as usize]).collect();
        for (node, _) in &mut self.tagged {
            *node = ranks[*node as usize];
        }
        self.tagged.sort_by_key(|(node, _)| *node);
    }

    /// The number of nodes.
    pub(super) fn node_count(&self) -> usize {
        self.ids.len()
    }

    /// The node of that number.
    pub(super) fn node(&self, id: i64) -> Option<u32> {
        self.ids.binary_search(&id).ok().map(|index| index as u32)
    }

    /// The number of a node in OpenStreetMap.
    pub(super) fn node_id(&self, node: u32) -> i64 {
        self.ids[node as usize]
    }

    /// Longitude and latitude of a node, degrees.
    pub(super) fn position(&self, node: u32) -> [f64; 2] {
        self.at[node as usize].map(|angle| f64::from(angle) * 1e-7)
    }

    /// Nodes with tags.
    pub(super) fn tagged_nodes(&self) -> impl Iterator<Item = (u32, Tags<'_>)> {
        self.tagged.iter().map(|(node, tags)| (*node, self.tags.of(*tags)))
    }

    /// The ways, by number.
    pub(super) fn ways(&self) -> &[Way] {
        &self.ways
    }

    /// The way of that number.
    pub(super) fn way(&self, id: i64) -> Option<&Way> {
        let index = self.ways.binary_search_by_key(&id, |way| way.id).ok()?;
        self.ways.get(index)
    }

    /// The relations.
    pub(super) fn relations(&self) -> &[Relation] {
        &self.relations
    }

    /// The nodes of a way; [`MISSING`] where the extract does not hold one.
    pub(super) fn nodes_of(&self, way: &Way) -> &[u32] {
        &self.nodes_of_ways[way.start as usize..(way.start + way.count) as usize]
    }

    /// The ways of a relation.
    pub(super) fn members_of(&self, relation: &Relation) -> &[Member] {
        &self.members[relation.start as usize..(relation.start + relation.count) as usize]
    }

    /// The tags of a way.
    pub(super) fn way_tags(&self, way: &Way) -> Tags<'_> {
        self.tags.of(way.tags)
    }

    /// The tags of a relation.
    pub(super) fn relation_tags(&self, relation: &Relation) -> Tags<'_> {
        self.tags.of(relation.tags)
    }
}
