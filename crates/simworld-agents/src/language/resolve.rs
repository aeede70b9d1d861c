//! References to entities: what a phrase means in a scene, seen from somewhere.

use std::ops::ControlFlow;

use simworld_core::geometry::{Aabb, Point2, Vector2, direction, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, Role, Scene};
use simworld_core::seam::PlanError;

use super::clause::{Choice, Count, Measure, Reference, Side, Target};
use super::paint::Paint;
use super::streets::StreetNames;
use super::{AmbiguityPolicy, RANGE};
use crate::editing::called;

/// How far one looks first, m; then farther and farther, until enough is found.
const FIRST_LOOK: f64 = 30.0;
/// Things so much farther away than the nearest are not meant by "the bench" when it could be either, m.
const EITHER: f64 = 75.0;
/// From here on a class is looked for in the scene's index, m.
pub(super) const FAR_LOOK: f64 = 400.0;
/// "All the chairs" are those within, m.
const ALL_WITHIN: f64 = 50.0;

/// What the thing is wanted for: it rules out what is in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// Nothing in particular.
    Any,
    /// To sit on it.
    Seat,
    /// To take it.
    Item,
}

/// A scene as the agent sees it from where it will be at this point of the plan.
#[derive(Clone)]
pub(super) struct View<'a> {
    pub(super) scene: &'a dyn Scene,
    pub(super) who: EntityId,
    pub(super) from: Point2,
    /// Where the sentence was said.
    pub(super) origin: Point2,
    /// Which way one looks, radians from east.
    pub(super) heading: f64,
    /// How far one looks, m.
    pub(super) range: f64,
    /// What "it" stands for.
    pub(super) it: Option<EntityId>,
    /// What of that can be taken up: "they wait for the letter at the museum, bring it there".
    pub(super) item: Option<EntityId>,
    /// Who "him", "her" and "them" stand for.
    pub(super) them: Option<EntityId>,
    /// What one has given away or put down by then: where it is, it is not taken from again.
    pub(super) gone: Vec<EntityId>,
    /// Who says it, if that is known.
    pub(super) speaker: Option<EntityId>,
    /// What to do if several things fit.
    pub(super) policy: AmbiguityPolicy,
    /// The names of streets, where the scene is spoken of and not what somebody is to do in it.
    pub(super) streets: Option<&'a StreetNames>,
    /// Whether of things that are named with an "or" one is taken later.
    pub(super) any_of: bool,
    /// What is near, as answers say it: it is looked for once from each place.
    pub(super) told: std::cell::OnceCell<String>,
}

/// Whether goods of that name are sold there.
pub(super) fn sells(entity: &EntityRef<'_>, goods: &str) -> bool {
    let sold = entity.info.attributes.get(simworld_core::scene::SELLS);
    matches!(sold, Some(simworld_core::value::Value::Text(sold)) if sold.split(',').any(|one| one.trim() == goods))
}

/// A thing that fits, with the figure by which to choose; less is better.
pub(super) type Ranked = (f64, EntityId);

impl<'a> View<'a> {
    /// As the agent stands when the sentence is said.
    pub(super) fn new(scene: &'a dyn Scene, me: &EntityRef<'_>, policy: AmbiguityPolicy) -> Self {
        let from = me.planar();
        Self {
            scene,
            who: me.id,
            from,
            origin: from,
            heading: yaw_of(me.pose),
            range: RANGE,
            it: None,
            item: None,
            them: None,
            gone: Vec::new(),
            speaker: None,
            policy,
            told: std::cell::OnceCell::new(),
            streets: None,
            any_of: false,
        }
    }

    /// The entity that a phrase means.
    pub(super) fn find(&self, reference: &Reference, purpose: Purpose) -> Result<EntityRef<'a>, PlanError> {
        let mut candidates = self.candidates(reference, purpose)?;
        if candidates.is_empty() && !self.gone.is_empty() {
            // Nothing else is left to take up.
            candidates = Self { gone: Vec::new(), ..self.clone() }.candidates(reference, purpose)?;
        }
        let Some(best) = candidates.first() else { return Err(self.not_found(reference, purpose)) };
        self.check_choice(reference, &candidates)?;
        let chosen = match self.policy {
            AmbiguityPolicy::First if reference.choice == Choice::Open && reference.relation.is_none() => {
                candidates.iter().map(|(_, id)| *id).min().unwrap_or(best.1)
            }
            _ => best.1,
        };
        self.scene.entity(chosen).ok_or_else(|| self.not_found(reference, purpose))
    }

    /// All that a phrase in the plural means, the nearest first.
    pub(super) fn find_all(
        &self,
        reference: &Reference,
        purpose: Purpose,
    ) -> Result<Vec<EntityId>, PlanError> {
        let mut found: Vec<EntityId> =
            self.candidates(reference, purpose)?.into_iter().map(|(_, id)| id).collect();
        match reference.count {
            Count::Exactly(count) if found.len() < count as usize => {
                let near = format!("there are only {}: {}", found.len(), self.surroundings());
                return Err(PlanError::NotFound { wanted: reference.text.clone(), near });
            }
            Count::Exactly(count) => found.truncate(count as usize),
            Count::All if found.is_empty() => return Err(self.not_found(reference, purpose)),
            Count::All => {}
            Count::One => found.truncate(1),
        }
        Ok(found)
    }

    /// Asks back, if the policy is to ask and the words leave open which.
    fn check_choice(&self, reference: &Reference, candidates: &[Ranked]) -> Result<(), PlanError> {
        let [best, second, ..] = candidates else { return Ok(()) };
        let open = match reference.choice {
            // A superlative without a single best is open under every policy.
            Choice::Most(..) | Choice::Compass(_) | Choice::Side(_) => same(best.0, second.0),
            _ if self.policy != AmbiguityPolicy::Ask || reference.indefinite => false,
            Choice::Open if Self::is_plain(reference) => second.0 <= best.0 + EITHER,
            // "The chair beside the table", where two stand as near to it.
            Choice::Open => {
                matches!(&reference.relation, Some(super::clause::Stands::To(..))) && same(best.0, second.0)
            }
            Choice::Nearest => same(best.0, second.0),
            _ => false,
        };
        if !open {
            return Ok(());
        }
        let reach = match reference.choice {
            Choice::Open if Self::is_plain(reference) => best.0 + EITHER,
            _ => best.0 + best.0.abs() * 0.01,
        };
        let meant = candidates.iter().take_while(|(rank, _)| *rank <= reach);
        let label = |(_, id): &Ranked| {
            let entity = self.scene.entity(*id)?;
            Some((*id, format!("{} at {:.0} m", called(self.scene, &entity), self.distance(&entity))))
        };
        let candidates = meant.filter_map(label).collect();
        Err(PlanError::Ambiguous { wanted: reference.text.clone(), candidates })
    }

    /// Whether the phrase names a class or a name, and not this very thing.
    fn is_plain(reference: &Reference) -> bool {
        let side = matches!(reference.relation, None | Some(super::clause::Stands::Side(_)));
        side && matches!(reference.target, Target::Any(_) | Target::Named(_))
    }

    /// All that a phrase may mean, the best first.
    pub(super) fn candidates(
        &self,
        reference: &Reference,
        purpose: Purpose,
    ) -> Result<Vec<Ranked>, PlanError> {
        let mut found = match &reference.relation {
            Some(relation) => self.related(reference, relation, purpose)?,
            None => self.plain(reference, purpose)?,
        };
        if let Some(except) = reference.except.as_ref().filter(|_| self.streets.is_none()) {
            let spared = self.candidates(except, Purpose::Any)?;
            let one = except.count == Count::One;
            let spared = if one { &spared[..spared.len().min(1)] } else { &spared[..] };
            found.retain(|(_, id)| spared.iter().all(|(_, other)| other != id));
        }
        self.leave_others_out(reference, &mut found);
        match reference.choice {
            Choice::Farthest => found.reverse(),
            Choice::Nth(nth) => {
                found = found.get(nth.saturating_sub(1) as usize).copied().into_iter().collect();
            }
            Choice::Most(measure, most) => self.rank_by(&mut found, measure, most),
            Choice::Compass(compass) => self.rank_along(&mut found, compass.step()),
            Choice::Side(side) => self.rank_along(&mut found, self.step_to(side)),
            Choice::Middle => self.middle_of(&mut found),
            Choice::Open | Choice::Nearest => {}
        }
        found.drain(..found.len().min(reference.place.saturating_sub(1) as usize));
        Ok(found)
    }

    /// A step of a metre to a side of the agent.
    fn step_to(&self, side: Side) -> Vector2 {
        let ahead = direction(self.heading);
        match side {
            Side::Left => Vector2::new(-ahead.y, ahead.x),
            Side::Right => Vector2::new(ahead.y, -ahead.x),
            Side::Ahead => ahead,
            Side::Behind => -ahead,
        }
    }

    /// The one in the middle of a row; none of an even number.
    fn middle_of(&self, found: &mut Vec<Ranked>) {
        let place = |id: EntityId| self.scene.entity(id).map(|entity| entity.planar());
        let ends = found.iter().filter_map(|(_, id)| place(*id)).collect::<Vec<_>>();
        let apart = |a: &Point2| ends.iter().map(|b| (a - b).norm()).fold(0.0, f64::max);
        let Some(end) = ends.iter().max_by(|a, b| apart(a).total_cmp(&apart(b))).copied() else { return };
        for (rank, id) in found.iter_mut() {
            *rank = place(*id).map_or(f64::INFINITY, |at| (at - end).norm());
        }
        sort(found);
        let middle = if found.len() % 2 == 1 { found.get(found.len() / 2).copied() } else { None };
        *found = middle.into_iter().collect();
    }

    /// The most of a measure first; what has none comes last.
    fn rank_by(&self, found: &mut [Ranked], measure: Measure, most: bool) {
        for (rank, id) in found.iter_mut() {
            let Some(entity) = self.scene.entity(*id) else { continue };
            let value = measured(&entity, measure);
            *rank = if most { -value } else { value };
        }
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    }

    /// The farthest in a direction first.
    fn rank_along(&self, found: &mut [Ranked], step: Vector2) {
        for (rank, id) in found.iter_mut() {
            let Some(entity) = self.scene.entity(*id) else { continue };
            // To the centimetre, so that things in a row stand level.
            *rank = -((entity.planar() - self.origin).dot(&step) * 100.0).round() * 0.01;
        }
        sort(found);
    }

    /// Without regard to relations, the nearest first.
    pub(super) fn plain(&self, reference: &Reference, purpose: Purpose) -> Result<Vec<Ranked>, PlanError> {
        match &reference.target {
            // What is named outright is meant, in use or not.
            Target::Id(id) => Ok(self.scene.entity(*id).map(|entity| (0.0, entity.id)).into_iter().collect()),
            Target::It if purpose == Purpose::Item => {
                let taken = self.it.filter(|id| self.scene.entity(*id).is_some_and(|it| is_item(it.kind)));
                Self::spoken_of(taken.or(self.item).or(self.it).or(self.them), reference)
            }
            Target::It => Self::spoken_of(self.it.or(self.them), reference),
            Target::Them => Self::spoken_of(self.them, reference),
            Target::There | Target::Here | Target::Point { .. } => {
                let near = "a place was given where a thing is needed".to_owned();
                Err(PlanError::NotFound { wanted: format!("thing {:?}", reference.text), near })
            }
            Target::Any(_) => Ok(self.of_class(reference, purpose)),
            Target::Named(ids) => {
                let known = ids.iter().filter_map(|id| self.scene.entity(*id));
                let fits = known.filter(|entity| self.fits(entity, reference, purpose));
                let mut found: Vec<Ranked> = fits.map(|entity| (self.distance(&entity), entity.id)).collect();
                sort(&mut found);
                Ok(found)
            }
        }
    }

    /// Things of a class, looked for in ever wider circles until there are enough.
    fn of_class(&self, reference: &Reference, purpose: Purpose) -> Vec<Ranked> {
        let spared = usize::from(reference.except.is_some());
        let (enough, first) = match (reference.choice, reference.count) {
            // Of those about, and not of all in the city.
            (_, Count::All) | (Choice::Side(_) | Choice::Middle, _) => (usize::MAX, ALL_WITHIN),
            (Choice::Farthest | Choice::Most(..) | Choice::Compass(_), _) => (usize::MAX, self.range),
            (Choice::Nth(nth), _) => (nth as usize + spared, FIRST_LOOK),
            (_, Count::Exactly(count)) => (count as usize + spared, FIRST_LOOK),
            _ => (1 + spared, FIRST_LOOK),
        };
        let mut reach = first.min(self.range);
        loop {
            let found = self.within(reach, reference, purpose);
            let about = reach >= ALL_WITHIN
                && !found.is_empty()
                && matches!(reference.choice, Choice::Side(_) | Choice::Middle);
            if found.len() >= enough || reach >= self.range || reference.count == Count::All || about {
                let asks = self.policy == AmbiguityPolicy::Ask && reference.choice == Choice::Open;
                let wider =
                    found.first().map(|nearest| nearest.0 + EITHER).filter(|wider| asks && *wider > reach);
                return wider.map_or(found, |wider| self.within(wider, reference, purpose));
            }
            // Where a few are enough one looks no farther than needed: what is looked at goes by the square.
            let factor = if enough == usize::MAX { 3.0 } else { 2.0 };
            reach = (reach * factor).min(self.range);
            if enough != usize::MAX && reach < FAR_LOOK && reach > 2.0 * FIRST_LOOK && self.are_few(reference)
            {
                reach = self.range;
            }
        }
    }

    /// Whether there are so few of a class that all of them are looked at sooner than all that stands about.
    fn are_few(&self, reference: &Reference) -> bool {
        const FEW: usize = 200;
        let (Target::Any(class), Some(index)) = (&reference.target, self.scene.classes()) else {
            return false;
        };
        let of_kinds = class.kinds().iter().flat_map(|kind| index.of_kind(*kind));
        let of_place = class.place().into_iter().flat_map(|place| index.of_place(place));
        !class.is_area() && of_kinds.chain(of_place).take(FEW).count() < FEW
    }

    fn within(&self, reach: f64, reference: &Reference, purpose: Purpose) -> Vec<Ranked> {
        let mut found = Vec::new();
        if reach >= FAR_LOOK && self.of_index(reference, reach, purpose, &mut found) {
            sort(&mut found);
            return found;
        }
        let _ = self.scene.visit(&Aabb::column_around(self.from, reach), &mut |entity| {
            if self.fits(&entity, reference, purpose) {
                let distance = self.distance(&entity);
                if distance <= reach {
                    found.push((distance, entity.id));
                }
            }
            ControlFlow::Continue(())
        });
        sort(&mut found);
        found
    }

    /// Adds those of a class within reach by the scene's index, if it keeps one; the work is that of the class and not of the city.
    pub(super) fn of_index(
        &self,
        reference: &Reference,
        reach: f64,
        purpose: Purpose,
        found: &mut Vec<Ranked>,
    ) -> bool {
        let (Target::Any(class), Some(index)) = (&reference.target, self.scene.classes()) else {
            return false;
        };
        if class.is_area() {
            return false;
        }
        let mut consider = |id: EntityId| {
            let Some(entity) = self.scene.entity(id).filter(|entity| self.fits(entity, reference, purpose))
            else {
                return;
            };
            let distance = self.distance(&entity);
            if distance <= reach {
                found.push((distance, id));
            }
        };
        class.kinds().iter().for_each(|kind| index.of_kind(*kind).for_each(&mut consider));
        class.place().into_iter().for_each(|place| index.of_place(place).for_each(&mut consider));
        true
    }

    fn spoken_of(who: Option<EntityId>, reference: &Reference) -> Result<Vec<Ranked>, PlanError> {
        who.map(|id| vec![(0.0, id)]).ok_or_else(|| PlanError::NotFound {
            wanted: format!("thing that {:?} could stand for", reference.text),
            near: "name it first, in the same sentence".to_owned(),
        })
    }

    /// Whether an entity is of the class that a phrase names, is as it says, and can be used.
    pub(super) fn fits(&self, entity: &EntityRef<'_>, reference: &Reference, purpose: Purpose) -> bool {
        let wanted = match &reference.target {
            Target::Any(category) => category.holds(entity),
            Target::Named(ids) => ids.contains(&entity.id),
            Target::Id(id) => entity.id == *id,
            _ => true,
        };
        let traits = &reference.traits;
        wanted
            && entity.id != self.who
            && traits.sort.as_ref().is_none_or(|sort| self.is_made_of(entity, sort))
            && !(traits.other && (self.it == Some(entity.id) || self.them == Some(entity.id)))
            && traits.paint.is_none_or(|paint| entity.info.color.map(Paint::of) == Some(paint))
            && (traits.unlike.is_empty()
                || entity.info.color.is_none_or(|color| !traits.unlike.contains(&Paint::of(color))))
            && traits.state.is_none_or(|(key, set)| {
                entity.info.attributes.get(key).is_some_and(|value| *value == true.into()) == set
            })
            && traits.sells.as_ref().is_none_or(|goods| sells(entity, goods))
            && traits.than.is_none_or(|(measure, more, limit)| {
                let value = measured(entity, measure);
                if more { value > limit } else { value < limit }
            })
            && (!traits.parked || entity.info.attributes.get("parked") == Some(&true.into()))
            && (!traits.free || self.is_free(entity, Purpose::Seat) && self.is_free(entity, Purpose::Item))
            && self.is_free(entity, purpose)
            && !(purpose == Purpose::Item && self.gone.contains(&entity.id))
    }

    fn is_made_of(&self, entity: &EntityRef<'_>, asset: &str) -> bool {
        let known = || self.scene.assets()?.get(entity.info.asset?);
        known().is_some_and(|known| known.name == asset || known.has_address() && known.is_called(asset))
    }

    pub(super) fn distance(&self, entity: &EntityRef<'_>) -> f64 {
        entity.info.shape.planar_distance(entity.pose, &self.from)
    }

    fn is_free(&self, entity: &EntityRef<'_>, purpose: Purpose) -> bool {
        match purpose {
            Purpose::Any => true,
            Purpose::Seat => self.scene.attached(entity.id, Role::Seated).is_none_or(|by| by == self.who),
            Purpose::Item => entity.attachment.is_none_or(|bond| bond.parent == self.who),
        }
    }

    /// The answer when nothing fits: whether all are in use, and what there is instead.
    pub(super) fn not_found(&self, reference: &Reference, purpose: Purpose) -> PlanError {
        let in_use = purpose != Purpose::Any
            && self.candidates(reference, Purpose::Any).is_ok_and(|candidates| !candidates.is_empty());
        let near = if in_use { "all that there are in use".to_owned() } else { self.surroundings() };
        let wanted = if in_use { format!("free {}", reference.text) } else { reference.text.clone() };
        PlanError::NotFound { wanted, near }
    }

    /// What is near, with distances, for answers.
    pub(super) fn surroundings(&self) -> String {
        self.told.get_or_init(|| self.look_around()).clone()
    }

    fn look_around(&self) -> String {
        /// How far, m, and how many things are listed.
        const NEAR: f64 = 100.0;
        const MOST: usize = 4;
        let mut found: Vec<Ranked> = Vec::new();
        let reach = NEAR.min(self.range);
        let _ = self.scene.visit(&Aabb::column_around(self.from, reach), &mut |entity| {
            let distance = self.distance(&entity);
            if entity.id != self.who && !is_surface(entity.kind) && distance <= reach {
                found.push((distance, entity.id));
            }
            ControlFlow::Continue(())
        });
        sort(&mut found);
        let mut listed: Vec<String> = Vec::new();
        for (distance, id) in found {
            let Some(entity) = self.scene.entity(id) else { continue };
            let label = called(self.scene, &entity);
            if !listed.iter().any(|other| other.starts_with(&format!("{label} "))) {
                listed.push(format!("{label} {id} at {distance:.0} m"));
            }
            if listed.len() == MOST {
                break;
            }
        }
        if listed.is_empty() {
            format!("nothing stands within {reach:.0} m")
        } else {
            format!("near are {}", listed.join(", "))
        }
    }
}

/// So much of a measure, in m, m³ and kg.
fn measured(entity: &EntityRef<'_>, measure: Measure) -> f64 {
    let size = entity.info.shape.size();
    match measure {
        Measure::Height => size.z,
        Measure::Volume => size.x * size.y * size.z,
        Measure::Mass => entity.info.mass.unwrap_or(0.0),
    }
}

/// Nearest first; of two at the same distance the lower id.
pub(super) fn sort(found: &mut [Ranked]) {
    found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
}

/// Whether two figures differ by less than people see, 1 %.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= a.abs() * 0.01
}

/// Whether one takes it up and carries it.
pub(super) const fn is_item(kind: EntityKind) -> bool {
    matches!(kind, EntityKind::Parcel | EntityKind::Prop | EntityKind::Cone | EntityKind::Chair)
}

const fn is_surface(kind: EntityKind) -> bool {
    matches!(kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk)
}
