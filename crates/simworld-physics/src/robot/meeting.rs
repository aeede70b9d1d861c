//! Which links of a robot meet one another, and which pass through one another.
//!
//! Two links that a joint holds together pass through one another, as far as the joint says nothing else, and so do those that
//! the description names and solids whose kinds do not meet. A link without solids is no more than a joint between its
//! neighbours, as the set-up of `MoveIt` has it: what hangs on it counts as hanging on the next link up that has any.

use std::collections::{BTreeMap, BTreeSet};

use parry3d_f64::bounding_volume::{Aabb, BoundingVolume};
use parry3d_f64::query::contact;
use rapier3d_f64::math::Pose as RapierPose;
use rapier3d_f64::prelude::SharedShape;

use super::description::RobotDescription;
use super::error::RobotError;
use super::solids::solid;
use super::tree::Tree;
use crate::apart::{Apart, Kinds};
use crate::convert::to_pose;

/// Links that reach less far into one another than this are pushed apart by the engine, if at all, m: it lets bodies so far in.
const DEPTH: f64 = 1e-3;

/// Which solids of a robot meet.
#[derive(Clone, Debug)]
pub(super) struct Meeting {
    pub(super) apart: Apart,
    /// The number of the first solid of each link.
    first: Vec<usize>,
    /// Of each part, whether anything of it meets anything of the part that it hangs on.
    pub(super) meets_parent: Vec<bool>,
    /// Whether any two solids meet.
    pub(super) is_any: bool,
    /// Whether there is more to it than what the engine knows of joints.
    pub(super) is_asked: bool,
}

impl Meeting {
    /// What follows from a description that was put in order.
    pub(super) fn of(description: &RobotDescription, tree: &Tree) -> Result<Self, RobotError> {
        let links = named(description)?.into_iter().chain(neighbours(description));
        let links: BTreeSet<(u16, u16)> = links.map(|(a, b)| (a.min(b) as u16, a.max(b) as u16)).collect();
        let mut first = Vec::with_capacity(description.links.len());
        let mut solids = Vec::new();
        for (link, data) in description.links.iter().enumerate() {
            first.push(solids.len());
            solids.extend(data.solids.iter().map(|solid| (link as u16, solid.kinds)));
        }
        let apart = Apart { solids, links: links.into_iter().collect() };
        let mut meeting = Self {
            apart,
            first,
            meets_parent: vec![false; tree.parts.len()],
            is_any: false,
            is_asked: false,
        };
        meeting.sum_up(description, tree);
        Ok(meeting)
    }

    /// The number of a solid of a link.
    pub(super) fn number(&self, link: usize, place: usize) -> u16 {
        (self.first[link] + place) as u16
    }

    /// Sums up for the engine what of its parts meets.
    fn sum_up(&mut self, description: &RobotDescription, tree: &Tree) {
        let kinds: Vec<Vec<Kinds>> = description
            .links
            .iter()
            .map(|link| {
                let kinds: BTreeSet<Kinds> = link.solids.iter().map(|solid| solid.kinds).collect();
                kinds.into_iter().collect()
            })
            .collect();
        let solid_links: Vec<usize> = (0..kinds.len()).filter(|link| !kinds[*link].is_empty()).collect();
        // By parts, the one that comes later first: whether some of both meet, and whether some do not.
        let mut pairs: BTreeMap<(usize, usize), [bool; 2]> = BTreeMap::new();
        for (at, one) in solid_links.iter().enumerate() {
            for other in &solid_links[..at] {
                let (a, b) = (tree.links[*one].0, tree.links[*other].0);
                if a == b {
                    continue;
                }
                let seen = pairs.entry((a.max(b), a.min(b))).or_default();
                if self.apart.has(*one as u16, *other as u16) {
                    seen[1] = true;
                    continue;
                }
                for meet in
                    kinds[*one].iter().flat_map(|one| kinds[*other].iter().map(|other| one.meets(*other)))
                {
                    seen[usize::from(!meet)] = true;
                }
            }
        }
        for ((part, other), [some, not_all]) in pairs {
            self.is_any |= some;
            let hangs = tree.parts[part].hinge.as_ref().is_some_and(|hinge| hinge.parent == other);
            if hangs {
                self.meets_parent[part] = some;
            }
            self.is_asked |= not_all && (some || !hangs);
        }
        self.is_asked &= self.is_any;
    }

    /// Pairs of links that meet, and are within one another with the joints at such positions.
    pub(super) fn overlaps(
        &self,
        description: &RobotDescription,
        tree: &Tree,
        positions: &[f64],
    ) -> Vec<(usize, usize)> {
        let placed = placed(description, tree, positions);
        let mut found = Vec::new();
        for one in 0..placed.len() {
            for other in one + 1..placed.len() {
                let is_apart =
                    tree.links[one].0 == tree.links[other].0 || self.apart.has(one as u16, other as u16);
                if !is_apart && overlap(&placed[one], &placed[other]) {
                    found.push((one, other));
                }
            }
        }
        found
    }
}

/// The pairs of links that a description names.
fn named(description: &RobotDescription) -> Result<Vec<(usize, usize)>, RobotError> {
    let places: BTreeMap<&str, usize> =
        description.links.iter().enumerate().map(|(at, link)| (link.name.as_str(), at)).collect();
    let find = |name: &String| {
        places.get(name.as_str()).copied().ok_or_else(|| RobotError::Unknown {
            place: "a pair of links that pass through one another".to_owned(),
            kind: "link",
            name: name.clone(),
        })
    };
    description.apart.iter().map(|[one, other]| Ok((find(one)?, find(other)?))).collect()
}

/// The pairs of links that joints hold together.
fn neighbours(description: &RobotDescription) -> Vec<(usize, usize)> {
    let places: BTreeMap<&str, usize> =
        description.links.iter().enumerate().map(|(at, link)| (link.name.as_str(), at)).collect();
    let mut holds = vec![None; description.links.len()];
    for joint in &description.joints {
        if let (Some(parent), Some(child)) =
            (places.get(joint.parent.as_str()), places.get(joint.child.as_str()))
        {
            holds[*child] = Some((*parent, joint.meets));
        }
    }
    let has_solids = |link: usize| !description.links[link].solids.is_empty();
    let mut pairs = Vec::new();
    for link in (0..holds.len()).filter(|link| has_solids(*link)) {
        let (mut at, mut meets) = (link, false);
        while let Some((above, they_meet)) = holds[at] {
            meets |= they_meet;
            if has_solids(above) {
                if !meets {
                    pairs.push((link, above));
                }
                break;
            }
            at = above;
        }
    }
    pairs
}

/// A solid in the frame of the first link.
struct Placed {
    shape: SharedShape,
    pose: RapierPose,
    aabb: Aabb,
    kinds: Kinds,
}

/// The solids of each link, and the box around them.
fn placed(
    description: &RobotDescription,
    tree: &Tree,
    positions: &[f64],
) -> Vec<(Option<Aabb>, Vec<Placed>)> {
    let poses = tree.poses(positions);
    let links = description.links.iter().zip(&tree.links);
    let links = links.map(|(link, (part, part_from_link))| {
        let frame = poses[*part] * part_from_link;
        let solids = link.solids.iter().filter_map(|data| {
            let (shape, form_from_shape) = solid(&data.form)?;
            let pose = to_pose(&(frame * data.link_from_solid)) * form_from_shape;
            let aabb = shape.compute_aabb(&pose);
            Some(Placed { shape, pose, aabb, kinds: data.kinds })
        });
        let solids: Vec<Placed> = solids.collect();
        let around = solids.iter().map(|solid| solid.aabb).reduce(|around, aabb| around.merged(&aabb));
        (around, solids)
    });
    links.collect()
}

fn overlap(
    (around, one): &(Option<Aabb>, Vec<Placed>),
    (beside, other): &(Option<Aabb>, Vec<Placed>),
) -> bool {
    let (Some(around), Some(beside)) = (around, beside) else { return false };
    around.intersects(beside)
        && one.iter().filter(|one| one.aabb.intersects(beside)).any(|one| {
            other.iter().any(|other| {
                one.aabb.intersects(&other.aabb)
                    && one.kinds.meets(other.kinds)
                    && contact(&one.pose, &*one.shape, &other.pose, &*other.shape, 0.0)
                        .is_ok_and(|found| found.is_some_and(|contact| contact.dist < -DEPTH))
            })
        })
}
