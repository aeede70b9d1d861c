//! Commands to the release's managers: where everything is, and the weather.

use std::fmt::Write;

use simworld_core::command::Command;
use simworld_core::environment::Environment;
use simworld_core::scene::{EntityKind, EntityRef};

use super::answer::{Answered, Failed, Said};
use super::command::{Order, Verb};
use super::convert::{
    density_of, illuminance_of, intensity_of, location_of, rotator_of, sun_direction_of, sun_in_world,
    visibility_of,
};
use super::desk::Desk;
use crate::remote::engine::Served;

pub(super) fn answer(desk: &mut Desk, served: &mut Served<'_>, order: &Order<'_>) -> Answered {
    if !desk.names.is_manager(order.word(0)) {
        return Err(Failed::NoObject(order.word(0).to_owned()));
    }
    let mut environment = *served.stage.scene().environment();
    let [first, second, _]: [f64; 3] = order.numbers(0);
    match order.verb {
        Verb::Information => return Ok(Said::Text(information(desk, served))),
        Verb::UpdateObjects => return Ok(Said::Done),
        Verb::GetSunDirection => {
            let [pitch, yaw] = sun_direction_of(&environment.sun);
            let rotation = format!("P={pitch:.6} Y={yaw:.6} R={:.6}", 0.0);
            return Ok(json(&serde_json::json!({ "rotation": rotation })));
        }
        Verb::GetSunIntensity => {
            let intensity = intensity_of(environment.sun.illuminance);
            return Ok(json(&serde_json::json!({ "SunIntensity": intensity })));
        }
        Verb::GetFog => {
            let density = density_of(environment.weather.visibility);
            let fog = serde_json::json!({ "FogDensity": density, "FogDistance": 0.0, "FogFalloff": 0.0 });
            return Ok(json(&fog));
        }
        Verb::SetSunDirection => environment.sun = sun_in_world(environment.sun, first, second),
        Verb::SetSunIntensity => environment.sun.illuminance = illuminance_of(first),
        _ => {
            if !(0.0..=100.0).contains(&first) {
                return Err(Failed::Value("a fog density is 0 to 100".to_owned()));
            }
            environment.weather.visibility = visibility_of(first);
        }
    }
    change(served, environment)
}

fn change(served: &mut Served<'_>, environment: Environment) -> Answered {
    served.apply(Command::SetEnvironment(environment))?;
    Ok(Said::Done)
}

fn json(value: &serde_json::Value) -> Said {
    Said::Text(value.to_string())
}

/// Places and headings of what clients brought, in the words that the release's client looks for.
fn information(desk: &mut Desk, served: &Served<'_>) -> String {
    let [mut vehicles, mut people, mut scooters] = [(); 3].map(|()| (String::new(), String::new()));
    for id in desk.names.brought(served.stage) {
        let name = desk.names.name_of(served.stage, id);
        let Some(entity) = served.stage.scene().entity(id) else { continue };
        let list = match entity.kind {
            EntityKind::Person => &mut people,
            EntityKind::Scooter => &mut scooters,
            kind if kind.is_vehicle() => &mut vehicles,
            _ => continue,
        };
        tell(list, &name, &entity);
    }
    let information = serde_json::json!({
        "VLocations": vehicles.0, "VRotations": vehicles.1,
        "PLocations": people.0, "PRotations": people.1,
        "ALocations": people.0, "ARotations": people.1,
        "SLocations": scooters.0, "SRotations": scooters.1,
        "LStates": "",
    });
    information.to_string()
}

fn tell((places, turns): &mut (String, String), name: &str, entity: &EntityRef<'_>) {
    let [x, y, z] = location_of(&entity.position());
    let [pitch, yaw, roll] = rotator_of(&entity.pose.rotation);
    // Writing to a string cannot fail.
    let _ = writeln!(places, "{name}X={x:.3} Y={y:.3} Z={z:.3}");
    let _ = writeln!(turns, "{name}P={pitch:.6} Y={yaw:.6} R={roll:.6}");
}
