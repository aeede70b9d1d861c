//! Commands about cameras and their pictures.

use nalgebra::Translation3;
use simworld_core::geometry::Pose;

use super::answer::{Answered, Failed, Said, numbers};
use super::command::{Order, Verb};
use super::convert::{
    angle_in_world, degrees_of, location_of, point_in_world, rotation_in_world, rotator_of,
};
use super::desk::Desk;
use super::image;
use crate::remote::engine::{Refused, Served};
use crate::remote::{CameraPlace, Mount, PictureKind};

pub(super) fn answer(desk: &Desk, served: &mut Served<'_>, order: &Order<'_>) -> Answered {
    let number = order.whole(0);
    match order.verb {
        Verb::Cameras => {
            let names: Vec<String> =
                served.cameras.iter().map(|(number, _)| format!("camera_{number}")).collect();
            return Ok(Said::Text(names.join(" ")));
        }
        Verb::SpawnCamera => {
            let first = served.cameras.get(0).copied().unwrap_or_default();
            let place = CameraPlace { mount: Mount::Free(Pose::identity()), ..first };
            let full = || Failed::State(format!("there are {} cameras already", served.limits.cameras));
            return served
                .cameras
                .add(place)
                .map(|number| Said::Text(format!("camera_{number}")))
                .ok_or_else(full);
        }
        Verb::Lit | Verb::Depth | Verb::ObjectMask => return picture(desk, served, order),
        _ => {}
    }
    let place = *served.cameras.get(number).ok_or(Refused::NoCamera(number))?;
    let pose = place.pose(served.stage.scene()).ok_or(Refused::NoWearer(number))?;
    let (location, rotation) = (location_of(&pose.translation.vector.into()), rotator_of(&pose.rotation));
    match order.verb {
        Verb::GetCameraLocation => Ok(numbers(&location)),
        Verb::GetCameraRotation => Ok(numbers(&rotation)),
        Verb::GetCameraPose => Ok(numbers(&[location, rotation].concat())),
        Verb::GetFov => Ok(numbers(&[degrees_of(place.horizontal_fov)])),
        Verb::GetSize => Ok(Said::Text(format!("{} {}", place.width, place.height))),
        _ => change(served, order, place, pose),
    }
}

fn change(served: &mut Served<'_>, order: &Order<'_>, mut place: CameraPlace, mut pose: Pose) -> Answered {
    match order.verb {
        Verb::SetFov => place.horizontal_fov = angle_in_world(order.numbers::<1>(1)[0]),
        Verb::SetSize => (place.width, place.height) = (order.whole(1), order.whole(2)),
        _ => {
            if order.verb != Verb::SetCameraRotation {
                pose.translation = Translation3::from(point_in_world(order.numbers(1)));
            }
            if order.verb != Verb::SetCameraLocation {
                let from = if order.verb == Verb::SetCameraPose { 4 } else { 1 };
                pose.rotation = rotation_in_world(order.numbers(from));
            }
            place.put(served.stage.scene(), pose);
        }
    }
    place.validate(served.limits).map_err(|error| Failed::Value(error.to_string()))?;
    if let Some(camera) = served.cameras.get_mut(order.whole(0)) {
        *camera = place;
    }
    Ok(Said::Done)
}

/// Gives all cameras a size such as `1280x720w`; the letter chose a window.
pub(super) fn set_resolution(served: &mut Served<'_>, text: &str) -> Answered {
    let digits = text.trim_end_matches(|letter: char| letter.is_ascii_alphabetic());
    let size =
        digits.split_once('x').and_then(|(width, height)| Some((width.parse().ok()?, height.parse().ok()?)));
    let (width, height) = size.ok_or_else(|| Failed::Value("a resolution reads 1280x720w".to_owned()))?;
    let limits = served.limits;
    for place in served.cameras.iter_mut() {
        let changed = CameraPlace { width, height, ..*place };
        changed.validate(limits).map_err(|error| Failed::Value(error.to_string()))?;
        *place = changed;
    }
    Ok(Said::Done)
}

fn picture(desk: &Desk, served: &mut Served<'_>, order: &Order<'_>) -> Answered {
    let (camera, form) = (order.whole(0), order.word(0));
    let (kind, forms) = match order.verb {
        Verb::Lit => (PictureKind::Color, "png or bmp"),
        Verb::Depth => (PictureKind::Depth, "npy"),
        _ => (PictureKind::Instances, "png or bmp"),
    };
    if !forms.split(" or ").any(|known| known == form) {
        // The original takes a path here and writes a file on the server's machine.
        return Err(Failed::Value(format!("the server writes no files, ask for {forms}")));
    }
    let picture = served.picture(camera, kind)?;
    if !picture.is_whole() {
        return Err(Failed::State("the picture is damaged".to_owned()));
    }
    let rgba = match kind {
        PictureKind::Depth => return Ok(Said::Bytes(image::depth_npy(&picture))),
        PictureKind::Color => image::rgba_of_color(&picture),
        PictureKind::Instances => image::rgba_of_instances(&picture, &|slot| desk.names.color_of(slot)),
    };
    if form == "bmp" {
        return Ok(Said::Bytes(image::bmp(picture.width, picture.height, &rgba)));
    }
    let packed = image::png(picture.width, picture.height, &rgba);
    packed.map(Said::Bytes).map_err(|error| Failed::State(error.to_string()))
}
