//! What the raster backend draws of a batch: listed by the host and sent, or found by the device.

use simworld_core::id::EntityId;
use simworld_core::scene::Scene;

use super::{Sight, Works};
use crate::batch::ViewRequest;
use crate::config::Culling;
use crate::draw_list::{Batch, ViewBatches};
use crate::gpu::{MOST_MAPS, Sifter};
use crate::shadow::ShadowView;
use crate::sieve::Sieve;
use crate::{RenderConfig, RenderError};

impl Works {
    /// Whether the device culls here, if the scene lets it.
    pub(crate) fn culls_on_device(&self, culling: Culling) -> bool {
        let is_wanted = match culling {
            Culling::Host => false,
            Culling::Device => true,
            Culling::Auto => self.gpu.info.device_type != wgpu::DeviceType::Cpu,
        };
        is_wanted && self.gpu.can_sift
    }

    /// Whether the device finds what is drawn.
    fn sifts(&self, config: &RenderConfig) -> bool {
        self.culls_on_device(config.culling)
            && Sifter::reaches(&self.gpu, self.residents.instances.len())
            && self.residents.models.keys().all(|model| model.pose.is_none())
    }

    /// Nobody culls on the device this time.
    pub(super) fn pass_over(&mut self) {
        match &mut self.sifter {
            Some(sifter) => sifter.pass_over(&mut self.residents),
            None => self.residents.recarded.clear(),
        }
    }

    /// Has the device find what the raster backend draws: sends what it needs for that.
    fn list_on_device(
        &mut self,
        config: &RenderConfig,
        scene: &dyn Scene,
        requests: &[ViewRequest],
        sight: &Sight,
        is_shaded: &[bool],
    ) -> Result<(), RenderError> {
        let finest = self.residents.finest;
        let slot = |id: Option<EntityId>| id.map(|id| id.index() as u32);
        let views = sight.views.iter().zip(requests).map(|(view, request)| {
            Sieve::of_view(view, config.min_pixels, finest, [request.hidden, request.only].map(slot))
        });
        let mut sieves: Vec<Sieve> = views.collect();
        if is_shaded.contains(&true) {
            // One that is not drawn has the sieve of some view.
            let none = sieves[0];
            let of = |shadow: &Option<ShadowView>| {
                shadow.as_ref().map_or(none, |shadow| Sieve::of_shadow(shadow, finest))
            };
            sieves.extend(sight.shadows.iter().map(of));
        }
        let models: Vec<_> = self.residents.models.keys().copied().collect();
        if self.raster.models.hold(&self.gpu, self.residents.sources(scene), models)? {
            self.raster.shadows.forget();
        }
        let sifter = self.sifter.get_or_insert_with(|| Sifter::new(&self.gpu));
        let raster = &self.raster;
        let batches =
            sifter.hold(&self.gpu, &mut self.residents, &self.scenery, &mut sieves, |mesh, matter| {
                raster.corners(mesh, matter)
            })?;
        for is_shaded in is_shaded {
            self.list.add_found(&batches, *is_shaded);
        }
        Ok(())
    }

    /// Finds what the raster backend draws, and sends that to the device; true if the device finds it.
    pub(super) fn list(
        &mut self,
        config: &RenderConfig,
        scene: &dyn Scene,
        requests: &[ViewRequest],
        sight: &Sight,
        in_color: bool,
    ) -> Result<bool, RenderError> {
        self.list.clear();
        self.raster.shadows.begin();
        // Maps of a larger batch are given away while it is drawn, and a model may change where no instance does.
        let may_stay = in_color && requests.len() <= MOST_MAPS && self.raster.models.is_empty();
        let (version, shadows) = (self.residents.version, &mut self.raster.shadows);
        let is_shaded = |shadow: &Option<ShadowView>| {
            let mut stays = |shadow: &ShadowView| may_stay && shadows.is_current(&shadow.key, version);
            in_color && shadow.as_ref().is_some_and(|shadow| !stays(shadow))
        };
        let is_shaded: Vec<bool> = sight.shadows.iter().map(is_shaded).collect();
        if self.sifts(config) {
            return self.list_on_device(config, scene, requests, sight, &is_shaded).map(|()| true);
        }
        self.pass_over();
        for (index, (view, request)) in sight.views.iter().zip(requests).enumerate() {
            let shadow = sight.shadows[index].as_ref().filter(|_| is_shaded[index]);
            let left_out = [request.hidden, request.only];
            self.list.add(&self.residents, view, shadow, config.min_pixels, left_out);
        }
        self.scenery.send_picks(&self.gpu, &self.list.picks, &self.residents)?;
        let batches = self.list.views.iter().flat_map(ViewBatches::all).flatten();
        let models = batches.filter_map(Batch::model);
        if self.raster.models.hold(&self.gpu, self.residents.sources(scene), models)? {
            self.raster.shadows.forget();
        }
        Ok(false)
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::camera::{Camera, Intrinsics};
    use simworld_core::geometry::{Point3, Twist, pose_facing};
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
    use simworld_core::seed::{Seed, StreamRng};

    use super::*;
    use crate::batch::{Channels, Projection, ViewOptions};
    use crate::draw_list::Run;
    use crate::mesh::{Drawn, MeshId};

    /// One of the things of a city, on a square of that side.
    fn put(world: &mut World, rng: &mut StreamRng, side: f64) -> EntityId {
        let (kind, shape) = match rng.uniform(0.0, 6.0) as u32 {
            0 => (EntityKind::Building, Shape::cuboid(12.0, 9.0, rng.uniform(5.0, 30.0))),
            1 => (EntityKind::Tree, Shape::Cylinder { radius: 0.15, height: 6.0 }),
            2 => (EntityKind::StreetLamp, Shape::Cylinder { radius: 0.09, height: 6.0 }),
            3 => (EntityKind::Car, Shape::cuboid(4.4, 1.8, 1.5)),
            4 => (EntityKind::Bench, Shape::cuboid(0.6, 1.8, 0.85)),
            _ => (EntityKind::Person, Shape::Capsule { radius: 0.25, height: 1.75 }),
        };
        let at = Point3::new(rng.uniform(-0.5, 0.5) * side, rng.uniform(-0.5, 0.5) * side, 0.0);
        let desc = EntityDesc::new(kind, pose_facing(at, rng.uniform(-3.0, 3.0)), shape);
        world.spawn(desc).expect("a solid in the world")
    }

    fn city(rng: &mut StreamRng, side: f64) -> (World, Vec<EntityId>) {
        let mut world = World::new();
        let ground = Shape::cuboid(side, side, 1.0);
        let pose = pose_facing(Point3::new(0.0, 0.0, -1.1), 0.0);
        world.spawn(EntityDesc::new(EntityKind::Ground, pose, ground)).expect("a ground");
        for lane in -2..=2 {
            let (pose, road) = (
                pose_facing(Point3::new(0.0, f64::from(lane) * 20.0, -0.1), 0.0),
                Shape::cuboid(side, 8.0, 0.1),
            );
            world.spawn(EntityDesc::new(EntityKind::Road, pose, road)).expect("a road");
        }
        let ids = (0..1500).map(|_| put(&mut world, rng, side)).collect();
        (world, ids)
    }

    fn look(rng: &mut StreamRng, side: f64, id: EntityId) -> ViewRequest {
        let eye =
            Point3::new(rng.uniform(-0.4, 0.4) * side, rng.uniform(-0.4, 0.4) * side, rng.uniform(0.5, 30.0));
        let to = Point3::new(rng.uniform(-0.5, 0.5) * side, rng.uniform(-0.5, 0.5) * side, 1.0);
        let intrinsics = Intrinsics::from_fov(96, 72, rng.uniform(0.3, 1.6)).expect("a size in range");
        let mut request = ViewRequest::from(Camera::looking_at(eye, to, intrinsics));
        match rng.uniform(0.0, 5.0) as u32 {
            0 => request.hidden = Some(id),
            1 => request.only = Some(id),
            2 => {
                request.projection = Projection::Parallel;
                let k = &mut request.camera.intrinsics;
                (k.fx, k.fy) = (2.0, 2.0);
            }
            _ => {}
        }
        request
    }

    /// What the device found, mesh by mesh, as the host lists it.
    fn listed(works: &Works) -> Vec<(Drawn, u32)> {
        let [view] = &works.list.views[..] else { panic!("one view") };
        let run = |batch: &Batch| match &batch.instances {
            Run::Listed(run) => {
                run.clone().map(|place| (batch.mesh, works.list.picks[place as usize])).collect()
            }
            Run::Found(_) => Vec::new(),
        };
        view.visible.iter().flat_map(run).collect()
    }

    /// Views of cities in which things come, go and move: the device finds the instances that the host lists, in the same order, and they are few.
    #[test]
    fn the_device_finds_what_the_host_lists() {
        let config = RenderConfig { backend: crate::Backend::Raster, ..RenderConfig::default() };
        let Some(mut works) = Works::new(&config).map_err(|error| println!("skipped: {error}")).ok() else {
            let required = std::env::var_os("SIMWORLD_REQUIRE_ADAPTER").is_some_and(|value| value == "1");
            assert!(!required, "an adapter is required here");
            return;
        };
        works.list.all = true;
        let mut rng = Seed(5).stream("tests/sieve").rng();
        let options = ViewOptions { channels: Channels::DEPTH, ..ViewOptions::default() };
        let (mut seen, mut there, mut most) = (0, 0, 0);
        for side in [60.0, 400.0, 3000.0] {
            let (mut world, mut ids) = city(&mut rng, side);
            for round in 0..16 {
                world.remove(ids.swap_remove(round)).expect("it lives");
                ids.push(put(&mut world, &mut rng, side));
                for id in ids.iter().skip(round).step_by(9) {
                    let pose = world.entity(*id).expect("it lives").pose
                        * nalgebra::Translation3::new(rng.uniform(-4.0, 4.0), 0.0, 0.0);
                    world.set_motion(*id, pose, Twist::ZERO).expect("it lives");
                }
                world.finish_step();
                let request = look(&mut rng, side, ids[round]);
                let mut draw = |culling| {
                    let config = RenderConfig { culling, ..config.clone() };
                    let (encoder, _) =
                        works.draw(&config, &world, &[request], options, None).expect("a picture");
                    works.leave(encoder).expect("a picture");
                    listed(&works)
                };
                // Now and then the device passes some changes over.
                let expected = draw(Culling::Host);
                assert!(draw(Culling::Device).is_empty(), "the host lists nothing");
                let found = works.sifter.as_ref().expect("the device culls").found(&works.gpu);
                let own = |(kind, number): (u32, u32)| (Drawn::Own(MeshId::ALL[kind as usize]), number);
                let found: Vec<(Drawn, u32)> = found.into_iter().map(own).collect();
                assert_eq!(found, expected, "side {side}, round {round}, {request:?}");
                seen += found.len();
                there += works.residents.ordered().count();
                most = most.max(found.len());
            }
        }
        println!("{seen} of {there} instances are seen, {most} at most");
        assert!(seen > 5000 && seen * 5 < there, "{seen} of {there}");
        assert!(most > 512, "more than two groups: {most}");
    }
}
