//! What is seen of a stage: the camera, the panes, the layers, who is picked; drawn into a canvas.

use std::collections::BTreeSet;

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};

use super::canvas::Canvas;
use super::layers::Painter;
use super::sight::Sight;
use super::trails::Trails;
use super::{Flight, Going, Layer, Panes, Stage};
use crate::Outcome;

/// The share of the way by which a camera that follows somebody nears its place in a second.
const EASE: f64 = 4.0;
/// The horizontal field of view, radians.
const FIELD: f64 = 1.25;

/// Settings of a [`Viewer`].
#[derive(Clone, Debug)]
pub struct ViewerSettings {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// What a picture shows at the start.
    pub panes: Panes,
    /// The layers that are drawn at the start.
    pub layers: BTreeSet<Layer>,
    /// Whom the camera follows at the start.
    pub follow: Option<EntityId>,
}

/// Somebody who looks on.
pub struct Viewer {
    /// What is looked at.
    pub stage: Stage,
    /// Where from, unless somebody is followed.
    pub flight: Flight,
    /// What a picture shows.
    pub panes: Panes,
    /// The layers that are drawn.
    pub layers: BTreeSet<Layer>,
    /// Who was asked about.
    pub picked: Option<EntityId>,
    /// Whom the camera follows.
    pub follow: Option<EntityId>,
    renderer: Renderer,
    intrinsics: Intrinsics,
    frame: Frame,
    color: Canvas,
    canvas: Canvas,
    painter: Painter,
    trails: Trails,
}

impl Viewer {
    /// Somebody who looks at a stage from its [`lookout`](Stage::lookout).
    ///
    /// # Errors
    /// No adapter (the message says what to install), or a size out of range.
    pub fn new(stage: Stage, settings: &ViewerSettings) -> Result<Self, RenderError> {
        let renderer = Renderer::new(&RenderConfig::default())?;
        let intrinsics = Intrinsics::from_fov(settings.width, settings.height, FIELD)?;
        let mut flight = stage.lookout();
        if let Some(body) = settings.follow.and_then(|id| stage.world().entity(id)) {
            flight = Flight::behind(&body);
        }
        Ok(Self {
            stage,
            flight,
            panes: settings.panes,
            layers: settings.layers.clone(),
            picked: settings.follow,
            follow: settings.follow,
            renderer,
            intrinsics,
            frame: Frame::new(),
            color: Canvas::default(),
            canvas: Canvas::default(),
            painter: Painter::default(),
            trails: Trails::default(),
        })
    }

    /// The adapter that draws.
    pub fn adapter(&self) -> String {
        self.renderer.adapter()
    }

    /// The world goes one step further, and the camera with whom it follows.
    ///
    /// # Errors
    /// As [`Stage::step`].
    pub fn step(&mut self) -> Outcome<Going> {
        let going = self.stage.step()?;
        let world = self.stage.world();
        self.trails.note(world, world.clock().tick().0);
        if let Some(id) = self.follow {
            match world.entity(id) {
                Some(body) => self.flight.ease(&Flight::behind(&body), (EASE * self.stage.dt()).min(1.0)),
                None => self.follow = None,
            }
        }
        Ok(going)
    }

    /// Picks what is on a pixel of the last picture, and says what that is.
    pub fn pick(&mut self, x: u32, y: u32) -> Option<String> {
        let (x, y) = match self.panes {
            Panes::All => {
                let half = (self.frame.width / 2, self.frame.height / 2);
                (x % half.0.max(1) * 2, y % half.1.max(1) * 2)
            }
            _ => (x, y),
        };
        self.picked = self.frame.entity_at(x, y);
        let entity = self.picked.and_then(|id| self.stage.world().entity(id))?;
        Some(describe(&entity))
    }

    /// Draws what is seen now.
    ///
    /// # Errors
    /// The adapter failed, or the waypoints cannot be made.
    pub fn draw(&mut self) -> Outcome<&Canvas> {
        let camera: Camera = self.flight.camera(self.intrinsics);
        let world = self.stage.world();
        self.renderer.render(world, &camera, &mut self.frame)?;
        self.color.load(self.frame.width as usize, self.frame.height as usize, &self.frame.rgb);
        let sight = Sight { camera: &camera, frame: &self.frame };
        self.painter.draw(&mut self.color, &sight, world, &self.trails, &self.layers)?;
        self.panes.compose(&self.frame, &self.color, &mut self.canvas);
        let mut line = format!("{:.1} s", world.clock().seconds());
        if let Some(entity) = self.picked.and_then(|id| world.entity(id)) {
            line = format!("{line} | {}", describe(&entity));
        }
        self.canvas.text([8, 8], &line, [255, 255, 255], 1);
        Ok(&self.canvas)
    }

    /// The picture that was drawn last.
    pub fn canvas(&self) -> &Canvas {
        &self.canvas
    }
}

/// What something is, in a line: name, kind, id, place, and speed if it moves.
fn describe(entity: &EntityRef<'_>) -> String {
    let at = entity.position();
    let speed = entity.twist.ground_speed();
    let mut text = format!("{} {} at ({:.1}, {:.1}, {:.1})", entity.kind, entity.id, at.x, at.y, at.z);
    if let Some(name) = &entity.info.name {
        text = format!("{name}, {text}");
    } else if let Some(place) = entity.info.place {
        text = format!("{}, {text}", place.as_str());
    }
    if entity.kind.is_mobile() {
        text = format!("{text}, {speed:.1} m/s");
    }
    text
}
