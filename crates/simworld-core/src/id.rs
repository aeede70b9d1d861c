//! Identifiers: small copyable handles instead of references.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Names one entity of a [`World`](crate::scene::World) for its whole life.
///
/// An index that is reused after a removal gets a new generation, so an old handle never names a newcomer.
/// Serialised as one integer, `generation << 32 | index`: ids of a world that removed nothing read 0, 1, 2 ...
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(from = "u64", into = "u64")]
pub struct EntityId {
    // The order of the fields is the order of ids: by slot, then by generation.
    index: u32,
    generation: u32,
}

impl EntityId {
    /// The handle of slot `index` in its `generation`-th use, counted from zero.
    pub const fn new(index: u32, generation: u32) -> Self {
        Self { index, generation }
    }

    /// The slot, dense from zero: use it to index arrays beside the world.
    pub const fn index(self) -> usize {
        self.index as usize
    }

    /// How often the slot was reused before this entity.
    pub const fn generation(self) -> u32 {
        self.generation
    }
}

impl From<u64> for EntityId {
    fn from(bits: u64) -> Self {
        Self { index: bits as u32, generation: (bits >> 32) as u32 }
    }
}

impl From<EntityId> for u64 {
    fn from(id: EntityId) -> Self {
        Self::from(id.generation) << 32 | Self::from(id.index)
    }
}

impl fmt::Display for EntityId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.index)?;
        if self.generation > 0 { write!(f, ".{}", self.generation) } else { Ok(()) }
    }
}

/// Declares a typed index into one array of a [`RoadNetwork`](crate::net::RoadNetwork) or a catalogue.
macro_rules! index_type {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
        #[serde(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The position in the array this index belongs to.
            pub const fn index(self) -> usize {
                self.0 as usize
            }

            /// The index of array position `index`; positions stay below 2³².
            pub fn from_index(index: usize) -> Self {
                Self(u32::try_from(index).expect("arrays of a world stay below 2^32 entries"))
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.0.fmt(f)
            }
        }
    };
}

index_type!(
    /// An asset of the [`Catalogue`](crate::asset::Catalogue) that a world is built with.
    AssetId
);
index_type!(
    /// A road: a centreline between two intersections, with its lanes and sidewalks.
    RoadId
);
index_type!(
    /// A lane: one directed strip of a road.
    LaneId
);
index_type!(
    /// A sidewalk: the walkway along one side of a road.
    SidewalkId
);
index_type!(
    /// A connection: the path from one lane to another across an intersection.
    ConnectionId
);
index_type!(
    /// An intersection, or the dead end of a road.
    IntersectionId
);
index_type!(
    /// A crossing: a marked strip on which pedestrians cross a road.
    CrossingId
);
index_type!(
    /// A plaza: open ground on which people walk wherever they like.
    PlazaId
);
index_type!(
    /// A waypoint of a [`WaypointGraph`](crate::net::WaypointGraph).
    WaypointId
);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_id_is_one_integer_in_files() {
        let id = EntityId::new(7, 2);
        assert_eq!(EntityId::from(u64::from(id)), id);
        assert_eq!(serde_json::to_string(&EntityId::new(7, 0)).unwrap(), "7");
        assert_eq!(id.to_string(), "#7.2");
    }
}
