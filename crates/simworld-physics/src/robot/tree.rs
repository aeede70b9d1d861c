//! A description made ready for the engine: links that no joint moves against one another are one part, and parts come
//! after those that they hang on.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, UnitQuaternion};
use simworld_core::geometry::{Pose, Vector3};

use super::description::{
    JointDescription, JointKind, LinkDescription, MOST_JOINTS, MOST_LINKS, MOST_SOLIDS, RobotDescription,
};
use super::error::RobotError;

/// As dense as water, kg/m³.
const WATER: f64 = 1000.0;
/// What hangs last on a joint has at least this mass and inertia, kg and kg m²: without any it could not be moved.
const LEAST: [f64; 2] = [1e-6, 1e-9];

/// The parts of a robot.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    /// The first is the one that everything hangs on; each other one hangs on an earlier one.
    pub(super) parts: Vec<Part>,
    /// Which part each link of the description belongs to, and where it sits in it.
    pub(super) links: Vec<(usize, Pose)>,
}

/// What moves as one body. Its frame is that of the link that its joint moves.
#[derive(Clone, Debug)]
pub(super) struct Part {
    pub(super) lump: Lump,
    /// Link and place in its list, and where the solid sits in the part.
    pub(super) solids: Vec<(usize, usize, Pose)>,
    /// The same of what is seen in place of them.
    pub(super) visuals: Vec<(usize, usize, Pose)>,
    /// What it hangs on; none for the first.
    pub(super) hinge: Option<Hinge>,
}

impl Part {
    /// One without anything yet.
    fn on(hinge: Option<Hinge>) -> Self {
        Self { lump: Lump::default(), solids: Vec::new(), visuals: Vec::new(), hinge }
    }
}

/// The joint between two parts.
#[derive(Clone, Debug)]
pub(super) struct Hinge {
    /// Place in the list of joints of the description.
    pub(super) joint: usize,
    pub(super) parent: usize,
    pub(super) parent_from_joint: Pose,
    /// Of length 1, joint frame.
    pub(super) axis: Vector3,
    pub(super) slides: bool,
}

/// Mass, its centre and its moments of inertia about that, in the frame of a part.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lump {
    pub(super) mass: f64,
    pub(super) center: Vector3,
    pub(super) inertia: Matrix3<f64>,
}

impl Lump {
    pub(super) fn of(link: &LinkDescription, part_from_link: &Pose) -> Self {
        let mut inertia = link.inertia;
        if link.mass > 0.0 && inertia.amax() == 0.0 {
            let radius =
                simworld_core::ops::pow(3.0 * link.mass / (4.0 * std::f64::consts::PI * WATER), 1.0 / 3.0);
            inertia = Matrix3::identity() * (0.4 * link.mass * radius * radius);
        }
        let turn = part_from_link.rotation.to_rotation_matrix();
        let center = part_from_link.transform_point(&link.center.into()).coords;
        Self { mass: link.mass, center, inertia: turn.matrix() * inertia * turn.matrix().transpose() }
    }

    /// Both together, by Steiner's rule.
    fn and(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        if mass == 0.0 {
            return Self::default();
        }
        let center = (self.center * self.mass + other.center * other.mass) / mass;
        let shifted = |lump: &Self| {
            let arm = lump.center - center;
            let spread = Matrix3::identity() * arm.norm_squared() - arm * arm.transpose();
            lump.inertia + spread * lump.mass
        };
        Self { mass, center, inertia: shifted(self) + shifted(other) }
    }
}

impl Hinge {
    /// Where the child stands in the frame of the parent.
    pub(super) fn parent_from_child(&self, position: f64) -> Pose {
        self.parent_from_joint * self.motion(position)
    }

    fn motion(&self, position: f64) -> Pose {
        if self.slides {
            Pose::from_parts((self.axis * position).into(), UnitQuaternion::identity())
        } else {
            let (sin, cos) = simworld_core::ops::sin_cos(position * 0.5);
            let turn = nalgebra::Quaternion::from_parts(cos, self.axis * sin);
            Pose::from_parts(Vector3::zeros().into(), UnitQuaternion::new_unchecked(turn))
        }
    }
}

/// By name, with the names that are there twice refused.
fn by_name<'a>(
    kind: &'static str,
    names: impl Iterator<Item = &'a str>,
) -> Result<BTreeMap<&'a str, usize>, RobotError> {
    let mut known = BTreeMap::new();
    for (place, name) in names.enumerate() {
        if known.insert(name, place).is_some() {
            return Err(RobotError::Duplicate { kind, name: name.to_owned() });
        }
    }
    Ok(known)
}

/// The joints by the link that they hang on, as they come, and the link on which everything hangs.
struct Order {
    children: Vec<Vec<(usize, usize)>>,
    root: usize,
}

impl Order {
    fn of(description: &RobotDescription) -> Result<Self, RobotError> {
        let links = by_name("links", description.links.iter().map(|link| link.name.as_str()))?;
        by_name("joints", description.joints.iter().map(|joint| joint.name.as_str()))?;
        let mut children = vec![Vec::new(); description.links.len()];
        let mut held: Vec<Option<usize>> = vec![None; description.links.len()];
        for (place, joint) in description.joints.iter().enumerate() {
            let find = |name: &str| {
                links.get(name).copied().ok_or_else(|| RobotError::Unknown {
                    place: format!("joint {:?}", joint.name),
                    kind: "link",
                    name: name.to_owned(),
                })
            };
            let (parent, child) = (find(&joint.parent)?, find(&joint.child)?);
            if let Some(first) = held[child].replace(place) {
                let (link, first) = (joint.child.clone(), description.joints[first].name.clone());
                return Err(RobotError::TwoParents { link, first, second: joint.name.clone() });
            }
            children[parent].push((place, child));
        }
        let roots: Vec<usize> = (0..held.len()).filter(|link| held[*link].is_none()).collect();
        match roots[..] {
            [root] => Ok(Self { children, root }),
            [] if !held.is_empty() => Err(RobotError::Cycle { link: description.links[0].name.clone() }),
            _ => {
                let names = roots.iter().take(4).map(|link| description.links[*link].name.as_str());
                let names = names.collect::<Vec<_>>().join(", ");
                Err(RobotError::Roots { found: roots.len(), names })
            }
        }
    }
}

impl Tree {
    /// Checks a description and puts it in order.
    pub(super) fn of(description: &RobotDescription) -> Result<Self, RobotError> {
        check_numbers(description)?;
        let order = Order::of(description)?;
        let mut tree =
            Self { parts: Vec::new(), links: vec![(usize::MAX, Pose::identity()); order.children.len()] };
        tree.parts.push(Part::on(None));
        let mut open = vec![(order.root, 0, Pose::identity())];
        while let Some((link, part, part_from_link)) = open.pop() {
            tree.take(description, link, part, part_from_link);
            // The first comes out of the stack first.
            let before = open.len();
            for (place, child) in &order.children[link] {
                let joint = &description.joints[*place];
                open.push(tree.hang(joint, *place, *child, (part, &part_from_link)));
            }
            open[before..].reverse();
        }
        if let Some(lost) = tree.links.iter().position(|(part, _)| *part == usize::MAX) {
            return Err(RobotError::Cycle { link: description.links[lost].name.clone() });
        }
        tree.make_movable();
        Ok(tree)
    }

    /// Adds a link to a part.
    fn take(&mut self, description: &RobotDescription, link: usize, part: usize, part_from_link: Pose) {
        self.links[link] = (part, part_from_link);
        let data = &description.links[link];
        let whole = &mut self.parts[part];
        whole.lump = whole.lump.and(&Lump::of(data, &part_from_link));
        let solids = data.solids.iter().enumerate();
        whole.solids.extend(solids.map(|(at, solid)| (link, at, part_from_link * solid.link_from_solid)));
        let visuals = data.visuals.iter().enumerate();
        whole.visuals.extend(visuals.map(|(at, seen)| (link, at, part_from_link * seen.link_from_visual)));
    }

    /// The link at the other end of a joint, with the part that it belongs to.
    fn hang(
        &mut self,
        joint: &JointDescription,
        place: usize,
        child: usize,
        (parent, parent_from_link): (usize, &Pose),
    ) -> (usize, usize, Pose) {
        let parent_from_joint = parent_from_link * joint.parent_from_joint;
        if joint.kind == JointKind::Fixed {
            return (child, parent, parent_from_joint);
        }
        let slides = joint.kind == JointKind::Prismatic;
        let hinge = Hinge { joint: place, parent, parent_from_joint, axis: joint.axis.normalize(), slides };
        self.parts.push(Part::on(Some(hinge)));
        (child, self.parts.len() - 1, Pose::identity())
    }

    fn make_movable(&mut self) {
        for part in &mut self.parts {
            part.lump.mass = part.lump.mass.max(LEAST[0]);
            if part.lump.inertia.amax() == 0.0 {
                part.lump.inertia = Matrix3::identity() * LEAST[1];
            }
        }
    }

    /// The parts that hang on joints, with these.
    pub(super) fn hinges(&self) -> impl Iterator<Item = (usize, &Hinge)> {
        self.parts.iter().enumerate().filter_map(|(part, data)| Some((part, data.hinge.as_ref()?)))
    }

    /// Positions of the joints as near to those wished for as their ends let them.
    pub(super) fn positions(
        &self,
        description: &RobotDescription,
        wished: impl Fn(&JointDescription) -> f64,
    ) -> Vec<f64> {
        let joints = self.hinges().map(|(_, hinge)| &description.joints[hinge.joint]);
        joints
            .map(|joint| joint.ends().map_or(wished(joint), |[low, high]| wished(joint).clamp(low, high)))
            .collect()
    }

    /// Where the parts stand in the frame of the first, with the joints at such positions.
    pub(super) fn poses(&self, positions: &[f64]) -> Vec<Pose> {
        let mut poses: Vec<Pose> = Vec::with_capacity(self.parts.len());
        poses.push(Pose::identity());
        for ((_, hinge), position) in self.hinges().zip(positions) {
            let pose = poses[hinge.parent] * hinge.parent_from_child(*position);
            poses.push(pose);
        }
        poses
    }
}

fn check_numbers(description: &RobotDescription) -> Result<(), RobotError> {
    let few = |what, found, most| {
        if found <= most {
            return Ok(());
        }
        Err(RobotError::TooMany { place: format!("robot {:?}", description.name), what, found, most })
    };
    few("links", description.links.len(), MOST_LINKS)?;
    let movable = description.joints.iter().filter(|joint| joint.kind != JointKind::Fixed).count();
    few("joints that move", movable, MOST_JOINTS)?;
    few("solids", description.links.iter().map(|link| link.solids.len()).sum(), MOST_SOLIDS)?;
    description.links.iter().try_for_each(LinkDescription::check)?;
    description.joints.iter().try_for_each(JointDescription::check)
}
