//! Meshes of robots, STL and OBJ, as convex solids: those of a decomposition, or the hull of all points.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Component, Path, PathBuf};

use parry3d_f64::math::Vector;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};
use simworld_core::geometry::Vector3;
use simworld_core::ops;

use super::Reading;
use super::xml::shortened;
use crate::convert::{from_vector, to_vector};
use crate::robot::description::Form;
#[cfg(feature = "mjcf")]
use crate::robot::description::MOST_CORNERS;
use crate::robot::solids::volume;
use crate::robot::{RobotError, Surface};

/// A hull has at most the points that lie outermost in so many directions.
const DIRECTIONS: usize = 128;
/// A mesh that fills so much of its hull is left whole.
const NEARLY_ALL: f64 = 0.95;
/// Voxels along the longest side, for a decomposition.
const VOXELS: u32 = 32;
/// Meshes of more triangles are left whole, since a decomposition would take long.
const MOST_APART: usize = 20_000;

/// What is wrong with a path that leads elsewhere.
const OUTSIDE: &str = "leads out of the folder of the robot: put the mesh into it and name it from there";

/// The surface of a mesh, scaled; none, with a note, where it cannot be read for want of a folder or of a reader.
pub(super) fn read(
    reading: &mut Reading<'_>,
    place: &str,
    name: &str,
    scale: [f64; 3],
) -> Result<Option<Surface>, RobotError> {
    let Some(folder) = &reading.options.folder else {
        reading.note(place.to_owned(), "the mesh is not read, since no folder is given");
        return Ok(None);
    };
    let path = confined(folder, name)?;
    let kind = path.extension().and_then(|end| end.to_str()).unwrap_or_default().to_ascii_lowercase();
    if kind != "stl" && kind != "obj" {
        let what = format!("meshes of the kind {:?} are not read", shortened(&kind));
        reading.note(place.to_owned(), what);
        return Ok(None);
    }
    let limits = &reading.options.limits;
    let failed = |reason: String| RobotError::File { path: shortened(name), reason };
    let length = fs::metadata(&path).map_err(|error| failed(error.to_string()))?.len();
    if length > limits.mesh_bytes {
        return Err(failed(format!("{length} bytes are too many: at most {} are read", limits.mesh_bytes)));
    }
    let bytes = fs::read(&path).map_err(|error| failed(error.to_string()))?;
    let read = if kind == "stl" { stl(&bytes, limits.triangles) } else { obj(&bytes, limits.triangles) };
    let mut surface = read.map_err(failed)?;
    for point in &mut surface.points {
        *point = point.component_mul(&Vector3::from(scale));
    }
    if scale.iter().product::<f64>() < 0.0 {
        // A mirror turns the surface inside out.
        surface.triangles.iter_mut().for_each(|corners| corners.swap(1, 2));
    }
    if surface.points.iter().any(|point| point.iter().any(|part| part.abs() > 1e4 || part.is_nan())) {
        return Err(failed("has corners beyond 1e4 m: scale it".to_owned()));
    }
    Ok(Some(surface))
}

/// The convex solids that are met in place of a surface; none, with a note, where it is flat or was not read.
pub(super) fn solids(reading: &mut Reading<'_>, place: &str, surface: Option<&Surface>) -> Vec<Form> {
    let forms = surface.map_or_else(Vec::new, |surface| apart(surface, reading.options.limits.parts));
    match surface {
        None => reading.note(place.to_owned(), "nothing meets this part"),
        Some(_) if forms.is_empty() => {
            reading.note(place.to_owned(), "the mesh is flat: nothing meets this part");
        }
        Some(Surface { triangles, .. }) => {
            let (triangles, solids) = (triangles.len(), forms.len());
            let what = format!("the mesh of {triangles} triangles is met as {solids} convex solids");
            reading.note(place.to_owned(), what);
        }
    }
    forms
}

/// The file of a name in a folder; a name that leads out of it is refused before anything is looked at.
fn confined(folder: &Path, name: &str) -> Result<PathBuf, RobotError> {
    let refused = |reason: &str| RobotError::File { path: shortened(name), reason: reason.to_owned() };
    let (rest, is_package) = match name.strip_prefix("package://") {
        Some(rest) => (rest, true),
        None => (name.strip_prefix("file://").unwrap_or(name), false),
    };
    let relative = Path::new(rest);
    let mut depth = 0_i32;
    for part in relative.components() {
        depth += match part {
            Component::Normal(_) => 1,
            Component::CurDir => 0,
            Component::ParentDir => -1,
            Component::RootDir | Component::Prefix(_) => return Err(refused(OUTSIDE)),
        };
        if depth < 0 {
            return Err(refused(OUTSIDE));
        }
    }
    let within: PathBuf = relative.components().skip(1).collect();
    let tries = [Some(folder.join(relative)), is_package.then(|| folder.join(within))];
    let real_folder = folder.canonicalize().map_err(|error| refused(&error.to_string()))?;
    for path in tries.into_iter().flatten() {
        // Links in the folder may point anywhere.
        let Ok(real) = path.canonicalize() else { continue };
        if !real.starts_with(&real_folder) {
            return Err(refused(OUTSIDE));
        }
        if real.is_file() {
            return Ok(real);
        }
    }
    Err(refused("is no file in the folder of the robot"))
}

/// STL, binary or as text.
fn stl(bytes: &[u8], most: usize) -> Result<Surface, String> {
    let too_many = || format!("more than {most} triangles are too many");
    let count = bytes.get(80..84).map(|count| u32::from_le_bytes([count[0], count[1], count[2], count[3]]));
    let mut points = Vec::new();
    if let Some(count) = count.filter(|count| bytes.len() as u64 == 84 + 50 * u64::from(*count)) {
        if count as usize > most {
            return Err(too_many());
        }
        for triangle in bytes[84..].chunks_exact(50) {
            let number = |at: usize| {
                let at = 12 + 4 * at;
                f64::from(f32::from_le_bytes([
                    triangle[at],
                    triangle[at + 1],
                    triangle[at + 2],
                    triangle[at + 3],
                ]))
            };
            points.extend((0..3).map(|corner| {
                Vector3::new(number(3 * corner), number(3 * corner + 1), number(3 * corner + 2))
            }));
        }
    } else {
        let text = std::str::from_utf8(bytes).map_err(|_| "is no STL: its length does not fit".to_owned())?;
        for line in text.lines() {
            let mut words = line.split_whitespace();
            if words.next() == Some("vertex") {
                points.push(vertex(words).ok_or("has a vertex without three numbers")?);
                if points.len() > 3 * most {
                    return Err(too_many());
                }
            }
        }
    }
    let triangles = (0..points.len() as u32 / 3).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]).collect();
    Ok(welded(&Surface { points, triangles }))
}

fn vertex<'a>(words: impl Iterator<Item = &'a str>) -> Option<Vector3> {
    let numbers: Vec<f64> = words.take(3).map_while(|word| word.parse().ok()).collect();
    let numbers = <[f64; 3]>::try_from(numbers).ok()?;
    numbers.iter().all(|number| number.is_finite()).then(|| numbers.into())
}

/// OBJ: corners and faces, without anything else.
fn obj(bytes: &[u8], most: usize) -> Result<Surface, String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "is no text, as OBJ is".to_owned())?;
    let mut surface = Surface { points: Vec::new(), triangles: Vec::new() };
    for (line, content) in text.lines().enumerate() {
        let mut words = content.split_whitespace();
        match words.next() {
            Some("v") => {
                let point = vertex(words).ok_or(format!("line {}: v without three numbers", line + 1))?;
                surface.points.push(point);
            }
            Some("f") => {
                let count = surface.points.len() as i64;
                let corner = |word: &str| {
                    let index: i64 = word.split('/').next()?.parse().ok()?;
                    let place = if index < 0 { count.checked_add(index)? } else { index.checked_sub(1)? };
                    (0..count).contains(&place).then_some(place as u32)
                };
                let face: Option<Vec<u32>> = words.map(corner).collect();
                let face = face.ok_or(format!("line {}: f names a corner that is not there", line + 1))?;
                for at in 2..face.len() {
                    surface.triangles.push([face[0], face[at - 1], face[at]]);
                }
            }
            _ => {}
        }
        if surface.triangles.len() > most || surface.points.len() > 3 * most {
            return Err(format!("more than {most} triangles are too many"));
        }
    }
    Ok(surface)
}

/// The same surface with each corner once.
fn welded(surface: &Surface) -> Surface {
    let mut known = std::collections::BTreeMap::new();
    let mut points = Vec::new();
    let places: Vec<u32> = surface
        .points
        .iter()
        .map(|point| {
            // Plus zero and minus zero are one place.
            let key = [point.x, point.y, point.z].map(|part| (part + 0.0).to_bits());
            *known.entry(key).or_insert_with(|| {
                points.push(*point);
                points.len() as u32 - 1
            })
        })
        .collect();
    let triangles = surface.triangles.iter().map(|corners| corners.map(|at| places[at as usize])).collect();
    Surface { points, triangles }
}

/// Convex solids that cover a surface.
fn apart(surface: &Surface, most: u32) -> Vec<Form> {
    let Some(whole) = hull(&surface.points) else { return Vec::new() };
    let enclosed: f64 = surface
        .triangles
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(|at| surface.points[at as usize]);
            a.dot(&b.cross(&c)) / 6.0
        })
        .sum();
    let is_whole = enclosed.abs() > NEARLY_ALL * volume(&whole);
    if is_whole || most < 2 || surface.triangles.len() > MOST_APART {
        return vec![whole];
    }
    let parts = catch_unwind(AssertUnwindSafe(|| parts(surface, most))).unwrap_or_default();
    if parts.is_empty() { vec![whole] } else { parts }
}

fn parts(surface: &Surface, most: u32) -> Vec<Form> {
    let points: Vec<Vector> = surface.points.iter().map(to_vector).collect();
    let parameters =
        VHACDParameters { resolution: VOXELS, max_convex_hulls: most, ..VHACDParameters::default() };
    let apart = VHACD::decompose(&parameters, &points, &surface.triangles, true);
    let hulls = apart.compute_exact_convex_hulls(&points, &surface.triangles);
    let hulls = hulls.iter().take(most as usize);
    hulls
        .filter_map(|(points, _)| hull(&points.iter().map(|point| from_vector(*point)).collect::<Vec<_>>()))
        .collect()
}

/// The least convex solid around points that lie within 1e4 m, or nearly that of very many; none for points of a plane.
#[cfg(feature = "mjcf")]
pub(super) fn around(points: &[Vector3]) -> Option<Form> {
    if points.len() > MOST_CORNERS {
        return hull(points);
    }
    let form = Form::Convex { points: points.to_vec() };
    (volume(&form) > 1e-12).then_some(form)
}

/// The hull of the points that lie outermost in directions all round; none for points of a plane.
fn hull(points: &[Vector3]) -> Option<Form> {
    let mut chosen: Vec<usize> = (0..DIRECTIONS)
        .filter_map(|step| {
            // Evenly over the ball, along a spiral.
            let z = 1.0 - (2.0 * step as f64 + 1.0) / DIRECTIONS as f64;
            let (sin, cos) = ops::sin_cos(step as f64 * 2.399_963_229_728_653);
            let flat = (1.0 - z * z).sqrt();
            let way = Vector3::new(cos * flat, sin * flat, z);
            (0..points.len()).max_by(|a, b| points[*a].dot(&way).total_cmp(&points[*b].dot(&way)))
        })
        .collect();
    chosen.sort_unstable();
    chosen.dedup();
    let form = Form::Convex { points: chosen.into_iter().map(|place| points[place]).collect() };
    (volume(&form) > 1e-12).then_some(form)
}
