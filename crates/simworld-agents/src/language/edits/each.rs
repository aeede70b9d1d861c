//! Edits of several at once: one at each of several things, on either side of one, one for each, as many more as there are.

use simworld_core::geometry::heading;
use simworld_core::id::{EntityId, RoadId};
use simworld_core::scene::{EntityKind, Relation};

use super::super::clause::{Choice, Count, Reference, Stands, Target};
use super::resolve::{Finder, plural};
use super::wish::{Anchor, NewThing, Where, Wish};
use crate::editing::{Edit, EditError, Stand};

impl Finder<'_> {
    /// "A lamp on either side of the door": one on its left, one on its right, or half of them.
    pub(super) fn at_two_sides(
        &self,
        things: &[NewThing],
        at: &[Where],
    ) -> Result<Option<Vec<Edit>>, EditError> {
        if let ([thing], [Where::Ends(roads, name)]) = (things, at) {
            return self.at_two_ends(thing, roads, name).map(Some);
        }
        if let ([thing], [Where::BothSides(Anchor::Street(_, roads))]) = (things, at) {
            return self.at_two_kerbs(thing, roads);
        }
        let ([thing], [Where::BothSides(anchor @ (Anchor::Thing(_) | Anchor::It))]) = (things, at) else {
            return Ok(None);
        };
        let is_area =
            self.scene.entity(self.anchor(anchor, &[])?).is_some_and(|one| one.kind == EntityKind::Ground);
        if is_area || thing.count > 2 && thing.count % 2 == 1 {
            return Ok(None);
        }
        let thing = NewThing { count: thing.count.div_ceil(2), many: false, ..thing.clone() };
        let mut edits = Vec::new();
        for relation in [Relation::LeftOf, Relation::RightOf] {
            edits.extend(self.edits(&Wish::Add {
                things: vec![thing.clone()],
                at: vec![Where::To(relation, anchor.clone())],
            })?);
        }
        Ok(Some(edits))
    }

    /// "A bench on each side of Oak Street": one beyond either kerb.
    fn at_two_kerbs(&self, thing: &NewThing, roads: &[RoadId]) -> Result<Option<Vec<Edit>>, EditError> {
        let road = roads.first().and_then(|road| self.scene.roads()?.roads.get(road.index()));
        let ends = road.and_then(|road| Some((*road.centerline.first()?, *road.centerline.last()?)));
        let Some((from, to)) = ends.filter(|_| thing.count <= 2 && !thing.many) else { return Ok(None) };
        let aside = heading(&(to - from)) + std::f64::consts::FRAC_PI_2;
        let make = self.made(thing)?;
        let side = |heading: f64| {
            let stands = vec![
                Stand::AlongRoad { roads: roads.to_vec() },
                Stand::OnSide { roads: roads.to_vec(), heading },
            ];
            Edit::Add { make: make.clone(), count: 1, stands }
        };
        Ok(Some(vec![side(aside), side(aside + std::f64::consts::PI)]))
    }

    /// The new things that "them" stands for, where several were made.
    pub(super) fn made_as(&self, reference: &Reference) -> Option<&[EntityId]> {
        let made = self.focus.made.as_slice();
        let are_there = made.iter().all(|id| self.scene.entity(*id).is_some());
        (reference.target == Target::Them && made.len() > 1 && are_there).then_some(made)
    }

    /// "A tree in front of each house": the same for every one of them.
    pub(super) fn at_each(&self, things: &[NewThing], at: &[Where]) -> Result<Option<Vec<Edit>>, EditError> {
        let is_each = |place: &Where| match place.anchor() {
            Some(Anchor::Thing(anchor)) => {
                let several = anchor.count == Count::All && anchor.choice == Choice::Open;
                several
                    && !matches!(place, Where::Between(..))
                    && (anchor.target != Target::Them || self.made_as(&anchor).is_some())
            }
            _ => false,
        };
        let [place] = at else { return Ok(None) };
        let Some(Anchor::Thing(anchor)) = place.anchor().filter(|_| is_each(place)) else { return Ok(None) };
        let mut edits = Vec::new();
        let all = self.made_as(&anchor).map(<[EntityId]>::to_vec);
        for id in all.map_or_else(|| self.candidates(&anchor), Ok)? {
            let mut place = place.clone();
            if let Some(anchor) = place.anchor_mut() {
                *anchor = Anchor::Thing(Reference::to(Target::Id(id), id.to_string()));
            }
            // "Cones behind the cars": one behind each of them.
            let one = |thing: &NewThing| NewThing {
                many: thing.many && matches!(place, Where::Around(_) | Where::Along(_)),
                ..thing.clone()
            };
            let things = things.iter().map(one).collect();
            edits.extend(self.edits(&Wish::Add { things, at: vec![place] })?);
        }
        Ok(Some(edits))
    }

    /// One thing for another; one for each of several, if it is said so.
    pub(super) fn replaced(&self, what: &Reference, with: &NewThing) -> Result<Vec<Edit>, EditError> {
        let each = what.count == Count::All;
        let things =
            if with.many && plural(what) || each { self.candidates(what)? } else { vec![self.one(what)?] };
        let make = self.made(with)?;
        let mut edits = Vec::new();
        for thing in things {
            let stands = vec![Stand::At { point: self.entity(thing, what)?.planar() }];
            edits.push(Edit::Remove { things: vec![thing] });
            edits.push(Edit::Add { make: make.clone(), count: with.count, stands });
        }
        Ok(edits)
    }

    /// As many more as there are, in the relation that is said of them, or near each.
    pub(super) fn multiplied(&self, what: &Reference, times: u32) -> Result<Vec<Edit>, EditError> {
        let things = self.candidates(what)?;
        let stand = match &what.relation {
            Some(Stands::OnStreet(roads)) => Some(Stand::AlongRoad { roads: roads.clone() }),
            Some(Stands::To(relation, anchor)) => {
                Some(Stand::To { relation: *relation, anchor: self.one(anchor)? })
            }
            _ => None,
        };
        let more = |thing: EntityId| {
            let near = Stand::To { relation: Relation::Near, anchor: thing };
            Edit::Copy {
                thing,
                count: times.saturating_sub(1).max(1),
                stands: vec![stand.clone().unwrap_or(near)],
            }
        };
        Ok(things.into_iter().map(more).collect())
    }
}
