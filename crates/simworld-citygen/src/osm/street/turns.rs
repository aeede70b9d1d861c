//! Which turns are allowed: the arrows on lanes and the signs that forbid turns.
//!
//! Sources: <https://wiki.openstreetmap.org/wiki/Key:turn>, <https://wiki.openstreetmap.org/wiki/Relation:restriction>.
//! A sign names a turn by a word: it is kept as the word, at the end of the street where it stands, so that it stays
//! true when junctions are drawn together.

use std::collections::BTreeMap;

use simworld_core::net::{Turn, TurnSet};

use super::over;
use super::web::Web;
use crate::osm::error::{OsmId, Warning};
use crate::osm::place::Place;
use crate::osm::raw::{Relation, Role};
use crate::osm::tags::{Key, Tags};

/// Lanes of one direction at most, as in a profile.
const MOST_LANES: usize = 8;
/// All turns.
const ALL: [Turn; 4] = [Turn::Left, Turn::Straight, Turn::Right, Turn::UTurn];

/// The arrows on lanes that lead to a junction, from left to right; none are no arrows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Arrows {
    lanes: [TurnSet; MOST_LANES],
    count: u8,
}

/// What is said about the turns at one end of a street.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Turns {
    pub(super) arrows: Arrows,
    /// Turns that signs forbid; [`TurnSet::ANY`] for none.
    forbidden: TurnSet,
    /// The signs over ways that begin here, and those that lead here.
    over: [Marks; 2],
}

/// Numbers of signs over ways, from 1 on; 0 for none.
pub(super) type Marks = [u16; 2];

impl Arrows {
    /// Those of a value such as `left|through|through;right`.
    fn of(value: &str) -> Option<Self> {
        let mut arrows = Self::default();
        for lane in value.split('|') {
            *arrows.lanes.get_mut(usize::from(arrows.count))? = arrow(lane);
            arrows.count += 1;
        }
        (value.len() > 1 && arrows.lanes.iter().any(|lane| !lane.is_any())).then_some(arrows)
    }
}

/// The turns of one lane. A slight turn may be a bend that the junction takes as straight on.
fn arrow(lane: &str) -> TurnSet {
    let turns = lane.split(';').flat_map(|turn| match turn.trim() {
        "left" | "sharp_left" => &[Turn::Left][..],
        "slight_left" => &[Turn::Left, Turn::Straight],
        "right" | "sharp_right" => &[Turn::Right],
        "slight_right" => &[Turn::Right, Turn::Straight],
        "through" | "merge_to_left" | "merge_to_right" => &[Turn::Straight],
        "reverse" => &[Turn::UTurn],
        _ => &[],
    });
    TurnSet::of(&turns.copied().collect::<Vec<Turn>>())
}

/// The arrows of a way at its end, and against its course at its beginning, where they fit its lanes.
pub(super) fn arrows(
    tags: &Tags<'_>,
    way: i64,
    (along, against): (u8, u8),
    warnings: &mut Vec<Warning>,
) -> [Arrows; 2] {
    let mut of = |keys: &[Key], lanes: u8| {
        let Some(arrows) = keys.iter().find_map(|key| tags.get(*key)).and_then(Arrows::of) else {
            return Arrows::default();
        };
        if arrows.count == lanes {
            return arrows;
        }
        let what = format!("{} arrows for {lanes} lanes; they were left out", arrows.count);
        warnings.push(Warning { what, element: Some(OsmId::Way(way)), at: None });
        Arrows::default()
    };
    let is_one_way = against == 0;
    let along_keys = [Key::TurnLanesForward, Key::TurnLanes];
    let ahead = of(if is_one_way { &along_keys } else { &along_keys[..1] }, along);
    let back = if is_one_way { Arrows::default() } else { of(&[Key::TurnLanesBackward], against) };
    [ahead, back]
}

/// An end of the way that a sign over ways governs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Where one comes from.
    Begins,
    /// Where one goes.
    Leads,
}

impl Turns {
    pub(super) const fn of(arrows: Arrows) -> Self {
        Self { arrows, forbidden: TurnSet::ANY, over: [[0; 2]; 2] }
    }

    fn forbids(&self, turn: Turn) -> bool {
        !self.forbidden.is_any() && self.forbidden.allows(turn)
    }

    /// Forbids more.
    pub(super) fn forbid(&mut self, turns: &[Turn]) {
        let all: Vec<Turn> =
            ALL.into_iter().filter(|turn| self.forbids(*turn) || turns.contains(turn)).collect();
        self.forbidden = TurnSet::of(&all);
    }

    /// Forbids what another end forbids.
    pub(super) fn forbid_as(&mut self, other: &Self) {
        let turns: Vec<Turn> = ALL.into_iter().filter(|turn| other.forbids(*turn)).collect();
        self.forbid(&turns);
        for side in [Side::Begins, Side::Leads] {
            other.marks(side).for_each(|sign| self.mark(side, sign));
        }
    }

    /// The signs over ways that begin here, or lead here.
    pub(super) fn marks(&self, side: Side) -> impl Iterator<Item = u16> + use<> {
        self.over[side as usize].into_iter().filter(|sign| *sign > 0)
    }

    /// Marks an end as that where a sign over ways begins, or to which it leads; what has no room is dropped.
    pub(super) fn mark(&mut self, side: Side, sign: u16) {
        let marks = &mut self.over[side as usize];
        if !marks.contains(&sign)
            && let Some(free) = marks.iter_mut().find(|mark| **mark == 0)
        {
            *free = sign;
        }
    }

    /// For a street of so many lanes: an arrow a lane, or none where nothing is said that fits.
    pub(super) fn on_lanes(&self, lanes: usize) -> Vec<TurnSet> {
        let drawn =
            Some(&self.arrows.lanes[..usize::from(self.arrows.count)]).filter(|drawn| drawn.len() == lanes);
        let allowed: Vec<Turn> = ALL.into_iter().filter(|turn| !self.forbids(*turn)).collect();
        let can_go = allowed.iter().any(|turn| *turn != Turn::UTurn);
        if self.forbidden.is_any() || !can_go {
            return drawn.unwrap_or_default().to_vec();
        }
        let of_lane = |lane: usize| {
            let arrow = drawn.map(|drawn| drawn[lane]).filter(|arrow| !arrow.is_any());
            let arrow = arrow.unwrap_or_else(|| usual(lane, lanes));
            let left: Vec<Turn> = allowed.iter().copied().filter(|turn| arrow.allows(*turn)).collect();
            // A lane must lead somewhere.
            TurnSet::of(if left.is_empty() { &allowed } else { &left })
        };
        (0..lanes).map(of_lane).collect()
    }
}

/// What a lane without an arrow is for: straight on, and from the outer lanes to their side.
fn usual(lane: usize, lanes: usize) -> TurnSet {
    let (is_first, is_last) = (lane == 0, lane + 1 == lanes);
    let turns = ALL.into_iter().filter(|turn| match turn {
        Turn::Straight => true,
        Turn::Left | Turn::UTurn => is_first,
        Turn::Right => is_last,
    });
    TurnSet::of(&turns.collect::<Vec<Turn>>())
}

/// The turns that a sign forbids.
fn forbidden(sign: &str) -> Option<&'static [Turn]> {
    Some(match sign {
        "no_left_turn" => &[Turn::Left],
        "no_right_turn" => &[Turn::Right],
        "no_straight_on" => &[Turn::Straight],
        "no_u_turn" => &[Turn::UTurn],
        "only_left_turn" => &[Turn::Straight, Turn::Right, Turn::UTurn],
        "only_right_turn" => &[Turn::Straight, Turn::Left, Turn::UTurn],
        "only_straight_on" => &[Turn::Left, Turn::Right, Turn::UTurn],
        _ => return None,
    })
}

/// Puts the signs that forbid turns at the ends of the streets where they stand. `vertices` are the nodes of the web at
/// nodes of the place.
pub(super) fn put_signs(
    web: &mut Web,
    place: &Place,
    vertices: &BTreeMap<u32, u32>,
    warnings: &mut Vec<Warning>,
) {
    for relation in place.raw.relations() {
        let tags = place.raw.relation_tags(relation);
        let Some(sign) = tags.get(Key::Restriction).filter(|_| tags.is(Key::Type, "restriction")) else {
            continue;
        };
        let is_for_others = tags.get(Key::Except).is_some_and(|except| {
            except.split(';').any(|who| matches!(who.trim(), "motorcar" | "motor_vehicle" | "vehicle"))
        });
        if is_for_others {
            continue;
        }
        if let Err(what) = put_sign(web, place, vertices, relation, sign) {
            let what = format!("a turn restriction {what}; left out");
            warnings.push(Warning { what, element: Some(OsmId::Relation(relation.id)), at: None });
        }
    }
}

fn put_sign(
    web: &mut Web,
    place: &Place,
    vertices: &BTreeMap<u32, u32>,
    relation: &Relation,
    sign: &str,
) -> Result<(), &'static str> {
    let turns = forbidden(sign).ok_or("is of a kind that is not known")?;
    let members = place.raw.members_of(relation);
    let of_role = |role: Role| members.iter().filter(move |member| member.role == role);
    if of_role(Role::Over).next().is_some() {
        let numbers = |role: Role| of_role(role).map(|member| member.number).collect();
        let [from, over, to] = [Role::From, Role::Over, Role::To].map(numbers);
        let course = over::Course { from, over, to };
        return over::put(web, &over::Extract { place, vertices }, relation.id, &course, turns);
    }
    let at = of_role(Role::At).next().ok_or("has no node")?;
    let node = place.raw.node(at.number).and_then(|node| vertices.get(&node));
    // Signs for ways that are no streets, and beyond the extract, say nothing here.
    let Some(node) = node.copied() else { return Ok(()) };
    for edge in web.node(node).edges.clone() {
        let found = web.edge(edge);
        if of_role(Role::From).any(|from| from.number == found.character.way) {
            for end in (0..2).filter(|end| found.ends[*end] == node).collect::<Vec<usize>>() {
                web.edges[edge as usize].turns[end].forbid(turns);
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arrows_are_read_lane_by_lane() {
        let arrows = Arrows::of("left|through;slight_right||none").unwrap();
        assert_eq!(arrows.count, 4);
        let allows = |lane: usize| ALL.map(|turn| arrows.lanes[lane].allows(turn));
        assert_eq!(allows(0), [true, false, false, false]);
        assert_eq!(allows(1), [false, true, true, false]);
        assert!(arrows.lanes[2].is_any() && arrows.lanes[3].is_any());
        assert_eq!(Arrows::of("none|none"), None);
        assert_eq!(Arrows::of(&"left|".repeat(20)), None);
    }

    #[test]
    fn a_sign_takes_its_turn_from_every_lane() {
        let mut turns = Turns::default();
        assert!(turns.on_lanes(2).is_empty());
        turns.forbid(forbidden("no_left_turn").unwrap());
        let lanes = turns.on_lanes(2);
        assert!(lanes.iter().all(|lane| !lane.allows(Turn::Left) && lane.allows(Turn::Straight)));
        assert!(!lanes[0].allows(Turn::Right) && lanes[1].allows(Turn::Right));
        turns.forbid(forbidden("only_right_turn").unwrap());
        assert!(turns.on_lanes(2).iter().all(|lane| *lane == TurnSet::of(&[Turn::Right])));
        // Signs that forbid all are a mistake.
        turns.forbid(&[Turn::Right]);
        assert!(turns.on_lanes(2).is_empty());
    }
}
