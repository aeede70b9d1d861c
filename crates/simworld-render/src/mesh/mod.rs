//! Procedural meshes, one for each silhouette, in one vertex and one index buffer.

mod builder;
mod buildings;
pub(crate) mod creatures;
pub(crate) mod cycles;
pub(crate) mod figures;
mod fittings;
mod heavy;
mod nature;
pub(crate) mod people;
mod primitives;
mod signs;
mod species;
mod specks;
mod street;
mod things;
mod vehicles;

use std::ops::Range;

use builder::Builder;
pub(crate) use builder::Vertex;
use buildings::Ridge;
use figures::Stance;
pub(crate) use nature::CROWN_RADIUS;
use people::{Grain, Hair};
use simworld_core::asset::RigPose;
pub(crate) use street::LAMP_REACH;

use crate::sources::Source;

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
    /// What is painted on roads, which is much to ask of every pixel of them.
    Mark = 7,
    /// The pictures on models of assets.
    Model = 8,
}

impl Pattern {
    /// Whether it paints surfaces that one walks and drives on.
    pub(crate) const fn is_flat(self) -> bool {
        matches!(self, Self::Road | Self::Mark | Self::Sidewalk | Self::Crosswalk | Self::Ground)
    }
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
    Pelvis = Plain, people::pelvis(Grain::Fine);
    Chest = Plain, people::chest(Grain::Fine);
    HeadShort = Plain, people::head(Grain::Fine, Hair::Short);
    HeadLong = Plain, people::head(Grain::Fine, Hair::Long);
    HeadBun = Plain, people::head(Grain::Fine, Hair::Bun);
    HeadBald = Plain, people::head(Grain::Fine, Hair::None);
    UpperArm = Plain, people::upper_arm(Grain::Fine);
    Forearm = Plain, people::forearm(Grain::Fine);
    Thigh = Plain, people::thigh(Grain::Fine);
    Shank = Plain, people::shank(Grain::Fine);
    Foot = Plain, people::foot(Grain::Fine);
    CoarsePelvis = Plain, people::pelvis(Grain::Coarse);
    CoarseChest = Plain, people::chest(Grain::Coarse);
    CoarseHeadShort = Plain, people::head(Grain::Coarse, Hair::Short);
    CoarseHeadLong = Plain, people::head(Grain::Coarse, Hair::Long);
    CoarseUpperArm = Plain, people::upper_arm(Grain::Coarse);
    CoarseForearm = Plain, people::forearm(Grain::Coarse);
    CoarseThigh = Plain, people::thigh(Grain::Coarse);
    CoarseShank = Plain, people::shank(Grain::Coarse);
    CoarseFoot = Plain, people::foot(Grain::Coarse);
    Cap = Plain, people::cap();
    Hat = Plain, people::hat();
    Helmet = Plain, people::helmet();
    Coat = Plain, people::coat();
    Skirt = Plain, people::skirt();
    Backpack = Plain, people::backpack();
    ShoulderBag = Plain, people::shoulder_bag();
    Standing = Plain, figures::person(Stance::Standing);
    Walking = Plain, figures::person(Stance::Walking(1.0));
    WalkingLeft = Plain, figures::person(Stance::Walking(0.5));
    WalkingRight = Plain, figures::person(Stance::Walking(-0.5));
    WalkingFarRight = Plain, figures::person(Stance::Walking(-1.0));
    Sitting = Plain, figures::person(Stance::Sitting);
    Dog = Plain, creatures::dog(0.0);
    DogLeft = Plain, creatures::dog(0.5);
    DogFarLeft = Plain, creatures::dog(1.0);
    DogRight = Plain, creatures::dog(-0.5);
    DogFarRight = Plain, creatures::dog(-1.0);
    Robot = Plain, creatures::robot();
    Parcel = Plain, street::parcel();
    DogTrunk = Plain, creatures::dog_trunk();
    DogThigh = Plain, creatures::dog_thigh();
    DogShank = Plain, creatures::dog_shank();
    RobotTrunk = Plain, creatures::robot_trunk();
    RobotThigh = Plain, creatures::robot_thigh();
    RobotShank = Plain, creatures::robot_shank();
    Wheel = Plain, cycles::wheel(18);
    CoarseWheel = Plain, cycles::wheel(8);
    CycleWheel = Plain, cycles::spoked(0.045);
    MotorWheel = Plain, cycles::spoked(0.16);
    Bicycle = Plain, cycles::bicycle();
    Motorcycle = Plain, cycles::motorcycle();
    Scooter = Plain, cycles::scooter();
    FarCycle = Plain, cycles::far_cycle();
    Sedan = Plain, vehicles::sedan();
    Hatchback = Plain, vehicles::hatchback();
    Estate = Plain, vehicles::estate();
    Suv = Plain, vehicles::suv();
    Sports = Plain, vehicles::sports();
    Pickup = Plain, vehicles::pickup();
    FarCar = Plain, vehicles::far_car();
    TaxiSign = Plain, vehicles::taxi_sign();
    LightBar = Plain, vehicles::light_bar();
    Stripe = Plain, vehicles::stripe();
    Van = Plain, heavy::van();
    Truck = Plain, heavy::truck();
    FireEngine = Plain, heavy::fire_engine();
    Tanker = Plain, heavy::tanker();
    Tipper = Plain, heavy::tipper();
    FarTruck = Plain, heavy::far_truck();
    Bus = Plain, heavy::bus();
    DoubleDecker = Plain, heavy::double_decker();
    FarBus = Plain, heavy::far_bus();
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
    Chimney = Plain, fittings::chimney();
    RoofUnit = Plain, fittings::roof_unit();
    Tank = Plain, fittings::tank();
    Antenna = Plain, fittings::antenna();
    Awning = Plain, fittings::awning();
    BladeSign = Plain, fittings::blade_sign();
    Balcony = Plain, fittings::balcony();
    Canopy = Plain, fittings::canopy();
    Portico = Plain, fittings::portico();
    Cross = Plain, fittings::cross();
    Gate = Plain, fittings::gate();
    Spire = Plain, fittings::spire();
    Skylight = Plain, fittings::skylight();
    Obelisk = Plain, fittings::obelisk();
    Door = Plain, fittings::door();
    Bollard = Plain, things::bollard();
    Barrel = Plain, things::barrel();
    Planter = Plain, things::planter();
    PicketFence = Plain, things::picket_fence();
    Railing = Plain, things::railing();
    SiteFence = Plain, things::site_fence();
    Barricade = Plain, things::barricade();
    Jersey = Plain, things::jersey();
    Kiosk = Plain, things::kiosk();
    Stall = Plain, things::stall();
    Parasol = Plain, things::parasol();
    Cabinet = Plain, things::cabinet();
    Machine = Plain, things::machine();
    Booth = Plain, things::booth();
    Rack = Plain, things::rack();
    StopSign = Plain, signs::plate(8, 0.36);
    YieldSign = Plain, signs::plate(3, 0.42);
    NameSign = Plain, signs::name_plate();
    Board = Plain, signs::board();
    PosterColumn = Plain, signs::column();
    Lantern = Plain, signs::lantern();
    DoubleLamp = Plain, signs::double_lamp();
    WalkSignal = Plain, signs::walk_signal();
    Fountain = Plain, things::fountain();
    Statue = Plain, things::statue();
    Container = Plain, things::container();
    Crate = Plain, things::crate_of_boards();
    Heap = Plain, things::heap();
    Tent = Plain, things::tent();
    Pavilion = Plain, things::pavilion();
    Mast = Plain, signs::mast();
    Flag = Plain, signs::flag();
    Frame = Plain, things::frame();
    Boat = Plain, things::boat();
    Ball = Plain, things::ball();
    SpeckPerson = Plain, specks::person();
    SpeckLamp = Plain, specks::lamp();
    SpeckCar = Plain, specks::car();
    SpeckWheel = Plain, specks::wheel();
    SpeckBin = Plain, specks::bin();
    SpeckBench = Plain, specks::bench();
    SpeckUnit = Plain, specks::roof_unit();
    SpeckBare = Plain, specks::bare();
    Bare = Plain, species::bare(2);
    CoarseBare = Plain, species::bare(1);
    FarBare = Plain, species::bare(0);
    Cuboid = Plain, primitives::cuboid();
    Cylinder = Plain, primitives::cylinder();
    Capsule = Plain, primitives::capsule();
    Sphere = Plain, primitives::sphere();
    Block = Facade, buildings::block();
    FarBlock = Facade, buildings::far_block();
    House = Facade, buildings::house(Ridge::Across, 0.0);
    HouseAlong = Facade, buildings::house(Ridge::Along, 0.0);
    Hip = Facade, buildings::house(Ridge::Across, 0.28);
    HipAlong = Facade, buildings::house(Ridge::Along, 0.28);
    Shed = Facade, buildings::shed();
    Broadleaf = Foliage, nature::broadleaf();
    Slender = Foliage, nature::slender();
    MiddleCrown = Foliage, species::middle_crown();
    FarCrown = Foliage, species::far_crown(0.25, 0.32);
    SpeckCrown = Foliage, specks::crown();
    Conifer = Foliage, species::conifer(1.0, 12);
    FarConifer = Foliage, species::conifer(1.0, 5);
    Column = Foliage, species::column(12);
    FarColumn = Foliage, species::column(5);
    Willow = Foliage, species::willow();
    Palm = Foliage, species::palm();
    Shrub = Foliage, nature::shrub();
    Mark = Mark, primitives::top();
    Sidewalk = Sidewalk, primitives::cuboid();
    Crosswalk = Crosswalk, primitives::cuboid();
    Road = Road, primitives::cuboid();
    Ground = Ground, primitives::cuboid();
}

impl MeshId {
    /// The mesh of fewer triangles that stands for this one a little farther away, or the same.
    pub(crate) const fn coarse(self) -> Self {
        match self {
            Self::Pelvis => Self::CoarsePelvis,
            Self::Chest => Self::CoarseChest,
            Self::HeadShort | Self::HeadBun | Self::HeadBald => Self::CoarseHeadShort,
            Self::HeadLong => Self::CoarseHeadLong,
            Self::UpperArm => Self::CoarseUpperArm,
            Self::Forearm => Self::CoarseForearm,
            Self::Thigh => Self::CoarseThigh,
            Self::Shank => Self::CoarseShank,
            Self::Foot => Self::CoarseFoot,
            _ => self,
        }
    }
}

impl MeshId {
    /// How far below the top of its box a closed block ends that nobody looks through, in units, and whether that holds from above;
    /// none for what has gaps.
    pub(crate) const fn closed(self) -> Option<(f32, bool)> {
        match self {
            Self::Cuboid => Some((0.0, true)),
            Self::Block | Self::FarBlock => Some((buildings::PARAPET[0], true)),
            // Under the eaves one may look over the wall.
            Self::House | Self::HouseAlong | Self::Hip | Self::HipAlong | Self::Shed => {
                Some((buildings::RISE, false))
            }
            _ => None,
        }
    }
}

/// A model in one of its poses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct ModelId {
    pub source: Source,
    /// None where it stands as it rests.
    pub pose: Option<RigPose>,
}

/// What is drawn of an entity: a mesh of this crate, or the model of its asset or of a link.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Drawn {
    // Before the large surfaces, as all small things.
    Model(ModelId),
    Own(MeshId),
}

impl Drawn {
    /// What stands for it where fewer pixels than these are across the ball around its entity, if anything does.
    pub(crate) const fn speck(self) -> Option<(f64, Self)> {
        match self {
            Self::Model(_) => None,
            Self::Own(mesh) => match mesh.speck() {
                Some((few, speck)) => Some((few, Self::Own(speck))),
                None => None,
            },
        }
    }

    pub(crate) const fn pattern(self) -> Pattern {
        match self {
            Self::Model(_) => Pattern::Model,
            Self::Own(mesh) => mesh.pattern(),
        }
    }
}

/// The box of a mesh: of its anchors, and of its offsets; with a scale and a unit both give the box of its points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Extent {
    /// Least and greatest anchor.
    pub anchors: [builder::V3; 2],
    /// Least and greatest offset.
    pub offsets: [builder::V3; 2],
}

impl Extent {
    fn around(vertices: &[Vertex]) -> Self {
        let bound = |of: fn(&Vertex) -> builder::V3| {
            let start = vertices.first().map_or([0.0; 3], of);
            vertices.iter().map(of).fold([start; 2], |[low, high], point| {
                [
                    std::array::from_fn(|axis| low[axis].min(point[axis])),
                    std::array::from_fn(|axis| high[axis].max(point[axis])),
                ]
            })
        };
        Self { anchors: bound(|vertex| vertex.anchor), offsets: bound(|vertex| vertex.offset) }
    }
}

/// All meshes, ready for upload.
pub(crate) struct MeshLibrary {
    pub vertices: Vec<Vertex>,
    pub indices: Vec<u32>,
    /// The indices of each mesh, in the order of [`MeshId::ALL`].
    pub ranges: Vec<Range<u32>>,
    /// The boxes of the meshes, in the same order.
    pub extents: Vec<Extent>,
}

impl MeshLibrary {
    pub(crate) fn build() -> Self {
        let mut library =
            Self { vertices: Vec::new(), indices: Vec::new(), ranges: Vec::new(), extents: Vec::new() };
        for mesh in MeshId::ALL {
            let built = mesh.build();
            let (base, first) = (library.vertices.len() as u32, library.indices.len() as u32);
            // Balls have rings of triangles without a surface, at their poles and where their halves meet.
            let is_flat = |[a, b, c]: [u32; 3]| {
                let [a, b, c] = [a, b, c].map(|index| &built.vertices[index as usize]);
                let same = |p: &Vertex, q: &Vertex| p.anchor == q.anchor && p.offset == q.offset;
                same(a, b) || same(b, c) || same(c, a)
            };
            let triangles = built.indices.chunks_exact(3).map(|three| [three[0], three[1], three[2]]);
            let solid = triangles.filter(|three| !is_flat(*three));
            library.indices.extend(solid.flatten().map(|index| base + index));
            library.extents.push(Extent::around(&built.vertices));
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
        for mesh in [MeshId::Cuboid, MeshId::Block, MeshId::FarBlock, MeshId::Road] {
            let built = mesh.build();
            let height = built.vertices.iter().map(|v| v.anchor[2] * 10.0 + v.offset[2]).fold(0.0, f32::max);
            let length = built.vertices.iter().map(|v| v.anchor[0] * 10.0 + v.offset[0]).fold(0.0, f32::max);
            assert_eq!((height, length), (10.0, 5.0), "{mesh:?}");
        }
    }
}
