//! Everything that lives on a device: what goes when the device goes.

mod listing;

use std::collections::VecDeque;
use std::sync::Arc;

use simworld_core::environment::Environment;
use simworld_core::geometry::Aabb;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;

use crate::batch::{Channels, Layout, Projection, ViewOptions, ViewRequest};
use crate::coats::Coats;
use crate::config::{AntiAliasing, Backend, LevelOfDetail};
use crate::demand::{Demand, Manner};
use crate::draw_list::DrawList;
use crate::falling::Falling;
use crate::gpu::{Features, Globals, Gpu, Planes, Readback, Readbacks, Scenery, Sifter, Timing, place};
use crate::lamps::LampGrids;
use crate::light::Light;
use crate::raster::{Job, Raster};
use crate::raycast::{BUFFERS, Cast, Look, MOST_VIEWS, Raycast, Rays};
use crate::resident::{MOST_SLOTS, Residents};
use crate::shadow::ShadowView;
use crate::view::View;
use crate::{RenderConfig, RenderError, Views};

/// A device, and all that was made on it.
pub(crate) struct Works {
    pub gpu: Gpu,
    /// Side of the shadow map, which an adapter may bound.
    pub shadow_resolution: u32,
    raster: Raster,
    /// Made when it is first used.
    raycast: Option<Raycast>,
    /// Made when the device first culls.
    sifter: Option<Sifter>,
    scenery: Scenery,
    pub planes: Planes,
    readbacks: Readbacks,
    timing: Timing,
    /// Batches that were left on the device, the oldest first.
    left: VecDeque<wgpu::SubmissionIndex>,
    residents: Residents,
    /// What the batch at hand may show of whom.
    demand: Demand,
    coats: Coats,
    list: DrawList,
    /// The light of the environment that was drawn last.
    light: Option<(Environment, Arc<Light>)>,
}

/// A batch on its way to the host.
pub(crate) struct Pending {
    readback: Readback,
    layout: Layout,
    options: ViewOptions,
    names: Arc<Vec<EntityId>>,
}

/// The views of a batch, checked.
struct Sight {
    views: Vec<View>,
    shadows: Vec<Option<ShadowView>>,
    light: Arc<Light>,
    /// What falls before each view.
    falling: Vec<Falling>,
    /// Around everything that any of them looks at.
    region: Aabb,
}

impl Works {
    pub(crate) fn new(config: &RenderConfig) -> Result<Self, RenderError> {
        let gpu = Gpu::new(config)?;
        let shadow_resolution = config.shadow_resolution.min(gpu.largest_picture());
        let coats = Coats::new(&gpu, config.texture_memory);
        let raster = Raster::new(&gpu, shadow_resolution, config.anti_aliasing, coats.texels().layout());
        let scenery = Scenery::new(&gpu, raster.pipelines.scenery());
        let planes = Planes::new(&gpu);
        let timing = Timing::new(&gpu);
        gpu.check()?;
        let (readbacks, list) = (Readbacks::default(), DrawList::new(raster.extents()));
        let mut residents = Residents::default();
        residents.finest = config.level_of_detail == LevelOfDetail::Finest;
        Ok(Self {
            gpu,
            shadow_resolution,
            raster,
            raycast: None,
            sifter: None,
            scenery,
            planes,
            readbacks,
            timing,
            left: VecDeque::new(),
            residents,
            demand: Demand::default(),
            coats,
            list,
            light: None,
        })
    }

    /// Gives back what grew with pictures and scenes, and begins anew with it: after an error of the device buffers that were asked for in
    /// vain cannot be told from others. Batches under way have buffers of their own, and stay.
    pub(crate) fn relieve(&mut self, config: &RenderConfig) {
        self.planes = Planes::new(&self.gpu);
        (self.readbacks, self.raycast, self.sifter) = (Readbacks::default(), None, None);
        self.coats = Coats::new(&self.gpu, config.texture_memory);
        // What was held is free when the device has seen that; if it fails again the next call says so.
        let _ = self.gpu.wait();
        let store = self.coats.texels().layout();
        self.raster = Raster::new(&self.gpu, self.shadow_resolution, config.anti_aliasing, store);
        self.scenery = Scenery::new(&self.gpu, self.raster.pipelines.scenery());
        self.residents = Residents::default();
        self.residents.finest = config.level_of_detail == LevelOfDetail::Finest;
        let _ = self.gpu.check();
    }

    /// Whether this device binds what rays need.
    pub(crate) fn can_cast(&self) -> bool {
        self.gpu.device.limits().max_storage_buffers_per_shader_stage >= BUFFERS
    }

    /// Draws a batch into the planes; the commands are recorded, and not handed in yet. With a table of rays the only view is cast by
    /// these, and depth is their range.
    pub(crate) fn draw(
        &mut self,
        config: &RenderConfig,
        scene: &dyn Scene,
        requests: &[ViewRequest],
        options: ViewOptions,
        table: Option<&[[f32; 4]]>,
    ) -> Result<(wgpu::CommandEncoder, Layout), RenderError> {
        let outcome = self.try_draw(config, scene, requests, options, table);
        if outcome.is_err() {
            // What of the scene came to the device is not known.
            self.residents.forget();
        }
        outcome
    }

    fn try_draw(
        &mut self,
        config: &RenderConfig,
        scene: &dyn Scene,
        requests: &[ViewRequest],
        options: ViewOptions,
        table: Option<&[[f32; 4]]>,
    ) -> Result<(wgpu::CommandEncoder, Layout), RenderError> {
        let mut sight = self.look(config, scene, requests)?;
        if table.is_some() {
            sight.views = sight.views.into_iter().map(View::all_round).collect();
            sight.region = sight.views.iter().fold(sight.region, |all, view| all.union(&view.region()));
        }
        let layout = Layout::of(requests.iter().map(|request| &request.camera.intrinsics));
        self.planes.hold(&self.gpu, &layout, options)?;
        let in_color = options.channels.contains(Channels::RGB);
        let is_cast = table.is_some() || self.casts(config, options, &layout);
        let manner = self.ask(config, &sight, table.is_some(), is_cast, in_color);
        self.residents.follow(scene, &sight.region, &self.demand);
        if self.residents.names.len() > MOST_SLOTS {
            return Err(RenderError::TooMany { count: self.residents.names.len(), limit: MOST_SLOTS });
        }
        self.coats.hold(&self.gpu, self.residents.sources(scene), &self.residents.models)?;
        let (globals, features) = self.send(scene, &sight, in_color, is_cast)?;
        let mut encoder = self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.timing.begin();
        if is_cast {
            self.pass_over();
            let store = self.coats.texels();
            let raycast = self.raycast.get_or_insert_with(|| Raycast::new(&self.gpu, store));
            let views = &sight.views[..];
            let look = Look {
                views,
                globals: &globals,
                requests,
                layout: &layout,
                falling: &sight.falling,
                min_pixels: manner.min_pixels,
                store: store.group(),
                finest: manner.finest,
                table,
            };
            raycast.hold(&self.gpu, scene, &self.residents, &look)?;
            let color = in_color.then_some(Cast::Color(features));
            let normals = options.channels.contains(Channels::NORMALS).then_some(Cast::Normals);
            let mut casts: Vec<Cast> = color.into_iter().chain(normals).collect();
            if casts.is_empty() {
                casts.push(Cast::Alone);
            }
            let (cuts, films) = (self.coats.are_cut(), self.coats.are_films());
            let rays = Rays { by_table: table.is_some(), cuts, films };
            raycast.prepare(&self.gpu, &casts, &sight.falling, rays);
            raycast.draw(&self.gpu, &mut encoder, &mut self.timing, &self.scenery, &self.planes, &layout);
        } else {
            let is_found = self.list(config, scene, requests, &sight, in_color)?;
            self.raster.hold(&self.gpu, layout.largest)?;
            let job = Job {
                sifter: self.sifter.as_ref().filter(|_| is_found),
                gpu: &self.gpu,
                version: self.residents.version,
                scenery: &self.scenery,
                list: &self.list,
                layout: &layout,
                channels: options.channels,
                shadows: &sight.shadows,
                features,
                falling: &sight.falling,
                store: self.coats.texels().group(),
                films: self.coats.are_films(),
            };
            self.raster.draw(&mut encoder, &self.planes, &job);
        }
        self.planes.pack(&mut encoder, &mut self.timing, &layout);
        Ok((encoder, layout))
    }

    /// Finds out what a batch may show of bodies that move; gives how it looks at things.
    fn ask(
        &mut self,
        config: &RenderConfig,
        sight: &Sight,
        by_table: bool,
        is_cast: bool,
        in_color: bool,
    ) -> Manner {
        let manner = Manner {
            // A ray of a table is no pixel that something could be smaller than.
            min_pixels: if by_table { 0.0 } else { config.min_pixels },
            finest: by_table || self.residents.finest,
            is_cast,
            in_color,
            widest: self.residents.widest,
        };
        let maps: &[Option<ShadowView>] = if in_color && !is_cast { &sight.shadows } else { &[] };
        self.demand.gather(&sight.views, maps, &manner);
        manner
    }

    /// Checks the cameras, and finds out what they look at in which light.
    fn look(
        &mut self,
        config: &RenderConfig,
        scene: &dyn Scene,
        requests: &[ViewRequest],
    ) -> Result<Sight, RenderError> {
        let environment = scene.environment();
        let light = self.light_of(environment, config.exposure_compensation);
        let (mut views, mut shadows, mut falling) = (Vec::new(), Vec::new(), Vec::new());
        let mut region: Option<Aabb> = None;
        for request in requests {
            let view = View::new(&request.camera, config.near, config.far, self.gpu.largest_picture())?
                .projected(request.projection);
            // Shadows are laid out around what a pinhole sees.
            let lit = request.only.is_none() && request.projection == Projection::Pinhole;
            let shadow = ShadowView::new(
                &view,
                &light.source,
                config.shadow_distance,
                if lit { self.shadow_resolution } else { 0 },
            );
            let around = view.region();
            let around = shadow.as_ref().map_or(around, |shadow| around.union(&shadow.region()));
            region = Some(region.map_or(around, |region| region.union(&around)));
            let mut air = Falling::of(environment, &view.eye, scene.clock().seconds());
            // What falls around an eye is nothing on a map.
            air.count = if request.projection == Projection::Pinhole { air.count } else { 0 };
            falling.push(air);
            views.push(view);
            shadows.push(shadow);
        }
        let region = region.ok_or(RenderError::NoViews)?.inflated(OVERHANG);
        Ok(Sight { views, shadows, light, falling, region })
    }

    /// Whether a batch is cast, and not drawn.
    fn casts(&self, config: &RenderConfig, options: ViewOptions, layout: &Layout) -> bool {
        if layout.spans.len() > MOST_VIEWS || !self.can_cast() {
            return false;
        }
        match config.backend {
            Backend::Raster => false,
            Backend::Raycast => true,
            Backend::Auto => {
                let is_gpu = matches!(
                    self.gpu.info.device_type,
                    wgpu::DeviceType::DiscreteGpu | wgpu::DeviceType::VirtualGpu
                );
                let is_smoothed =
                    config.anti_aliasing != AntiAliasing::Off && options.channels.contains(Channels::RGB);
                is_gpu && !is_smoothed
            }
        }
    }

    /// The light of an environment, reckoned anew only where that has changed.
    fn light_of(&mut self, environment: &Environment, compensation: f64) -> Arc<Light> {
        if let Some((known, light)) = &self.light
            && known == environment
        {
            return Arc::clone(light);
        }
        let light = Arc::new(Light::of(environment, compensation));
        self.light = Some((*environment, Arc::clone(&light)));
        light
    }

    /// Sends what every view is drawn from, and what changed of the instances; gives the globals, and what the pictures
    /// need. Lamps are looked for where there is colour that they could light.
    fn send(
        &mut self,
        scene: &dyn Scene,
        sight: &Sight,
        in_color: bool,
        is_cast: bool,
    ) -> Result<(Vec<Globals>, Features), RenderError> {
        let (light, mut lamps) = (&sight.light, LampGrids::default());
        let views = sight.views.iter().zip(&sight.shadows).zip(&sight.falling);
        let mut globals: Vec<Globals> = views
            .map(|((view, shadow), falling)| {
                let first = light.sky.len();
                let place = if in_color { lamps.around(scene, view.eye, light, first) } else { None };
                Globals::new(view, light, falling, shadow.as_ref(), place.as_ref())
            })
            .collect();
        if let Some(raycast) = &mut self.raycast {
            raycast.note(&self.residents.changed);
        }
        if in_color && !is_cast && sight.shadows.iter().any(Option::is_some) {
            // Behind those of the views, those of their shadow maps.
            let of = |shadow: &Option<ShadowView>| shadow.as_ref().map_or(globals[0], Globals::of_shadow);
            globals.extend(sight.shadows.iter().map(of).collect::<Vec<_>>());
        }
        // Rays have the globals of each view beside it.
        let drawn = if is_cast { &globals[..0] } else { &globals[..] };
        self.scenery.send(&self.gpu, drawn, [&light.sky, &lamps.entries], &mut self.residents)?;
        let cover = &light.cover;
        let mut features = Features::default();
        features.set(Features::LAMPS, !lamps.entries.is_empty());
        features.set(Features::WATER, cover.wetness > 0.0 || cover.puddles > 0.0);
        features.set(Features::SNOW, cover.snow_depth > 0.0);
        features.set(Features::MODELS, is_cast && !self.coats.is_empty());
        Ok((globals, features))
    }

    /// Something failed: what was recorded may never have been drawn, and shadow maps are drawn anew.
    pub(crate) fn distrust(&mut self) {
        self.raster.shadows.forget();
    }

    /// Hands the commands in, and asks for what they draw.
    pub(crate) fn submit(
        &mut self,
        mut encoder: wgpu::CommandEncoder,
        layout: Layout,
        options: ViewOptions,
    ) -> Result<Pending, RenderError> {
        let buffer = self.readbacks.copy(&self.gpu, &mut encoder, &self.planes, &layout, options)?;
        let submission = self.gpu.queue.submit([encoder.finish()]);
        self.gpu.check()?;
        let readback = Readback::begin(buffer, submission);
        Ok(Pending { readback, layout, options, names: Arc::clone(&self.residents.names) })
    }

    /// Hands the commands in, and leaves what they draw on the device; waits where too many batches are under way.
    pub(crate) fn leave(&mut self, encoder: wgpu::CommandEncoder) -> Result<(), RenderError> {
        self.left.push_back(self.gpu.queue.submit([encoder.finish()]));
        if self.left.len() > MOST_LEFT
            && let Some(oldest) = self.left.pop_front()
        {
            self.gpu.wait_for(oldest)?;
        }
        self.gpu.check()
    }

    /// Seconds that each step of the batch that was drawn last took on the device.
    pub(crate) fn times(&self) -> Result<Vec<(&'static str, f64)>, RenderError> {
        self.timing.read(&self.gpu)
    }

    /// Waits for a batch.
    pub(crate) fn take(&mut self, pending: Pending, views: &mut Views) -> Result<(), RenderError> {
        let Pending { readback, layout, options, names } = pending;
        let lies = |channel| place(&layout, options, channel);
        let buffer = readback.read(&self.gpu, |bytes| views.fill(&layout, options, &names, lies, bytes))?;
        self.readbacks.give_back(buffer);
        Ok(())
    }
}

/// Batches that may be under way when they are left on the device: enough that it never waits for the host.
const MOST_LEFT: usize = 3;
/// The farthest that a silhouette reaches beyond the bounds of its entity, m.
const OVERHANG: f64 = 8.0;

#[cfg(test)]
mod tests {
    use simworld_core::camera::{Camera, Intrinsics};
    use simworld_core::geometry::{Point3, pose_facing};
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};

    use super::*;
    use crate::gpu::{Brush, Matter};
    use crate::mesh::Pattern;

    /// Of nine patterns and all that is measured, a picture of a car makes what draws that, and normals what draws these.
    #[test]
    fn pipelines_are_made_for_what_is_drawn() {
        let config = RenderConfig { backend: Backend::Raster, ..RenderConfig::default() };
        let Some(mut works) = Works::new(&config).map_err(|error| println!("skipped: {error}")).ok() else {
            let required = std::env::var_os("SIMWORLD_REQUIRE_ADAPTER").is_some_and(|value| value == "1");
            assert!(!required, "an adapter is required here");
            return;
        };
        assert!(works.raster.pipelines.made().is_empty());
        let (mut world, ahead) = (World::new(), Point3::new(12.0, 0.0, 0.0));
        let car = EntityDesc::new(EntityKind::Car, pose_facing(ahead, 0.0), Shape::cuboid(4.5, 1.8, 1.5));
        world.spawn(car).expect("a solid in the world");
        let intrinsics = Intrinsics::from_fov(64, 64, 1.0).expect("a size in range");
        let camera = Camera::looking_at(Point3::new(0.0, 4.0, 2.0), ahead, intrinsics);
        let mut made = |channels| {
            let options = ViewOptions { channels, ..ViewOptions::default() };
            let drawn = works.draw(&config, &world, &[camera.into()], options, None);
            let (encoder, _) = drawn.expect("a picture");
            works.leave(encoder).expect("a picture");
            works.raster.pipelines.made()
        };
        let of_picture =
            [Brush::Picture(Features::empty(), Pattern::Plain, Matter::Whole), Brush::Shadow(Matter::Whole)];
        assert_eq!(made(Channels::RGB | Channels::DEPTH), [&of_picture[..], &[Brush::Sky]].concat());
        let [picture, shadow] = of_picture;
        let (measures, normals) = (Brush::Measures(Matter::Whole), Brush::Normals(Matter::Whole));
        assert_eq!(
            made(Channels::NORMALS | Channels::DEPTH),
            [picture, measures, normals, shadow, Brush::Sky]
        );
    }
}
