//! What one sees while it is done: the map with the way so far, and the view from the eyes.

use std::path::{Path, PathBuf};

use simworld_citygen::City;
use simworld_citygen::map::MapDrawing;
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, bounds, direction};
use simworld_core::scene::Scene;
use simworld_core::seam::{Goal, PlanStep};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};
use svg::node::element::{Circle, Polyline};

use super::Stage;
use super::stage::heading_of;
use crate::edit::Plan;

/// The colours of the way so far, and of where it leads.
const WAY: &str = "#b3261e";
const GOAL: &str = "#1f4e9c";

/// Writes the pictures of a stage to a folder.
pub struct Pictures {
    folder: PathBuf,
    eyes: Option<(Renderer, Intrinsics, Frame)>,
}

impl Pictures {
    /// Pictures in that folder; without a graphics adapter there is the map alone, and the reason is returned beside.
    pub fn new(folder: &Path) -> (Self, Option<RenderError>) {
        let made = Renderer::new(&RenderConfig::default()).and_then(|renderer| {
            Ok((renderer, Intrinsics::from_fov(960, 540, 1.4).map_err(RenderError::from)?, Frame::new()))
        });
        let (eyes, missing) = match made {
            Ok(eyes) => (Some(eyes), None),
            Err(reason) => (None, Some(reason)),
        };
        (Self { folder: folder.to_owned(), eyes }, missing)
    }

    /// Writes `map.svg`: the city or, where there is none, the scene from above; the way so far and where it leads now.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn map(&self, city: Option<&City>, stage: &Stage, title: &str) -> std::io::Result<()> {
        let mut trail = stage.trail.clone();
        trail.push(stage.here());
        let goal = goal_of(stage);
        let drawing = if let Some(city) = city {
            let drawing = MapDrawing::of(city).title(shortened(title)).trail(&trail, WAY, "Robin");
            match goal {
                Some(goal) => drawing.marker(&goal, GOAL, "goal").to_string(),
                None => drawing.to_string(),
            }
        } else {
            plan(stage, &shortened(title), &trail, goal).to_string()
        };
        std::fs::write(self.folder.join("map.svg"), drawing)
    }

    /// Writes what the eyes see as `eye-TICK.png` and `eye.png`, if there is an adapter.
    ///
    /// # Errors
    /// The adapter failed, or a file cannot be written.
    pub fn eye(&mut self, stage: &Stage) -> Result<(), RenderError> {
        let Some((renderer, intrinsics, frame)) = &mut self.eyes else { return Ok(()) };
        let world = stage.world();
        let Some(yaw) = heading_of(world, stage.me()) else { return Ok(()) };
        // From between the eyes; in a car from above the dashboard.
        let ahead = direction(yaw);
        let is_aboard = world.entity(stage.me()).is_some_and(|me| me.attachment.is_some());
        let (height, forward) = if is_aboard { (1.7, 1.2) } else { (1.62, 0.35) };
        let here = stage.here() + ahead * forward;
        let target = here + ahead * 20.0;
        let camera = Camera::looking_at(
            Point3::new(here.x, here.y, height),
            Point3::new(target.x, target.y, 1.2),
            *intrinsics,
        );
        renderer.render(world, &camera, frame)?;
        frame.write_png(self.folder.join(format!("eye-{:06}.png", world.clock().tick().0)))?;
        frame.write_png(self.folder.join("eye.png"))?;
        Ok(())
    }
}

/// Where the step under way leads, if that is one place.
fn goal_of(stage: &Stage) -> Option<Point2> {
    match stage.under_way()? {
        PlanStep::Navigate { to: Goal::Point(point), .. } => Some(point.xy()),
        PlanStep::Navigate { to: Goal::Entity(id), .. } => {
            stage.world().entity(*id).map(|entity| entity.access().xy())
        }
        _ => None,
    }
}

/// A scene from above, as far as its streets reach: the way so far, who goes there and where it leads.
fn plan(stage: &Stage, title: &str, trail: &[Point2], goal: Option<Point2>) -> svg::Document {
    /// Beyond the outermost street, m; and the most that is shown to every side.
    const MARGIN: f64 = 15.0;
    const FARTHEST: f64 = 500.0;
    let world = stage.world();
    let streets = world.roads().into_iter().flat_map(|roads| &roads.roads);
    let points = streets.flat_map(|road| &road.centerline).chain(trail);
    let (low, high) = bounds(points).unwrap_or((stage.here(), stage.here()));
    let reach = ((high - low).max() * 0.5 + MARGIN).min(FARTHEST);
    let middle = low + (high - low) * 0.5;
    let at = |point: &Point2| (point.x - middle.x, middle.y - point.y);
    let dot = |point: &Point2, color: &str| {
        let (x, y) = at(point);
        Circle::new().set("cx", x).set("cy", y).set("r", reach / 60.0).set("fill", color)
    };
    let way: Vec<String> = trail.iter().map(at).map(|(x, y)| format!("{x:.2},{y:.2}")).collect();
    let way = Polyline::new()
        .set("points", way.join(" "))
        .set("fill", "none")
        .set("stroke", WAY)
        .set("stroke-width", reach / 150.0);
    let plan = Plan { middle, reach, title, touched: &[], placings: &[] };
    let drawing = plan.draw(world).add(way).add(dot(&stage.here(), WAY));
    match goal {
        Some(goal) => drawing.add(dot(&goal, GOAL)),
        None => drawing,
    }
}

/// What of a sentence finds room beside the legend.
fn shortened(sentence: &str) -> String {
    const ROOM: usize = 42;
    match sentence.char_indices().nth(ROOM) {
        Some((end, _)) => format!("{} …", sentence[..end].trim_end()),
        None => sentence.to_owned(),
    }
}
