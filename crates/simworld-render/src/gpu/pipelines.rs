//! The pipelines: one for each pattern, specialised by an override constant, so that no pixel pays for another's
//! painting; one for the sky, and one for shadows.

use std::collections::BTreeMap;

use bitflags::bitflags;

use super::device::Gpu;
use super::targets::{COLOR, DEPTH, ID, SAMPLES, Z};
use crate::config::AntiAliasing;
use crate::mesh::{Pattern, Vertex};
use crate::resident::Instance;

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
const PATTERNS: &str = include_str!("../shaders/patterns.wgsl");
const ROADS: &str = include_str!("../shaders/roads.wgsl");
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
const FORWARD: &str = include_str!("../shaders/forward.wgsl");
const OCTAHEDRAL: &str = include_str!("../shaders/octahedral.wgsl");
const NORMALS: &str = include_str!("../shaders/normals.wgsl");
const SHADOW: &str = include_str!("../shaders/shadow.wgsl");

/// Everything that is bound and run.
pub(crate) struct Pipelines {
    /// RGB with the measures, or RGB alone where it is smoothed; by [`Features`], then by [`Pattern`].
    picture: BTreeMap<Features, Vec<wgpu::RenderPipeline>>,
    forward: wgpu::ShaderModule,
    forward_layout: wgpu::PipelineLayout,
    /// The same with the pictures of models.
    model_layout: wgpu::PipelineLayout,
    /// Of what is cut out, made when there is some: RGB by [`Features`], and everything else.
    cut_picture: BTreeMap<Features, wgpu::RenderPipeline>,
    cuts: Option<Cuts>,
    /// The same pictures without shadows.
    cut_layout: wgpu::PipelineLayout,
    smooth: bool,
    /// Depth and ids alone, where RGB is smoothed or not asked for.
    pub measures: wgpu::RenderPipeline,
    /// Normals alone.
    pub normals: wgpu::RenderPipeline,
    pub sky: wgpu::RenderPipeline,
    /// Rain and snow over the picture.
    pub precipitation: wgpu::RenderPipeline,
    pub shadow: wgpu::RenderPipeline,
    /// The layout of [`Scenery`](super::Scenery): globals of a view, and its light.
    pub scenery: wgpu::BindGroupLayout,
}

/// What is cut out of models is drawn with, beside its picture.
pub(crate) struct Cuts {
    pub measures: wgpu::RenderPipeline,
    pub normals: wgpu::RenderPipeline,
    pub shadow: wgpu::RenderPipeline,
}

bitflags! {
    /// What a picture needs beyond sun and sky; the bits of FEATURES in shaders/shading.wgsl.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
    pub(crate) struct Features: u32 {
        const LAMPS = 1;
        const WATER = 2;
        const SNOW = 4;
        /// Of rays alone: triangles of models have a pipeline of their own.
        const MODELS = 8;
        /// Of rays alone, too: some of these are cut out.
        const CUTS = 16;
    }
}

/// What the pipelines of one module share.
struct Recipe<'a> {
    gpu: &'a Gpu,
    module: &'a wgpu::ShaderModule,
    layout: &'a wgpu::PipelineLayout,
}

struct Variant<'a> {
    label: &'a str,
    vertex: &'a str,
    fragment: Option<&'a str>,
    constants: &'a [(&'a str, f64)],
    targets: &'a [Option<wgpu::ColorTargetState>],
    depth: wgpu::DepthStencilState,
    samples: u32,
    /// Whether it reads vertices and instances.
    meshes: bool,
}

impl Pipelines {
    pub(crate) fn new(
        gpu: &Gpu,
        shadows: &wgpu::BindGroupLayout,
        store: &wgpu::BindGroupLayout,
        smoothing: AntiAliasing,
    ) -> Self {
        let device = &gpu.device;
        let scenery = scenery_layout(device);
        let layout = |groups: &[Option<&wgpu::BindGroupLayout>]| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: None,
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        let module = |label, sources: &[&str]| {
            device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(sources.concat().into()),
            })
        };
        let full = layout(&[Some(&scenery), Some(shadows)]);
        let plain = layout(&[Some(&scenery)]);
        let shading = [COMMON, BINDINGS, NOISE, SKY, MATERIALS, HIT, PATTERNS, ROADS, SHADING, LAMPS, SUNLIT];
        let models = [PICTURES, STORE, MODELS, FORWARD, FORWARD_MODELS];
        let forward = module("forward", &[&shading[..], &models[..]].concat());
        let sky = module("sky", &[COMMON, BINDINGS, NOISE, SKY, SKY_PASS]);
        let falling = module("precipitation", &[COMMON, BINDINGS, NOISE, SKY, DROPS, PRECIPITATION]);
        let shadow = module("shadow", &[COMMON, BINDINGS, SHADOW]);
        let normals = module("normals", &[COMMON, BINDINGS, OCTAHEDRAL, NORMALS]);

        let smooth = smoothing == AntiAliasing::Msaa4;
        Self {
            picture: BTreeMap::new(),
            measures: Recipe { gpu, module: &forward, layout: &full }
                .measures(["vertex_main", "fragment_measures"]),
            normals: Recipe { gpu, module: &normals, layout: &plain }
                .normals(["vertex_normals", "fragment_normals"]),
            forward,
            forward_layout: full,
            model_layout: layout(&[Some(&scenery), Some(shadows), Some(store)]),
            cut_picture: BTreeMap::new(),
            cuts: None,
            cut_layout: layout(&[Some(&scenery), None, Some(store)]),
            smooth,
            precipitation: Recipe { gpu, module: &falling, layout: &plain }.precipitation(smooth),
            sky: Recipe { gpu, module: &sky, layout: &plain }.sky(smooth),
            shadow: Recipe { gpu, module: &shadow, layout: &plain }.shadow("vertex_shadow", None),
            scenery,
        }
    }

    /// Makes what a picture of these features is drawn with, the first time that one is wanted.
    pub(crate) fn prepare(&mut self, gpu: &Gpu, features: Features) {
        let picture = |pattern| {
            let is_model = pattern == Pattern::Model;
            let layout = if is_model { &self.model_layout } else { &self.forward_layout };
            Recipe { gpu, module: &self.forward, layout }.picture(pattern, features, self.smooth, false)
        };
        self.picture.entry(features).or_insert_with(|| Pattern::ALL.map(picture).into());
    }

    /// Makes what draws what is cut out of models, and with features pictures of it, the first time that one is wanted.
    pub(crate) fn prepare_cuts(&mut self, gpu: &Gpu, features: Option<Features>) {
        if self.cuts.is_none() {
            let source = [COMMON, BINDINGS, OCTAHEDRAL, PICTURES, STORE, CUTOUTS].concat();
            let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("cutouts"),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            });
            let recipe = Recipe { gpu, module: &module, layout: &self.cut_layout };
            self.cuts = Some(Cuts {
                measures: recipe.measures(["vertex_cut", "fragment_cut_measures"]),
                normals: recipe.normals(["vertex_cut", "fragment_cut_normals"]),
                shadow: recipe.shadow("vertex_cut_shadow", Some("fragment_cut_shadow")),
            });
        }
        let recipe = Recipe { gpu, module: &self.forward, layout: &self.model_layout };
        if let Some(features) = features {
            let picture = || recipe.picture(Pattern::Model, features, self.smooth, true);
            self.cut_picture.entry(features).or_insert_with(picture);
        }
    }

    /// What draws pictures of what is cut out, if it was [prepared](Self::prepare_cuts).
    pub(crate) fn cut_picture(&self, features: Features) -> Option<&wgpu::RenderPipeline> {
        self.cut_picture.get(&features)
    }

    /// What else draws it, if it was [prepared](Self::prepare_cuts).
    pub(crate) const fn cuts(&self) -> Option<&Cuts> {
        self.cuts.as_ref()
    }

    /// The pipeline of a pattern, if it was [prepared](Self::prepare).
    pub(crate) fn picture(&self, features: Features, pattern: Pattern) -> Option<&wgpu::RenderPipeline> {
        self.picture.get(&features).and_then(|pipelines| pipelines.get(pattern as usize))
    }
}

/// The source of the ray-cast backend: the same shading with another `sunlit` and other bindings.
pub(crate) fn raycast_source() -> String {
    let shading = [COMMON, NOISE, SKY, MATERIALS, HIT, PATTERNS, ROADS, SHADING, LAMPS];
    [&shading[..], &[PICTURES, MODELS, OCTAHEDRAL, RAYS, BLOCKED, CAST, CAST_MODELS, DROPS, FALL]]
        .concat()
        .concat()
}

#[expect(clippy::unnecessary_wraps, reason = "wgpu takes every target as an option")]
fn target(format: wgpu::TextureFormat, write_mask: wgpu::ColorWrites) -> Option<wgpu::ColorTargetState> {
    Some(wgpu::ColorTargetState { format, blend: None, write_mask })
}

/// Colour that is laid over what is there by its alpha.
#[expect(clippy::unnecessary_wraps, reason = "wgpu takes every target as an option")]
fn overlay(format: wgpu::TextureFormat) -> Option<wgpu::ColorTargetState> {
    let blend = Some(wgpu::BlendState::ALPHA_BLENDING);
    Some(wgpu::ColorTargetState { format, blend, write_mask: wgpu::ColorWrites::COLOR })
}

fn depth_state(compare: wgpu::CompareFunction, bias: wgpu::DepthBiasState) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: Z,
        depth_write_enabled: Some(true),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias,
    }
}

impl Recipe<'_> {
    fn picture(&self, pattern: Pattern, features: Features, smooth: bool, cut: bool) -> wgpu::RenderPipeline {
        let all = wgpu::ColorWrites::ALL;
        let targets = [target(COLOR, all), target(DEPTH, all), target(ID, all)];
        let (vertex, color, everything) = match pattern {
            Pattern::Model => ("vertex_model", "fragment_model_color", "fragment_model_all"),
            _ => ("vertex_main", "fragment_color", "fragment_all"),
        };
        self.build(&Variant {
            label: "picture",
            vertex,
            fragment: Some(if smooth { color } else { everything }),
            constants: &[
                ("PATTERN", f64::from(pattern as u32)),
                ("FEATURES", f64::from(features.bits())),
                ("CUT", f64::from(u8::from(cut))),
            ],
            targets: if smooth { &targets[..1] } else { &targets },
            depth: depth_state(wgpu::CompareFunction::Greater, wgpu::DepthBiasState::default()),
            samples: if smooth { SAMPLES } else { 1 },
            meshes: true,
        })
    }

    fn measures(&self, [vertex, fragment]: [&str; 2]) -> wgpu::RenderPipeline {
        let all = wgpu::ColorWrites::ALL;
        self.build(&Variant {
            label: "measures",
            vertex,
            fragment: Some(fragment),
            constants: &[],
            targets: &[target(DEPTH, all), target(ID, all)],
            depth: depth_state(wgpu::CompareFunction::Greater, wgpu::DepthBiasState::default()),
            samples: 1,
            meshes: true,
        })
    }

    fn normals(&self, [vertex, fragment]: [&str; 2]) -> wgpu::RenderPipeline {
        self.build(&Variant {
            label: "normals",
            vertex,
            fragment: Some(fragment),
            constants: &[],
            targets: &[target(ID, wgpu::ColorWrites::ALL)],
            depth: depth_state(wgpu::CompareFunction::Greater, wgpu::DepthBiasState::default()),
            samples: 1,
            meshes: true,
        })
    }

    fn sky(&self, smooth: bool) -> wgpu::RenderPipeline {
        let (all, none) = (wgpu::ColorWrites::ALL, wgpu::ColorWrites::empty());
        let targets = [target(COLOR, all), target(DEPTH, none), target(ID, none)];
        self.build(&Variant {
            label: "sky",
            vertex: "vertex_sky",
            fragment: Some(if smooth { "fragment_sky" } else { "fragment_sky_all" }),
            constants: &[],
            targets: if smooth { &targets[..1] } else { &targets },
            // Infinity, where nothing was drawn.
            depth: depth_state(wgpu::CompareFunction::Equal, wgpu::DepthBiasState::default()),
            samples: if smooth { SAMPLES } else { 1 },
            meshes: false,
        })
    }

    fn precipitation(&self, smooth: bool) -> wgpu::RenderPipeline {
        let none = wgpu::ColorWrites::empty();
        let targets = [overlay(COLOR), target(DEPTH, none), target(ID, none)];
        let mut depth = depth_state(wgpu::CompareFunction::Greater, wgpu::DepthBiasState::default());
        depth.depth_write_enabled = Some(false);
        self.build(&Variant {
            label: "precipitation",
            vertex: "vertex_drop",
            fragment: Some(if smooth { "fragment_drop" } else { "fragment_drop_all" }),
            constants: &[],
            targets: if smooth { &targets[..1] } else { &targets },
            depth,
            samples: if smooth { SAMPLES } else { 1 },
            meshes: false,
        })
    }

    fn shadow(&self, vertex: &str, fragment: Option<&str>) -> wgpu::RenderPipeline {
        let bias = wgpu::DepthBiasState { constant: 2, slope_scale: 1.5, clamp: 0.0 };
        self.build(&Variant {
            label: "shadow",
            vertex,
            fragment,
            constants: &[],
            targets: &[],
            depth: depth_state(wgpu::CompareFunction::Less, bias),
            samples: 1,
            meshes: true,
        })
    }

    fn build(&self, variant: &Variant<'_>) -> wgpu::RenderPipeline {
        let options = wgpu::PipelineCompilationOptions { constants: variant.constants, ..Default::default() };
        let buffers = [Some(vertex_layout()), Some(instance_layout())];
        self.gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(variant.label),
            layout: Some(self.layout),
            vertex: wgpu::VertexState {
                module: self.module,
                entry_point: Some(variant.vertex),
                compilation_options: options.clone(),
                buffers: if variant.meshes { &buffers } else { &[] },
            },
            primitive: wgpu::PrimitiveState {
                cull_mode: variant.meshes.then_some(wgpu::Face::Back),
                ..Default::default()
            },
            depth_stencil: Some(variant.depth.clone()),
            multisample: wgpu::MultisampleState { count: variant.samples, ..Default::default() },
            fragment: variant.fragment.map(|entry| wgpu::FragmentState {
                module: self.module,
                entry_point: Some(entry),
                compilation_options: options,
                targets: variant.targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

fn vertex_layout() -> wgpu::VertexBufferLayout<'static> {
    const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
        wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3, 3 => Uint32];
    wgpu::VertexBufferLayout {
        array_stride: size_of::<Vertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &ATTRIBUTES,
    }
}

/// The instances that are drawn, one behind the other: a vertex finds its own without a look into a buffer.
fn instance_layout() -> wgpu::VertexBufferLayout<'static> {
    const ATTRIBUTES: [wgpu::VertexAttribute; 7] = wgpu::vertex_attr_array![
        4 => Float32x4, 5 => Float32x4, 6 => Float32x3, 7 => Uint32, 8 => Float32x4, 9 => Float32x4, 10 => Float32x4
    ];
    wgpu::VertexBufferLayout {
        array_stride: size_of::<Instance>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &ATTRIBUTES,
    }
}

fn scenery_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry = |binding, visibility, ty, has_dynamic_offset| wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None },
        count: None,
    };
    let stages = wgpu::ShaderStages::VERTEX_FRAGMENT | wgpu::ShaderStages::COMPUTE;
    let data = wgpu::BufferBindingType::Storage { read_only: true };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("scenery"),
        entries: &[
            entry(0, stages, wgpu::BufferBindingType::Uniform, true),
            // The sky and the lamps, and the sky alone.
            entry(1, stages, data, false),
            entry(2, stages, wgpu::BufferBindingType::Uniform, false),
        ],
    })
}
