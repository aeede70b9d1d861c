//! What holds all over an MJCF file: angles, classes of defaults, places, inertias.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Quaternion, UnitQuaternion};
use roxmltree::Node;
use simworld_core::geometry::{Pose, Vector3};

use super::Reading;
use super::mjcf::one;
use super::mjcf_geoms::Geom;
use super::xml::{children, exactly, numbers, place, shortened};
use crate::robot::RobotError;
use crate::robot::description::LinkDescription;

/// What the compiler of the file is told, and its classes.
pub(super) struct Settings<'n> {
    /// How many radians the angles of the file are.
    pub(super) angle: f64,
    /// Whether a range alone is a limit.
    pub(super) autolimits: bool,
    /// Axes of `euler`, small ones turn with the body.
    euler: [char; 3],
    /// Folder of the meshes.
    pub(super) meshes: &'n str,
    /// Assets of the kind mesh, by name.
    pub(super) mesh_assets: BTreeMap<&'n str, Node<'n, 'n>>,
    /// Assets of the kind material, by name.
    pub(super) material_assets: BTreeMap<&'n str, Node<'n, 'n>>,
    /// Attributes by class and element.
    classes: BTreeMap<&'n str, Defaults<'n>>,
}

type Defaults<'n> = BTreeMap<&'n str, BTreeMap<&'n str, &'n str>>;

/// The attributes of an element with those of its class.
pub(super) struct Class<'a, 'n> {
    pub(super) node: Node<'a, 'a>,
    defaults: Option<&'a BTreeMap<&'n str, &'n str>>,
}

impl<'a> Class<'a, '_> {
    pub(super) fn get(&self, attribute: &str) -> Option<&'a str> {
        self.node.attribute(attribute).or_else(|| self.defaults?.get(attribute).copied())
    }

    pub(super) fn number(&self, attribute: &str) -> Result<Option<f64>, RobotError> {
        one(self.node, attribute, self.get(attribute))
    }

    pub(super) fn exactly<const N: usize>(&self, attribute: &str) -> Result<Option<[f64; N]>, RobotError> {
        exactly::<N>(self.node, attribute, self.get(attribute))
    }

    /// A range that counts: because something says that it is a limit, or because it is there.
    pub(super) fn range(
        &self,
        range: &str,
        limited: &str,
        autolimits: bool,
    ) -> Result<Option<[f64; 2]>, RobotError> {
        let given = self.exactly::<2>(range)?;
        match self.get(limited).unwrap_or("auto") {
            "true" => Ok(Some(given.unwrap_or_default())),
            "false" => Ok(None),
            _ => Ok(given.filter(|_| autolimits)),
        }
    }
}

impl<'n> Settings<'n> {
    pub(super) fn of(root: Node<'n, 'n>) -> Result<Self, RobotError> {
        let mut settings = Self {
            angle: std::f64::consts::PI / 180.0,
            autolimits: true,
            euler: ['x', 'y', 'z'],
            meshes: "",
            mesh_assets: BTreeMap::new(),
            material_assets: BTreeMap::new(),
            classes: BTreeMap::new(),
        };
        for compiler in children(root, "compiler") {
            match compiler.attribute("angle") {
                None | Some("degree") => {}
                Some("radian") => settings.angle = 1.0,
                Some(other) => return Err(wrong(compiler, "angle", other, "degree or radian")),
            }
            settings.autolimits &= compiler.attribute("autolimits") != Some("false");
            settings.meshes = compiler.attribute("meshdir").or(compiler.attribute("assetdir")).unwrap_or("");
            if let Some(axes) = compiler.attribute("eulerseq") {
                let axes: Vec<char> = axes.chars().collect();
                settings.euler = <[char; 3]>::try_from(axes)
                    .ok()
                    .filter(|axes| axes.iter().all(|axis| "xyzXYZ".contains(*axis)))
                    .ok_or_else(|| wrong(compiler, "eulerseq", "", "three of x, y, z, X, Y and Z"))?;
            }
        }
        for mesh in children(root, "asset").flat_map(|asset| children(asset, "mesh")) {
            let file = mesh.attribute("file").unwrap_or_default();
            let stem = file.rsplit('/').next().and_then(|file| file.split('.').next()).unwrap_or_default();
            settings.mesh_assets.insert(mesh.attribute("name").unwrap_or(stem), mesh);
        }
        let materials = children(root, "asset").flat_map(|asset| children(asset, "material"));
        settings.material_assets =
            materials.filter_map(|material| Some((material.attribute("name")?, material))).collect();
        for default in children(root, "default") {
            settings.learn(default, &Defaults::new());
        }
        Ok(settings)
    }

    /// Takes up a class and those within it; the depth of the file is bounded, and so is this.
    fn learn(&mut self, node: Node<'n, 'n>, above: &Defaults<'n>) {
        let mut here = above.clone();
        for element in node.children().filter(|inner| inner.is_element() && !inner.has_tag_name("default")) {
            let known = here.entry(element.tag_name().name()).or_default();
            known.extend(element.attributes().map(|attribute| (attribute.name(), attribute.value())));
        }
        for inner in children(node, "default") {
            self.learn(inner, &here);
        }
        self.classes.insert(node.attribute("class").unwrap_or("main"), here);
    }

    /// An element with the attributes of its class, or of the one that holds where it stands.
    pub(super) fn class<'a>(
        &'a self,
        node: Node<'a, 'a>,
        around: Option<&str>,
        element: &str,
    ) -> Result<Class<'a, 'n>, RobotError> {
        let name = node.attribute("class").or(around);
        let known = self.classes.get(name.unwrap_or("main"));
        if let (Some(name), None) = (name, known) {
            let (place, name) = (place(node), shortened(name));
            return Err(RobotError::Unknown { place, kind: "class of defaults", name });
        }
        Ok(Class { node, defaults: known.and_then(|known| known.get(element)) })
    }

    /// Where something sits, by its attributes.
    pub(super) fn pose<'a>(
        &self,
        node: Node<'_, '_>,
        get: &dyn Fn(&str) -> Option<&'a str>,
    ) -> Result<Pose, RobotError> {
        let place: Vector3 = exactly::<3>(node, "pos", get("pos"))?.unwrap_or_default().into();
        Ok(Pose::from_parts(place.into(), self.turn(node, get)?))
    }

    fn turn<'a>(
        &self,
        node: Node<'_, '_>,
        get: &dyn Fn(&str) -> Option<&'a str>,
    ) -> Result<UnitQuaternion<f64>, RobotError> {
        let short = |attribute: &str| wrong(node, attribute, "", "directions that are not 0");
        if let Some([w, x, y, z]) = exactly::<4>(node, "quat", get("quat"))? {
            let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9);
            return turn.ok_or_else(|| short("quat"));
        }
        if let Some([x, y, z, angle]) = exactly::<4>(node, "axisangle", get("axisangle"))? {
            let axis =
                nalgebra::Unit::try_new(Vector3::new(x, y, z), 1e-9).ok_or_else(|| short("axisangle"))?;
            return Ok(UnitQuaternion::from_axis_angle(&axis, angle * self.angle));
        }
        if let Some(angles) = exactly::<3>(node, "euler", get("euler"))? {
            return Ok(self.euler.iter().zip(angles).fold(
                UnitQuaternion::identity(),
                |turn, (axis, angle)| {
                    let along = match axis.to_ascii_lowercase() {
                        'x' => Vector3::x_axis(),
                        'y' => Vector3::y_axis(),
                        _ => Vector3::z_axis(),
                    };
                    let next = UnitQuaternion::from_axis_angle(&along, angle * self.angle);
                    if axis.is_ascii_lowercase() { turn * next } else { next * turn }
                },
            ));
        }
        if let Some([a, b, c, d, e, f]) = exactly::<6>(node, "xyaxes", get("xyaxes"))? {
            let x = Vector3::new(a, b, c).try_normalize(1e-9).ok_or_else(|| short("xyaxes"))?;
            let y = Vector3::new(d, e, f);
            let y = (y - x * x.dot(&y)).try_normalize(1e-9).ok_or_else(|| short("xyaxes"))?;
            let axes = Matrix3::from_columns(&[x, y, x.cross(&y)]);
            return Ok(UnitQuaternion::from_matrix(&axes));
        }
        if let Some(axis) = exactly::<3>(node, "zaxis", get("zaxis"))? {
            let axis = Vector3::from(axis).try_normalize(1e-9).ok_or_else(|| short("zaxis"))?;
            return Ok(along_z(&axis));
        }
        Ok(UnitQuaternion::identity())
    }

    /// Mass and inertia of a link that the file gives.
    pub(super) fn inertial(
        &self,
        node: Node<'_, '_>,
        link: &mut LinkDescription,
        link_from_body: &Pose,
        reading: &mut Reading<'_>,
    ) -> Result<(), RobotError> {
        let pose = link_from_body * self.pose(node, &|name| node.attribute(name))?;
        link.mass = one(node, "mass", node.attribute("mass"))?.ok_or_else(|| RobotError::Missing {
            place: place(node),
            what: "mass".to_owned(),
            mend: "give it in kg, or leave <inertial> out",
        })?;
        link.center = pose.translation.vector;
        let full = exactly::<6>(node, "fullinertia", node.attribute("fullinertia"))?;
        let diagonal = exactly::<3>(node, "diaginertia", node.attribute("diaginertia"))?;
        let matrix = match (full, diagonal) {
            (Some([xx, yy, zz, xy, xz, yz]), _) => Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
            (None, Some(diagonal)) => Matrix3::from_diagonal(&diagonal.into()),
            (None, None) => Matrix3::zeros(),
        };
        if matrix.amax() == 0.0 && link.mass > 0.0 {
            reading.note(place(node), "has no inertia: that of a ball as dense as water is taken");
        }
        let turn = pose.rotation.to_rotation_matrix();
        let turned = turn.matrix() * matrix * turn.matrix().transpose();
        link.inertia = (turned + turned.transpose()) * 0.5;
        Ok(())
    }
}

/// The rotation that takes z to a direction of length 1 on the shortest way.
pub(super) fn along_z(axis: &Vector3) -> UnitQuaternion<f64> {
    if axis.z < -1.0 + 1e-12 {
        return UnitQuaternion::new_unchecked(Quaternion::new(0.0, 1.0, 0.0, 0.0));
    }
    UnitQuaternion::new_normalize(Quaternion::from_parts(1.0 + axis.z, Vector3::z().cross(axis)))
}

/// An attribute that says something else than it may.
pub(super) fn wrong(node: Node<'_, '_>, attribute: &str, value: &str, allowed: &'static str) -> RobotError {
    RobotError::Text { place: place(node), attribute: attribute.to_owned(), value: shortened(value), allowed }
}

/// The numbers of an attribute, as many as there are.
pub(super) fn some(class: &Class<'_, '_>, attribute: &str) -> Result<Vec<f64>, RobotError> {
    class.get(attribute).map_or(Ok(Vec::new()), |text| numbers(class.node, attribute, text))
}

/// The masses of the geoms of a body, for one without an `inertial`.
#[derive(Default)]
pub(super) struct Masses {
    parts: Vec<(f64, Vector3, Matrix3<f64>)>,
}

impl Masses {
    pub(super) fn add(&mut self, geom: &Geom) {
        self.parts.extend(geom.masses.iter().copied());
    }

    pub(super) fn give(&self, link: &mut LinkDescription) {
        let mass: f64 = self.parts.iter().map(|(mass, ..)| mass).sum();
        if mass <= 0.0 {
            return;
        }
        let center = self.parts.iter().map(|(mass, center, _)| center * *mass).sum::<Vector3>() / mass;
        let inertia = self.parts.iter().map(|(mass, place, inertia)| {
            let arm = place - center;
            inertia + (Matrix3::identity() * arm.norm_squared() - arm * arm.transpose()) * *mass
        });
        let inertia = inertia.sum::<Matrix3<f64>>();
        (link.mass, link.center, link.inertia) = (mass, center, (inertia + inertia.transpose()) * 0.5);
    }
}
