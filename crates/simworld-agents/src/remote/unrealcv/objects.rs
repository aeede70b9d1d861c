//! Commands about things: bringing them, placing them, changing them, taking them away.

use nalgebra::Translation3;
use simworld_core::alteration::Alteration;
use simworld_core::command::Command;
use simworld_core::geometry::Pose;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, Shape, Solidity, Visibility};
use simworld_core::value::Value;

use super::answer::{Answered, Failed, Said, numbers};
use super::command::{Order, Verb};
use super::convert::{location_of, point_in_world, rotation_in_world, rotator_of};
use super::desk::{Desk, entity};
use super::{assets, names};
use crate::remote::engine::Served;

/// The attribute that holds a chosen colour in object masks, 0xRRGGBB.
pub(super) const MASK_COLOR: &str = "mask_color";
/// The attribute that holds the class something was brought as.
pub(super) const CLASS: &str = "class";
/// The attribute that says whether something may be moved.
const MOVABLE: &str = "movable";
/// The attribute that says whether something is a body of the physics.
const PHYSICS: &str = "physics";
/// The attributes that hold a scale other than 1.
const SCALE: [&str; 3] = ["scale_x", "scale_y", "scale_z"];

pub(super) fn answer(desk: &mut Desk, served: &mut Served<'_>, order: &Order<'_>) -> Answered {
    match order.verb {
        Verb::Objects => {
            let mut text = String::new();
            for name in desk.names.all(served.stage) {
                text.push_str(name);
                text.push(' ');
            }
            return Ok(Said::Text(text));
        }
        Verb::Spawn => return spawn(desk, served, order),
        Verb::Destroy if desk.names.remove_manager(order.word(0)) => return Ok(Said::Done),
        // A manager has no place and no look.
        _ if desk.names.is_manager(order.word(0)) => {
            return if reads(order.verb) {
                Err(Failed::NoObject(order.word(0).to_owned()))
            } else {
                Ok(Said::Done)
            };
        }
        _ => {}
    }
    let id = desk.find(served.stage, order.word(0))?;
    if reads(order.verb) { read(desk, served, order, id) } else { write(desk, served, order, id) }
}

fn reads(verb: Verb) -> bool {
    use Verb::{GetBounds, GetClass, GetColor, GetLocation, GetMobility, GetRotation, GetScale};
    matches!(verb, GetLocation | GetRotation | GetScale | GetColor | GetMobility | GetClass | GetBounds)
}

fn spawn(desk: &mut Desk, served: &mut Served<'_>, order: &Order<'_>) -> Answered {
    let (class, wanted) = (order.word(0), order.words.get(1).copied());
    if let Some(name) = wanted {
        if !names::is_name(name) {
            return Err(Failed::Value("a name is one word of at most 128 bytes, without slashes".to_owned()));
        }
        if desk.names.is_manager(name) || desk.names.find(served.stage, name).is_some() {
            return Err(Failed::Exists(name.to_owned()));
        }
        if assets::is_manager(class) {
            if !desk.names.add_manager(name, served.limits.spawned) {
                return Err(Failed::State(format!("there are {} managers already", served.limits.spawned)));
            }
            return Ok(Said::Text(name.to_owned()));
        }
    }
    let found = assets::asset_of(served.stage.scene(), class);
    let (asset_id, asset) = found.ok_or_else(|| Failed::NoClass(class.to_owned()))?;
    let mut desc = asset.at(asset_id.unwrap_or_default(), Pose::identity()).with(CLASS, class);
    desc.info.asset = asset_id;
    desc.info.name = wanted.map(str::to_owned);
    let before = served.stage.revision();
    let applied = served.apply(Command::Spawn(Box::new(desc)))?;
    // A spawn that took effect made an entity.
    let id = applied.spawned.ok_or_else(|| Failed::State("nothing came".to_owned()))?;
    desk.names.came(served.stage, before, id);
    served.wear_camera(id);
    Ok(Said::Text(desk.names.name_of(served.stage, id)))
}

fn read(desk: &Desk, served: &Served<'_>, order: &Order<'_>, id: EntityId) -> Answered {
    let entity = entity(served, id)?;
    let text = match order.verb {
        Verb::GetLocation => return Ok(numbers(&location_of(&entity.position()))),
        Verb::GetRotation => return Ok(numbers(&rotator_of(&entity.pose.rotation))),
        Verb::GetScale => return Ok(numbers(&scale_of(&entity.to_desc()))),
        Verb::GetBounds => {
            let (min, max) = (location_of(&entity.bounds.min), location_of(&entity.bounds.max));
            // The mirror swaps least and greatest y.
            return Ok(numbers(&[min[0], max[1], min[2], max[0], min[1], max[2]]));
        }
        Verb::GetColor => {
            let [r, g, b] = desk.names.color_of(id.index() as u32);
            format!("(R={r},G={g},B={b},A=255)")
        }
        Verb::GetMobility => (if is_movable(&entity.to_desc()) { "Movable" } else { "Static" }).to_owned(),
        _ => match entity.info.attributes.get(CLASS).and_then(Value::as_str) {
            Some(class) => class.to_owned(),
            None => entity.kind.to_string(),
        },
    };
    Ok(Said::Text(text))
}

fn write(desk: &mut Desk, served: &mut Served<'_>, order: &Order<'_>, id: EntityId) -> Answered {
    match order.verb {
        Verb::SetLocation | Verb::SetRotation => place(served, order, id)?,
        Verb::SetScale => return set_scale(desk, served, order, id),
        Verb::SetColor => {
            let channels: [f64; 3] = order.numbers(0);
            if channels.iter().any(|channel| *channel > 255.0) {
                return Err(Failed::Value("a colour is three numbers from 0 to 255".to_owned()));
            }
            let [r, g, b] = channels.map(|channel| channel as u8);
            let color = i64::from(u32::from_be_bytes([0, r, g, b]));
            set(served, id, MASK_COLOR, Some(color.into()))?;
            desk.names.set_color(id, [r, g, b]);
        }
        Verb::SetMobility => set(served, id, MOVABLE, Some((order.whole(0) == 1).into()))?,
        Verb::SetPhysics => set(served, id, PHYSICS, Some((order.whole(0) == 1).into()))?,
        Verb::SetCollision => {
            let (is_own, wanted) = (entity(served, id)?.is_solid_by_kind(), order.whole(0) == 1);
            let solidity = match wanted {
                _ if is_own == wanted => Solidity::OfItsKind,
                true => Solidity::Solid,
                false => Solidity::Hollow,
            };
            alter(desk, served, id, Alteration::Solidity(solidity))?;
        }
        Verb::Show => alter(desk, served, id, Alteration::Visibility(Visibility::Shown))?,
        Verb::Hide => alter(desk, served, id, Alteration::Visibility(Visibility::Hidden))?,
        Verb::SetName => return rename(desk, served, order, id),
        _ => {
            let before = served.stage.revision();
            served.apply(Command::Remove { id })?;
            desk.names.forget(order.word(0));
            desk.names.still_complete(served.stage, before);
            desk.errands.cancel(id);
            served.cameras.forget_gone(served.stage.scene());
        }
    }
    Ok(Said::Done)
}

/// Puts it elsewhere, or turns it.
fn place(served: &mut Served<'_>, order: &Order<'_>, id: EntityId) -> Result<(), Failed> {
    let body = entity(served, id)?;
    if body.info.attributes.get(MOVABLE) == Some(&Value::Bool(false)) {
        return Err(Failed::State("it is not movable: set object_mobility true first".to_owned()));
    }
    let mut pose = *body.pose;
    match order.verb {
        Verb::SetLocation => pose.translation = Translation3::from(point_in_world(order.numbers(0))),
        _ => pose.rotation = rotation_in_world(order.numbers(0)),
    }
    served.apply(Command::Move { id, pose })?;
    Ok(())
}

fn set_scale(desk: &mut Desk, served: &mut Served<'_>, order: &Order<'_>, id: EntityId) -> Answered {
    let desc = entity(served, id)?.to_desc();
    let (old, new): ([f64; 3], [f64; 3]) = (scale_of(&desc), order.numbers(0));
    if old == new {
        return Ok(Said::Done);
    }
    let by: [f64; 3] = std::array::from_fn(|axis| new[axis] / old[axis]);
    let shape = scaled(desc.info.shape, by)?;
    shape.validate().map_err(|error| Failed::Value(error.to_string()))?;
    alter(desk, served, id, Alteration::Shape(shape))?;
    for (key, value) in SCALE.iter().zip(new) {
        set(served, id, key, Some(Value::Number(value)))?;
    }
    Ok(Said::Done)
}

fn scaled(shape: Shape, [x, y, z]: [f64; 3]) -> Result<Shape, Failed> {
    let round = || {
        if (x - y).abs() < 1e-9 {
            Ok(x)
        } else {
            Err(Failed::Value("what is round scales alike along x and y".to_owned()))
        }
    };
    match shape {
        Shape::Box { size } => Ok(Shape::cuboid(size.x * x, size.y * y, size.z * z)),
        Shape::Cylinder { radius, height } => {
            Ok(Shape::Cylinder { radius: radius * round()?, height: height * z })
        }
        Shape::Capsule { radius, height } => {
            Ok(Shape::Capsule { radius: radius * round()?, height: height * z })
        }
        Shape::Sphere { radius } if (x - z).abs() < 1e-9 => Ok(Shape::Sphere { radius: radius * round()? }),
        _ => Err(Failed::Value("this shape scales alike along all axes".to_owned())),
    }
}

fn rename(desk: &mut Desk, served: &mut Served<'_>, order: &Order<'_>, id: EntityId) -> Answered {
    let (old, new) = (order.word(0), order.word(1));
    if !names::is_name(new) {
        return Err(Failed::Value("a name is one word of at most 128 bytes, without slashes".to_owned()));
    }
    match desk.names.find(served.stage, new) {
        Some(other) if other == id => return Ok(Said::Text("The name has already been set".to_owned())),
        Some(_) => return Err(Failed::Overwrites(new.to_owned())),
        None if desk.names.is_manager(new) => return Err(Failed::Overwrites(new.to_owned())),
        None => {}
    }
    let before = served.stage.revision();
    served.apply(Command::Alter { id, alteration: Alteration::Name(Some(new.to_owned())) })?;
    desk.names.forget(old);
    desk.names.is_called(served.stage, before, id);
    Ok(Said::Done)
}

/// Alters something; its name stays.
fn alter(
    desk: &mut Desk,
    served: &mut Served<'_>,
    id: EntityId,
    alteration: Alteration,
) -> Result<(), Failed> {
    let before = served.stage.revision();
    served.apply(Command::Alter { id, alteration })?;
    desk.names.still_complete(served.stage, before);
    Ok(())
}

/// Sets an attribute.
pub(super) fn set(
    served: &mut Served<'_>,
    id: EntityId,
    key: &str,
    value: Option<Value>,
) -> Result<(), Failed> {
    served.apply(Command::SetAttribute { id, key: key.to_owned(), value })?;
    Ok(())
}

fn scale_of(desc: &EntityDesc) -> [f64; 3] {
    SCALE.map(|key| desc.info.attributes.get(key).and_then(Value::as_f64).unwrap_or(1.0))
}

fn is_movable(desc: &EntityDesc) -> bool {
    match desc.info.attributes.get(MOVABLE) {
        Some(value) => *value != Value::Bool(false),
        None => desc.kind.is_mobile(),
    }
}
