//! What keys and pointer do: the camera flies, time stands or goes faster, something is asked about. It knows no window, so that it
//! can be tried without one.

use std::collections::BTreeSet;

use simworld_core::geometry::{Vector3, direction};

use super::{Layer, Outlook, Panes};

/// Speed of the camera at the start, m/s; the wheel changes it.
const SPEED: f64 = 12.0;
/// The slowest and the fastest, m/s.
const SPEEDS: (f64, f64) = (0.5, 400.0);
/// So much faster the camera is with the key for it.
const FAST: f64 = 5.0;
/// Turned by the pointer, radians a pixel.
const TURN: f64 = 0.004;
/// A pointer that moved less far between down and up has clicked, pixels.
const CLICK: f64 = 4.0;
/// Simulated time over real time: slowest, fastest.
const PACES: (f64, f64) = (1.0 / 16.0, 16.0);
/// Time that was lost beyond this is not made up for, s: who draws slowly sees slow motion, and no leaps.
const LAG: f64 = 0.25;

/// Where the camera goes while a key is down.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Motion {
    /// Where it looks to, on the level.
    Forward,
    /// The other way.
    Backward,
    /// To its left.
    Left,
    /// To its right.
    Right,
    /// Up.
    Up,
    /// Down.
    Down,
    /// It goes faster.
    Fast,
}

/// What a key does once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Press {
    /// Time stands, or goes on.
    Pause,
    /// One step while time stands; otherwise time stands from now on.
    Step,
    /// Time goes half as fast.
    Slower,
    /// Time goes twice as fast.
    Faster,
    /// Follows who was asked about, or flies freely again.
    Follow,
    /// Follows the next that moves, by ids.
    Next,
    /// Shows something else.
    Show(Panes),
    /// Draws a layer, or draws it no longer.
    Toggle(Layer),
    /// Writes the picture to a file.
    Save,
    /// Shows the keys, or hides them.
    Help,
    /// Ends.
    Quit,
}

/// What comes in from keys and pointer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Input {
    /// A key that moves the camera goes down or up.
    Held(Motion, bool),
    /// Another key goes down.
    Pressed(Press),
    /// The pointer is there, pixels from the top left.
    Pointer([f64; 2]),
    /// The button of the pointer goes down or up.
    Button(bool),
    /// The wheel turns: notches away from who looks.
    Wheel(f64),
    /// The window is no longer written to: no key is down.
    Left,
}

/// What is left for the viewer to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wish {
    /// Say what is on that pixel.
    Pick([u32; 2]),
    /// Follow who was asked about, or nobody.
    Follow,
    /// Follow the next that moves.
    Next,
    /// Write the picture to a file.
    Save,
    /// End.
    Quit,
}

/// The state of keys, pointer and time.
#[derive(Clone, Debug)]
pub struct Controls {
    /// Whether time stands.
    pub paused: bool,
    /// Simulated time over real time.
    pub pace: f64,
    /// Speed of the camera, m/s.
    pub speed: f64,
    held: BTreeSet<Motion>,
    pointer: [f64; 2],
    /// Where the button went down, while it is, and whether the pointer was dragged since.
    grip: Option<([f64; 2], bool)>,
    /// Simulated time that is owed, s.
    owed: f64,
    /// Single steps that are owed.
    steps: u32,
}

impl Default for Controls {
    fn default() -> Self {
        Self {
            paused: false,
            pace: 1.0,
            speed: SPEED,
            held: BTreeSet::new(),
            pointer: [0.0; 2],
            grip: None,
            owed: 0.0,
            steps: 0,
        }
    }
}

impl Controls {
    /// The keys, in lines of key and meaning.
    pub const HELP: [&str; 13] = [
        "W A S D       fly",
        "E Q           up, down",
        "Shift         faster; wheel: speed",
        "drag          look around",
        "click         what is that?",
        "F             follow it, let go",
        "Tab           follow the next",
        "Space         pause",
        "N             one step",
        "- +           slower, faster",
        "1 2 3 4 5     color depth classes instances all",
        "L M T I       lanes waypoints paths ids",
        "P H Esc       picture, help, end",
    ];

    /// Takes what came in; returns what is left to do.
    pub fn take(&mut self, outlook: &mut Outlook, input: Input) -> Option<Wish> {
        match input {
            Input::Held(motion, true) => {
                self.held.insert(motion);
            }
            Input::Held(motion, false) => {
                self.held.remove(&motion);
            }
            Input::Left => {
                self.held.clear();
                self.grip = None;
            }
            Input::Wheel(notches) => {
                let factor = simworld_core::ops::pow(1.25, notches.clamp(-20.0, 20.0));
                self.speed = (self.speed * factor).clamp(SPEEDS.0, SPEEDS.1);
            }
            Input::Pointer(to) => self.point(outlook, to),
            Input::Button(true) => self.grip = Some((self.pointer, false)),
            Input::Button(false) => return self.let_go(),
            Input::Pressed(press) => return self.press(outlook, press),
        }
        None
    }

    fn press(&mut self, outlook: &mut Outlook, press: Press) -> Option<Wish> {
        match press {
            Press::Pause => (self.paused, self.owed) = (!self.paused, 0.0),
            Press::Step => {
                self.steps += u32::from(self.paused);
                (self.paused, self.owed) = (true, 0.0);
            }
            Press::Slower => self.pace = (self.pace / 2.0).max(PACES.0),
            Press::Faster => self.pace = (self.pace * 2.0).min(PACES.1),
            Press::Show(panes) => outlook.panes = panes,
            Press::Toggle(layer) => outlook.toggle(layer),
            Press::Help => outlook.help = !outlook.help,
            Press::Follow => return Some(Wish::Follow),
            Press::Next => return Some(Wish::Next),
            Press::Save => return Some(Wish::Save),
            Press::Quit => return Some(Wish::Quit),
        }
        None
    }

    /// The pointer moved; with the button down the camera turns after it, as if the picture were held.
    fn point(&mut self, outlook: &mut Outlook, to: [f64; 2]) {
        let by = [to[0] - self.pointer[0], to[1] - self.pointer[1]];
        self.pointer = to;
        let Some((from, dragged)) = &mut self.grip else { return };
        let was_dragged = *dragged;
        *dragged |= simworld_core::ops::hypot(to[0] - from[0], to[1] - from[1]) >= CLICK;
        if *dragged {
            // What moved while it could still have been a click counts too.
            let by = if was_dragged { by } else { [to[0] - from[0], to[1] - from[1]] };
            outlook.follow = None;
            outlook.flight.turn(by[0] * TURN, by[1] * TURN);
        }
    }

    fn let_go(&mut self) -> Option<Wish> {
        let (_, dragged) = self.grip.take()?;
        let pixel = self.pointer.map(|at| at.max(0.0) as u32);
        (!dragged).then_some(Wish::Pick(pixel))
    }

    /// Moves the camera by the keys that are down, for that much real time, s; whoever flies follows nobody.
    pub fn fly(&self, outlook: &mut Outlook, seconds: f64) {
        let way = |ahead, back| {
            f64::from(i8::from(self.held.contains(&ahead)) - i8::from(self.held.contains(&back)))
        };
        let forward = direction(outlook.flight.yaw);
        let left = Vector3::new(-forward.y, forward.x, 0.0);
        let way = Vector3::new(forward.x, forward.y, 0.0) * way(Motion::Forward, Motion::Backward)
            + left * way(Motion::Left, Motion::Right)
            + Vector3::z() * way(Motion::Up, Motion::Down);
        let length = way.norm();
        if length < 0.5 {
            return;
        }
        let fast = if self.held.contains(&Motion::Fast) { FAST } else { 1.0 };
        outlook.flight.position += way * (self.speed * fast * seconds / length);
        outlook.follow = None;
    }

    /// How many steps of `dt` seconds are due after that much real time, s.
    pub fn steps(&mut self, seconds: f64, dt: f64) -> u32 {
        let single = std::mem::take(&mut self.steps);
        if self.paused {
            return single;
        }
        self.owed = (self.owed + seconds * self.pace).min((LAG * self.pace).max(dt));
        let due = (self.owed / dt + 1e-9).floor();
        self.owed = (self.owed - due * dt).max(0.0);
        due as u32
    }

    /// Whether the picture stays as it is until something comes in.
    pub fn is_at_rest(&self) -> bool {
        self.paused && self.steps == 0 && self.held.iter().all(|motion| *motion == Motion::Fast)
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::Point3;

    use super::super::Flight;
    use super::*;

    fn begin() -> (Controls, Outlook) {
        let east = Flight { position: Point3::new(0.0, 0.0, 5.0), yaw: 0.0, pitch: -0.3 };
        (Controls::default(), Outlook::from(east))
    }

    #[test]
    fn held_keys_fly_on_the_level_and_at_one_speed_in_every_direction() {
        let (mut controls, mut outlook) = begin();
        outlook.follow = Some(simworld_core::id::EntityId::new(3, 0));
        controls.fly(&mut outlook, 1.0);
        assert!(outlook.follow.is_some(), "who touches nothing keeps following");
        for motion in [Motion::Forward, Motion::Left] {
            controls.take(&mut outlook, Input::Held(motion, true));
        }
        controls.fly(&mut outlook, 2.0);
        let at = outlook.flight.position;
        assert!((at.x - at.y).abs() < 1e-9 && at.x > 0.0 && at.z == 5.0, "{at}");
        assert!((at.coords.xy().norm() - 2.0 * SPEED).abs() < 1e-9, "{at}");
        assert_eq!(outlook.follow, None);
        controls.take(&mut outlook, Input::Left);
        controls.fly(&mut outlook, 2.0);
        assert_eq!(outlook.flight.position, at, "no key is down any more");
    }

    #[test]
    fn a_click_asks_and_a_drag_turns() {
        let (mut controls, mut outlook) = begin();
        let before = outlook.flight;
        controls.take(&mut outlook, Input::Pointer([40.0, 30.0]));
        controls.take(&mut outlook, Input::Button(true));
        controls.take(&mut outlook, Input::Pointer([41.0, 31.0]));
        assert_eq!(controls.take(&mut outlook, Input::Button(false)), Some(Wish::Pick([41, 31])));
        assert_eq!(outlook.flight, before, "a hand that trembles turns nothing");
        controls.take(&mut outlook, Input::Button(true));
        controls.take(&mut outlook, Input::Pointer([141.0, 31.0]));
        assert_eq!(controls.take(&mut outlook, Input::Button(false)), None);
        // What was on the left comes to the middle as the picture is pulled to the right.
        assert!((outlook.flight.yaw - 100.0 * TURN).abs() < 1e-9, "{}", outlook.flight.yaw);
        controls.take(&mut outlook, Input::Pointer([300.0, 300.0]));
        assert!((outlook.flight.yaw - 100.0 * TURN).abs() < 1e-9, "without the button nothing turns");
    }

    #[test]
    fn time_stands_steps_and_changes_its_pace() {
        let (mut controls, mut outlook) = begin();
        let mut press = |controls: &mut Controls, press| controls.take(&mut outlook, Input::Pressed(press));
        let total: u32 = (0..10).map(|_| controls.steps(0.016, 0.05)).sum();
        assert_eq!(total, 3, "0.16 s have three whole steps");
        press(&mut controls, Press::Faster);
        controls.steps(1.0, 0.05);
        let fast: u32 = (0..50).map(|_| controls.steps(0.02, 0.05)).sum();
        assert!((39..=41).contains(&fast), "a second at twice the pace: {fast}");
        assert!(controls.steps(60.0, 0.05) <= 10, "a minute that was slept through is not made up for");
        press(&mut controls, Press::Pause);
        assert!(controls.is_at_rest());
        assert_eq!(controls.steps(1.0, 0.05), 0);
        press(&mut controls, Press::Step);
        assert!(!controls.is_at_rest());
        assert_eq!((controls.steps(1.0, 0.05), controls.steps(1.0, 0.05)), (1, 0));
        press(&mut controls, Press::Pause);
        assert_eq!(controls.steps(0.05, 0.05), 2, "at twice the pace");
        // A step while time goes stops it where it is.
        press(&mut controls, Press::Step);
        assert!(controls.paused && controls.steps(1.0, 0.05) == 0);
    }

    #[test]
    fn keys_choose_what_is_shown() {
        let (mut controls, mut outlook) = begin();
        let mut press = |press| controls.take(&mut outlook, Input::Pressed(press));
        assert_eq!(press(Press::Show(Panes::Depth)), None);
        press(Press::Toggle(Layer::Lanes));
        press(Press::Toggle(Layer::Ids));
        press(Press::Toggle(Layer::Lanes));
        assert_eq!(press(Press::Quit), Some(Wish::Quit));
        assert_eq!(press(Press::Save), Some(Wish::Save));
        assert_eq!((outlook.panes, outlook.layers), (Panes::Depth, BTreeSet::from([Layer::Ids])));
    }
}
