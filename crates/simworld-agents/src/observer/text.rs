//! Observations as lines for a prompt, within a budget.

use std::fmt::Write as _;

use simworld_core::event::{Event, EventKind};
use simworld_core::id::EntityId;
use simworld_core::scene::{FallCause, Role};

use super::{SceneGraph, Sighting};

/// From this on one sees that somebody looks up or down, radians.
const NOD: f64 = 0.15;

impl SceneGraph {
    /// Takes down what the events of a step say about the agent: what failed and why, plans that ended, words said to it; and
    /// what those in sight do: gestures, and who talks to whom, but not the words. An observation clears it, so call it after [`observe`](simworld_core::seam::Observer::observe).
    pub fn hear(&mut self, events: &[Event], who: EntityId) {
        let in_sight = |id: EntityId| self.sightings.iter().any(|sighting| sighting.id == id);
        let line = |event| feedback_line(event, who).or_else(|| doing_line(event, who, &in_sight));
        let lines: Vec<String> = events.iter().filter_map(line).collect();
        self.feedback.extend(lines);
    }

    /// The things in sight as lines for a prompt, nearest first, at most `budget` characters; what is left out is
    /// counted.
    pub fn to_text(&self, budget: usize) -> String {
        let mut text = String::new();
        self.append_sightings(&mut text, &|text| text.chars().count() <= budget);
        text
    }

    /// All of it as lines for a prompt, of at most that many tokens as [`tokens_in`] counts them: first the agent, then
    /// feedback, then what is in sight, nearest first; what is left out is counted.
    pub fn to_prompt(&self, tokens: usize) -> String {
        let mut text = String::new();
        let fits = |text: &str| tokens_in(text) <= tokens;
        let lines = std::iter::once(self.oneself_line())
            .chain(self.feedback.iter().map(|line| format!("> {line}\n")));
        for line in lines {
            let length = text.len();
            text.push_str(&line);
            if !fits(&text) {
                text.truncate(length);
                return text;
            }
        }
        self.append_sightings(&mut text, &fits);
        text
    }

    fn oneself_line(&self) -> String {
        let (fix, place) = (&self.oneself.fix, &self.oneself.fix.position);
        let degrees = fix.heading.to_degrees().rem_euclid(360.0);
        let mut line = format!("you: ({:.1}, {:.1}), heading {degrees:.0}°", place.x, place.y);
        if fix.speed > 0.1 {
            // Writing to a string does not fail.
            let _ = write!(line, ", {:.1} m/s", fix.speed);
        }
        if let Some((carrier, role)) = self.oneself.on {
            let _ =
                write!(line, ", {} {carrier}", if role == Role::Seated { "sitting on" } else { "aboard" });
        }
        for (load, role) in &self.oneself.with {
            let _ = match role {
                Role::Ridden => write!(line, ", riding {load}"),
                Role::Carried => write!(line, ", carrying {load}"),
                Role::Held => write!(line, ", holding {load}"),
                _ => Ok(()),
            };
        }
        line.push('\n');
        line
    }

    /// Adds a line for each thing while it fits with the count of those that would be left out.
    fn append_sightings(&self, text: &mut String, fits: &dyn Fn(&str) -> bool) {
        for (index, sighting) in self.sightings.iter().enumerate() {
            let before = text.len();
            let left = self.sightings.len() - index;
            let _ = writeln!(text, "{sighting}");
            let line_ends = text.len();
            if left > 1 {
                let _ = writeln!(text, "... and {} more", left - 1);
            }
            if fits(text) {
                text.truncate(line_ends);
                continue;
            }
            text.truncate(before);
            let _ = writeln!(text, "... and {left} more");
            if !fits(text) {
                text.truncate(before); // even the count has no room
            }
            return;
        }
    }
}

/// What an event says about an agent: what failed and why, plans that ended, words said to it; one line.
pub(super) fn feedback_line(event: &Event, who: EntityId) -> Option<String> {
    let line = match &event.kind {
        EventKind::ActionFailed { who: actor, action, reason } if *actor == who => {
            format!("{action} failed: {reason}")
        }
        EventKind::Fell { who: actor, cause } if *actor == who => match cause {
            FallCause::Tripped => "you tripped and fell".to_owned(),
            FallCause::Slipped => "you slipped and fell".to_owned(),
            FallCause::Landed => "you came down hard and fell".to_owned(),
            _ => "you were run into and fell".to_owned(),
        },
        EventKind::GotUp { who: actor } if *actor == who => "you are on your feet again".to_owned(),
        EventKind::GraspBroke { who: actor, thing, .. } if *actor == who => {
            format!("you lost hold of {thing}")
        }
        EventKind::Thrown { who: actor, item, .. } if *actor == who => format!("you threw {item}"),
        EventKind::Rerouted { who: actor, reason } if *actor == who => {
            format!("plan goes on otherwise: {reason}")
        }
        EventKind::PlanDone { who: actor } if *actor == who => "plan done".to_owned(),
        EventKind::PlanFailed { who: actor, reason } if *actor == who => format!("plan failed: {reason}"),
        EventKind::IntentRefused { who: actor, reason } if *actor == who => format!("refused: {reason}"),
        EventKind::Said { who: speaker, to, words } if *to == who => {
            format!("{speaker} said to you: {words:?}")
        }
        EventKind::Gesture { who: other, gesture, to: Some(to), .. } if *to == who => {
            format!("{other} does this at you: {gesture}")
        }
        EventKind::Contact { a, b, .. } if *a == who => format!("you touched {b}"),
        EventKind::Contact { a, b, .. } if *b == who => format!("you touched {a}"),
        _ => return None,
    };
    // A reason may quote a name that holds line breaks.
    Some(line.split_whitespace().collect::<Vec<_>>().join(" "))
}

/// What somebody else in sight does, in one line.
fn doing_line(event: &Event, who: EntityId, in_sight: &dyn Fn(EntityId) -> bool) -> Option<String> {
    let seen = |other: &EntityId| *other != who && in_sight(*other);
    match &event.kind {
        EventKind::Gesture { who: other, heading: Some(heading), .. } if seen(other) => {
            Some(format!("{other} points to {:.0}°", heading.to_degrees().rem_euclid(360.0)))
        }
        EventKind::Gesture { who: other, gesture, to: Some(to), .. } if seen(other) => {
            Some(format!("{other} does this at {to}: {gesture}"))
        }
        EventKind::Gesture { who: other, gesture, .. } if seen(other) => {
            Some(format!("{other} does this: {gesture}"))
        }
        EventKind::Said { who: other, to, .. } if seen(other) => Some(format!("{other} talks to {to}")),
        EventKind::Fell { who: other, .. } if seen(other) => Some(format!("{other} falls")),
        EventKind::GotUp { who: other } if seen(other) => Some(format!("{other} is on its feet again")),
        _ => None,
    }
}

/// An estimate of the tokens of a text that rather exceeds what byte-pair tokenisers of language models make of English:
/// one for every four letters or begun four, one for every three digits, one for every other sign but blanks.
pub fn tokens_in(text: &str) -> usize {
    let (mut tokens, mut letters, mut digits) = (0, 0, 0);
    for sign in text.chars() {
        (letters, digits) = match (sign.is_alphabetic(), sign.is_ascii_digit()) {
            (true, _) => (letters + 1, 0),
            (_, true) => (0, digits + 1),
            _ => (0, 0),
        };
        let begins = letters % 4 == 1 || digits % 3 == 1;
        let is_sign = letters == 0 && digits == 0 && sign != ' ';
        tokens += usize::from(begins || is_sign);
    }
    tokens
}

impl std::fmt::Display for Sighting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let degrees = self.bearing.to_degrees();
        let side = if degrees >= 0.0 { "left" } else { "right" };
        let mut notes = String::new();
        if self.speed > 0.1 {
            write!(notes, ", moving at {:.1} m/s", self.speed)?;
        }
        if let Some((carrier, role)) = self.bond {
            write!(notes, ", {} by {carrier}", format!("{role:?}").to_lowercase())?;
        }
        notes.push_str(match self.is_open {
            Some(true) => ", open",
            Some(false) => ", closed",
            None => "",
        });
        if self.gaze.abs() > NOD {
            notes.push_str(if self.gaze > 0.0 { ", looking up" } else { ", looking down" });
        }
        let (id, kind, label) = (self.id, self.kind, &self.label);
        // Quoted with its quotes and line breaks escaped: no name looks like two things in sight.
        let name = if label == kind.as_str() { String::new() } else { format!(" {label:?}") };
        write!(f, "{id} {kind}{name}: {:.1} m, {:.0}° to the {side}{notes}", self.distance, degrees.abs())
    }
}
