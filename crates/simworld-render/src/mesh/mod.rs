//! Procedural meshes, one for each silhouette, in one vertex and one index buffer.

mod builder;
mod buildings;
mod nature;
mod people;
mod primitives;
mod street;
mod vehicles;

use std::ops::Range;

use builder::Builder;
pub(crate) use builder::Vertex;
pub(crate) use nature::CROWN_RADIUS;
use people::Stance;
use simworld_core::id::AssetId;
pub(crate) use street::LAMP_REACH;

/// How the fragments of a mesh are painted; each is a pipeline of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[repr(u32)]
pub(crate) enum Pattern {
    Plain = 0,
    Facade = 1,
    Road = 2,
    Sidewalk = 3,
    Crosswalk = 4,
    Ground = 5,
    Foliage = 6,
}

impl Pattern {
    /// Whether it paints surfaces that one walks and drives on.
    pub(crate) const fn is_flat(self) -> bool {
        matches!(self, Self::Road | Self::Sidewalk | Self::Crosswalk | Self::Ground)
    }

    pub(crate) const ALL: [Self; 7] =
        [Self::Plain, Self::Facade, Self::Road, Self::Sidewalk, Self::Crosswalk, Self::Ground, Self::Foliage];
}

macro_rules! meshes {
    ($($(#[$doc:meta])* $name:ident = $pattern:ident, $make:expr;)+) => {
        /// A mesh; drawn in this order.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[repr(u8)]
        pub(crate) enum MeshId {
            $($(#[$doc])* $name,)+
        }

        impl MeshId {
            pub(crate) const ALL: &[Self] = &[$(Self::$name,)+];

            pub(crate) const fn pattern(self) -> Pattern {
                match self {
                    $(Self::$name => Pattern::$pattern,)+
                }
            }

            fn build(self) -> Builder {
                match self {
                    $(Self::$name => $make,)+
                }
            }
        }
    };
}

// Near and small things first: what they hide is not shaded again.
meshes! {
    Standing = Plain, people::person(Stance::Standing);
    Walking = Plain, people::person(Stance::Walking);
    Sitting = Plain, people::person(Stance::Sitting);
    Dog = Plain, people::dog();
    Robot = Plain, people::robot();
    Parcel = Plain, street::parcel();
    Sedan = Plain, vehicles::sedan();
    Hatchback = Plain, vehicles::hatchback();
    Truck = Plain, vehicles::truck();
    Bus = Plain, vehicles::bus();
    Motorcycle = Plain, vehicles::motorcycle();
    Bicycle = Plain, vehicles::bicycle();
    Scooter = Plain, vehicles::scooter();
    Lamp = Plain, street::lamp();
    Signal = Plain, street::signal();
    Sign = Plain, buildings::sign();
    Bench = Plain, street::bench();
    Chair = Plain, street::chair();
    Table = Plain, street::table();
    TrashBin = Plain, street::trash_bin();
    Mailbox = Plain, street::mailbox();
    Hydrant = Plain, street::hydrant();
    Cone = Plain, street::cone();
    BusStop = Plain, buildings::bus_stop();
    Cuboid = Plain, primitives::cuboid();
    Cylinder = Plain, primitives::cylinder();
    Capsule = Plain, primitives::capsule();
    Sphere = Plain, primitives::sphere();
    Block = Facade, buildings::block();
    House = Facade, buildings::house();
    Broadleaf = Foliage, nature::broadleaf();
    Slender = Foliage, nature::slender();
    Shrub = Foliage, nature::shrub();
    Sidewalk = Sidewalk, primitives::cuboid();
    Crosswalk = Crosswalk, primitives::cuboid();
    Road = Road, primitives::cuboid();
    Ground = Ground, primitives::cuboid();
}

/// What is drawn of an entity: a mesh of this crate, or the model of its asset.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Drawn {
    // Before the large surfaces, as all small things.
    Model(AssetId),
    Own(MeshId),
}

impl Drawn {
    pub(crate) const fn pattern(self) -> Pattern {
        match self {
            Self::Model(_) => Pattern::Plain,
            Self::Own(mesh) => mesh.pattern(),
        }
    }
}

/// All meshes, ready for upload.
pub(crate) struct MeshLibrary {
    pub vertices: Vec<Vertex>,
    pub indices: Vec<u32>,
    /// The indices of each mesh, in the order of [`MeshId::ALL`].
    pub ranges: Vec<Range<u32>>,
}

impl MeshLibrary {
    pub(crate) fn build() -> Self {
        let mut library = Self { vertices: Vec::new(), indices: Vec::new(), ranges: Vec::new() };
        for mesh in MeshId::ALL {
            let built = mesh.build();
            let (base, first) = (library.vertices.len() as u32, library.indices.len() as u32);
            library.indices.extend(built.indices.iter().map(|index| base + index));
            library.vertices.extend(built.vertices);
            library.ranges.push(first..library.indices.len() as u32);
        }
        library
    }
}

#[cfg(test)]
mod tests {
    use super::builder::{cross, dot, length, sub};
    use super::*;

    /// Every triangle of every mesh is wound counter-clockwise as its normals say.
    #[test]
    fn every_surface_looks_outwards() {
        for mesh in MeshId::ALL {
            let Builder { vertices, indices, .. } = mesh.build();
            let place = |index: u32| -> [f32; 3] {
                let vertex = &vertices[index as usize];
                std::array::from_fn(|axis| vertex.anchor[axis] * 4.0 + vertex.offset[axis])
            };
            for triangle in indices.chunks_exact(3) {
                let [a, b, c] = [triangle[0], triangle[1], triangle[2]].map(place);
                let face = cross(sub(b, a), sub(c, a));
                if length(face) < 1e-9 {
                    continue;
                }
                let normal = vertices[triangle[0] as usize].normal;
                assert!(normal.iter().all(|component| component.is_finite()), "{mesh:?}");
                let cosine = dot(face, normal) / length(face);
                assert!(cosine > -0.2, "{mesh:?}: a face looks inwards, cosine {cosine}");
            }
        }
    }

    /// The four solids and the walls fill their boxes exactly: depth agrees with what bodies collide with.
    #[test]
    fn solids_fill_their_boxes() {
        for mesh in [MeshId::Cuboid, MeshId::Block, MeshId::House, MeshId::Road] {
            let built = mesh.build();
            let height = built.vertices.iter().map(|v| v.anchor[2] * 10.0 + v.offset[2]).fold(0.0, f32::max);
            let length = built.vertices.iter().map(|v| v.anchor[0] * 10.0 + v.offset[0]).fold(0.0, f32::max);
            assert_eq!((height, length), (10.0, 5.0), "{mesh:?}");
        }
    }
}
