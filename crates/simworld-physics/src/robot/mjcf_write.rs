//! A robot as MJCF, the format of `MuJoCo`.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, UnitQuaternion};
use simworld_core::geometry::{Pose, Vector3};

use super::description::{
    Base, Form, JointDescription, JointKind, LinkDescription, LinkSolid, RobotDescription,
};
use super::error::RobotError;
use super::import::color::values_of;
use super::meeting::Meeting;
use super::tree::{Lump, Tree};
use crate::apart::Kinds;

/// Class of the defaults of everything in the robot, so that what is put beside it in the file has its own.
const CLASS: &str = "robot";
/// The least size that a file may say, m: thinner things are written as thick as that.
const LEAST: f64 = 1e-6;
/// What the first body of a file hangs on unless it moves freely; no file names it.
const WORLD: &str = "world";

/// The text of a file that [`from_str`](super::mjcf::from_str) and `MuJoCo` read: the same masses, inertias, forms, joints, limits,
/// springs, frictions and motors.
///
/// Lengths are m and angles radians. Joints with a motor have an actuator of the kind `motor` that takes torques or forces, within what
/// the motor gives, and has the joint's name. Links that pass through one another here are told by `exclude`, those on one joint too, and kinds of
/// solids by `contype` and `conaffinity`. Colours are in steps of 1/255 of sRGB. There is no ground in it.
///
/// What MJCF has no word for is left out: speeds at which motors drive no further, and how materials bounce. So is what is seen of links in place of
/// their solids. Where two things touch,
/// `MuJoCo` takes the greater friction of both and this physics the geometric mean: a ground with `priority="1"` and that mean as its
/// friction makes both the same. `MuJoCo` takes no link without mass that a joint moves.
///
/// ```
/// use simworld_physics::QuadrupedModel;
/// use simworld_physics::robot::{ImportOptions, mjcf};
///
/// let dog = QuadrupedModel::default();
/// let text = mjcf::to_string(&dog.description())?;
/// let read = mjcf::from_str(&text, &ImportOptions::default())?;
/// assert!((read.description.mass() - dog.mass()).abs() < 1e-12);
/// assert_eq!(read.description.joints[2].effort, Some(36.0)); // a knee
/// # Ok::<(), simworld_physics::RobotError>(())
/// ```
///
/// # Errors
/// A description that is no robot, or a name that cannot be written: one with a character that XML does not have, or `world`, which
/// MJCF calls what stands still.
pub fn to_string(description: &RobotDescription) -> Result<String, RobotError> {
    description.validate()?;
    let mut writer = Writer::of(description);
    let held: Vec<&str> = description.joints.iter().map(|joint| joint.child.as_str()).collect();
    let root = description.links.iter().find(|link| !held.contains(&link.name.as_str()));
    if let Some(root) = root {
        writer.top(root)?;
    }
    writer.file()
}

/// The parts of the file on the way.
struct Writer<'a> {
    description: &'a RobotDescription,
    links: BTreeMap<&'a str, &'a LinkDescription>,
    /// The joints that hang on a link, as they come.
    joints: BTreeMap<&'a str, Vec<&'a JointDescription>>,
    bodies: String,
    meshes: String,
    /// How many meshes there are.
    count: usize,
}

impl<'a> Writer<'a> {
    fn of(description: &'a RobotDescription) -> Self {
        let mut joints: BTreeMap<&str, Vec<&JointDescription>> = BTreeMap::new();
        for joint in &description.joints {
            joints.entry(&joint.parent).or_default().push(joint);
        }
        let links = description.links.iter().map(|link| (link.name.as_str(), link)).collect();
        Self { description, links, joints, bodies: String::new(), meshes: String::new(), count: 0 }
    }

    fn file(self) -> Result<String, RobotError> {
        let name = escaped("the robot", &self.description.name)?;
        let mut text = String::new();
        line(&mut text, 0, &format!("<mujoco model=\"{name}\">"));
        line(&mut text, 1, "<compiler angle=\"radian\"/>");
        line(&mut text, 1, "<default>");
        line(&mut text, 2, &format!("<default class=\"{CLASS}\"><geom mass=\"0\"/></default>"));
        line(&mut text, 1, "</default>");
        // What passes through what is told pair by pair.
        line(&mut text, 1, "<option><flag filterparent=\"disable\"/></option>");
        let parts = [
            ("asset", &self.meshes),
            ("worldbody", &self.bodies),
            ("contact", &self.excluded()?),
            ("actuator", &self.motors()?),
        ];
        for (element, inside) in parts.into_iter().filter(|(_, inside)| !inside.is_empty()) {
            line(&mut text, 1, &format!("<{element}>"));
            text += inside;
            line(&mut text, 1, &format!("</{element}>"));
        }
        line(&mut text, 0, "</mujoco>");
        Ok(text)
    }

    /// The pairs of links that pass through one another; what has no solids meets nothing anyway.
    fn excluded(&self) -> Result<String, RobotError> {
        let tree = Tree::of(self.description)?;
        let meeting = Meeting::of(self.description, &tree)?;
        let links = &self.description.links;
        let mut text = String::new();
        for (one, other) in meeting.apart.links {
            let [one, other] = [one, other].map(|link| &links[usize::from(link)]);
            if !one.solids.is_empty() && !other.solids.is_empty() {
                let (one, other) = (body_name(one)?, body_name(other)?);
                line(&mut text, 2, &format!("<exclude body1=\"{one}\" body2=\"{other}\"/>"));
            }
        }
        Ok(text)
    }

    fn motors(&self) -> Result<String, RobotError> {
        let mut text = String::new();
        for joint in self.description.joints.iter().filter(|joint| joint.kind != JointKind::Fixed) {
            let name = escaped("a joint", &joint.name)?;
            let range = match joint.effort {
                Some(0.0) => continue,
                Some(most) => format!(" forcerange=\"{} {most}\"", -most),
                None => String::new(),
            };
            line(&mut text, 2, &format!("<motor name=\"{name}\" joint=\"{name}\"{range}/>"));
        }
        Ok(text)
    }

    /// The link on which everything hangs, and all that does.
    fn top(&mut self, root: &'a LinkDescription) -> Result<(), RobotError> {
        let is_free = self.description.base == Base::Free;
        if !is_free && root.name == WORLD && root.mass == 0.0 && root.solids.is_empty() {
            return self.below(root, 2, &format!(" childclass=\"{CLASS}\""));
        }
        let name = body_name(root)?;
        line(&mut self.bodies, 2, &format!("<body name=\"{name}\" childclass=\"{CLASS}\">"));
        if is_free {
            line(&mut self.bodies, 3, "<freejoint/>");
        }
        self.inside(root, 3)?;
        line(&mut self.bodies, 2, "</body>");
        Ok(())
    }

    /// What a body holds: its mass, its solids, and what hangs on it; so many levels in.
    fn inside(&mut self, link: &'a LinkDescription, level: usize) -> Result<(), RobotError> {
        if link.mass > 0.0 {
            let lump = Lump::of(link, &Pose::identity());
            let (place, mass, inertia) = (numbers(lump.center.as_slice()), lump.mass, inertia(&lump.inertia));
            let inertial = format!("<inertial pos=\"{place}\" mass=\"{mass}\" {inertia}/>");
            line(&mut self.bodies, level, &inertial);
        }
        for solid in &link.solids {
            let geom = self.geom(solid);
            line(&mut self.bodies, level, &format!("<geom {geom}/>"));
        }
        self.below(link, level, "")
    }

    /// The bodies that hang on a link; those directly below it have such attributes.
    fn below(&mut self, link: &LinkDescription, level: usize, attributes: &str) -> Result<(), RobotError> {
        for joint in self.joints.remove(link.name.as_str()).unwrap_or_default() {
            // Validated: every joint names links that are there.
            let Some(child) = self.links.get(joint.child.as_str()).copied() else { continue };
            let (name, place) = (body_name(child)?, pose(&joint.parent_from_joint));
            line(&mut self.bodies, level, &format!("<body name=\"{name}\"{place}{attributes}>"));
            if joint.kind != JointKind::Fixed {
                line(&mut self.bodies, level + 1, &format!("<joint {}/>", hinge(joint)?));
            }
            self.inside(child, level + 1)?;
            line(&mut self.bodies, level, "</body>");
        }
        Ok(())
    }

    fn geom(&mut self, solid: &LinkSolid) -> String {
        let (kind, size) = match &solid.form {
            Form::Box { size } => ("box", (size * 0.5).as_slice().to_vec()),
            Form::Cylinder { radius, length } => ("cylinder", vec![*radius, length * 0.5]),
            Form::Sphere { radius } => ("sphere", vec![*radius]),
            // A capsule without a middle is a ball, and no capsule to MuJoCo.
            Form::Capsule { radius, length } if *length < 2.0 * LEAST => ("sphere", vec![*radius]),
            Form::Capsule { radius, length } => ("capsule", vec![*radius, length * 0.5]),
            Form::Convex { points } => ("mesh", self.mesh(points)),
        };
        let form = match kind {
            "mesh" => format!("mesh=\"mesh {}\"", self.count),
            _ => {
                format!("size=\"{}\"", numbers(&size.iter().map(|size| size.max(LEAST)).collect::<Vec<_>>()))
            }
        };
        let (friction, Kinds { own, met }) = (solid.material.friction(), solid.kinds);
        let kinds = match (own, met) {
            (1, 1) => String::new(),
            _ => format!(" contype=\"{own}\" conaffinity=\"{met}\""),
        };
        let color = solid.color.map(|color| format!(" rgba=\"{} 1\"", numbers(&values_of(color))));
        let place = pose(&solid.link_from_solid);
        format!("type=\"{kind}\" {form}{place} friction=\"{friction}\"{kinds}{}", color.unwrap_or_default())
    }

    /// Adds a convex solid as a mesh of its corners, which has no size beside.
    fn mesh(&mut self, points: &[Vector3]) -> Vec<f64> {
        self.count += 1;
        let corners: Vec<f64> = points.iter().flat_map(|point| point.iter().copied()).collect();
        let (name, corners) = (self.count, numbers(&corners));
        line(&mut self.meshes, 2, &format!("<mesh name=\"mesh {name}\" vertex=\"{corners}\"/>"));
        Vec::new()
    }
}

/// Adds a line so many levels in.
fn line(text: &mut String, level: usize, content: &str) {
    *text += &"  ".repeat(level);
    *text += content;
    text.push('\n');
}

/// The attributes of a joint that moves.
fn hinge(joint: &JointDescription) -> Result<String, RobotError> {
    let name = escaped("a joint", &joint.name)?;
    let kind = if joint.kind == JointKind::Prismatic { "slide" } else { "hinge" };
    let axis = numbers(joint.axis.as_slice());
    let mut attributes = vec![format!("name=\"{name}\" type=\"{kind}\" axis=\"{axis}\"")];
    attributes.extend(joint.ends().map(|ends| format!("range=\"{}\"", numbers(&ends))));
    let [stiffness, rest] = joint.spring;
    let others = [
        ("damping", joint.damping),
        ("frictionloss", joint.friction),
        ("armature", joint.armature),
        ("stiffness", stiffness),
        ("springref", rest),
    ];
    let others = others.into_iter().filter(|(_, value)| *value != 0.0);
    attributes.extend(others.map(|(attribute, value)| format!("{attribute}=\"{value}\"")));
    Ok(attributes.join(" "))
}

/// The shortest texts that read as the same numbers.
fn numbers(numbers: &[f64]) -> String {
    let texts: Vec<String> = numbers.iter().map(f64::to_string).collect();
    texts.join(" ")
}

/// The attributes of a place, as far as it is another than the origin.
fn pose(pose: &Pose) -> String {
    let place = (pose.translation.vector != Vector3::zeros())
        .then(|| format!(" pos=\"{}\"", numbers(pose.translation.vector.as_slice())));
    let q = &pose.rotation;
    let turn =
        (*q != UnitQuaternion::identity()).then(|| format!(" quat=\"{}\"", numbers(&[q.w, q.i, q.j, q.k])));
    [place, turn].into_iter().flatten().collect()
}

fn inertia(inertia: &Matrix3<f64>) -> String {
    let at = |row, column| inertia[(row, column)];
    let (diagonal, others) = ([at(0, 0), at(1, 1), at(2, 2)], [at(0, 1), at(0, 2), at(1, 2)]);
    if others == [0.0; 3] {
        return format!("diaginertia=\"{}\"", numbers(&diagonal));
    }
    format!("fullinertia=\"{}\"", numbers(&[diagonal, others].concat()))
}

/// The name of a link that is a body.
fn body_name(link: &LinkDescription) -> Result<String, RobotError> {
    if link.name == WORLD {
        let (place, what) = (format!("link {WORLD:?}"), "a link of this name".to_owned());
        let mend = "MJCF calls so what stands still: rename it";
        return Err(RobotError::Unsupported { place, what, mend });
    }
    escaped("a link", &link.name)
}

/// A name as the value of an attribute.
fn escaped(of: &str, name: &str) -> Result<String, RobotError> {
    let mut text = String::with_capacity(name.len());
    for letter in name.chars() {
        match letter {
            '&' => text += "&amp;",
            '<' => text += "&lt;",
            '"' => text += "&quot;",
            // As such a reader would take them for spaces.
            '\t' => text += "&#9;",
            '\n' => text += "&#10;",
            '\r' => text += "&#13;",
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => {
                let (place, what) =
                    (format!("the name of {of}, {name:?}"), format!("the character {letter:?}"));
                return Err(RobotError::Unsupported { place, what, mend: "XML does not have it: rename it" });
            }
            other => text.push(other),
        }
    }
    Ok(text)
}
