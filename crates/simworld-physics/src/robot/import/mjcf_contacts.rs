//! Which bodies of MJCF meet one another, beside the bits of their geoms.
//!
//! By `MuJoCo`'s rules (Computation, Collision detection): bodies without a joint between them are one, and one and its parent pass
//! through one another unless the parent stands still as the world does or the flag `filterparent` is off; `exclude` names others.

use roxmltree::Node;

use super::Reading;
use super::mjcf::WORLD;
use super::xml::{children, place, shortened};
use crate::robot::description::Base;
use crate::robot::tree::Tree;
use crate::robot::{RobotDescription, RobotError};

/// Says in a description whose bodies were read which of them meet.
pub(super) fn read(
    root: Node<'_, '_>,
    description: &mut RobotDescription,
    reading: &mut Reading<'_>,
) -> Result<(), RobotError> {
    for contact in children(root, "contact") {
        for pair in children(contact, "pair") {
            reading
                .note(place(pair), "is passed over: whether geoms meet follows from their bodies and bits");
        }
        for exclude in children(contact, "exclude") {
            let pair = [body(exclude, "body1", description)?, body(exclude, "body2", description)?];
            // The geoms of the world were passed over.
            if !pair.iter().any(|name| name == WORLD) {
                description.apart.push(pair);
            }
        }
    }
    let flags = children(root, "option").flat_map(|option| children(option, "flag"));
    let filters = flags.filter_map(|flag| flag.attribute("filterparent")).last() != Some("disable");
    let tree = Tree::of(description)?;
    let parts = Welded::of(description, &tree);
    let stands = |part: usize| part == 0 && description.base == Base::Fixed;
    let mut meets = Vec::new();
    for (part, hinge) in tree.hinges() {
        let mut meet = !filters || stands(hinge.parent);
        // A body without geoms is a body all the same: what hangs on it meets what it hangs on.
        meets.push((hinge.joint, meet || (parts.geoms[part].is_empty() && !parts.is_hollow[part])));
        let mut parent = hinge.parent;
        while let Some(above) = tree.parts[parent].hinge.as_ref().filter(|_| parts.is_hollow[parent]) {
            parent = above.parent;
            meet |= stands(parent);
        }
        if !meet {
            let name = |link: &usize| description.links[*link].name.clone();
            let of_parent = || parts.geoms[parent].iter().map(name);
            let pairs =
                parts.geoms[part].iter().flat_map(|one| of_parent().map(move |other| [name(one), other]));
            description.apart.extend(pairs.collect::<Vec<_>>());
        }
    }
    for (joint, meet) in meets {
        description.joints[joint].meets = meet;
    }
    Ok(())
}

/// What of a robot is one body.
struct Welded {
    /// Of each part, its links with geoms.
    geoms: Vec<Vec<usize>>,
    /// Whether it is nothing but the link between two joints of one body.
    is_hollow: Vec<bool>,
}

impl Welded {
    fn of(description: &RobotDescription, tree: &Tree) -> Self {
        let count = tree.parts.len();
        let mut welded = Self { geoms: vec![Vec::new(); count], is_hollow: vec![true; count] };
        for (place, (link, (part, _))) in description.links.iter().zip(&tree.links).enumerate() {
            if !link.solids.is_empty() {
                welded.geoms[*part].push(place);
            }
            // No body that moves is without mass.
            welded.is_hollow[*part] &= link.solids.is_empty() && link.mass == 0.0;
        }
        welded
    }
}

/// The body that an attribute names.
fn body(node: Node<'_, '_>, attribute: &str, description: &RobotDescription) -> Result<String, RobotError> {
    let name = node.attribute(attribute).ok_or_else(|| RobotError::Missing {
        place: place(node),
        what: attribute.to_owned(),
        mend: "name two bodies",
    })?;
    if name != WORLD && !description.links.iter().any(|link| link.name == name) {
        let (place, name) = (place(node), shortened(name));
        return Err(RobotError::Unknown { place, kind: "body", name });
    }
    Ok(name.to_owned())
}
