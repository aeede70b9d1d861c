//! Orders to a plan: conditions, with what they are about found in the scene.

use simworld_core::scene::{EntityKind, EntityRef, OPEN};
use simworld_core::seam::{Condition, PlanError, Which};

use super::clause::{Choice, Clause, Reference, Target, Test};
use super::draft::Draft;
use super::lexicon::class;
use super::relate::PART;
use super::resolve::Purpose;
use super::tests_of::NEARBY;

/// "If the green bench is taken, use the red one": what is chosen in its place is sat on.
pub(super) fn taken_instead(test: &Test, mut then: Vec<Clause>) -> Vec<Clause> {
    let of_use =
        matches!(test, Test::InUse(_)) || matches!(test, Test::Not(test) if matches!(**test, Test::InUse(_)));
    if let [Clause::Take { what, to: None, .. } | Clause::Board { what, to: None }] = &then[..]
        && of_use
    {
        then = vec![Clause::Sit { on: Some(what.clone()) }];
    }
    then
}

impl Test {
    /// Whether it is about light, weather, doors or seats, and not about what one sees.
    pub(super) fn is_of_the_world(&self) -> bool {
        match self {
            Self::Raining | Self::Snowing | Self::Dark | Self::Open(_) | Self::InUse(_) => true,
            Self::Not(test) => test.is_of_the_world(),
            _ => false,
        }
    }
}

impl Draft<'_> {
    pub(super) fn condition(&mut self, test: &Test) -> Result<Condition, PlanError> {
        Ok(match test {
            Test::Light { light, shows } => {
                let nearest = Reference { indefinite: true, ..Reference::nearest(class("traffic light")) };
                let light = self.find(light.as_ref().unwrap_or(&nearest), Purpose::Any)?.id;
                Condition::Signal { light, shows: *shows }
            }
            Test::Sees(what) => Condition::Sees(self.which(what)?),
            Test::Near { what, within } => Condition::Near { what: self.which(what)?, within: *within },
            Test::There { what, .. } => {
                let which = self.which(what)?;
                Condition::FreeNear { what: which, within: NEARBY }
            }
            Test::InUse(what) => Condition::InUse(self.find(what, Purpose::Any)?.id),
            Test::Open(what) => {
                let mut door = self.find(what, Purpose::Any)?;
                // A house is open if its door is.
                if door.kind == EntityKind::Building && !door.info.attributes.contains_key(OPEN) {
                    let of_house = |at: &EntityRef<'_>| at.kind == EntityKind::Door;
                    let near = door.access().xy();
                    door = self.view.scene.nearest(near, PART, &of_house).unwrap_or(door);
                }
                if door.kind != EntityKind::Door && !door.info.attributes.contains_key(OPEN) {
                    let near = format!("a {} neither opens nor closes", door.kind);
                    return Err(PlanError::NotFound {
                        wanted: format!("{:?} that is open", what.text),
                        near,
                    });
                }
                Condition::Open(door.id)
            }
            Test::Holds(what) => match what {
                Some(what) => Condition::Holds(Some(self.find(what, Purpose::Any)?.id)),
                None => Condition::Holds(None),
            },
            Test::Together { one, other, within } => {
                let one = self.find(one, Purpose::Any)?.id;
                // "If Anna is near the bin, wave at her": the place is not what is spoken of.
                let (it, them) = (self.view.it, self.view.them);
                let other = self.find(other, Purpose::Any)?.id;
                if one != other && them.is_some() {
                    self.view.them = them;
                }
                self.view.it = it.or(self.view.it);
                self.lead_to(other);
                Condition::Together { one, other, within: *within }
            }
            Test::Seated => Condition::Seated,
            Test::Raining => Condition::Raining,
            Test::Snowing => Condition::Snowing,
            Test::Dark => Condition::Dark,
            Test::Never => Condition::Any(Vec::new()),
            Test::Elapsed(seconds) => Condition::Elapsed(*seconds),
            #[cfg(feature = "thought")]
            Test::Stated(condition) => condition.clone(),
            Test::Not(test) => Condition::Not(Box::new(self.condition(test)?)),
            Test::Both(one, other) => Condition::All(vec![self.condition(one)?, self.condition(other)?]),
            Test::Either(one, other) => Condition::Any(vec![self.condition(one)?, self.condition(other)?]),
        })
    }

    /// This thing, or any of its class if any will do; what is nearest by now is spoken of.
    fn which(&mut self, what: &Reference) -> Result<Which, PlanError> {
        let open = what.choice == Choice::Open && what.relation.is_none();
        let is_plain = what.traits.paint.is_none() && what.traits.sort.is_none();
        match &what.target {
            Target::Any(category) if what.indefinite && open && is_plain => {
                if let Ok(found) = self.view.find(what, Purpose::Any) {
                    self.mention(&found);
                }
                Ok(category.to_which())
            }
            _ => Ok(Which::Entity(self.find(what, Purpose::Any)?.id)),
        }
    }
}
