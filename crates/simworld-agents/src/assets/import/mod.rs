//! From a GLB file of anybody's to an asset: read, mended, scaled, stood on its origin, taken apart into convex solids, weighed.

mod config;
mod decompose;
mod error;
mod measure;
mod normals;
mod repair;
mod scale;
mod weld;

use std::sync::Arc;

pub use config::{Facing, ImportConfig, Unit};
pub use error::ImportError;
use nalgebra::{Matrix3, Matrix4, Translation3};
pub use repair::Repair;
use serde::{Deserialize, Serialize};
use simworld_core::asset::{Asset, ContentId, Model, ModelVertex, Paint, Rig, RigError};
use simworld_core::geometry::{Point3, Vector3};
use simworld_core::scene::{EntityKind, Shape};

use self::decompose::{Fineness, Solid, decompose};
use self::measure::{Bulk, enclosed};
use super::glb::{read_glb_at, read_rigged_glb};
use super::prior::SizePrior;
use super::surface::Surface;
use crate::generation::SizeHint;

/// The thinnest that a thing may be, m.
const THINNEST: f64 = 1e-3;

/// What a file is said to be.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Thing {
    /// The name of the asset: lower-case letters, digits and underscores.
    pub name: String,
    /// What it is, in words: `a wooden bench`. They name its class, and are the tags of the asset.
    pub words: String,
    /// How large it is, where that is known.
    pub size: SizeHint,
    /// Where it comes from.
    pub source: String,
    /// Under which licence, as an SPDX expression; empty where none is known.
    pub licence: String,
}

/// An asset from a file, and how it came about.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The asset, valid. Its source ends with the digest of the file.
    pub asset: Asset,
    /// How it came about.
    pub report: ImportReport,
}

/// How an asset came about from a file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ImportReport {
    /// The class by which it was measured, if its words name one.
    pub class: Option<String>,
    /// What was mended.
    pub repair: Repair,
    /// Metres in a unit of the file.
    pub scale: f64,
    /// Whether it was turned a quarter to the left.
    pub quarter_turned: bool,
    /// m³: what its surface encloses if it is closed, else what its hulls hold.
    pub volume: f64,
    /// Middle of its mass, body frame, m.
    pub center_of_mass: [f64; 3],
    /// Convex solids.
    pub hulls: usize,
    /// What it can do: the names of its clips.
    pub clips: Vec<String>,
}

/// Makes an asset of a GLB file.
///
/// It is deterministic: the same bytes give the same asset. Entities made from it collide as its hulls.
///
/// ```
/// use simworld_agents::assets::{ImportConfig, Thing, export_glb, import_glb};
/// use simworld_core::asset::{Model, ModelPart, ModelVertex};
/// // A tetrahedron 80 units high: in centimetres, if it is to be a stool.
/// let corners = [[-20.0, -20.0, 0.0], [20.0, -20.0, 0.0], [0.0, 20.0, 0.0], [0.0, 0.0, 50.0]];
/// let model = Model {
///     vertices: corners.map(|position| ModelVertex { position, color: [0.3, 0.2, 0.1], ..Default::default() }).to_vec(),
///     triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
///     parts: vec![ModelPart { name: "seat".into(), triangles: 4, ..ModelPart::default() }],
///     ..Model::default()
/// };
/// let thing = Thing { name: "stool".into(), words: "a wooden stool".into(), ..Thing::default() };
/// let stool = import_glb(&export_glb(&model), &thing, &ImportConfig::default())?;
/// assert_eq!(stool.report.scale, 0.01);
/// assert!((stool.asset.collider.size().z - 0.5).abs() < 1e-6);
/// # Ok::<(), simworld_agents::assets::ImportError>(())
/// ```
///
/// # Errors
/// The bytes are no file that can be read, hold no surface, one that is too far from sound, none of a size or shape that such
/// things have, or one without volume; see [`ImportError`].
pub fn import_glb(bytes: &[u8], thing: &Thing, config: &ImportConfig) -> Result<Imported, ImportError> {
    let config = config.checked()?;
    let read = if config.clips { read_rigged_glb } else { read_glb_at };
    let mut surface = read(bytes, &config.limits, config.moment)?;
    let mut repair = mend(&mut surface, &config)?;
    let class = SizePrior::of(&thing.words);
    let (scale, quarter_turned) = place(&mut surface, thing, class.as_ref(), &config)?;
    let bulk = look_outward(&mut surface, &mut repair);
    if repair.turned > 0 || surface.normals.iter().any(|normal| normal.norm_squared() < 0.5) {
        normals::smooth(&mut surface);
    }

    let fineness =
        Fineness { hulls: config.hulls, voxels: config.voxels, volume: bulk.map(|bulk| bulk.volume) };
    let solids = decompose(&surface.points, &surface.triangles, fineness);
    let bulk = weighed(bulk, &solids).ok_or(ImportError::NoSolid)?;
    let report = ImportReport {
        class: class.map(|class| class.name.to_owned()),
        repair,
        scale,
        quarter_turned,
        volume: bulk.volume,
        center_of_mass: bulk.center.into(),
        hulls: solids.len(),
        clips: surface.rig.iter().flat_map(|rig| &rig.clips).map(|clip| clip.name.clone()).collect(),
    };
    let digest = ContentId::of_bytes(bytes);
    let asset = Asset {
        source: format!("{}{}glb {digest}", thing.source, if thing.source.is_empty() { "" } else { "; " }),
        ..asset(surface, solids, thing, class, bulk)?
    };
    asset.validate()?;
    Ok(Imported { asset, report })
}

/// Drops what is none, closes cracks, and says what is still wrong.
fn mend(surface: &mut Surface, config: &ImportConfig) -> Result<Repair, ImportError> {
    let triangles = surface.triangles.len();
    let report = repair::repair(surface, config.weld);
    surface.compact();
    if surface.triangles.is_empty() {
        return Err(ImportError::NoArea { triangles });
    }
    let unsound = |count: usize, allowed: f64, what, field| {
        if count as f64 > allowed * report.edges as f64 {
            Err(ImportError::Unsound { count, edges: report.edges, what, field })
        } else {
            Ok(())
        }
    };
    unsound(report.tangled, config.tangled, "lie between more than two triangles, or twist", "tangled")?;
    unsound(report.open, config.open, "belong to one triangle alone", "open")?;
    Ok(report)
}

/// Scales it to metres and stands it on its origin; the scale, and whether it was turned.
fn place(
    surface: &mut Surface,
    thing: &Thing,
    class: Option<&SizePrior>,
    config: &ImportConfig,
) -> Result<(f64, bool), ImportError> {
    let extent = |surface: &Surface| -> [f64; 3] {
        surface.bounds().map_or([0.0; 3], |[low, high]| (high - low).into())
    };
    let is_long = |[length, width, _]: [f64; 3]| match length / width {
        ratio if ratio > 1.25 => Some(true),
        ratio if ratio < 0.8 => Some(false),
        _ => None,
    };
    let before = extent(surface);
    let turns = config.facing == Facing::ByClass
        && matches!(
            (class.and_then(|class| is_long(class.size)), is_long(before)),
            (Some(wanted), Some(got)) if wanted != got
        );
    if turns {
        surface.points.iter_mut().for_each(|point| *point = Point3::new(-point.y, point.x, point.z));
        surface.normals.iter_mut().for_each(|normal| *normal = Vector3::new(-normal.y, normal.x, normal.z));
        surface.tangents.iter_mut().for_each(|[x, y, ..]| (*x, *y) = (-*y, *x));
        let quarter = Matrix3::from_rows(&[
            -Vector3::y().transpose(),
            Vector3::x().transpose(),
            Vector3::z().transpose(),
        ]);
        surface.carry_rig(&quarter.to_homogeneous());
    }
    let before = extent(surface);
    let scale = scale::scale(before, thing.size, class, config.unit, &thing.words)?;
    let size = before.map(|side| side * scale);
    if size.iter().any(|side| *side < THINNEST) {
        return Err(ImportError::Flat { size });
    }
    if let Some([low, high]) = surface.bounds() {
        let foot = Point3::new((low.x + high.x) * 0.5, (low.y + high.y) * 0.5, low.z);
        for point in &mut surface.points {
            *point = Point3::from((*point - foot) * scale);
            // What is drawn and what is met are the same points.
            *point = point.map(|number| f64::from(number as f32));
        }
        let shift = Translation3::from(-foot.coords * scale).to_homogeneous();
        surface.carry_rig(&(shift * Matrix4::new_scaling(scale)));
    }
    Ok((scale, turns))
}

/// Turns a surface over that looks inward. What a closed one encloses.
fn look_outward(surface: &mut Surface, repair: &mut Repair) -> Option<Bulk> {
    /// An open surface looks inward if it encloses less than nothing by more than this share of its box.
    const CLEARLY: f64 = 0.1;
    let [low, high] = surface.bounds()?;
    let size = high - low;
    let about = nalgebra::center(&low, &high);
    let mut bulk = enclosed(about, surface.triangles.iter().map(|triangle| surface.corners(*triangle)));
    let room = size.x * size.y * size.z;
    let least = if repair.is_closed() { 0.0 } else { -CLEARLY * room };
    if bulk.volume < least {
        surface.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        repair.turned = surface.triangles.len() - repair.turned;
        bulk.volume = -bulk.volume;
    }
    repair.is_closed().then_some(bulk)
}

/// The volume and its middle: of the surface where these are possible, else of the solids.
fn weighed(closed: Option<Bulk>, solids: &[Solid]) -> Option<Bulk> {
    let volume: f64 = solids.iter().map(|solid| solid.bulk.volume).sum();
    let moment: Vector3 = solids.iter().map(|solid| solid.bulk.center.coords * solid.bulk.volume).sum();
    if solids.is_empty() || volume <= 0.0 {
        return None;
    }
    let hulls = Bulk { volume, center: Point3::from(moment / volume) };
    // Walls within walls, and parts that look inward, make a surface enclose more than it can hold, or nothing.
    let possible = closed.filter(|bulk| (0.02..=1.05).contains(&(bulk.volume / volume)));
    Some(possible.unwrap_or(hulls))
}

fn asset(
    surface: Surface,
    solids: Vec<Solid>,
    thing: &Thing,
    class: Option<SizePrior>,
    bulk: Bulk,
) -> Result<Asset, ImportError> {
    let color = mean_color(&surface);
    let model = model(surface, solids)?;
    let [low, high] = model.bounds().ok_or(ImportError::NoSolid)?;
    let [length, width, height] = std::array::from_fn(|axis| f64::from(high[axis]) - f64::from(low[axis]));
    let (kind, density) = match class {
        Some(class) => (class.kind, class.bulk_density()),
        // Of what nothing is known, half is room, and the rest as heavy as wood and plastic.
        None => (EntityKind::Prop, Some(300.0)),
    };
    let mass = density.map(|density| bulk.volume * density);
    if let Some(mass) = mass.filter(|mass| !(1e-3..=1e9).contains(mass)) {
        return Err(ImportError::Mass { mass, volume: bulk.volume });
    }
    let tags = thing.words.split(|c: char| !c.is_alphanumeric()).filter(|word| word.len() > 1);
    let shape = Shape::cuboid(length, width, height);
    let asset = Asset::new(&thing.name, kind, shape).tagged(tags.map(str::to_lowercase));
    let (material, licence) = (class.map(|class| class.material), thing.licence.clone());
    Ok(Asset { mass, material, color, licence, model: Some(Arc::new(model)), ..asset })
}

fn model(mut surface: Surface, solids: Vec<Solid>) -> Result<Model, RigError> {
    let single = |[x, y, z]: [f64; 3]| [x as f32, y as f32, z as f32];
    let rig = surface.rig.take().map(|mut rig| {
        let normals: Vec<[f32; 3]> = surface.normals.iter().map(|normal| single((*normal).into())).collect();
        rig.face(&normals);
        Rig::new(rig)
    });
    let looks = surface.colors.iter().zip(surface.places.iter().zip(&surface.alphas));
    let vertices = surface.points.iter().zip(&surface.normals).zip(looks);
    let vertices = vertices
        .map(|((point, normal), (color, (place, alpha)))| ModelVertex {
            position: single((*point).into()),
            normal: single((*normal).into()),
            color: *color,
            place: *place,
            alpha: *alpha,
        })
        .collect();
    let is_known = surface.tangents.iter().any(|[.., side]| *side != 0.0);
    Ok(Model {
        vertices,
        tangents: if is_known { surface.tangents } else { Vec::new() },
        triangles: surface.triangles,
        parts: surface.parts,
        hulls: solids.into_iter().map(|solid| solid.hull).collect(),
        images: surface.images,
        rig: rig.transpose()?,
    })
}

/// The mean colour of what has one of its own, by area.
fn mean_color(surface: &Surface) -> Option<[f32; 3]> {
    let (mut sum, mut area) = ([0.0; 3], 0.0);
    let mut first = 0;
    for part in &surface.parts {
        let last = first + part.triangles as usize;
        for triangle in &surface.triangles[first..last] {
            if part.paint == Paint::Own {
                let share = surface.cross(*triangle).norm();
                area += share;
                for (point, shown) in triangle.iter().zip(surface.shown(part, *triangle)) {
                    let tint = surface.colors[*point as usize];
                    let color: [f32; 3] = std::array::from_fn(|which| tint[which] * shown[which]);
                    sum = std::array::from_fn(|which| sum[which] + f64::from(color[which]) * share / 3.0);
                }
            }
        }
        first = last;
    }
    (area > 0.0).then(|| sum.map(|channel| (channel / area).clamp(0.0, 1.0) as f32))
}
