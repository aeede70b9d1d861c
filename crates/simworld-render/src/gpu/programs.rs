//! The sources of the shaders, put together from files.

use super::device::Gpu;
use crate::mesh::Pattern;

const COMMON: &str = include_str!("../shaders/globals.wgsl");
const BINDINGS: &str = include_str!("../shaders/bindings.wgsl");
const RAYS: &str = include_str!("../shaders/rays.wgsl");
const BLOCKED: &str = include_str!("../shaders/blocked.wgsl");
const CAST: &str = include_str!("../shaders/cast.wgsl");
const NOISE: &str = include_str!("../shaders/noise.wgsl");
const SKY: &str = include_str!("../shaders/sky.wgsl");
const SKY_PASS: &str = include_str!("../shaders/sky_pass.wgsl");
const MATERIALS: &str = include_str!("../shaders/materials.wgsl");
const HIT: &str = include_str!("../shaders/hit.wgsl");
const SURFACES: &str = include_str!("../shaders/surfaces.wgsl");
const PAINTED: &str = include_str!("../shaders/painted.wgsl");
const FACADES: &str = include_str!("../shaders/facades.wgsl");
const GROUNDS: &str = include_str!("../shaders/grounds.wgsl");
const CARRIAGEWAYS: &str = include_str!("../shaders/carriageways.wgsl");
const ROADS: &str = include_str!("../shaders/roads.wgsl");
const MARKS: &str = include_str!("../shaders/marks.wgsl");
const LAMPS: &str = include_str!("../shaders/lamps.wgsl");
const DROPS: &str = include_str!("../shaders/drops.wgsl");
const FALL: &str = include_str!("../shaders/fall.wgsl");
const PRECIPITATION: &str = include_str!("../shaders/precipitation.wgsl");
const SHADING: &str = include_str!("../shaders/shading.wgsl");
const SUNLIT: &str = include_str!("../shaders/sunlit.wgsl");
const PICTURES: &str = include_str!("../shaders/pictures.wgsl");
const STORE: &str = include_str!("../shaders/store.wgsl");
const CUTOUTS: &str = include_str!("../shaders/cutouts.wgsl");
const MODELS: &str = include_str!("../shaders/models.wgsl");
const FORWARD_MODELS: &str = include_str!("../shaders/forward_models.wgsl");
const CAST_MODELS: &str = include_str!("../shaders/cast_models.wgsl");
const CAST_FILMS: &str = include_str!("../shaders/cast_films.wgsl");
const FORWARD: &str = include_str!("../shaders/forward.wgsl");
const MEASURES: &str = include_str!("../shaders/measures.wgsl");
const OCTAHEDRAL: &str = include_str!("../shaders/octahedral.wgsl");
const NORMALS: &str = include_str!("../shaders/normals.wgsl");
const SHADOW: &str = include_str!("../shaders/shadow.wgsl");

/// A module of shaders.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Program {
    /// Pictures of one pattern by triangles. Each has a module of its own, since drivers translate all that is in one before they see what of it is
    /// never reached.
    Forward(Pattern),
    /// Depth and ids of what is whole, by triangles.
    Measures,
    /// Normals of what is whole, by triangles.
    Normals,
    /// Shadow maps of what is whole.
    Shadow,
    /// Everything but the picture of what is cut out of models.
    Cutouts,
    Sky,
    /// Rain and snow before triangles.
    Precipitation,
    /// The ray-cast backend: the same shading as [`Forward`](Self::Forward) with another `sunlit` and other bindings.
    Rays,
}

impl Program {
    /// The files that it is made of, one behind the other.
    fn files(self) -> Vec<&'static str> {
        let shading = [COMMON, NOISE, SKY, MATERIALS, HIT, SURFACES, SHADING, LAMPS];
        match self {
            Self::Forward(pattern) => {
                let models = [PICTURES, STORE, MODELS, FORWARD_MODELS];
                let models = if pattern == Pattern::Model { &models[..] } else { &[] };
                [&shading[..], painters(pattern), &[BINDINGS, SUNLIT, FORWARD], models].concat()
            }
            Self::Measures => vec![COMMON, BINDINGS, MEASURES],
            Self::Normals => vec![COMMON, BINDINGS, OCTAHEDRAL, NORMALS],
            Self::Shadow => vec![COMMON, BINDINGS, SHADOW],
            Self::Cutouts => vec![COMMON, BINDINGS, OCTAHEDRAL, PICTURES, STORE, CUTOUTS],
            Self::Sky => vec![COMMON, BINDINGS, NOISE, SKY, SKY_PASS],
            Self::Precipitation => vec![COMMON, BINDINGS, NOISE, SKY, DROPS, PRECIPITATION],
            Self::Rays => {
                let painters = [FACADES, GROUNDS, CARRIAGEWAYS, ROADS, MARKS, PAINTED];
                let rays =
                    [PICTURES, MODELS, OCTAHEDRAL, RAYS, BLOCKED, CAST, CAST_MODELS, DROPS, FALL, CAST_FILMS];
                [&shading[..], &painters, &rays].concat()
            }
        }
    }

    /// Reads it on a device.
    pub(crate) fn module(self, gpu: &Gpu) -> wgpu::ShaderModule {
        gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(match self {
                Self::Forward(_) => "forward",
                Self::Measures => "measures",
                Self::Normals => "normals",
                Self::Shadow => "shadow",
                Self::Cutouts => "cutouts",
                Self::Sky => "sky",
                Self::Precipitation => "precipitation",
                Self::Rays => "raycast",
            }),
            source: wgpu::ShaderSource::Wgsl(self.files().concat().into()),
        })
    }
}

/// What paints one pattern: `painted`, and what that needs.
const fn painters(pattern: Pattern) -> &'static [&'static str] {
    match pattern {
        Pattern::Plain | Pattern::Model => {
            &["fn painted(hit: Hit, base: Surface) -> Surface { return base; }"]
        }
        Pattern::Facade => {
            &[FACADES, "fn painted(hit: Hit, base: Surface) -> Surface { return facade(hit, base); }"]
        }
        Pattern::Road => &[
            CARRIAGEWAYS,
            ROADS,
            "fn painted(hit: Hit, base: Surface) -> Surface { return road(hit, base); }",
        ],
        Pattern::Crosswalk => &[
            CARRIAGEWAYS,
            ROADS,
            "fn painted(hit: Hit, base: Surface) -> Surface { return crosswalk(hit, base); }",
        ],
        Pattern::Mark => &[
            CARRIAGEWAYS,
            MARKS,
            "fn painted(hit: Hit, base: Surface) -> Surface { return marked(hit, base); }",
        ],
        Pattern::Sidewalk => {
            &[GROUNDS, "fn painted(hit: Hit, base: Surface) -> Surface { return sidewalk(hit, base); }"]
        }
        Pattern::Ground => {
            &[GROUNDS, "fn painted(hit: Hit, base: Surface) -> Surface { return ground(hit, base); }"]
        }
        Pattern::Foliage => {
            &[GROUNDS, "fn painted(hit: Hit, base: Surface) -> Surface { return foliage(hit, base); }"]
        }
    }
}
