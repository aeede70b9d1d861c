//! What is seen of a stage: the camera, the panes, the layers, who is picked; drawn into a canvas.

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};

use super::canvas::{Canvas, LETTER};
use super::card::{card, line};
use super::layers::Painter;
use super::sight::Sight;
use super::trails::Trails;
use super::{Controls, Flight, Going, Outlook, Panes, Stage};
use crate::Outcome;

/// The share of the way by which a camera that follows somebody nears its place in a second.
const EASE: f64 = 4.0;
/// The horizontal field of view, radians.
const FIELD: f64 = 1.25;

/// Letters of cards and keys stand so far apart, pixels.
const LINE: usize = LETTER + 4;

/// Somebody who looks on.
pub struct Viewer {
    /// What is looked at.
    pub stage: Stage,
    /// Where from, after whom, and what is shown.
    pub outlook: Outlook,
    /// What is written beside the time.
    pub note: String,
    renderer: Renderer,
    intrinsics: Intrinsics,
    frame: Frame,
    color: Canvas,
    canvas: Canvas,
    painter: Painter,
    trails: Trails,
}

impl Viewer {
    /// Somebody who looks at a stage from its [`lookout`](Stage::lookout), at pictures of that many pixels across and down.
    ///
    /// # Errors
    /// No adapter (the message says what to install), or a size out of range.
    pub fn new(stage: Stage, [width, height]: [u32; 2]) -> Result<Self, RenderError> {
        let renderer = Renderer::new(&RenderConfig::default())?;
        let intrinsics = Intrinsics::from_fov(width, height, FIELD)?;
        let outlook = Outlook::from(stage.lookout());
        Ok(Self {
            stage,
            outlook,
            note: String::new(),
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

    /// Pictures have that many pixels across and down from now on.
    ///
    /// # Errors
    /// A size out of range.
    pub fn resize(&mut self, [width, height]: [u32; 2]) -> Result<(), RenderError> {
        self.intrinsics = Intrinsics::from_fov(width, height, FIELD)?;
        Ok(())
    }

    /// How many pixels pictures have across and down.
    pub fn size(&self) -> [u32; 2] {
        [self.intrinsics.width, self.intrinsics.height]
    }

    /// Follows somebody from behind at once, or nobody, and asks about them.
    pub fn follow(&mut self, who: Option<EntityId>) {
        let body = who.and_then(|id| self.stage.world().entity(id));
        self.outlook.follow = body.as_ref().map(|body| body.id);
        if let Some(body) = body {
            self.outlook.flight = Flight::behind(&body);
            self.outlook.picked = Some(body.id);
        }
    }

    /// Follows who was asked about, or nobody if somebody is followed.
    pub fn follow_picked(&mut self) {
        let is_mobile =
            |id: &EntityId| self.stage.world().entity(*id).is_some_and(|body| body.kind.is_mobile());
        let who = self.outlook.picked.filter(is_mobile);
        self.follow(if self.outlook.follow.is_some() { None } else { who });
    }

    /// Follows the next that moves, by ids, after who is followed or was asked about.
    pub fn follow_next(&mut self) {
        let before = self.outlook.follow.or(self.outlook.picked);
        let moves = |body: &EntityRef<'_>| body.kind.is_mobile() && body.twist.ground_speed() > 0.2;
        let bodies = || self.stage.world().iter().filter(moves).map(|body| body.id);
        let next = bodies().filter(|id| Some(*id) > before).min().or_else(|| bodies().min());
        if next.is_some() {
            self.follow(next);
        }
    }

    /// The world goes one step further, and the camera with whom it follows.
    ///
    /// # Errors
    /// As [`Stage::step`].
    pub fn step(&mut self) -> Outcome<Going> {
        let going = self.stage.step()?;
        let world = self.stage.world();
        self.trails.note(world, world.clock().tick().0);
        if let Some(id) = self.outlook.follow {
            match world.entity(id) {
                Some(body) => {
                    let share = (EASE * self.stage.dt()).min(1.0);
                    self.outlook.flight.ease(&Flight::behind(&body), share);
                }
                None => self.outlook.follow = None,
            }
        }
        Ok(going)
    }

    /// Picks what is on a pixel of the last picture, and says in lines what that is; nothing for the sky.
    pub fn pick(&mut self, [x, y]: [u32; 2]) -> Option<Vec<String>> {
        // In all panes at once a pixel of each stands for four.
        let (x, y) = match self.outlook.panes {
            Panes::All => {
                let half = (self.frame.width / 2, self.frame.height / 2);
                (x % half.0.max(1) * 2, y % half.1.max(1) * 2)
            }
            _ => (x, y),
        };
        let is_there = x < self.frame.width && y < self.frame.height;
        self.outlook.picked = if is_there { self.frame.entity_at(x, y) } else { None };
        self.card()
    }

    /// All that is known of who was asked about.
    pub fn card(&self) -> Option<Vec<String>> {
        let world = self.stage.world();
        let entity = self.outlook.picked.and_then(|id| world.entity(id))?;
        Some(card(world, &entity, &self.outlook.flight.position))
    }

    /// Draws what is seen now.
    ///
    /// # Errors
    /// The adapter failed, or the waypoints cannot be made.
    pub fn draw(&mut self) -> Outcome<&Canvas> {
        let camera: Camera = self.outlook.flight.camera(self.intrinsics);
        let world = self.stage.world();
        self.renderer.render(world, &camera, &mut self.frame)?;
        self.color.load(self.frame.width as usize, self.frame.height as usize, &self.frame.rgb);
        let sight = Sight { camera: &camera, frame: &self.frame };
        self.painter.draw(&mut self.color, &sight, world, &self.trails, &self.outlook.layers)?;
        self.outlook.panes.compose(&self.frame, &self.color, &mut self.canvas);
        self.write();
        Ok(&self.canvas)
    }

    /// Writes the time and what was asked over the picture.
    fn write(&mut self) {
        let world = self.stage.world();
        let mut lines = vec![format!("{:.1} s{}", world.clock().seconds(), self.note)];
        if self.outlook.card {
            lines.extend(self.card().into_iter().flatten());
        } else if let Some(entity) = self.outlook.picked.and_then(|id| world.entity(id)) {
            lines[0] = format!("{} | {}", lines[0], line(&entity));
        }
        if self.outlook.help {
            lines.push(String::new());
            lines.extend(Controls::HELP.map(str::to_owned));
        }
        for (row, line) in lines.iter().enumerate().filter(|(_, line)| !line.is_empty()) {
            self.canvas.text([8, (8 + row * LINE) as i64], line, [255, 255, 255], 1);
        }
    }

    /// The picture that was drawn last.
    pub fn canvas(&self) -> &Canvas {
        &self.canvas
    }
}
