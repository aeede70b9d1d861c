//! Wishes to edits: the things that words mean, looked for in the scene as it is by then.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, Vector2, direction, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Scene};
use simworld_core::seam::PlanError;

use super::super::clause::{Choice, Count, Reference, Stands, Target};
use super::super::compass::Compass;
use super::super::lexer::{Token, lex};
use super::super::lexicon::category;
use super::super::resolve::{Purpose, View};
use super::places::is_pronoun;
use super::settle::Settling;
use super::sky::changed;
use super::wish::{NewThing, Where, Wish};
use super::{Focus, Reading};
use crate::editing::{Edit, EditError, Stand, Stock};

/// The questions about what stands somewhere are answered so far around, m.
const ASKED_AROUND: f64 = 80.0;

impl Reading {
    /// New things that a stock has not: their words, and those from which one may be made.
    pub(crate) fn lacking(&self, stock: &Stock) -> Vec<(String, String)> {
        let things = self.wishes.iter().flatten().flat_map(|wish| match wish {
            Wish::Add { things, .. } => things.as_slice(),
            Wish::Replace { with: thing, .. } | Wish::Row { thing, .. } => std::slice::from_ref(thing),
            _ => &[],
        });
        let lacking = things.filter(|thing| matches!(thing.make(stock), Err(EditError::UnknownThing { .. })));
        lacking.map(|thing| (thing.text.clone(), thing.prompt().to_owned())).collect()
    }
}

pub(super) struct Finder<'a> {
    pub(super) scene: &'a dyn Scene,
    pub(super) stock: &'a Stock,
    pub(super) focus: &'a Focus,
    pub(super) view: View<'a>,
    /// What takes one of several that fit; without it, which is asked.
    pub(super) settling: Option<&'a Settling>,
}

impl Finder<'_> {
    pub(super) fn edits(&self, wish: &Wish) -> Result<Vec<Edit>, EditError> {
        let edit = match wish {
            Wish::Add { things, at } => return self.added(things, at),
            Wish::Remove { what } => Edit::Remove { things: self.all(what)? },
            Wish::Move { what, at } => return self.moved(what, at),
            Wish::Replace { what, with } => return self.replaced(what, with),
            Wish::Rotate { what, angle } => Edit::Rotate { things: self.each_once(what)?, angle: *angle },
            Wish::Face { what, towards } => self.facing(what, towards)?,
            Wish::FaceCompass { what, compass } => return self.facing_compass(what, *compass),
            Wish::Swap { one, other } => self.swapped(one, other.as_ref())?,
            Wish::Paint { what, paint } => Edit::Paint { things: self.all(what)?, color: paint.color() },
            Wish::Resize { what, size } => return self.resized(what, size),
            Wish::Scale { what, factor } => Edit::Scale { things: self.each_once(what)?, factor: *factor },
            Wish::Copy { what, count, at } => {
                Edit::Copy { thing: self.one(what)?, count: *count, stands: self.stands(at, &[])? }
            }
            Wish::Multiply { what, times } => return self.multiplied(what, *times),
            Wish::Name { what, name } => Edit::Name { thing: self.one(what)?, name: name.clone() },
            Wish::Count { what } => self.counted(what)?,
            Wish::CountAll { what, text } => self.counted_together(what, text)?,
            Wish::List { what, at } => Edit::List { things: self.listed(what.as_ref(), at)? },
            Wish::Describe { what } => Edit::Describe { thing: self.one(what)? },
            Wish::Row { thing, line, spacing } => self.row(thing, line, *spacing)?,
            Wish::Passage { which, passage } => self.passage(which, *passage)?,
            Wish::Nothing { why } => Edit::Leave { why: why.clone() },
            Wish::PaintEach { what, paints } => return self.painted_each(what, paints),
            Wish::PaintLike { what, like } => self.painted_like(what, like)?,
            Wish::AskPassage { which } => self.passages_told(which)?,
            Wish::AskSky => self.sky_told(),
            Wish::AskDistance { one, other } => self.distance_told(one, other)?,
            Wish::When { sky, so, then } => return self.when(sky, *so, then),
            Wish::WhenPassage { which, closed, then } => return self.when_passage(which, *closed, then),
            Wish::WhenLarger { one, other, extent, larger, then } => {
                return self.when_larger((one, other), (*extent, *larger), then);
            }
            Wish::All(wishes) => return self.all_of(wishes),
            Wish::Given { what, least, there, then } => return self.given(what, (*least, *there), then),
            Wish::Sky(skies) => Edit::SetEnvironment(changed(*self.scene.environment(), skies)),
        };
        Ok(vec![edit])
    }

    fn facing(&self, what: &[Reference], towards: &Reference) -> Result<Edit, EditError> {
        let things = self.all(what)?;
        // "Get Rex to look at me": who speaks is looked at, and stays as they are.
        if let (Target::Here, Some(who)) = (&towards.target, self.focus.who) {
            return Ok(Edit::Face { things, towards: who });
        }
        let towards = self.one(towards)?;
        // "Move Fay next to Gus and make her face him": nobody faces themselves.
        let other = self.focus.beside.filter(|_| things == [towards]);
        Ok(Edit::Face { things, towards: other.unwrap_or(towards) })
    }

    fn facing_compass(&self, what: &[Reference], compass: Compass) -> Result<Vec<Edit>, EditError> {
        let turn = |thing: EntityId| {
            let now = self.scene.entity(thing).map_or(0.0, |entity| yaw_of(entity.pose));
            let angle = simworld_core::ops::wrap_angle(compass.heading() - now);
            Edit::Rotate { things: vec![thing], angle }
        };
        Ok(self.all(what)?.into_iter().map(turn).collect())
    }

    /// What is not there is none.
    fn counted(&self, what: &Reference) -> Result<Edit, EditError> {
        let things = match self.candidates(what) {
            Err(EditError::NotFound { .. }) => Vec::new(),
            found => found?,
        };
        Ok(Edit::Count { what: what.text.clone(), things })
    }

    fn counted_together(&self, what: &[Reference], text: &str) -> Result<Edit, EditError> {
        let mut things = Vec::new();
        for one in what {
            let all = Reference { count: Count::All, ..one.clone() };
            match self.candidates(&all) {
                Err(EditError::NotFound { .. }) => {}
                found => things.extend(found?),
            }
        }
        things.sort_unstable();
        things.dedup();
        Ok(Edit::Count { what: text.to_owned(), things })
    }

    pub(super) fn added(&self, things: &[NewThing], at: &[Where]) -> Result<Vec<Edit>, EditError> {
        if let Some(each) = self.at_each(things, at)? {
            return Ok(each);
        }
        if let ([thing], [Where::Corners(anchor)]) = (things, at)
            && thing.count == 1
        {
            let four = NewThing { count: 4, many: false, ..thing.clone() };
            return self.added(&[four], &[Where::Corner(anchor.clone())]);
        }
        if let Some(sides) = self.at_two_sides(things, at)? {
            return Ok(sides);
        }
        if let Some(row) = self.lined_up(things, at)? {
            return Ok(vec![row]);
        }
        let stands = self.stands(at, &[])?;
        let add = |thing: &NewThing| {
            let make = self.made(thing)?;
            // "Stairs" are one thing.
            let is_one = thing.words.last().is_some_and(|word| make.asset.ends_with(word.as_str()));
            let count = if thing.many && !is_one { super::ground::ROW } else { thing.count };
            Ok(Edit::Add { make, count, stands: stands.clone() })
        };
        things.iter().map(add).collect()
    }

    fn moved(&self, what: &[Reference], at: &[Where]) -> Result<Vec<Edit>, EditError> {
        let things = self.all(what)?;
        // "By 3 m to the west and by 2 m to the north" is one way.
        let shift = at.iter().filter_map(|place| match place {
            Where::Shift(east, north) => Some((*east, *north)),
            _ => None,
        });
        let shift = shift.reduce(|sum, more| (sum.0 + more.0, sum.1 + more.1));
        if let Some((east, north)) = shift {
            let shifted = |thing: EntityId| {
                let from = self.scene.entity(thing).map_or(Point2::origin(), |entity| entity.planar());
                let point = Point2::new(from.x + east, from.y + north);
                Edit::Move { things: vec![thing], stands: vec![Stand::At { point }] }
            };
            return Ok(things.into_iter().map(shifted).collect());
        }
        let own = at.iter().filter_map(|place| match place {
            Where::ShiftOwn(forward, left) => Some(Vector2::new(*forward, *left)),
            _ => None,
        });
        let own = own.reduce(|sum, more| sum + more);
        if let Some(own) = own {
            let shifted = |thing: EntityId| {
                let entity = self.scene.entity(thing)?;
                let ahead = direction(yaw_of(entity.pose));
                let point = entity.planar() + ahead * own.x + Vector2::new(-ahead.y, ahead.x) * own.y;
                Some(Edit::Move { things: vec![thing], stands: vec![Stand::At { point }] })
            };
            return Ok(things.into_iter().filter_map(shifted).collect());
        }
        if let Some(steps) = self.stepped(&things, at)? {
            return Ok(steps);
        }
        let stands = self.stands(at, &things)?;
        Ok(vec![Edit::Move { things, stands }])
    }

    fn swapped(&self, one: &Reference, other: Option<&Reference>) -> Result<Edit, EditError> {
        if let Some(other) = other {
            let (one, other) = (self.one(one)?, self.one(other)?);
            if one == other {
                let what = "to swap a thing with itself".to_owned();
                return Err(EditError::Impossible { what, why: "name two things".to_owned() });
            }
            return Ok(Edit::Swap { one, other });
        }
        let both = self.candidates(one)?;
        let both = if both.len() > 2 { self.some_of(one, &both, 2)? } else { both };
        match both[..] {
            [first, second] => Ok(Edit::Swap { one: first, other: second }),
            _ => Err(self.ambiguous(one, &both)),
        }
    }

    fn listed(&self, what: Option<&Reference>, at: &[Where]) -> Result<Vec<EntityId>, EditError> {
        if let Some(what) = what {
            let is_nearest = matches!(what.relation, Some(Stands::NearestTo(..)))
                || matches!(
                    what.choice,
                    Choice::Nearest
                        | Choice::Farthest
                        | Choice::Most(..)
                        | Choice::Compass(_)
                        | Choice::Side(_)
                );
            if is_nearest && (!plural(what) || is_of_several(what)) {
                return Ok(vec![self.one(&Reference { count: Count::One, ..what.clone() })?]);
            }
            return if what.count == Count::One && !plural(what) {
                Ok(vec![self.one(what)?])
            } else {
                self.candidates(what)
            };
        }
        let stands = self.stands(at, &[])?;
        let middle = stands.iter().find_map(|stand| match stand {
            Stand::Around { point } | Stand::At { point } => Some(*point),
            stand => self.scene.entity(stand.anchor()?).map(|entity| entity.planar()),
        });
        let middle = middle.unwrap_or(self.focus.from);
        let mut found: Vec<(f64, EntityId)> = Vec::new();
        let _ = self.scene.visit(&Aabb::column_around(middle, ASKED_AROUND), &mut |entity| {
            let flat = matches!(entity.kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk);
            if !flat
                && Some(entity.id) != self.focus.who
                && stands.iter().all(|stand| stand.holds(self.scene, entity.id))
            {
                found.push((entity.info.shape.planar_distance(entity.pose, &middle), entity.id));
            }
            ControlFlow::Continue(())
        });
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Ok(found.into_iter().map(|(_, id)| id).collect())
    }

    // ---- things ----

    pub(super) fn all(&self, what: &[Reference]) -> Result<Vec<EntityId>, EditError> {
        let mut things = Vec::new();
        for one in what {
            if let Some(made) = self.made_as(one) {
                things.extend_from_slice(made);
            } else if one.count == Count::One && (!plural(one) || is_of_several(one)) {
                things.push(self.one(one)?);
            } else {
                things.extend(self.candidates(one)?);
            }
        }
        Ok(things)
    }

    /// As [`Self::all`], each once: "the blue bench, yes, the blue one" is turned once.
    fn each_once(&self, what: &[Reference]) -> Result<Vec<EntityId>, EditError> {
        let mut things: Vec<EntityId> = Vec::new();
        for thing in self.all(what)? {
            if !things.contains(&thing) {
                things.push(thing);
            }
        }
        Ok(things)
    }

    /// All that a phrase may mean, the nearest first, at least one.
    pub(super) fn candidates(&self, reference: &Reference) -> Result<Vec<EntityId>, EditError> {
        self.is_about_viewer(reference)?;
        self.is_called_so(reference)?;
        if let (Count::All, Choice::Nth(nth)) = (reference.count, reference.choice) {
            return self.every_nth(reference, nth);
        }
        if reference.choice == Choice::Middle && reference.place <= 1 {
            return self.middle(reference);
        }
        let open = reference.choice == Choice::Open;
        // The farthest of all is looked for everywhere, and no other choice is.
        let choice = if open { Choice::Farthest } else { reference.choice };
        let count = if open { Count::One } else { reference.count };
        let mut found =
            self.view.candidates(&Reference { choice, count, ..reference.clone() }, Purpose::Any)?;
        if open {
            found.reverse();
        }
        let mut things: Vec<EntityId> = found.into_iter().map(|(_, id)| id).collect();
        if let Some(except) = &reference.except {
            // "But the tallest" is that one alone.
            let is_nearest = matches!(except.relation, Some(Stands::NearestTo(..)));
            let is_one = except.count == Count::One
                && (except.choice != Choice::Open || is_nearest && !plural(except));
            // "The trees along Oak Street except the smallest": of those the smallest.
            let of_those = Reference {
                relation: except.relation.clone().or_else(|| reference.relation.clone()),
                ..(**except).clone()
            };
            let except = if is_one && except.target == reference.target { &of_those } else { &**except };
            let spared = if is_one { vec![self.one(except)?] } else { self.candidates(except)? };
            things.retain(|thing| !spared.contains(thing));
        }
        // "The car by the shop": of cars not next to it, the only one near it.
        if things.is_empty()
            && let Some(Stands::To(simworld_core::scene::Relation::NextTo, anchor)) = &reference.relation
            && reference.text.contains(" by ")
        {
            let near = Stands::To(simworld_core::scene::Relation::Near, anchor.clone());
            let text = reference.text.replace(" by ", " near ");
            let around = self.candidates(&Reference { relation: Some(near), text, ..reference.clone() });
            things = around.ok().filter(|found| found.len() == 1).unwrap_or_default();
        }
        if things.is_empty() {
            return Err(self.view.find(reference, Purpose::Any).err().map_or_else(
                || EditError::NotFound { wanted: reference.text.clone(), near: String::new() },
                EditError::from,
            ));
        }
        if let Count::Exactly(count) = reference.count {
            if things.len() < count as usize {
                let near = format!("there are only {}", things.len());
                return Err(EditError::NotFound { wanted: reference.text.clone(), near });
            }
            if open
                && things.len() > count as usize
                && !reference.indefinite
                && reference.text.contains("the ")
            {
                return self.some_of(reference, &things, count as usize);
            }
            things.truncate(count as usize);
        }
        Ok(things)
    }

    /// The middle one of all that fit, in the order in which they stand.
    fn middle(&self, reference: &Reference) -> Result<Vec<EntityId>, EditError> {
        let all =
            self.in_a_row(&Reference { choice: Choice::Open, count: Count::All, ..reference.clone() })?;
        match all.len() % 2 {
            1 => Ok(vec![all[all.len() / 2]]),
            _ => self.one_of_the_middle(reference, &all),
        }
    }

    /// The one thing that a phrase means; where several fit and nothing decides, which is asked.
    pub(super) fn one(&self, reference: &Reference) -> Result<EntityId, EditError> {
        let mut found = self.candidates(reference)?;
        if found.len() > 1 && reference.text.to_lowercase().contains("park bench") {
            // Of several benches the one that is in a park.
            let in_park: Vec<EntityId> =
                found.iter().copied().filter(|thing| self.is_in_park(*thing)).collect();
            found = if in_park.is_empty() { found } else { in_park };
        }
        let decided = reference.choice != Choice::Open
            || reference.indefinite
            || is_pronoun(reference)
            || matches!(reference.relation, Some(Stands::NearestTo(..)))
            || matches!(reference.target, Target::Id(_));
        if decided && reference.choice != Choice::Middle {
            // A superlative that two share is open.
            let shared =
                self.view.find(&Reference { count: Count::One, ..reference.clone() }, Purpose::Any).err();
            if let Some(shared) = shared {
                return self.one_of_shared(reference, shared);
            }
        } else if found.len() > 1 {
            return Ok(self.some_of(reference, &found, 1)?[0]);
        }
        Ok(found[0])
    }

    fn is_about_viewer(&self, reference: &Reference) -> Result<(), EditError> {
        let me = ["me", "myself", "yourself", "you", "i"];
        if me.contains(&reference.text.trim().to_lowercase().as_str())
            || self.focus.who.is_some() && reference.target == self.focus.who.map_or(Target::Here, Target::Id)
        {
            let what = format!("to edit {:?}", reference.text);
            return Err(EditError::Impossible {
                what,
                why: "who speaks is no part of what is edited".to_owned(),
            });
        }
        Ok(())
    }

    /// "The maple" is no house of that name, and "the moon" no shop: such words name what they say, unless they are written as
    /// names are.
    fn is_called_so(&self, reference: &Reference) -> Result<(), EditError> {
        const ABOVE: &[&str] = &["moon", "sun", "sky", "star", "stars", "sea", "horizon", "cloud", "clouds"];
        let Target::Named(_) = &reference.target else { return Ok(()) };
        let text = reference.text.trim();
        let is_whole = [
            "campus",
            "the campus",
            "harbour",
            "the harbour",
            "the old town",
            "the quarter",
            "the town",
            "town",
        ];
        let is_common = is_whole.contains(&text.to_lowercase().as_str())
            || lex(text).first().is_some_and(|word| super::follow::species(word).is_some())
            || ABOVE.contains(&text);
        let is_word = !text.is_empty() && text.chars().all(char::is_lowercase);
        if !is_common || !is_word {
            return Ok(());
        }
        let found = self.view.candidates(reference, Purpose::Any).unwrap_or_default();
        let Some(entity) = found.first().and_then(|(_, id)| self.scene.entity(*id)) else { return Ok(()) };
        if !entity.label().eq_ignore_ascii_case(text) {
            return Err(EditError::NotFound {
                wanted: text.to_owned(),
                near: "nothing here is known to be one".to_owned(),
            });
        }
        Ok(())
    }

    pub(super) fn entity(&self, id: EntityId, what: &Reference) -> Result<EntityRef<'_>, EditError> {
        let missing = || EditError::NotFound { wanted: what.text.clone(), near: String::new() };
        self.scene.entity(id).ok_or_else(missing)
    }
}

/// "The tallest of the limes" is one of them.
fn is_of_several(what: &Reference) -> bool {
    let of = [" of the ", " of all ", " of these ", " of those "];
    what.choice != Choice::Open && of.iter().any(|of| what.text.contains(of))
}

/// Whether the noun is in the plural: "the trash bins".
pub(super) fn plural(reference: &Reference) -> bool {
    let Target::Any(class) = &reference.target else { return false };
    let lower = reference.text.to_lowercase().replace("'s", "").replace("’s", "");
    let head = lower.split([',', '.']).next().unwrap_or_default();
    let head = lex(head);
    // "The limes" are trees of that sort.
    let sort = reference.traits.sort.as_ref().and_then(|sort| sort.rsplit(['_', ' ']).next());
    let is_singular = |word: &str| {
        class.words.iter().any(|known| known.rsplit(' ').next() == Some(word)) || sort == Some(word)
    };
    let many = ["people", "everybody", "everyone", "men", "women", "kids"];
    let is_plural = |word: &str| {
        let stems = [word.strip_suffix("es"), word.strip_suffix('s')];
        let of_y = word.strip_suffix("ies").map(|stem| format!("{stem}y"));
        !is_singular(word)
            && (stems.into_iter().flatten().any(is_singular) || of_y.is_some_and(|word| is_singular(&word)))
            || many.contains(&word)
    };
    // The first noun of the class is what the phrase is about; what follows belongs to its relation.
    let said = |at: usize| match &head.get(at)?.token {
        Token::Word(word) => Some(word.as_str()),
        _ => None,
    };
    let last = |at: usize| {
        let words =
            category(&head[at..]).filter(|(own, _)| std::ptr::eq(*own, *class)).map_or(1, |found| found.1);
        said(at + words - 1).filter(|word| is_singular(word) || is_plural(word))
    };
    // "The white ones" behind chairs are all that are white.
    let are_ones = || (0..head.len()).any(|at| said(at) == Some("ones"));
    (0..head.len()).find_map(last).map_or_else(are_ones, is_plural)
}

impl From<PlanError> for EditError {
    fn from(error: PlanError) -> Self {
        match error {
            PlanError::NotUnderstood { words, fragment, hint } => {
                Self::NotUnderstood { words, fragment, hint }
            }
            PlanError::NotFound { wanted, near } => Self::NotFound { wanted, near },
            PlanError::Ambiguous { wanted, candidates } => Self::Ambiguous { wanted, candidates },
            other => Self::Impossible { what: "that".to_owned(), why: other.to_string() },
        }
    }
}
