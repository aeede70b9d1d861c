//! Shadow maps that are kept: one is drawn anew only where the sun, its place or what throws shadows into it changed.
//!
//! A map belongs to a place and a sun, not to an eye, so that views from about one place share it, and what it holds depends on
//! the scene alone. What stands still has a layer of its own once something moves in the map; what moves is drawn over a copy of it.

use super::device::Gpu;
use super::targets::Z;
use crate::shadow::ShadowKey;

/// Maps that are kept at most.
pub(crate) const MOST_MAPS: usize = 6;

/// Who throws shadows into a map: numbers of instances, and when each last changed.
pub(crate) type Casters = Vec<(u32, u64)>;

/// The maps of a device.
pub(crate) struct ShadowMaps {
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    side: u32,
    /// What pictures without shadows bind.
    none: wgpu::BindGroup,
    held: Vec<Held>,
    round: u64,
}

struct Held {
    key: ShadowKey,
    /// Of the residents when it was last found up to date.
    version: u64,
    /// The round in which it was last drawn from what the device found.
    redrawn: u64,
    /// What is in it, still and moving.
    drawn: [Casters; 2],
    whole: Layer,
    /// What stands still, and whether that is in it.
    still: Option<(Layer, Casters)>,
    group: wgpu::BindGroup,
    used: u64,
}

struct Layer {
    texture: wgpu::Texture,
    view: wgpu::TextureView,
}

/// What is to be done before a map is right.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Redraw {
    Nothing,
    /// What stands still, into the map itself: nothing moves in it.
    Whole,
    /// What stands still into its layer if that is `stale`; a copy of it; what moves over that.
    Layers {
        /// Whether what stands still is not as in its layer.
        stale: bool,
    },
}

impl ShadowMaps {
    pub(crate) fn new(gpu: &Gpu, side: u32) -> Self {
        let device = &gpu.device;
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        let map = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let compared = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison);
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("shadow"),
            entries: &[entry(0, map), entry(1, compared)],
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadow"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let none = bind(gpu, &layout, &sampler, &Layer::new(gpu, 1));
        Self { layout, sampler, side, none, held: Vec::new(), round: 0 }
    }

    pub(crate) const fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// What a map of that key is bound by; without one, a map that nobody reads.
    pub(crate) fn group(&self, key: Option<&ShadowKey>) -> &wgpu::BindGroup {
        let held = key.and_then(|key| self.held.iter().find(|held| held.key == *key));
        held.map_or(&self.none, |held| &held.group)
    }

    /// What each map holds is not known any more.
    pub(crate) fn forget(&mut self) {
        self.held.clear();
    }

    /// A new batch begins: maps that it uses are given away last.
    pub(crate) fn begin(&mut self) {
        self.round += 1;
    }

    /// Whether the map of a key is right for that version of the residents; it is then kept for this batch.
    pub(crate) fn is_current(&mut self, key: &ShadowKey, version: u64) -> bool {
        let held = self.held.iter_mut().find(|held| held.key == *key && held.version == version);
        held.map(|held| held.used = self.round).is_some()
    }

    /// Makes a map ready to be drawn for these casters, still and moving, and says what of it has to be.
    pub(crate) fn plan(
        &mut self,
        gpu: &Gpu,
        key: &ShadowKey,
        version: u64,
        casters: &[Casters; 2],
    ) -> Redraw {
        let index = self.find(gpu, key);
        let held = &mut self.held[index];
        (held.used, held.version) = (self.round, version);
        if held.drawn == *casters {
            return Redraw::Nothing;
        }
        held.drawn.clone_from(casters);
        let [standing, moving] = casters;
        if moving.is_empty() {
            return Redraw::Whole;
        }
        let side = self.side;
        let (_, layered) = held.still.get_or_insert_with(|| (Layer::new(gpu, side), NOT_DRAWN.to_vec()));
        let stale = layered != standing;
        if stale {
            layered.clone_from(standing);
        }
        Redraw::Layers { stale }
    }

    /// Makes a map ready to be drawn whole from what the device finds; false if it was in this batch.
    pub(crate) fn plan_whole(&mut self, gpu: &Gpu, key: &ShadowKey, version: u64) -> bool {
        let (index, round) = (self.find(gpu, key), self.round);
        let held = &mut self.held[index];
        (held.used, held.version) = (round, version);
        held.drawn = [NOT_DRAWN.to_vec(), Casters::new()];
        std::mem::replace(&mut held.redrawn, round) != round
    }

    /// The map of a key as a target; `still` is the layer of what stands still.
    pub(crate) fn target(&self, key: &ShadowKey, still: bool) -> Option<&wgpu::TextureView> {
        let held = self.held.iter().find(|held| held.key == *key)?;
        if still { held.still.as_ref().map(|(layer, _)| &layer.view) } else { Some(&held.whole.view) }
    }

    /// Records the copy of what stands still into the map.
    pub(crate) fn copy(&self, encoder: &mut wgpu::CommandEncoder, key: &ShadowKey) {
        let Some(held) = self.held.iter().find(|held| held.key == *key) else { return };
        let Some((still, _)) = &held.still else { return };
        let (from, to) = (still.texture.as_image_copy(), held.whole.texture.as_image_copy());
        encoder.copy_texture_to_texture(from, to, held.whole.texture.size());
    }

    /// The map of a key: the one that has it, a new one, or the one that was not used for longest.
    fn find(&mut self, gpu: &Gpu, key: &ShadowKey) -> usize {
        if let Some(index) = self.held.iter().position(|held| held.key == *key) {
            return index;
        }
        if self.held.len() < MOST_MAPS {
            let whole = Layer::new(gpu, self.side);
            let group = bind(gpu, &self.layout, &self.sampler, &whole);
            let drawn = [NOT_DRAWN.to_vec(), Casters::new()];
            self.held.push(Held {
                key: *key,
                version: 0,
                redrawn: 0,
                drawn,
                whole,
                still: None,
                group,
                used: 0,
            });
            return self.held.len() - 1;
        }
        let oldest = (0..self.held.len()).min_by_key(|index| self.held[*index].used).unwrap_or(0);
        let held = &mut self.held[oldest];
        (held.key, held.redrawn) = (*key, 0);
        held.drawn = [NOT_DRAWN.to_vec(), Casters::new()];
        if let Some((_, layered)) = &mut held.still {
            *layered = NOT_DRAWN.to_vec();
        }
        oldest
    }
}

/// Casters that nobody has: no instance has that number.
const NOT_DRAWN: [(u32, u64); 1] = [(u32::MAX, u64::MAX)];

impl Layer {
    fn new(gpu: &Gpu, side: u32) -> Self {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow map"),
            size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: Z,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC
                | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view }
    }
}

fn bind(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    sampler: &wgpu::Sampler,
    layer: &Layer,
) -> wgpu::BindGroup {
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("shadow"),
        layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&layer.view) },
            wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(sampler) },
        ],
    })
}
