//! Robots from URDF, the format of ROS (wiki.ros.org/urdf/XML): links with masses and collision geometry, and joints that are
//! fixed, revolute, continuous or prismatic.
//!
//! ```
//! use simworld_physics::robot::{ImportOptions, urdf};
//!
//! let text = r#"<robot name="pendulum">
//!   <link name="world"/>
//!   <link name="rod">
//!     <inertial><origin xyz="0 0 -1"/><mass value="1"/>
//!       <inertia ixx="1e-6" ixy="0" ixz="0" iyy="1e-6" iyz="0" izz="1e-6"/></inertial>
//!   </link>
//!   <joint name="hinge" type="continuous">
//!     <parent link="world"/><child link="rod"/><axis xyz="0 1 0"/><limit effort="5" velocity="20"/>
//!   </joint>
//! </robot>"#;
//! let read = urdf::from_str(text, &ImportOptions::default())?;
//! assert_eq!(read.description.joints[0].effort, Some(5.0));
//! assert!(read.report.is_empty());
//! # Ok::<(), simworld_physics::RobotError>(())
//! ```
//!
//! A first link that is called `world` stands still, any other moves freely, unless the options say otherwise. A link is seen as its
//! visuals, in their colours; one of which any cannot be drawn (another kind of mesh than STL and OBJ, no folder), or without any, is seen as what is
//! met of it, in the colour of its first visual that says one. Textures, transmissions, sensors and what simulators add are passed over. Links that
//! no joint holds together meet one another, unless they are within one another where the joints rest, which the report then says.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, UnitQuaternion};
use roxmltree::Node;
use simworld_core::asset::Material;
use simworld_core::geometry::{Pose, Vector3};

use super::xml::{child, children, exactly, number, parse, place, required, shortened};
use super::{ImportOptions, Imported, Reading, color, finish, mesh, see};
use crate::robot::description::{Base, Form, JointDescription, JointKind, LinkDescription, LinkSolid};
use crate::robot::{Kinds, LinkVisual, RobotDescription, RobotError, Surface, VisualForm};

/// Reads a robot from the text of a file.
///
/// # Errors
/// What is wrong first, with line and column.
pub fn from_str(text: &str, options: &ImportOptions) -> Result<Imported, RobotError> {
    let document = parse(text, &options.limits)?;
    let root = document.root_element();
    if !root.has_tag_name("robot") {
        let what = format!("a document that begins with <{}>", shortened(root.tag_name().name()));
        return Err(RobotError::Unsupported { place: place(root), what, mend: "URDF begins with <robot>" });
    }
    let mut reading = Reading::new(options);
    let mut description = RobotDescription {
        name: root.attribute("name").unwrap_or_default().to_owned(),
        ..RobotDescription::default()
    };
    let palette = palette_of(root)?;
    for node in root.children().filter(Node::is_element) {
        match node.tag_name().name() {
            "link" => description.links.push(link(node, &palette, &mut reading)?),
            "joint" => description.joints.push(joint(node, &mut reading)?),
            "material" | "transmission" | "gazebo" | "sensor" => {}
            other => {
                let what = format!("<{}> is passed over", shortened(other));
                reading.note(place(node), what);
            }
        }
    }
    description.base = options.base.unwrap_or_else(|| base_of(&description));
    finish(description, reading, BTreeMap::new())
}

fn base_of(description: &RobotDescription) -> Base {
    let hangs = |name: &str| description.joints.iter().any(|joint| joint.child == name);
    let first = description.links.iter().find(|link| !hangs(&link.name));
    if first.is_some_and(|link| link.name == "world") { Base::Fixed } else { Base::Free }
}

/// Where something sits, by its `origin`.
fn origin(node: Node<'_, '_>) -> Result<Pose, RobotError> {
    let Some(origin) = child(node, "origin") else { return Ok(Pose::identity()) };
    let [x, y, z] = exactly::<3>(origin, "xyz", origin.attribute("xyz"))?.unwrap_or_default();
    let [roll, pitch, yaw] = exactly::<3>(origin, "rpy", origin.attribute("rpy"))?.unwrap_or_default();
    let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    Ok(Pose::from_parts(Vector3::new(x, y, z).into(), turn))
}

/// Colours by name of their material.
type Palette<'a> = BTreeMap<&'a str, [f32; 3]>;

/// The materials of the whole file; those of visuals that say a colour have a name for others as well.
fn palette_of<'a>(root: Node<'a, '_>) -> Result<Palette<'a>, RobotError> {
    let mut palette = Palette::new();
    let visuals = children(root, "link").flat_map(|link| children(link, "visual"));
    let within = visuals.filter_map(|visual| child(visual, "material"));
    for material in within.chain(children(root, "material")) {
        if let (Some(name), Some(color)) = (material.attribute("name"), color_in(material)?) {
            palette.insert(name, color);
        }
    }
    Ok(palette)
}

/// The colour that stands within a material.
fn color_in(material: Node<'_, '_>) -> Result<Option<[f32; 3]>, RobotError> {
    let Some(node) = child(material, "color") else { return Ok(None) };
    node.attribute("rgba").map_or(Ok(None), |text| color::read(node, text))
}

/// The colour of what is seen of a link: of its first visual that has one.
fn seen_color(link: Node<'_, '_>, palette: &Palette<'_>) -> Result<Option<[f32; 3]>, RobotError> {
    for visual in children(link, "visual") {
        if let Some(color) = color_of(visual, palette)? {
            return Ok(Some(color));
        }
    }
    Ok(None)
}

/// The colour of a visual, if it says one.
fn color_of(visual: Node<'_, '_>, palette: &Palette<'_>) -> Result<Option<[f32; 3]>, RobotError> {
    let Some(material) = child(visual, "material") else { return Ok(None) };
    let named = || material.attribute("name").and_then(|name| palette.get(name)).copied();
    Ok(color_in(material)?.or_else(named))
}

fn link(
    node: Node<'_, '_>,
    palette: &Palette<'_>,
    reading: &mut Reading<'_>,
) -> Result<LinkDescription, RobotError> {
    let mut link = LinkDescription::new(required(node, "name", "give every link a name of its own")?);
    for collision in children(node, "collision") {
        let link_from_solid = origin(collision)?;
        let forms = match geometry(collision, reading)? {
            Geometry::Form(form) => vec![form],
            Geometry::Mesh { place, surface } => mesh::solids(reading, &place, surface.as_ref()),
        };
        for form in forms {
            let (material, kinds, color) = (Material::Plastic, Kinds::default(), None);
            link.solids.push(LinkSolid { form, link_from_solid, material, kinds, color });
        }
    }
    color::lend(&mut link.solids, seen_color(node, palette)?);
    see(&mut link, visuals(node, palette, reading));
    match child(node, "inertial") {
        Some(inertial) => weigh(&mut link, inertial, reading)?,
        None => reading.weigh(&mut link, &|| place(node)),
    }
    Ok(link)
}

fn weigh(
    link: &mut LinkDescription,
    node: Node<'_, '_>,
    reading: &mut Reading<'_>,
) -> Result<(), RobotError> {
    let frame = origin(node)?;
    let missing = |what: &str| RobotError::Missing {
        place: place(node),
        what: what.to_owned(),
        mend: "an <inertial> has <mass value=...> and <inertia ixx=... .../>",
    };
    let mass = child(node, "mass").ok_or_else(|| missing("<mass>"))?;
    link.mass = number(mass, "value")?.ok_or_else(|| missing("value of <mass>"))?;
    link.center = frame.translation.vector;
    let inertia = child(node, "inertia").ok_or_else(|| missing("<inertia>"))?;
    let part = |name| Ok::<f64, RobotError>(number(inertia, name)?.unwrap_or(0.0));
    let (xx, yy, zz) = (part("ixx")?, part("iyy")?, part("izz")?);
    let (xy, xz, yz) = (part("ixy")?, part("ixz")?, part("iyz")?);
    let matrix = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    let turn = frame.rotation.to_rotation_matrix();
    let turned = turn.matrix() * matrix * turn.matrix().transpose();
    // Exactly symmetric, whatever rounding left.
    link.inertia = (turned + turned.transpose()) * 0.5;
    if matrix.amax() == 0.0 && link.mass > 0.0 {
        reading.note(place(inertia), "is zero: that of a ball as dense as water is taken");
    } else if xx + yy < zz || yy + zz < xx || zz + xx < yy {
        reading
            .note(place(inertia), "is that of no body, since two moments are together less than the third");
    }
    Ok(())
}

/// What is seen of a link; nothing if any of it cannot be drawn, so that the link is seen as what is met.
fn visuals(link: Node<'_, '_>, palette: &Palette<'_>, reading: &mut Reading<'_>) -> Vec<LinkVisual> {
    let mut all = Vec::new();
    for visual in children(link, "visual").filter(|visual| child(*visual, "geometry").is_some()) {
        // What is only looked at makes no robot unfit.
        let seen = seen(visual, palette, reading).unwrap_or_else(|error| {
            reading.note(place(visual), error.to_string());
            None
        });
        let Some(seen) = seen.filter(|seen| seen.check(&|| place(visual)).is_ok()) else {
            reading.note(place(visual), "is not drawn: the link is seen as what is met of it");
            return Vec::new();
        };
        all.push(seen);
    }
    all
}

/// A visual, if it is read and there is anything to see.
fn seen(
    visual: Node<'_, '_>,
    palette: &Palette<'_>,
    reading: &mut Reading<'_>,
) -> Result<Option<LinkVisual>, RobotError> {
    let (link_from_visual, color) = (origin(visual)?, color_of(visual, palette)?);
    Ok(match geometry(visual, reading)? {
        Geometry::Form(form) => Some(LinkVisual { form: VisualForm::Solid(form), link_from_visual, color }),
        Geometry::Mesh { surface, .. } => {
            surface.and_then(|surface| reading.surface(&surface, &link_from_visual, color))
        }
    })
}

/// What a visual or a collision has the form of.
enum Geometry {
    Form(Form),
    /// A mesh, where it stands in the file, and its surface, if that was read.
    Mesh {
        place: String,
        surface: Option<Surface>,
    },
}

/// The geometry of a visual or a collision.
fn geometry(node: Node<'_, '_>, reading: &mut Reading<'_>) -> Result<Geometry, RobotError> {
    let geometry = child(node, "geometry").ok_or_else(|| RobotError::Missing {
        place: place(node),
        what: "<geometry>".to_owned(),
        mend: "say what form it has",
    })?;
    let Some(node) = geometry.children().find(Node::is_element) else {
        let what = "a form".to_owned();
        let mend = "give <box>, <cylinder>, <sphere>, <capsule> or <mesh>";
        return Err(RobotError::Missing { place: place(geometry), what, mend });
    };
    let length = |name| {
        number(node, name)?.ok_or_else(|| RobotError::Missing {
            place: place(node),
            what: String::from(name),
            mend: "give it in metres",
        })
    };
    Ok(Geometry::Form(match node.tag_name().name() {
        "box" => {
            let size = exactly::<3>(node, "size", Some(required(node, "size", "give three edges")?))?;
            Form::Box { size: size.unwrap_or_default().into() }
        }
        "cylinder" => Form::Cylinder { radius: length("radius")?, length: length("length")? },
        "capsule" => Form::Capsule { radius: length("radius")?, length: length("length")? },
        "sphere" => Form::Sphere { radius: length("radius")? },
        "mesh" => {
            let name = required(node, "filename", "name the file of the mesh")?;
            let scale = exactly::<3>(node, "scale", node.attribute("scale"))?.unwrap_or([1.0; 3]);
            let surface = mesh::read(reading, &place(node), name, scale)?;
            return Ok(Geometry::Mesh { place: place(node), surface });
        }
        other => {
            let what = format!("the form <{}>", shortened(other));
            let mend = "give <box>, <cylinder>, <sphere>, <capsule> or <mesh>";
            return Err(RobotError::Unsupported { place: place(node), what, mend });
        }
    }))
}

fn kind(node: Node<'_, '_>) -> Result<JointKind, RobotError> {
    match required(node, "type", "give revolute, continuous, prismatic or fixed")? {
        "fixed" => Ok(JointKind::Fixed),
        "revolute" => Ok(JointKind::Revolute),
        "continuous" => Ok(JointKind::Continuous),
        "prismatic" => Ok(JointKind::Prismatic),
        other => Err(RobotError::Unsupported {
            place: place(node),
            what: format!("the type {:?}", shortened(other)),
            mend: "give revolute, continuous, prismatic or fixed; several of them, with empty links between, stand for \
                   joints that move in more ways",
        }),
    }
}

fn joint(node: Node<'_, '_>, reading: &mut Reading<'_>) -> Result<JointDescription, RobotError> {
    let name = required(node, "name", "give every joint a name of its own")?;
    let kind = kind(node)?;
    let end = |tag: &str| {
        let missing =
            || RobotError::Missing { place: place(node), what: format!("<{tag}>"), mend: "name the link" };
        required(child(node, tag).ok_or_else(missing)?, "link", "name the link")
    };
    let mut joint = JointDescription::new(name, kind, [end("parent")?, end("child")?]);
    joint.parent_from_joint = origin(node)?;
    if let Some(axis) = child(node, "axis") {
        joint.axis = exactly::<3>(axis, "xyz", axis.attribute("xyz"))?.unwrap_or([1.0, 0.0, 0.0]).into();
    }
    if let Some(dynamics) = child(node, "dynamics") {
        joint.damping = number(dynamics, "damping")?.unwrap_or(0.0);
        joint.friction = number(dynamics, "friction")?.unwrap_or(0.0);
    }
    if kind != JointKind::Fixed {
        limit(node, &mut joint, reading)?;
    }
    if let Some(mimic) = child(node, "mimic") {
        reading.note(place(mimic), "nothing is followed: the joint is led like any other");
    }
    Ok(joint)
}

fn limit(
    node: Node<'_, '_>,
    joint: &mut JointDescription,
    reading: &mut Reading<'_>,
) -> Result<(), RobotError> {
    let Some(limit) = child(node, "limit") else {
        if joint.kind == JointKind::Continuous {
            reading.note(place(node), "has no <limit>: its motor gives as much as it takes");
            return Ok(());
        }
        let mend = "give <limit lower=... upper=... effort=... velocity=.../>, or the type continuous";
        return Err(RobotError::Missing { place: place(node), what: "<limit>".to_owned(), mend });
    };
    if joint.kind != JointKind::Continuous {
        let [low, high] = [number(limit, "lower")?, number(limit, "upper")?].map(|end| end.unwrap_or(0.0));
        joint.limits = Some([low, high]);
        if low == high {
            reading.note(place(limit), "leaves the joint no way to go");
        }
    }
    joint.effort = number(limit, "effort")?;
    if joint.effort.is_none() {
        reading.note(place(limit), "has no effort: the motor gives as much as it takes");
    }
    joint.velocity = number(limit, "velocity")?;
    if joint.velocity == Some(0.0) {
        joint.velocity = None;
        reading.note(place(limit), "has a velocity of 0: it is taken as none");
    }
    Ok(())
}
