//! Places to relations: where what is told of stands in the scene as it is by then.

use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Relation};

use super::resolve::Finder;
use super::wish::{Anchor, Where};
use crate::editing::{EditError, Stand};

impl Finder<'_> {
    pub(super) fn stands(&self, at: &[Where], moved: &[EntityId]) -> Result<Vec<Stand>, EditError> {
        let mut stands = Vec::new();
        for place in at {
            let stand = match place {
                Where::To(relation, anchor) => match anchor {
                    Anchor::Street(name, _) if matches!(relation, Relation::LeftOf | Relation::RightOf) => {
                        let what = format!("to tell the left of {name} from its right");
                        let why = "say its north, south, east or west side".to_owned();
                        return Err(EditError::Impossible { what, why });
                    }
                    Anchor::Street(name, _)
                        if matches!(relation, Relation::FarFrom | Relation::Behind | Relation::InFrontOf) =>
                    {
                        let what = format!("to stand so to {name}");
                        let why = "a street is long; say along it, or name a thing".to_owned();
                        return Err(EditError::Impossible { what, why });
                    }
                    Anchor::Street(_, roads) => Stand::AlongRoad { roads: roads.clone() },
                    _ => self.to(*relation, self.anchor(anchor, moved)?)?,
                },
                Where::Between(one, other) => match self.pair_made(one, other) {
                    Some([one, other]) => Stand::Between { one, other },
                    None => {
                        Stand::Between { one: self.anchor(one, moved)?, other: self.anchor(other, moved)? }
                    }
                },
                Where::Across(anchor) => Stand::AcrossFrom { anchor: self.anchor(anchor, moved)? },
                Where::Along(Anchor::Street(_, roads)) | Where::BothSides(Anchor::Street(_, roads)) => {
                    Stand::AlongRoad { roads: roads.clone() }
                }
                Where::Along(anchor) | Where::BothSides(anchor) => {
                    Stand::Along { anchor: self.anchor(anchor, moved)? }
                }
                Where::Corner(anchor) | Where::Corners(anchor) => {
                    Stand::AtCornerOf { anchor: self.anchor(anchor, moved)? }
                }
                Where::Compass(compass, Anchor::Street(_, roads)) => {
                    stands.push(Stand::AlongRoad { roads: roads.clone() });
                    Stand::OnSide { roads: roads.clone(), heading: compass.heading() }
                }
                Where::Compass(compass, anchor) => {
                    Stand::Towards { heading: compass.heading(), anchor: self.anchor(anchor, moved)? }
                }
                Where::At(point) => Stand::At { point: *point },
                Where::Here => Stand::Around { point: self.focus.from },
                Where::There => self.there(moved)?,
                Where::End(..) | Where::Ends(..) | Where::Part(..) => {
                    stands.extend(self.part(place, moved)?);
                    continue;
                }
                place if place.is_step() || *place == Where::Anywhere => continue,
                place => self.stand_on_ground(place, moved)?,
            };
            stands.push(stand);
        }
        Ok(stands)
    }

    /// "Between them", of two new things.
    fn pair_made(&self, one: &Anchor, other: &Anchor) -> Option<[EntityId; 2]> {
        let (Anchor::Thing(one), Anchor::Thing(_)) = (one, other) else { return None };
        self.made_as(one).filter(|_| other.is_it())?.try_into().ok()
    }

    /// Where what was spoken of last stood; beside it, if it still stands there.
    fn there(&self, moved: &[EntityId]) -> Result<Stand, EditError> {
        let wanted = "place that \"there\" could stand for".to_owned();
        let missing = || EditError::NotFound { wanted, near: "name it".to_owned() };
        let point = self.focus.place.ok_or_else(missing)?;
        let stands_there = |it: &EntityId| {
            let entity = self.scene.entity(*it).filter(|it| it.kind != EntityKind::Ground);
            !moved.contains(it) && entity.is_some_and(|it| (it.planar() - point).norm() < 1e-6)
        };
        Ok(match self.focus.it.filter(stands_there) {
            Some(anchor) => Stand::To { relation: Relation::NextTo, anchor },
            None => Stand::At { point },
        })
    }

    pub(super) fn to(&self, relation: Relation, anchor: EntityId) -> Result<Stand, EditError> {
        let kind = self.scene.entity(anchor).map(|entity| entity.kind);
        let impossible = |why: &str| {
            let what = format!("to stand {}", Stand::To { relation, anchor }.told(self.scene));
            Err(EditError::Impossible { what, why: why.to_owned() })
        };
        match (relation, kind) {
            // "On Market Square", "over the park": where else would one be on the ground.
            (Relation::OnTopOf | Relation::Inside, Some(EntityKind::Ground)) => {
                Ok(Stand::To { relation: Relation::Inside, anchor })
            }
            (Relation::Inside, Some(kind)) if kind.is_solid() => {
                impossible("it is solid; say next to it, or on top of it")
            }
            (Relation::OnTopOf, Some(kind)) if !crate::editing::has_flat_top(kind) => {
                impossible("it has no top that holds anything; say next to it")
            }
            _ => Ok(Stand::To { relation, anchor }),
        }
    }

    pub(super) fn anchor(&self, anchor: &Anchor, moved: &[EntityId]) -> Result<EntityId, EditError> {
        let itself = || {
            let what = "to put a thing beside or upon itself".to_owned();
            Err(EditError::Impossible { what, why: "name another thing".to_owned() })
        };
        match anchor {
            Anchor::Itself => itself(),
            Anchor::It => self.focus.it.filter(|it| !moved.contains(it)).ok_or_else(|| {
                let wanted = "thing that is meant".to_owned();
                EditError::NotFound { wanted, near: "name it".to_owned() }
            }),
            Anchor::Viewer => self.focus.who.ok_or_else(|| {
                let what = "to stand so to you".to_owned();
                EditError::Impossible {
                    what,
                    why: "nobody looks at the scene; name a thing or a place".to_owned(),
                }
            }),
            Anchor::Street(name, _) => Err(EditError::Impossible {
                what: format!("to stand so to {name}"),
                why: "a street is long; say along it".to_owned(),
            }),
            Anchor::Thing(reference) => {
                let found = self.one(reference)?;
                if moved.contains(&found) { itself() } else { Ok(found) }
            }
        }
    }
}
