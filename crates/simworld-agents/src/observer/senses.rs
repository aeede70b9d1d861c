//! Any set of senses by name, and one text of them all within a budget of tokens.

use std::collections::BTreeMap;

use simworld_core::event::Event;
use simworld_core::id::EntityId;
use simworld_core::scene::Scene;
use simworld_core::seam::{ObserveError, Observer, SpaceValue};

use super::text::feedback_line;
use super::{GpsFix, SceneGraph, tokens_in};

/// The most lines of feedback that are kept until somebody reads them.
const KEPT: usize = 64;

/// An observation that can be told in words.
pub trait Describe {
    /// Lines of at most that many tokens, as [`tokens_in`] counts them; what matters most comes first.
    fn describe(&self, tokens: usize) -> String;

    /// The observation as a value for learners; `None` if it is none.
    fn value(&self) -> Option<SpaceValue> {
        None
    }
}

impl Describe for SceneGraph {
    fn describe(&self, tokens: usize) -> String {
        self.to_prompt(tokens)
    }
}

impl Describe for GpsFix {
    fn describe(&self, tokens: usize) -> String {
        let (at, degrees) = (&self.position, self.heading.to_degrees().rem_euclid(360.0));
        let line = format!("({:.1}, {:.1}), heading {degrees:.0}°, {:.1} m/s\n", at.x, at.y, self.speed);
        lines_within(&line, tokens)
    }

    fn value(&self) -> Option<SpaceValue> {
        let at = &self.position;
        Some(SpaceValue::Box(vec![at.x, at.y, at.z, self.heading, self.speed]))
    }
}

impl Describe for String {
    fn describe(&self, tokens: usize) -> String {
        lines_within(self, tokens)
    }

    fn value(&self) -> Option<SpaceValue> {
        Some(SpaceValue::Text(self.clone()))
    }
}

/// A sense with a memory of what it perceived last.
pub trait Sense: Send {
    /// Perceives the scene as `who`.
    ///
    /// # Errors
    /// Nobody is there, or the sensor failed.
    fn perceive(&mut self, scene: &dyn Scene, who: EntityId) -> Result<(), ObserveError>;

    /// Takes down what happened in the last step; nothing by default.
    fn notice(&mut self, _events: &[Event], _who: EntityId) {}

    /// Forgets what was told once; nothing by default.
    fn told(&mut self) {}

    /// What it perceived last.
    fn perceived(&self) -> &dyn Describe;

    /// What it has taken down and not told yet, as bytes for a snapshot; empty by default.
    fn save(&self) -> Vec<u8> {
        Vec::new()
    }

    /// Takes up a saved state; false if the bytes are not this sense's.
    fn restore(&mut self, saved: &[u8]) -> bool {
        saved.is_empty()
    }
}

/// An observer with its buffer.
struct Observed<O: Observer> {
    observer: O,
    observation: O::Observation,
}

impl<O> Sense for Observed<O>
where
    O: Observer<Observation: Describe + Send> + Send,
{
    fn perceive(&mut self, scene: &dyn Scene, who: EntityId) -> Result<(), ObserveError> {
        self.observer.observe(scene, who, &mut self.observation)
    }

    fn perceived(&self) -> &dyn Describe {
        &self.observation
    }
}

/// What became of what one did, and what was said and done to one, since it was told last.
#[derive(Clone, Debug, Default)]
pub struct Feedback {
    lines: Lines,
}

#[derive(Clone, Debug, Default)]
struct Lines(Vec<String>);

impl Describe for Lines {
    /// The newest lines that fit, the oldest of them first.
    fn describe(&self, tokens: usize) -> String {
        let mut text = String::new();
        for line in self.0.iter().rev() {
            let longer = format!("- {line}\n{text}");
            if tokens_in(&longer) > tokens {
                break;
            }
            text = longer;
        }
        text
    }
}

impl Sense for Feedback {
    fn perceive(&mut self, _: &dyn Scene, _: EntityId) -> Result<(), ObserveError> {
        Ok(())
    }

    fn notice(&mut self, events: &[Event], who: EntityId) {
        self.lines.0.extend(events.iter().filter_map(|event| feedback_line(event, who)));
        let excess = self.lines.0.len().saturating_sub(KEPT);
        self.lines.0.drain(..excess);
    }

    fn told(&mut self) {
        self.lines.0.clear();
    }

    fn perceived(&self) -> &dyn Describe {
        &self.lines
    }

    fn save(&self) -> Vec<u8> {
        // Plain data, which postcard always takes.
        postcard::to_stdvec(&self.lines.0).expect("plain data serialises")
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        match postcard::from_bytes(saved) {
            Ok(lines) => {
                self.lines = Lines(lines);
                true
            }
            Err(_) => false,
        }
    }
}

/// Words that somebody else sets: the state of a task.
#[derive(Clone, Debug, Default)]
struct Words(String);

impl Sense for Words {
    fn perceive(&mut self, _: &dyn Scene, _: EntityId) -> Result<(), ObserveError> {
        Ok(())
    }

    fn perceived(&self) -> &dyn Describe {
        &self.0
    }
}

/// One named sense with its share of a budget.
struct Named {
    name: String,
    weight: f64,
    sense: Box<dyn Sense>,
}

/// A set of senses.
///
/// ```
/// use simworld_agents::observer::{Feedback, GpsObserver, SceneGraphObserver, Senses, tokens_in};
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
///
/// let mut world = World::new();
/// let at = |x| pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
/// let me = world.spawn(EntityDesc::new(EntityKind::Person, at(0.0), Shape::Capsule { radius: 0.25, height: 1.8 }))?;
/// world.spawn(EntityDesc::new(EntityKind::Chair, at(3.0), Shape::cuboid(0.5, 0.5, 0.9)))?;
///
/// let mut senses = Senses::new()
///     .with("in sight", SceneGraphObserver::new(50.0))
///     .with("receiver", GpsObserver::exact())
///     .with_sense("feedback", 1.0, Feedback::default());
/// senses.perceive(&world, me)?;
/// let prompt = senses.prompt(100);
/// assert!(prompt.contains("[in sight]") && prompt.contains("#1 chair") && tokens_in(&prompt) <= 100);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Default)]
pub struct Senses {
    senses: Vec<Named>,
}

impl Senses {
    /// None yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// With an observer of that name, whose share of a budget is 1; one of the same name is replaced.
    #[must_use]
    pub fn with<O>(self, name: &str, observer: O) -> Self
    where
        O: Observer<Observation: Describe + Default + Send> + Send + 'static,
    {
        self.with_sense(name, 1.0, Observed { observer, observation: O::Observation::default() })
    }

    /// With a sense of that name and share (more than 0); one of the same name is replaced.
    #[must_use]
    pub fn with_sense(mut self, name: &str, weight: f64, sense: impl Sense + 'static) -> Self {
        let weight = if weight.is_finite() { weight.max(0.01) } else { 1.0 };
        let named = Named { name: name.to_owned(), weight, sense: Box::new(sense) };
        match self.senses.iter_mut().find(|other| other.name == name) {
            Some(other) => *other = named,
            None => self.senses.push(named),
        }
        self
    }

    /// The names, in the order in which they are told.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.senses.iter().map(|named| named.name.as_str())
    }

    /// Perceives by all of them.
    ///
    /// # Errors
    /// The first that fails, with its name.
    pub fn perceive(&mut self, scene: &dyn Scene, who: EntityId) -> Result<(), ObserveError> {
        for named in &mut self.senses {
            named.sense.perceive(scene, who).map_err(|error| match error {
                ObserveError::Missing { .. } => error,
                other => ObserveError::Sensor(format!("{}: {other}", named.name)),
            })?;
        }
        Ok(())
    }

    /// Has all of them take down what happened in the last step.
    pub fn notice(&mut self, events: &[Event], who: EntityId) {
        for named in &mut self.senses {
            named.sense.notice(events, who);
        }
    }

    /// Sets the words of a name, such as the state of a task.
    pub fn tell(&mut self, name: &str, words: String) {
        let senses = std::mem::take(self);
        *self = match senses.senses.iter().find(|named| named.name == name).map(|named| named.weight) {
            Some(weight) => senses.with_sense(name, weight, Words(words)),
            None => senses.with_sense(name, 1.0, Words(words)),
        };
    }

    /// Forgets what is told only once: feedback, after it went into a prompt.
    pub fn told(&mut self) {
        self.senses.iter_mut().for_each(|named| named.sense.told());
    }

    /// The observations that are values, by name.
    pub fn values(&self) -> BTreeMap<String, SpaceValue> {
        let value = |named: &Named| Some((named.name.clone(), named.sense.perceived().value()?));
        self.senses.iter().filter_map(value).collect()
    }

    /// What each of them has taken down and not told yet.
    pub fn save(&self) -> Vec<Vec<u8>> {
        self.senses.iter().map(|named| named.sense.save()).collect()
    }

    /// Takes up what [`save`](Self::save) gave; false if it was of other senses.
    pub fn restore(&mut self, saved: &[Vec<u8>]) -> bool {
        saved.len() == self.senses.len()
            && self.senses.iter_mut().zip(saved).all(|(named, saved)| named.sense.restore(saved))
    }

    /// All of it in words, of at most that many tokens as [`tokens_in`] counts them, each sense under its name. What one needs
    /// not of its share the others have; a sense that has nothing to say is left out.
    pub fn prompt(&self, tokens: usize) -> String {
        let whole: Vec<String> = self.senses.iter().map(|named| section(named, usize::MAX)).collect();
        let needs: Vec<usize> = whole.iter().map(|text| tokens_in(text)).collect();
        let shares =
            shares(&needs, &self.senses.iter().map(|named| named.weight).collect::<Vec<_>>(), tokens);
        let mut prompt = String::new();
        for (((named, whole), need), share) in self.senses.iter().zip(whole).zip(needs).zip(shares) {
            let text = if need <= share { whole } else { section(named, share) };
            prompt.push_str(&text);
        }
        prompt
    }
}

/// A sense's lines under its name, of at most that many tokens; nothing if there are none.
fn section(named: &Named, tokens: usize) -> String {
    let head = format!("[{}]\n", named.name);
    let Some(left) = tokens.checked_sub(tokens_in(&head)) else { return String::new() };
    let mut text = named.sense.perceived().describe(left);
    if !text.is_empty() && !text.ends_with('\n') {
        text.push('\n');
    }
    let text = lines_within(&text, left);
    if text.is_empty() { text } else { head + &text }
}

/// What each gets of a budget: what it needs, or else its share by weight of what those leave over who need less.
fn shares(needs: &[usize], weights: &[f64], budget: usize) -> Vec<usize> {
    let mut shares = vec![0; needs.len()];
    let mut open: Vec<usize> = (0..needs.len()).collect();
    let mut left = budget;
    loop {
        let total: f64 = open.iter().map(|index| weights[*index]).sum();
        let share = |index: usize| (left as f64 * weights[index] / total) as usize;
        let (content, hungry): (Vec<usize>, Vec<usize>) =
            open.iter().copied().partition(|index| needs[*index] <= share(*index));
        if content.is_empty() {
            for index in hungry {
                shares[index] = share(index);
            }
            return shares;
        }
        for index in content {
            shares[index] = needs[index];
            left -= needs[index];
        }
        open = hungry;
    }
}

/// The first lines of a text, as many as fit.
fn lines_within(text: &str, tokens: usize) -> String {
    let mut kept = String::new();
    for line in text.split_inclusive('\n') {
        let length = kept.len();
        kept.push_str(line);
        if tokens_in(&kept) > tokens {
            kept.truncate(length);
            break;
        }
    }
    kept
}
