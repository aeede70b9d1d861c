//! The window: what a [`Viewer`] draws goes to the screen, and keys and pointer to [`Controls`].

use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::time::{Duration, Instant};

use softbuffer::{Context, SoftBufferError, Surface};
use thiserror::Error;
use winit::application::ApplicationHandler;
use winit::dpi::{LogicalSize, PhysicalSize};
use winit::error::{EventLoopError, OsError};
use winit::event::{ElementState, KeyEvent, MouseButton, MouseScrollDelta, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::keyboard::{KeyCode, PhysicalKey};
use winit::window::{Window, WindowId};

use super::film::write_png;
use super::{Canvas, Controls, Going, Input, Layer, Motion, Panes, Press, Viewer, Wish};
use crate::Outcome;

/// The shortest time from one picture to the next.
const SHORTEST: Duration = Duration::from_micros(16_600);
/// The camera flies no farther between two pictures than in that time, s.
const LONGEST: f64 = 0.5;
/// A wheel that tells pixels has turned by a notch after so many.
const NOTCH: f64 = 40.0;

/// Why there is no window.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum WindowError {
    /// There is no display, or it went away.
    #[error(
        "there is no window ({0}): set DISPLAY or WAYLAND_DISPLAY, try it under `xvfb-run`, or film with --gif, --png or --mp4"
    )]
    Display(#[from] EventLoopError),
    /// The display gives no window.
    #[error("the display gives no window: {0}")]
    Window(#[from] OsError),
    /// The window takes no pixels.
    #[error("the window takes no pixels: {0}")]
    Pixels(#[from] SoftBufferError),
}

/// What was done in a window.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shown {
    /// Pictures that were shown.
    pub pictures: u32,
    /// Steps that were taken.
    pub steps: u64,
}

/// Shows what the viewer sees in a window, until that is closed or so many pictures were shown. Pictures that are asked for go to that
/// folder; what is clicked at is printed.
///
/// # Errors
/// There is no window ([`WindowError`]), or what [`Viewer::step`] and [`Viewer::draw`] say.
pub fn show(viewer: &mut Viewer, folder: &Path, pictures: Option<u32>) -> Outcome<Shown> {
    let events = EventLoop::new().map_err(WindowError::from)?;
    viewer.outlook.card = true;
    let mut screen = Screen {
        viewer,
        controls: Controls::default(),
        folder: folder.to_owned(),
        most: pictures.unwrap_or(u32::MAX),
        shown: Shown::default(),
        saved: 0,
        surface: None,
        last: None,
        rate: 0.0,
        is_over: false,
        fault: None,
    };
    events.run_app(&mut screen).map_err(WindowError::from)?;
    match screen.fault {
        Some(fault) => Err(fault),
        None => Ok(screen.shown),
    }
}

struct Screen<'a> {
    viewer: &'a mut Viewer,
    controls: Controls,
    folder: PathBuf,
    most: u32,
    shown: Shown,
    /// Pictures that were written to files.
    saved: u32,
    surface: Option<Surface<Rc<Window>, Rc<Window>>>,
    /// When the last picture was drawn.
    last: Option<Instant>,
    /// Pictures a second, smoothed.
    rate: f64,
    /// Whether a recorded run has come to its end.
    is_over: bool,
    fault: Option<Box<dyn std::error::Error>>,
}

impl Screen<'_> {
    fn open(&mut self, events: &ActiveEventLoop) -> Result<(), WindowError> {
        let [width, height] = self.viewer.size();
        let attributes = Window::default_attributes()
            .with_title("simworld")
            .with_inner_size(PhysicalSize::new(width, height))
            .with_min_inner_size(LogicalSize::new(64, 48));
        let window = Rc::new(events.create_window(attributes)?);
        let context = Context::new(Rc::clone(&window))?;
        self.surface = Some(Surface::new(&context, Rc::clone(&window))?);
        window.request_redraw();
        Ok(())
    }

    /// Steps as much as time has gone on, draws, and puts it on the screen.
    fn redraw(&mut self) -> Outcome<()> {
        let seconds = self.lap().min(LONGEST);
        self.controls.fly(&mut self.viewer.outlook, seconds);
        for _ in 0..self.controls.steps(seconds, self.viewer.stage.dt()) {
            if self.viewer.step()? == Going::Ended {
                (self.is_over, self.controls.paused) = (true, true);
                break;
            }
            self.shown.steps += 1;
        }
        let Some(surface) = &mut self.surface else { return Ok(()) };
        let size = surface.window().inner_size();
        let (Some(width), Some(height)) = (NonZeroU32::new(size.width), NonZeroU32::new(size.height)) else {
            return Ok(());
        };
        if self.viewer.size() != [size.width, size.height] {
            self.viewer.resize([size.width, size.height])?;
        }
        self.viewer.note = note(&self.controls, self.rate, self.is_over);
        let canvas = self.viewer.draw()?;
        surface.resize(width, height).map_err(WindowError::from)?;
        let mut pixels = surface.buffer_mut().map_err(WindowError::from)?;
        fill(&mut pixels, canvas);
        pixels.present().map_err(WindowError::from)?;
        self.shown.pictures += 1;
        Ok(())
    }

    /// The real time since the last picture, s.
    #[expect(clippy::disallowed_methods, reason = "how fast a window goes is a matter of real time")]
    fn lap(&mut self) -> f64 {
        let now = Instant::now();
        let seconds = self.last.map_or(0.0, |last| (now - last).as_secs_f64());
        self.last = Some(now);
        if seconds > 0.0 {
            self.rate += (1.0 / seconds - self.rate) * if self.rate == 0.0 { 1.0 } else { 0.2 };
        }
        seconds
    }

    fn take(&mut self, events: &ActiveEventLoop, input: Input) -> Outcome<()> {
        match self.controls.take(&mut self.viewer.outlook, input) {
            None => {}
            Some(Wish::Quit) => events.exit(),
            Some(Wish::Follow) => self.viewer.follow_picked(),
            Some(Wish::Next) => self.viewer.follow_next(),
            Some(Wish::Pick(pixel)) => {
                let card = self.viewer.pick(pixel).unwrap_or_else(|| vec!["the sky".to_owned()]);
                println!("{}\n", card.join("\n"));
            }
            Some(Wish::Save) => {
                crate::folder::make_folder(&self.folder)?;
                let path = self.folder.join(format!("view-{:03}.png", self.saved));
                write_png(self.viewer.canvas(), &path)?;
                self.saved += 1;
                println!("written to {}", path.display());
            }
        }
        Ok(())
    }

    /// Ends with an error, if there is one.
    fn mind(&mut self, events: &ActiveEventLoop, done: Outcome<()>) {
        if let Err(fault) = done {
            self.fault = Some(fault);
            events.exit();
        }
    }
}

impl ApplicationHandler for Screen<'_> {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.surface.is_none() {
            let done = self.open(events).map_err(Into::into);
            self.mind(events, done);
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        match event {
            WindowEvent::CloseRequested => return events.exit(),
            WindowEvent::RedrawRequested => {
                let done = self.redraw();
                self.mind(events, done);
                if self.shown.pictures >= self.most {
                    events.exit();
                }
                return;
            }
            WindowEvent::Resized(_) => {}
            event => {
                let Some(input) = input_of(&event) else { return };
                if self.controls.is_at_rest() {
                    // The time since the last picture was nobody's.
                    self.last = None;
                }
                let done = self.take(events, input);
                self.mind(events, done);
            }
        }
        if let Some(surface) = &self.surface {
            surface.window().request_redraw();
        }
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        let (Some(surface), Some(last)) = (&self.surface, self.last) else { return };
        if self.controls.is_at_rest() {
            events.set_control_flow(ControlFlow::Wait);
        } else if last.elapsed() >= SHORTEST {
            surface.window().request_redraw();
        } else {
            events.set_control_flow(ControlFlow::WaitUntil(last + SHORTEST));
        }
    }
}

/// What stands beside the time.
fn note(controls: &Controls, rate: f64, is_over: bool) -> String {
    let state = match (controls.paused, is_over) {
        (true, true) => " | the recorded run is over".to_owned(),
        (true, false) => " | paused".to_owned(),
        (false, _) => format!(" | {rate:.0} pictures/s"),
    };
    format!("{state} | x{} | {:.0} m/s | H: keys", controls.pace, controls.speed)
}

/// Puts a picture on the screen's pixels; what is beside it stays black.
fn fill(pixels: &mut [u32], canvas: &Canvas) {
    let colors = canvas.rgb.chunks_exact(3).map(|rgb| u32::from_be_bytes([0, rgb[0], rgb[1], rgb[2]]));
    for (pixel, color) in pixels.iter_mut().zip(colors) {
        *pixel = color;
    }
}

/// What an event of the window means here, if anything.
fn input_of(event: &WindowEvent) -> Option<Input> {
    Some(match event {
        WindowEvent::KeyboardInput { event: KeyEvent { physical_key, state, repeat, .. }, .. } => {
            let PhysicalKey::Code(code) = physical_key else { return None };
            return input_of_key(*code, *state == ElementState::Pressed, *repeat);
        }
        WindowEvent::CursorMoved { position, .. } => Input::Pointer([position.x, position.y]),
        WindowEvent::MouseInput { state, button: MouseButton::Left, .. } => {
            Input::Button(*state == ElementState::Pressed)
        }
        WindowEvent::MouseWheel { delta: MouseScrollDelta::LineDelta(_, notches), .. } => {
            Input::Wheel(f64::from(*notches))
        }
        WindowEvent::MouseWheel { delta: MouseScrollDelta::PixelDelta(by), .. } => Input::Wheel(by.y / NOTCH),
        WindowEvent::Focused(false) => Input::Left,
        _ => return None,
    })
}

/// What a key means, by its place on the keyboard: W A S D lie together on every one. A key that is held repeats nothing but steps.
fn input_of_key(code: KeyCode, is_down: bool, repeats: bool) -> Option<Input> {
    let motion = match code {
        KeyCode::KeyW | KeyCode::ArrowUp => Some(Motion::Forward),
        KeyCode::KeyS | KeyCode::ArrowDown => Some(Motion::Backward),
        KeyCode::KeyA | KeyCode::ArrowLeft => Some(Motion::Left),
        KeyCode::KeyD | KeyCode::ArrowRight => Some(Motion::Right),
        KeyCode::KeyE | KeyCode::PageUp => Some(Motion::Up),
        KeyCode::KeyQ | KeyCode::PageDown => Some(Motion::Down),
        KeyCode::ShiftLeft | KeyCode::ShiftRight => Some(Motion::Fast),
        _ => None,
    };
    if let Some(motion) = motion {
        return Some(Input::Held(motion, is_down));
    }
    let press = match code {
        KeyCode::Space => Press::Pause,
        KeyCode::KeyN => Press::Step,
        KeyCode::Minus | KeyCode::NumpadSubtract => Press::Slower,
        KeyCode::Equal | KeyCode::NumpadAdd => Press::Faster,
        KeyCode::KeyF => Press::Follow,
        KeyCode::Tab => Press::Next,
        KeyCode::Digit1 => Press::Show(Panes::Color),
        KeyCode::Digit2 => Press::Show(Panes::Depth),
        KeyCode::Digit3 => Press::Show(Panes::Classes),
        KeyCode::Digit4 => Press::Show(Panes::Instances),
        KeyCode::Digit5 => Press::Show(Panes::All),
        KeyCode::KeyL => Press::Toggle(Layer::Lanes),
        KeyCode::KeyM => Press::Toggle(Layer::Waypoints),
        KeyCode::KeyT => Press::Toggle(Layer::Paths),
        KeyCode::KeyI => Press::Toggle(Layer::Ids),
        KeyCode::KeyP => Press::Save,
        KeyCode::KeyH | KeyCode::F1 => Press::Help,
        KeyCode::Escape => Press::Quit,
        _ => return None,
    };
    (is_down && (!repeats || press == Press::Step)).then_some(Input::Pressed(press))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_those_of_the_help() {
        let down = |code| input_of_key(code, true, false);
        assert_eq!(down(KeyCode::KeyW), Some(Input::Held(Motion::Forward, true)));
        assert_eq!(input_of_key(KeyCode::KeyW, false, false), Some(Input::Held(Motion::Forward, false)));
        assert_eq!(down(KeyCode::Space), Some(Input::Pressed(Press::Pause)));
        assert_eq!(input_of_key(KeyCode::Space, true, true), None, "held down it does not flicker");
        assert_eq!(input_of_key(KeyCode::Space, false, false), None);
        assert_eq!(input_of_key(KeyCode::KeyN, true, true), Some(Input::Pressed(Press::Step)));
        assert_eq!(down(KeyCode::F9), None);
    }

    #[test]
    fn pixels_are_red_green_blue() {
        let mut canvas = Canvas::default();
        canvas.load(2, 1, &[1, 2, 3, 255, 0, 0]);
        let mut pixels = [7; 2];
        fill(&mut pixels, &canvas);
        assert_eq!(pixels, [0x01_02_03, 0xff_00_00]);
    }
}
