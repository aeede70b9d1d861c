//! Geoms of MJCF: solids with their masses.

use nalgebra::{Matrix3, UnitQuaternion};
use rapier3d_f64::math::Vector;
use roxmltree::Node;
use simworld_core::asset::Material;
use simworld_core::geometry::{Pose, Vector3};

use super::mjcf_read::{Class, Settings, along_z, some, wrong};
use super::xml::{numbers_up_to, place, shortened};
use super::{Reading, WATER, color, mesh};
use crate::convert::from_vector;
use crate::robot::description::{Form, LinkSolid};
use crate::robot::solids::solid;
use crate::robot::{Kinds, LinkVisual, RobotError, Surface, VisualForm};

/// A geom.
#[derive(Default)]
pub(super) struct Geom {
    pub(super) solids: Vec<LinkSolid>,
    /// How it is seen; nothing where it is not.
    pub(super) visuals: Vec<LinkVisual>,
    /// Whether others meet it.
    pub(super) meets: bool,
    /// What it looks like, if the file says so.
    pub(super) color: Option<[f32; 3]>,
    /// kg, m and kg m² about that place, link frame.
    pub(super) masses: Vec<(f64, Vector3, Matrix3<f64>)>,
}

/// Reads a geom of a body, whose frame sits so in that of the link.
pub(super) fn read(
    class: &Class<'_, '_>,
    settings: &Settings<'_>,
    reading: &mut Reading<'_>,
    link_from_body: &Pose,
) -> Result<Geom, RobotError> {
    let node = class.node;
    let Formed { forms, middle, surface } = forms(class, settings, reading)?;
    let pose = match middle {
        Some(pose) => pose,
        None => settings.pose(node, &|name| class.get(name))?,
    };
    let link_from_solid = link_from_body * pose;
    let density = class.number("density")?.unwrap_or(WATER);
    let volumes: Vec<_> = forms.iter().filter_map(|form| Some((form, solid(form)?))).collect();
    let whole: f64 = volumes.iter().map(|(_, (shape, _))| shape.mass_properties(1.0).mass()).sum();
    let density = match class.number("mass")? {
        Some(mass) if whole > 0.0 => mass / whole,
        Some(_) => 0.0,
        None => density,
    };
    if !(0.0..=1e7).contains(&density) {
        return Err(wrong(node, "mass", &format!("{density} kg/m³"), "a mass of 0 to 1e7 kg/m³"));
    }
    let kinds = Kinds { own: bits(class, "contype")?, met: bits(class, "conaffinity")? };
    let (meets, color) = (kinds.own != 0 || kinds.met != 0, color_of(class, settings)?);
    let mut geom = Geom { meets, color, ..Geom::default() };
    if is_shown(class)? {
        geom.visuals = visuals(class, (&forms, surface.as_ref()), &link_from_solid, color, reading);
    }
    for (form, (shape, form_from_shape)) in &volumes {
        let properties = shape.mass_properties(density);
        let frame = link_from_solid * crate::convert::from_pose(form_from_shape);
        let inertia = properties.reconstruct_inertia_matrix();
        let column = |axis: Vector| from_vector(inertia * axis);
        let inertia = Matrix3::from_columns(&[column(Vector::X), column(Vector::Y), column(Vector::Z)]);
        let turn = frame.rotation.to_rotation_matrix();
        let center = frame * nalgebra::Point3::from(from_vector(properties.local_com));
        let inertia = turn.matrix() * inertia * turn.matrix().transpose();
        geom.masses.push((properties.mass(), center.coords, inertia));
        let (form, material) = ((*form).clone(), material(class)?);
        geom.solids.push(LinkSolid { form, link_from_solid, material, kinds, color });
    }
    Ok(geom)
}

/// Whether a viewer shows it without being asked to: groups 0 to 2, by its own default, and what is not clear.
fn is_shown(class: &Class<'_, '_>) -> Result<bool, RobotError> {
    let is_clear = match class.get("rgba") {
        Some(text) => numbers_up_to(class.node, "rgba", text, 4)?.get(3).is_some_and(|cover| *cover <= 0.0),
        None => false,
    };
    Ok(!is_clear && class.number("group")?.is_none_or(|group| group < 3.0))
}

/// What is seen of a geom: the surface of a mesh, or else its forms; nothing of it where that is none. What is only looked at makes no robot
/// unfit.
fn visuals(
    class: &Class<'_, '_>,
    (forms, surface): (&[Form], Option<&Surface>),
    link_from_geom: &Pose,
    color: Option<[f32; 3]>,
    reading: &mut Reading<'_>,
) -> Vec<LinkVisual> {
    let link_from_visual = *link_from_geom;
    let solid = |form: &Form| LinkVisual { form: VisualForm::Solid(form.clone()), link_from_visual, color };
    let seen = match surface.and_then(|surface| reading.surface(surface, link_from_geom, color)) {
        Some(seen) => vec![seen],
        None => forms.iter().map(solid).collect(),
    };
    let is_fit = seen.iter().all(|seen| seen.check(&|| place(class.node)).is_ok());
    if is_fit { seen } else { Vec::new() }
}

/// Bits as an integer of 32 bits, which may be written with a sign; 1 by default.
fn bits(class: &Class<'_, '_>, attribute: &str) -> Result<u32, RobotError> {
    let Some(number) = class.number(attribute)? else { return Ok(1) };
    if number.fract() == 0.0 && (f64::from(i32::MIN)..=f64::from(u32::MAX)).contains(&number) {
        return Ok(number as i64 as u32);
    }
    let value = class.get(attribute).unwrap_or_default();
    Err(wrong(class.node, attribute, value, "an integer of 32 bits"))
}

/// Its own colour, or else that of the material of its looks.
fn color_of(class: &Class<'_, '_>, settings: &Settings<'_>) -> Result<Option<[f32; 3]>, RobotError> {
    if let Some(text) = class.get("rgba") {
        return color::read(class.node, text);
    }
    let Some(asset) = class.get("material").and_then(|name| settings.material_assets.get(name)) else {
        return Ok(None);
    };
    let text = settings.class(*asset, None, "material")?.get("rgba");
    text.map_or(Ok(None), |text| color::read(*asset, text))
}

/// The material whose friction is nearest to that of the geom, which is 1 unless it says otherwise.
fn material(class: &Class<'_, '_>) -> Result<Material, RobotError> {
    let Some(friction) = some(class, "friction")?.first().copied() else { return Ok(Material::Rubber) };
    let off = |material: &Material| (material.friction() - friction).abs();
    let nearest = Material::ALL.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
    Ok(nearest.copied().unwrap_or_default())
}

/// The forms of a geom.
#[derive(Default)]
struct Formed {
    forms: Vec<Form>,
    /// Where they sit, if that follows from its ends.
    middle: Option<Pose>,
    /// What is seen of them, if that is a mesh.
    surface: Option<Surface>,
}

fn forms(
    class: &Class<'_, '_>,
    settings: &Settings<'_>,
    reading: &mut Reading<'_>,
) -> Result<Formed, RobotError> {
    let node = class.node;
    let size = some(class, "size")?;
    let at = |index: usize| {
        size.get(index).copied().ok_or_else(|| RobotError::Missing {
            place: place(node),
            what: format!("number {} of size", index + 1),
            mend: "a sphere has one, a capsule or cylinder two or fromto, a box three",
        })
    };
    let ends = class.exactly::<6>("fromto")?;
    let middle = ends.map(|[a, b, c, d, e, f]| {
        let (from, to) = (Vector3::new(a, b, c), Vector3::new(d, e, f));
        let turn = (to - from).try_normalize(1e-9).map_or(UnitQuaternion::identity(), |way| along_z(&way));
        (Pose::from_parts(((from + to) * 0.5).into(), turn), (to - from).norm())
    });
    let length = || middle.map_or_else(|| at(1).map(|half| 2.0 * half), |(_, length)| Ok(length));
    let form = match class.get("type").unwrap_or(if class.get("mesh").is_some() { "mesh" } else { "sphere" })
    {
        "sphere" => Form::Sphere { radius: at(0)? },
        "capsule" => Form::Capsule { radius: at(0)?, length: length()? },
        "cylinder" => Form::Cylinder { radius: at(0)?, length: length()? },
        "box" => Form::Box { size: Vector3::new(at(0)?, at(1)?, at(2)?) * 2.0 },
        "ellipsoid" => {
            reading.note(place(node), "an ellipsoid is met as the box around it");
            Form::Box { size: Vector3::new(at(0)?, at(1)?, at(2)?) * 2.0 }
        }
        "mesh" => return meshes(class, settings, reading),
        "plane" => {
            reading.note(place(node), "a plane of a robot is passed over");
            return Ok(Formed::default());
        }
        other => {
            let what = format!("the type {:?}", shortened(other));
            let mend = "give sphere, capsule, cylinder, box or mesh";
            return Err(RobotError::Unsupported { place: place(node), what, mend });
        }
    };
    check_sizes(class, &form)?;
    Ok(Formed { forms: vec![form], middle: middle.map(|(pose, _)| pose), surface: None })
}

/// Sizes of nothing are refused here, before a mass is reckoned from them.
fn check_sizes(class: &Class<'_, '_>, form: &Form) -> Result<(), RobotError> {
    let sizes = match form {
        Form::Box { size } => size.iter().copied().collect(),
        Form::Sphere { radius } => vec![*radius],
        Form::Cylinder { radius, length } | Form::Capsule { radius, length } => vec![*radius, *length],
        Form::Convex { .. } => Vec::new(),
    };
    if sizes.iter().all(|size| (1e-6..=1e4).contains(size)) {
        return Ok(());
    }
    let value = class.get("size").unwrap_or_default();
    Err(wrong(class.node, "size", value, "sizes of 1e-6 to 1e4 m, and ends that lie apart"))
}

fn meshes(
    class: &Class<'_, '_>,
    settings: &Settings<'_>,
    reading: &mut Reading<'_>,
) -> Result<Formed, RobotError> {
    let node = class.node;
    let name = class.get("mesh").unwrap_or_default();
    let Some(asset) = settings.mesh_assets.get(name) else {
        let (place, name) = (place(node), shortened(name));
        return Err(RobotError::Unknown { place, kind: "mesh", name });
    };
    let scale = settings.class(*asset, None, "mesh")?.exactly::<3>("scale")?.unwrap_or([1.0; 3]);
    let Some(file) = asset.attribute("file") else {
        return Ok(Formed { forms: corners(*asset, scale, reading)?, ..Formed::default() });
    };
    let path = if settings.meshes.is_empty() {
        file.to_owned()
    } else {
        format!("{}/{file}", settings.meshes.trim_end_matches('/'))
    };
    let surface = mesh::read(reading, &place(node), &path, scale)?;
    let forms = mesh::solids(reading, &place(node), surface.as_ref());
    Ok(Formed { forms, middle: None, surface })
}

/// A mesh whose corners stand in the file, which is met as the hull of these.
fn corners(asset: Node<'_, '_>, scale: [f64; 3], reading: &mut Reading<'_>) -> Result<Vec<Form>, RobotError> {
    let Some(text) = asset.attribute("vertex") else {
        reading.note(place(asset), "a mesh without a file and without corners is passed over");
        return Ok(Vec::new());
    };
    let most = 3 * reading.options.limits.triangles;
    let numbers = numbers_up_to(asset, "vertex", text, 3 * most)?;
    let (points, rest) = numbers.as_chunks::<3>();
    if !rest.is_empty() || points.len() > most {
        return Err(wrong(asset, "vertex", text, "three numbers a corner, and not too many corners"));
    }
    let points: Vec<Vector3> =
        points.iter().map(|at| Vector3::from(*at).component_mul(&Vector3::from(scale))).collect();
    if points.iter().any(|point: &Vector3| point.iter().any(|part| part.abs() > 1e4 || part.is_nan())) {
        return Err(wrong(asset, "vertex", text, "corners within 1e4 m of the origin"));
    }
    let form = mesh::around(&points);
    if form.is_none() {
        reading.note(place(asset), "the mesh is flat: nothing meets this part");
    } else if asset.attribute("face").is_some() {
        reading.note(place(asset), "the mesh is met as the hull of its corners");
    }
    Ok(form.into_iter().collect())
}
