//! Handles into a street graph.

use std::fmt;

/// Declares a handle: a position in one of the graph's arrays. It stays good until what it names is removed.
macro_rules! handle {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub u32);

        impl $name {
            /// The position in the graph's array.
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.0.fmt(f)
            }
        }
    };
}

handle!(
    /// A node: where streets meet or end. After a build, its index in the plan.
    NodeId
);
handle!(
    /// A street. After a build, its index in the plan.
    StreetId
);
handle!(
    /// A face: the land that one closed walk has on its left.
    FaceId
);
handle!(
    /// One side of a street, walked with the side's face on the left: half-edge 2i along street i, 2i + 1 against it.
    HalfEdge
);

impl HalfEdge {
    /// The side walked along a street.
    pub const fn along(street: StreetId) -> Self {
        Self(2 * street.0)
    }

    /// The side walked against a street.
    pub const fn against(street: StreetId) -> Self {
        Self(2 * street.0 + 1)
    }

    /// The other side of the street.
    #[must_use]
    pub const fn twin(self) -> Self {
        Self(self.0 ^ 1)
    }

    /// Its street.
    pub const fn street(self) -> StreetId {
        StreetId(self.0 / 2)
    }

    /// Whether it is walked along its street.
    pub const fn is_along(self) -> bool {
        self.0.is_multiple_of(2)
    }
}
