//! Robots from MJCF, the format of `MuJoCo` (mujoco.readthedocs.io, XML reference): one tree of bodies with its joints, geoms,
//! inertias, classes of defaults, and the motors of its joints.
//!
//! ```
//! use simworld_physics::robot::{ImportOptions, mjcf};
//!
//! let text = r#"<mujoco model="pendulum"><worldbody>
//!   <body name="rod"><joint name="hinge" axis="0 1 0"/><geom type="sphere" size="0.05" pos="0 0 -1" mass="1"/></body>
//! </worldbody><actuator><motor joint="hinge" forcerange="-5 5"/></actuator></mujoco>"#;
//! let read = mjcf::from_str(text, &ImportOptions::default())?;
//! assert_eq!(read.description.joints[0].effort, Some(5.0));
//! # Ok::<(), simworld_physics::RobotError>(())
//! ```
//!
//! The frame of a link has its origin at its first joint, where that of its body may have it elsewhere. A body with a free joint
//! moves freely; any other one hangs on a link `world` that stands still. A joint without an actuator has no motor. Geoms of one
//! robot meet as `contype`, `conaffinity`, `exclude` and the rule for parents and children say, unless their bodies are within one
//! another where the joints rest, which the report then says. A link is seen as its geoms of the groups that a viewer shows by itself, 0 to 2, meshes as their
//! surfaces; one without any, as what is met of it. Textures, tendons, equalities, sensors and other contact settings are passed over.
//! [`to_string`] writes a robot as such a file.

use std::collections::BTreeMap;

use roxmltree::Node;
use simworld_core::geometry::{Pose, Vector3};

use super::mjcf_read::Settings;
use super::xml::{child, children, exactly, parse, place, shortened};
use super::{ImportOptions, Imported, Reading, finish};
use crate::robot::description::{Base, JointDescription, JointKind, LinkDescription};
pub use crate::robot::mjcf_write::to_string;
use crate::robot::{RobotDescription, RobotError};

/// The link that everything hangs on that does not move freely.
pub(super) const WORLD: &str = "world";

/// Reads a robot from the text of a file.
///
/// # Errors
/// What is wrong first, with line and column.
pub fn from_str(text: &str, options: &ImportOptions) -> Result<Imported, RobotError> {
    let document = parse(text, &options.limits)?;
    let root = document.root_element();
    if !root.has_tag_name("mujoco") {
        let what = format!("a document that begins with <{}>", shortened(root.tag_name().name()));
        return Err(RobotError::Unsupported { place: place(root), what, mend: "MJCF begins with <mujoco>" });
    }
    if let Some(include) = document.descendants().find(|node| node.has_tag_name("include")) {
        let mend = "put the contents of the file in its place";
        return Err(RobotError::Unsupported { place: place(include), what: "<include>".to_owned(), mend });
    }
    let mut reading = Reading::new(options);
    let settings = Settings::of(root)?;
    let mut tree = Bodies {
        settings: &settings,
        reading: &mut reading,
        description: RobotDescription {
            name: root.attribute("model").unwrap_or_default().to_owned(),
            ..RobotDescription::default()
        },
    };
    tree.read(root)?;
    let mut description = tree.description;
    let gains = super::mjcf_motors::read(root, &settings, &mut description, &mut reading)?;
    pass_over(root, &mut reading);
    if let Some(base) = options.base {
        description.base = base;
    }
    super::mjcf_contacts::read(root, &mut description, &mut reading)?;
    finish(description, reading, gains)
}

fn pass_over(root: Node<'_, '_>, reading: &mut Reading<'_>) {
    for node in root.children().filter(Node::is_element) {
        let name = node.tag_name().name();
        if matches!(name, "tendon" | "equality" | "deformable" | "extension") {
            reading.note(place(node), "is passed over");
        }
    }
}

/// The bodies on the way.
struct Bodies<'a, 'b, 'o> {
    settings: &'a Settings<'a>,
    reading: &'b mut Reading<'o>,
    description: RobotDescription,
}

/// Where a body is read.
struct Spot<'n> {
    /// The link that it hangs on, and where the frame of the body above sits in that.
    parent: String,
    link_from_body: Pose,
    class: Option<&'n str>,
}

impl Bodies<'_, '_, '_> {
    fn read(&mut self, root: Node<'_, '_>) -> Result<(), RobotError> {
        let worlds: Vec<_> = children(root, "worldbody").collect();
        let tops: Vec<_> = worlds.iter().flat_map(|world| children(*world, "body")).collect();
        let [top] = tops[..] else {
            let names: Vec<_> = tops.iter().take(4).map(|body| place(*body)).collect();
            return Err(RobotError::Roots { found: tops.len(), names: names.join(", ") });
        };
        if worlds.iter().any(|world| child(*world, "geom").is_some()) {
            self.reading
                .note(place(worlds[0]), "geoms of the world are passed over: the city has its own ground");
        }
        let class = top.attribute("childclass");
        if is_free(top) {
            self.description.base = Base::Free;
            let link = self.link(top, &Pose::identity(), class)?;
            let name = link.name.clone();
            self.description.links.push(link);
            return self.below(top, &Spot { parent: name, link_from_body: Pose::identity(), class }, 0);
        }
        self.description.base = Base::Fixed;
        self.description.links.push(LinkDescription::new(WORLD));
        let spot = Spot { parent: WORLD.to_owned(), link_from_body: Pose::identity(), class: None };
        self.body(top, &spot, 0)
    }

    /// The bodies within one; the depth of the file is bounded, and so is this.
    fn below(&mut self, node: Node<'_, '_>, spot: &Spot<'_>, depth: usize) -> Result<(), RobotError> {
        children(node, "body").try_for_each(|inner| self.body(inner, spot, depth + 1))
    }

    fn body(&mut self, node: Node<'_, '_>, spot: &Spot<'_>, depth: usize) -> Result<(), RobotError> {
        let class = node.attribute("childclass").or(spot.class);
        let link_from_body = spot.link_from_body * self.settings.pose(node, &|name| node.attribute(name))?;
        let joints: Vec<_> = node
            .children()
            .filter(|inner| inner.has_tag_name("joint") || inner.has_tag_name("freejoint"))
            .collect();
        let name = Self::name_of(node, "body");
        let Some((last, before)) = joints.split_last() else {
            let weld =
                JointDescription::new(&format!("{name} (fixed)"), JointKind::Fixed, [&spot.parent, &name]);
            self.description.joints.push(JointDescription { parent_from_joint: link_from_body, ..weld });
            let link = self.link(node, &Pose::identity(), class)?;
            self.description.links.push(link);
            let spot = Spot { parent: name, link_from_body: Pose::identity(), class };
            return self.below(node, &spot, depth);
        };
        // Several joints of one body are a chain with empty links between; each frame has its origin at its joint.
        let (mut parent, mut parent_from_body) = (spot.parent.clone(), link_from_body);
        for (at, joint) in before.iter().chain([last]).enumerate() {
            let is_last = at + 1 == joints.len();
            let child = if is_last { name.clone() } else { format!("{name} ({at})") };
            let anchor = self.joint(*joint, (&parent, &child), &parent_from_body, class)?;
            parent_from_body = Pose::translation(-anchor.x, -anchor.y, -anchor.z);
            if !is_last {
                self.description.links.push(LinkDescription::new(&child));
            }
            parent = child;
        }
        let link = self.link(node, &parent_from_body, class)?;
        self.description.links.push(link);
        self.below(node, &Spot { parent: name, link_from_body: parent_from_body, class }, depth)
    }

    fn name_of(node: Node<'_, '_>, kind: &str) -> String {
        node.attribute("name").map_or_else(|| format!("{kind} at {}", node.range().start), str::to_owned)
    }

    /// Reads a joint; its anchor in the frame of the body is returned.
    fn joint(
        &mut self,
        node: Node<'_, '_>,
        (parent, child): (&str, &str),
        parent_from_body: &Pose,
        class: Option<&str>,
    ) -> Result<Vector3, RobotError> {
        let class = self.settings.class(node, class, "joint")?;
        let kind = match class.get("type").unwrap_or("hinge") {
            _ if node.has_tag_name("freejoint") => return Err(misplaced(node)),
            "free" => return Err(misplaced(node)),
            "hinge" => JointKind::Revolute,
            "slide" => JointKind::Prismatic,
            other => {
                let what = format!("the type {:?}", shortened(other));
                let mend = "give hinge, slide or free; three hinges of one body stand for a ball";
                return Err(RobotError::Unsupported { place: place(node), what, mend });
            }
        };
        let anchor: Vector3 = class.exactly::<3>("pos")?.unwrap_or_default().into();
        let name = Self::name_of(node, "joint");
        let mut joint = JointDescription::new(&name, kind, [parent, child]);
        joint.parent_from_joint = parent_from_body * Pose::translation(anchor.x, anchor.y, anchor.z);
        joint.axis = class.exactly::<3>("axis")?.unwrap_or([0.0, 0.0, 1.0]).into();
        let scale = if kind == JointKind::Revolute { self.settings.angle } else { 1.0 };
        joint.limits = class.range("range", "limited", self.settings.autolimits)?;
        joint.limits = joint.limits.map(|ends| ends.map(|end| end * scale));
        if joint.limits.is_none() && kind == JointKind::Revolute {
            joint.kind = JointKind::Continuous;
        }
        joint.damping = class.number("damping")?.unwrap_or(0.0);
        joint.friction = class.number("frictionloss")?.unwrap_or(0.0);
        joint.armature = class.number("armature")?.unwrap_or(0.0);
        let rest = class.number("springref")?.unwrap_or(0.0) * scale;
        joint.spring = [class.number("stiffness")?.unwrap_or(0.0), rest];
        joint.effort = Some(0.0);
        if class.number("ref")?.is_some_and(|place| place != 0.0) {
            self.reading
                .note(place(node), "positions are counted from where the file draws the body, not from ref");
        }
        self.description.joints.push(joint);
        Ok(anchor)
    }

    /// The link of a body, whose frame sits so in that of the link.
    fn link(
        &mut self,
        node: Node<'_, '_>,
        link_from_body: &Pose,
        class: Option<&str>,
    ) -> Result<LinkDescription, RobotError> {
        let mut link = LinkDescription::new(&Self::name_of(node, "body"));
        let mut masses = super::mjcf_read::Masses::default();
        // What is seen alone lends its colour to what is met.
        let (mut seen, mut visuals) = (None, Vec::new());
        for geom in children(node, "geom") {
            let class = self.settings.class(geom, class, "geom")?;
            let solid = super::mjcf_geoms::read(&class, self.settings, self.reading, link_from_body)?;
            masses.add(&solid);
            visuals.extend(solid.visuals);
            if solid.meets {
                link.solids.extend(solid.solids);
            } else {
                seen = seen.or(solid.color);
            }
        }
        super::color::lend(&mut link.solids, seen);
        super::see(&mut link, visuals);
        match child(node, "inertial") {
            Some(inertial) => self.settings.inertial(inertial, &mut link, link_from_body, self.reading)?,
            None => masses.give(&mut link),
        }
        Ok(link)
    }
}

/// Whether a body moves freely.
fn is_free(body: Node<'_, '_>) -> bool {
    child(body, "freejoint").is_some()
        || children(body, "joint").any(|joint| joint.attribute("type") == Some("free"))
}

fn misplaced(node: Node<'_, '_>) -> RobotError {
    let mend = "only the body that all others hang on may be free, and it has no other joints";
    RobotError::Unsupported { place: place(node), what: "a free joint here".to_owned(), mend }
}

/// Gains by joint, for [`Imported::gains`].
pub(super) type Gains = BTreeMap<String, [f64; 2]>;

/// One number of an attribute, if it is there.
pub(super) fn one(
    node: Node<'_, '_>,
    attribute: &str,
    text: Option<&str>,
) -> Result<Option<f64>, RobotError> {
    Ok(exactly::<1>(node, attribute, text)?.map(|[number]| number))
}
