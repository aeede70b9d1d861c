//! Culling on the device: one view after the other, each by a few dispatches over all instances, whose outcome is drawn without the host.

use std::collections::BTreeMap;
use std::ops::Range;

use super::device::Gpu;
use super::pipelines::Matter;
use super::scenery::{Scenery, runs};
use crate::RenderError;
use crate::deck::{Deck, Kind, Token};
use crate::draw_list::{Batch, Run};
use crate::mesh::Drawn;
use crate::resident::{Instance, Residents};
use crate::sieve::{BUCKETS, Sieve};

const SIFT: &str = include_str!("../shaders/sift.wgsl");
/// Instances that a group looks at, as in sift.wgsl.
const WIDE: u32 = 256;
/// Storage buffers that it binds, as many as rays do.
const BUFFERS: u32 = 9;
/// Bytes of the arguments of a draw.
const DRAW: u64 = 20;
/// An instance is so many vectors of four in sift.wgsl.
const _: () = assert!(size_of::<Instance>() == 6 * 16);

/// What a device must have for it, of what the adapter has.
pub(super) fn features(adapter: &wgpu::Adapter) -> wgpu::Features {
    adapter.features() & wgpu::Features::INDIRECT_FIRST_INSTANCE
}

/// Whether a device can do it.
pub(super) fn is_offered(adapter: &wgpu::Adapter, limits: &wgpu::Limits) -> bool {
    let indirect = wgpu::DownlevelFlags::INDIRECT_EXECUTION | wgpu::DownlevelFlags::COMPUTE_SHADERS;
    !features(adapter).is_empty()
        && adapter.get_downlevel_capabilities().flags.contains(indirect)
        && limits.max_storage_buffers_per_shader_stage >= BUFFERS
        && limits.max_compute_invocations_per_workgroup >= WIDE
}

/// A step of sift.wgsl, and which eight bits of the keys it looks at.
type Step = (&'static str, u32);

/// How many groups a step has.
#[derive(Clone, Copy)]
enum Groups {
    Exactly(u32),
    /// As those that come through are worth, which the device knows.
    Found,
}

/// The buffers and pipelines of sift.wgsl, and what they know of the scene. They hold one view at a time: a view is sifted, then drawn.
pub(crate) struct Sifter {
    deck: Deck,
    arrangement: u64,
    module: wgpu::ShaderModule,
    layout: wgpu::BindGroupLayout,
    /// Of the steps, and of those that say how many groups others have.
    pipeline_layouts: [wgpu::PipelineLayout; 2],
    pipelines: BTreeMap<Step, wgpu::ComputePipeline>,
    sieves: wgpu::Buffer,
    /// Bytes from one sieve to the next.
    stride: u64,
    cards: wgpu::Buffer,
    order: wgpu::Buffer,
    kinds: wgpu::Buffer,
    entries: wgpu::Buffer,
    sums: wgpu::Buffer,
    /// The instances as they are drawn.
    pub drawn: wgpu::Buffer,
    draws: wgpu::Buffer,
    /// How many groups look at those that come through, and what that is bound by.
    groups: wgpu::Buffer,
    scan_group: wgpu::BindGroup,
    group: Option<wgpu::BindGroup>,
    /// Instances and kinds.
    count: u32,
    kind_count: u32,
}

impl Sifter {
    pub(crate) fn new(gpu: &Gpu) -> Self {
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("sift"),
            source: wgpu::ShaderSource::Wgsl(SIFT.into()),
        });
        let (layout, scan_layout) = layouts(device);
        let pipeline_layout = |layouts: &[Option<&wgpu::BindGroupLayout>]| {
            device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("sift"),
                bind_group_layouts: layouts,
                immediate_size: 0,
            })
        };
        let pipeline_layouts =
            [pipeline_layout(&[Some(&layout)]), pipeline_layout(&[Some(&layout), Some(&scan_layout)])];
        let groups = buffer(gpu, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDIRECT, 16);
        let scan_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("sift"),
            layout: &scan_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: groups.as_entire_binding() }],
        });
        let alignment = u64::from(device.limits().min_uniform_buffer_offset_alignment);
        let stride = (size_of::<Sieve>() as u64).next_multiple_of(alignment);
        let small = |usage| buffer(gpu, usage, 256);
        let storage = wgpu::BufferUsages::STORAGE;
        Self {
            deck: Deck::default(),
            arrangement: u64::MAX,
            module,
            layout,
            pipeline_layouts,
            pipelines: BTreeMap::new(),
            sieves: buffer(gpu, wgpu::BufferUsages::UNIFORM, stride),
            stride,
            cards: small(storage),
            order: small(storage),
            kinds: small(storage),
            entries: small(storage),
            sums: small(storage),
            drawn: small(storage | wgpu::BufferUsages::VERTEX),
            draws: small(storage | wgpu::BufferUsages::INDIRECT),
            groups,
            scan_group,
            group: None,
            count: 0,
            kind_count: 0,
        }
    }

    /// Whether a dispatch reaches so many instances.
    pub(crate) fn reaches(gpu: &Gpu, count: usize) -> bool {
        count.div_ceil(WIDE as usize) <= gpu.device.limits().max_compute_workgroups_per_dimension as usize
    }

    /// Changes are looked at when it is used again.
    pub(crate) fn pass_over(&mut self, residents: &mut Residents) {
        self.deck.pass_over(residents);
    }

    /// Sends what changed of the instances, and the sieves of a batch; gives what may be drawn in each of its views. `corners` says which of a mesh
    /// are of which matter.
    pub(crate) fn hold(
        &mut self,
        gpu: &Gpu,
        residents: &mut Residents,
        scenery: &Scenery,
        sieves: &mut [Sieve],
        corners: impl Fn(Drawn, Matter) -> Option<Range<u32>>,
    ) -> Result<Vec<Batch>, RenderError> {
        self.send_cards(gpu, residents);
        if self.arrangement != residents.arrangement {
            self.arrangement = residents.arrangement;
            let order: Vec<u32> = residents.ordered().collect();
            self.count = order.len() as u32;
            self.order = held(gpu, &self.order, bytemuck::cast_slice(&order));
        }
        let table: Vec<Kind> = self.deck.table(corners);
        self.kind_count = self.deck.count();
        self.kinds = held(gpu, &self.kinds, bytemuck::cast_slice(&table));
        let mut bytes = vec![0; self.stride as usize * sieves.len()];
        for (sieve, place) in sieves.iter_mut().zip(bytes.chunks_mut(self.stride as usize)) {
            sieve.count = self.count;
            place[..size_of::<Sieve>()].copy_from_slice(bytemuck::bytes_of(sieve));
        }
        self.sieves = held(gpu, &self.sieves, &bytes);
        let many = u64::from(self.count.max(1));
        self.entries = roomy(gpu, &self.entries, many * 16);
        self.sums = roomy(gpu, &self.sums, (many + 2 * u64::from(WIDE)) * 4);
        self.drawn = roomy(gpu, &self.drawn, many * size_of::<Instance>() as u64);
        self.draws = roomy(gpu, &self.draws, u64::from(self.kind_count) * 3 * DRAW);
        self.group = Some(self.bind(gpu, scenery));
        self.make_pipelines(gpu);
        gpu.check()?;
        let batch = |(mesh, kinds)| Batch { mesh, instances: Run::Found(kinds) };
        Ok(self.deck.runs().into_iter().map(batch).collect())
    }

    fn send_cards(&mut self, gpu: &Gpu, residents: &mut Residents) {
        let everything = self.deck.follow(residents);
        let count = residents.cards.len();
        let long = (count * size_of::<Token>()) as u64;
        let is_new = long > self.cards.size();
        self.cards = roomy(gpu, &self.cards, long);
        let mut recarded = std::mem::take(&mut residents.recarded);
        for run in runs(&mut recarded, (everything || is_new).then_some(count as u32)) {
            let offset = u64::from(run.start) * size_of::<Token>() as u64;
            let tokens = self.deck.tokens(residents, run);
            gpu.queue.write_buffer(&self.cards, offset, bytemuck::cast_slice(&tokens));
        }
        residents.recarded = recarded;
    }

    fn bind(&self, gpu: &Gpu, scenery: &Scenery) -> wgpu::BindGroup {
        let size = |bytes: u64| std::num::NonZeroU64::new(bytes);
        let part =
            |buffer, size| wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset: 0, size });
        let kinds = size(u64::from(self.kind_count) * size_of::<Kind>() as u64);
        let resources = [
            part(&self.sieves, size(size_of::<Sieve>() as u64)),
            part(&self.cards, None),
            part(&self.order, None),
            part(&self.kinds, kinds),
            part(&scenery.instances, None),
            part(&self.entries, None),
            part(&self.sums, None),
            part(&self.drawn, None),
            part(&self.draws, None),
        ];
        let entry = |(binding, resource)| wgpu::BindGroupEntry { binding, resource };
        let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..).zip(resources).map(entry).collect();
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("sift"),
            layout: &self.layout,
            entries: &entries,
        })
    }

    /// The steps of a view, in their order, and how many groups each has.
    fn steps(&self) -> Vec<(Step, Groups)> {
        let of = |count: u32| Groups::Exactly(count.div_ceil(WIDE));
        let (all, one, found) = (of(self.count), Groups::Exactly(1), Groups::Found);
        // An even number, so that what is sorted ends where it began.
        let digits = if self.kind_count * BUCKETS <= 1 << 16 { 2 } else { 4 };
        let mut steps = vec![(("sift", 0), all), (("scan", 0), one), (("gather", 0), all)];
        for digit in 0..digits {
            // Sums of digits are the same whichever these are.
            steps.extend([(("tally", digit), found), (("scan", 1), one), (("deal", digit), found)]);
        }
        steps.extend([(("copy", 0), found), (("tell", 0), of(self.kind_count))]);
        steps
    }

    fn make_pipelines(&mut self, gpu: &Gpu) {
        for (step, _) in self.steps() {
            self.pipelines.entry(step).or_insert_with(|| {
                let (entry, digit) = step;
                let constants = match entry {
                    "scan" => vec![("DIGITS", f64::from(digit))],
                    "tally" | "deal" => vec![("DIGIT", f64::from(digit))],
                    _ => Vec::new(),
                };
                let layout = &self.pipeline_layouts[usize::from(entry == "scan")];
                gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(entry),
                    layout: Some(layout),
                    module: &self.module,
                    entry_point: Some(entry),
                    compilation_options: wgpu::PipelineCompilationOptions {
                        constants: &constants,
                        // Each step does that where it needs it.
                        zero_initialize_workgroup_memory: false,
                    },
                    cache: None,
                })
            });
        }
    }

    /// Records the steps that find what the sieve of that index lets through.
    pub(crate) fn sift(&self, encoder: &mut wgpu::CommandEncoder, sieve: usize) {
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("sift"), timestamp_writes: None });
        pass.set_bind_group(1, &self.scan_group, &[]);
        pass.set_bind_group(0, self.group.as_ref(), &[(sieve as u64 * self.stride) as u32]);
        for (step, groups) in self.steps() {
            let Some(pipeline) = self.pipelines.get(&step) else { continue };
            pass.set_pipeline(pipeline);
            match groups {
                Groups::Exactly(groups) => pass.dispatch_workgroups(groups, 1, 1),
                Groups::Found => pass.dispatch_workgroups_indirect(&self.groups, 0),
            }
        }
    }

    /// Draws what was found of a run of kinds.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, kinds: &Range<u32>, matter: Matter) {
        let first = matter as u32 * self.kind_count + kinds.start;
        pass.multi_draw_indexed_indirect(&self.draws, u64::from(first) * DRAW, kinds.end - kinds.start);
    }
}

/// That of all steps, and that of those that say how many groups others have.
fn layouts(device: &wgpu::Device) -> (wgpu::BindGroupLayout, wgpu::BindGroupLayout) {
    let entry = |binding, ty, has_dynamic_offset| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None },
        count: None,
    };
    let storage = |read_only| wgpu::BufferBindingType::Storage { read_only };
    let mut entries = vec![entry(0, wgpu::BufferBindingType::Uniform, true)];
    entries.extend((1..=4).map(|binding| entry(binding, storage(true), false)));
    entries.extend((5..=8).map(|binding| entry(binding, storage(false), false)));
    let layout = |entries: &[wgpu::BindGroupLayoutEntry]| {
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("sift"), entries })
    };
    (layout(&entries), layout(&[entry(0, storage(false), false)]))
}

fn buffer(gpu: &Gpu, usage: wgpu::BufferUsages, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("sift"),
        size,
        usage: usage | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}

/// The buffer, or one that has room for so many bytes, and for twice what there was, as far as the device allows.
fn roomy(gpu: &Gpu, known: &wgpu::Buffer, bytes: u64) -> wgpu::Buffer {
    if bytes <= known.size() {
        return known.clone();
    }
    let limits = gpu.device.limits();
    let most = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size) & !15;
    buffer(gpu, known.usage(), bytes.next_power_of_two().min(most.max(bytes)))
}

/// The buffer, or a larger one, with these bytes.
fn held(gpu: &Gpu, known: &wgpu::Buffer, bytes: &[u8]) -> wgpu::Buffer {
    let buffer = roomy(gpu, known, bytes.len() as u64);
    gpu.queue.write_buffer(&buffer, 0, bytes);
    buffer
}

#[cfg(test)]
impl Sifter {
    /// Kinds and numbers of what was found last, in the order in which it is drawn.
    pub(crate) fn found(&self, gpu: &Gpu) -> Vec<(u32, u32)> {
        let read = |from: &wgpu::Buffer, bytes: u64| -> Vec<u32> {
            let to = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: bytes,
                usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            });
            let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            encoder.copy_buffer_to_buffer(from, 0, &to, 0, bytes);
            gpu.queue.submit([encoder.finish()]);
            to.map_async(wgpu::MapMode::Read, .., |_| ());
            gpu.wait().expect("a device");
            let range = to.get_mapped_range(..).expect("it is mapped");
            bytemuck::pod_collect_to_vec(&range)
        };
        let many = read(&self.sums, 4)[0];
        if many == 0 {
            return Vec::new();
        }
        let entries = read(&self.entries, u64::from(many) * 8);
        entries.chunks_exact(2).map(|entry| (entry[0] / BUCKETS, entry[1])).collect()
    }
}
