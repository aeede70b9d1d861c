//! A robot as data: links of mass and form, and the joints between them.
//!
//! SI units and radians. The frame of a link stands where its joint is; x forward, y left, z up are the habit of robots, and
//! no rule.

use nalgebra::{Matrix3, UnitQuaternion};
use serde::{Deserialize, Serialize};
use simworld_core::asset::Material;
use simworld_core::geometry::{Pose, Vector3};

use super::error::{RobotError, check};
use super::meeting::Meeting;
use super::tree::Tree;
use super::visual::LinkVisual;
use crate::apart::Kinds;

/// More links than this are no robot.
pub const MOST_LINKS: usize = 1000;
/// More joints that move than this are no robot: what a substep costs grows with the third power of their number.
pub const MOST_JOINTS: usize = 128;
/// More solids than this are no robot.
pub const MOST_SOLIDS: usize = 4096;
/// The greatest number of corners of a convex solid.
pub const MOST_CORNERS: usize = 256;
/// Beyond this length nothing is taken, m.
const FAR: f64 = 1e4;

/// A robot: a tree of links that joints hold together.
///
/// It is plain data, from a file (modules `urdf` and `mjcf`) or by hand:
///
/// ```
/// use simworld_core::geometry::Vector3;
/// use simworld_physics::robot::{Base, JointDescription, JointKind, LinkDescription, RobotDescription};
///
/// let bob = LinkDescription::new("bob").with_mass(1.0, Vector3::new(0.0, 0.0, -1.0), [1e-6; 3]);
/// let hinge = JointDescription::new("hinge", JointKind::Continuous, ["stand", "bob"]).about(Vector3::y());
/// let pendulum = RobotDescription {
///     name: "pendulum".to_owned(),
///     base: Base::Fixed,
///     links: vec![LinkDescription::new("stand"), bob],
///     joints: vec![hinge],
///     apart: Vec::new(),
/// };
/// pendulum.validate()?;
/// assert_eq!(pendulum.mass(), 1.0);
/// # Ok::<(), simworld_physics::RobotError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RobotDescription {
    /// What it is called.
    pub name: String,
    /// Whether its first link moves freely.
    pub base: Base,
    /// Its links; one of them hangs on nothing, and all others on it.
    pub links: Vec<LinkDescription>,
    /// Its joints.
    pub joints: Vec<JointDescription>,
    /// Pairs of links that pass through one another, beside those that a joint holds together. All others meet.
    pub apart: Vec<[String; 2]>,
}

/// How the link that everything hangs on is held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Base {
    /// By nothing: it drives, walks or falls.
    #[default]
    Free,
    /// By the ground or a wall: it stays where it is.
    Fixed,
}

/// One link: mass, and what others meet of it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LinkDescription {
    /// What it is called.
    pub name: String,
    /// kg, 0 to 1e7.
    pub mass: f64,
    /// Its centre of mass, link frame, m.
    pub center: Vector3,
    /// Moments of inertia about its centre of mass along the axes of the link frame, kg m²; positive definite, or all 0, which
    /// stands for a ball as dense as water.
    pub inertia: Matrix3<f64>,
    /// What others meet.
    pub solids: Vec<LinkSolid>,
    /// What is seen of it, in place of the solids; where there is nothing, these are seen.
    pub visuals: Vec<LinkVisual>,
}

/// One convex solid of a link.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinkSolid {
    /// Its form.
    pub form: Form,
    /// Where it sits.
    pub link_from_solid: Pose,
    /// What it is made of: its friction and how it bounces.
    pub material: Material,
    /// Which solids of its own robot it meets.
    #[serde(default)]
    pub kinds: Kinds,
    /// Its colour, linear-light sRGB primaries in [0, 1]; without one it has that of the entity, or else a grey.
    #[serde(default)]
    pub color: Option<[f32; 3]>,
}

/// The form of a solid, in a frame in its middle, m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Form {
    /// A box with its edges along the axes.
    Box {
        /// Its edges.
        size: Vector3,
    },
    /// A cylinder along z.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// From face to face.
        length: f64,
    },
    /// A ball.
    Sphere {
        /// Its radius.
        radius: f64,
    },
    /// A cylinder along z with half a ball at each end.
    Capsule {
        /// Its radius.
        radius: f64,
        /// Of the cylinder alone.
        length: f64,
    },
    /// The least convex solid around points.
    Convex {
        /// 4 to 256 points that do not lie in a plane.
        points: Vec<Vector3>,
    },
}

/// How a joint moves.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum JointKind {
    /// Not at all.
    #[default]
    Fixed,
    /// Turns about its axis, within limits.
    Revolute,
    /// Turns about its axis without end.
    Continuous,
    /// Slides along its axis, within limits.
    Prismatic,
}

/// One joint, from a parent link to a child.
///
/// A joint that slides has m and N where others have radians and N m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct JointDescription {
    /// What it is called.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// The link that it hangs on.
    pub parent: String,
    /// The link that hangs on it; its frame is that of the joint, turned or moved along by it.
    pub child: String,
    /// Where it sits on its parent.
    pub parent_from_joint: Pose,
    /// About which, or along which, it moves, joint frame; of any length but 0.
    pub axis: Vector3,
    /// Where it ends, from and to; of no interest for joints that are fixed or turn without end.
    pub limits: Option<[f64; 2]>,
    /// The greatest torque of its motor, N m, 0 to 1e9; none is as much as it takes.
    pub effort: Option<f64>,
    /// The speed at which its motor drives it no further, rad/s, above 0; none is as fast as you like.
    pub velocity: Option<f64>,
    /// Viscous friction, N m s/rad, 0 to 1e6.
    pub damping: f64,
    /// Dry friction, N m, 0 to 1e6.
    pub friction: f64,
    /// Inertia of its motor as the joint feels it, kg m², 0 to 1e6.
    pub armature: f64,
    /// A spring in it: stiffness, N m/rad, 0 to 1e6, and the angle at which it rests.
    pub spring: [f64; 2],
    /// Whether the links that it holds together meet one another as others do. If not, they pass through one another, as links
    /// do that overlap at their joint; a link without solids between two others is passed over here.
    pub meets: bool,
}

impl Default for JointDescription {
    fn default() -> Self {
        Self {
            name: String::new(),
            kind: JointKind::Fixed,
            parent: String::new(),
            child: String::new(),
            parent_from_joint: Pose::identity(),
            axis: Vector3::x(),
            limits: None,
            effort: None,
            velocity: None,
            damping: 0.0,
            friction: 0.0,
            armature: 0.0,
            spring: [0.0; 2],
            meets: false,
        }
    }
}

impl RobotDescription {
    /// Checks names, numbers, and that the links are a tree.
    ///
    /// # Errors
    /// What is wrong first.
    pub fn validate(&self) -> Result<(), RobotError> {
        let tree = Tree::of(self)?;
        Meeting::of(self, &tree).map(|_| ())
    }

    /// Lets those links pass through one another that are within one another by more than a millimetre where all joints are at 0, or
    /// at the end of their way that is nearest to it: what touches there would be pushed apart for good. The readers of files do so;
    /// the pairs are returned.
    ///
    /// # Errors
    /// A description that is no robot.
    pub fn part_at_rest(&mut self) -> Result<Vec<[String; 2]>, RobotError> {
        let tree = Tree::of(self)?;
        let meeting = Meeting::of(self, &tree)?;
        let found = meeting.overlaps(self, &tree, &tree.positions(self, |_| 0.0));
        let name = |link: usize| self.links[link].name.clone();
        let pairs: Vec<[String; 2]> =
            found.into_iter().map(|(one, other)| [name(one), name(other)]).collect();
        self.apart.extend(pairs.iter().cloned());
        Ok(pairs)
    }

    /// The mass of all of it, kg.
    pub fn mass(&self) -> f64 {
        self.links.iter().map(|link| link.mass).sum()
    }
}

impl LinkDescription {
    /// A link without mass and form.
    pub fn new(name: &str) -> Self {
        Self { name: name.to_owned(), ..Self::default() }
    }

    /// With a mass, kg, its centre, m, and its moments of inertia about the axes of the link frame, kg m².
    #[must_use]
    pub fn with_mass(mut self, mass: f64, center: Vector3, moments: [f64; 3]) -> Self {
        (self.mass, self.center) = (mass, center);
        self.inertia = Matrix3::from_diagonal(&Vector3::from(moments));
        self
    }

    /// With one more solid.
    #[must_use]
    pub fn with_solid(mut self, form: Form, link_from_solid: Pose, material: Material) -> Self {
        let (kinds, color) = (Kinds::default(), None);
        self.solids.push(LinkSolid { form, link_from_solid, material, kinds, color });
        self
    }

    pub(super) fn check(&self) -> Result<(), RobotError> {
        let place = || format!("link {:?}", self.name);
        check(&place, "mass", self.mass, 0.0..=1e7, "0 to 1e7 kg")?;
        for part in self.center.iter() {
            check(&place, "center", *part, -FAR..=FAR, "at most 1e4 m")?;
        }
        for part in self.inertia.iter() {
            check(&place, "inertia", *part, -1e12..=1e12, "at most 1e12 kg m²")?;
        }
        let (inertia, most) = (&self.inertia, self.inertia.amax());
        for (one, other) in [((0, 1), (1, 0)), ((0, 2), (2, 0)), ((1, 2), (2, 1))] {
            let skew = (inertia[one] - inertia[other]).abs();
            check(&place, "inertia", skew, 0.0..=most * 1e-9, "a symmetric matrix")?;
        }
        if most > 0.0 {
            // Positive definite, by its leading minors.
            for minor in [
                inertia[(0, 0)],
                inertia[(0, 0)] * inertia[(1, 1)] - inertia[(0, 1)] * inertia[(1, 0)],
                inertia.determinant(),
            ] {
                check(&place, "inertia", minor, f64::MIN_POSITIVE..=f64::MAX, "a positive definite matrix")?;
            }
            check(&place, "mass", self.mass, f64::MIN_POSITIVE..=1e7, "more than 0 kg to what has inertia")?;
        }
        self.solids.iter().try_for_each(|solid| solid.check(&place))?;
        self.visuals.iter().try_for_each(|visual| visual.check(&place))
    }
}

impl LinkSolid {
    fn check(&self, place: &dyn Fn() -> String) -> Result<(), RobotError> {
        check_pose(place, &self.link_from_solid)?;
        check_color(place, self.color)?;
        self.form.check(place)
    }
}

impl Form {
    pub(super) fn check(&self, place: &dyn Fn() -> String) -> Result<(), RobotError> {
        let size = |field, value| check(place, field, value, 1e-6..=FAR, "1e-6 to 1e4 m");
        match self {
            Form::Box { size: edges } => edges.iter().try_for_each(|edge| size("size", *edge)),
            Form::Cylinder { radius, length } => {
                size("radius", *radius).and_then(|()| size("length", *length))
            }
            Form::Sphere { radius } => size("radius", *radius),
            Form::Capsule { radius, length } => {
                size("radius", *radius)?;
                check(place, "length", *length, 0.0..=FAR, "0 to 1e4 m")
            }
            Form::Convex { points } => {
                if points.len() > MOST_CORNERS {
                    let (found, most) = (points.len(), MOST_CORNERS);
                    return Err(RobotError::TooMany { place: place(), what: "corners", found, most });
                }
                for part in points.iter().flat_map(|point| point.iter()) {
                    check(place, "corner", *part, -FAR..=FAR, "at most 1e4 m")?;
                }
                let volume = super::solids::volume(self);
                check(place, "volume", volume, 1e-15..=f64::MAX, "corners of a solid, not of a plane")
            }
        }
    }
}

impl JointDescription {
    /// A joint between a parent and a child, in the middle of the parent, along or about x.
    pub fn new(name: &str, kind: JointKind, [parent, child]: [&str; 2]) -> Self {
        let (name, parent, child) = (name.to_owned(), parent.to_owned(), child.to_owned());
        Self { name, kind, parent, child, ..Self::default() }
    }

    /// At a place on its parent, m.
    #[must_use]
    pub fn at(mut self, place: Vector3) -> Self {
        self.parent_from_joint = Pose::from_parts(place.into(), UnitQuaternion::identity());
        self
    }

    /// About or along an axis.
    #[must_use]
    pub fn about(mut self, axis: Vector3) -> Self {
        self.axis = axis;
        self
    }

    /// Within limits.
    #[must_use]
    pub fn within(mut self, limits: [f64; 2]) -> Self {
        self.limits = Some(limits);
        self
    }

    /// With a motor of so much torque, N m, and an inertia of it as the joint feels it, kg m².
    #[must_use]
    pub fn with_motor(mut self, effort: f64, armature: f64) -> Self {
        (self.effort, self.armature) = (Some(effort), armature);
        self
    }

    /// The ends of its way, if it has any.
    pub(super) fn ends(&self) -> Option<[f64; 2]> {
        match self.kind {
            JointKind::Fixed | JointKind::Continuous => None,
            JointKind::Revolute | JointKind::Prismatic => self.limits,
        }
    }

    pub(super) fn check(&self) -> Result<(), RobotError> {
        let place = || format!("joint {:?}", self.name);
        check_pose(&place, &self.parent_from_joint)?;
        if self.kind == JointKind::Fixed {
            return Ok(());
        }
        for part in self.axis.iter() {
            check(&place, "axis", *part, -1e6..=1e6, "numbers of at most 1e6")?;
        }
        check(&place, "axis", self.axis.norm(), 1e-9..=1e7, "a direction, not 0")?;
        if let Some([low, high]) = self.ends() {
            check(&place, "limits", low, -FAR..=FAR, "at most 1e4")?;
            check(&place, "limits", high, low..=FAR, "no less than the lower one, and at most 1e4")?;
        }
        check(&place, "effort", self.effort.unwrap_or(0.0), 0.0..=1e9, "0 to 1e9 N m")?;
        check(&place, "velocity", self.velocity.unwrap_or(1.0), 1e-9..=1e9, "above 0 rad/s")?;
        check(&place, "damping", self.damping, 0.0..=1e6, "0 to 1e6 N m s/rad")?;
        check(&place, "friction", self.friction, 0.0..=1e6, "0 to 1e6 N m")?;
        check(&place, "armature", self.armature, 0.0..=1e6, "0 to 1e6 kg m²")?;
        check(&place, "spring", self.spring[0], 0.0..=1e6, "0 to 1e6 N m/rad")?;
        check(&place, "spring", self.spring[1], -FAR..=FAR, "a rest of at most 1e4")
    }
}

pub(super) fn check_color(place: &dyn Fn() -> String, color: Option<[f32; 3]>) -> Result<(), RobotError> {
    let mut parts = color.into_iter().flatten();
    parts.try_for_each(|part| check(place, "color", f64::from(part), 0.0..=1.0, "0 to 1"))
}

pub(super) fn check_pose(place: &dyn Fn() -> String, pose: &Pose) -> Result<(), RobotError> {
    for part in pose.translation.vector.iter() {
        check(place, "place", *part, -FAR..=FAR, "at most 1e4 m")?;
    }
    check(place, "rotation", pose.rotation.coords.norm(), 0.999..=1.001, "a rotation")
}
