//! The pictures of a run.

use simworld_traffic::Traffic;
use simworld_traffic::look::{
    Quantity, fundamental_diagram, junction_film, network_map, service_chart, time_space_diagram,
};
use simworld_traffic::vehicle::Idm;

use super::Watched;

/// A picture with the name of its file.
pub struct Picture {
    /// Name of its file.
    pub name: &'static str,
    /// The picture.
    pub svg: String,
}

/// The driver of the first type on a street of 50 km/h.
fn urban_driver(traffic: &Traffic) -> Idm {
    let own = traffic.config().types.first().map(|row| row.driver).unwrap_or_default();
    Idm { desired_speed: own.desired_speed.min(50.0 / 3.6), ..own }
}

/// All pictures of a run; those of which nothing was seen are left out.
pub fn pictures(traffic: &Traffic, watched: &Watched) -> Vec<Picture> {
    let (network, recorder) = (traffic.network(), &watched.recorder);
    let map = |quantity| network_map(recorder, network, quantity);
    let mut pictures = vec![
        Picture { name: "density.svg", svg: map(Quantity::Density) },
        Picture { name: "speed.svg", svg: map(Quantity::Speed) },
        Picture { name: "flow.svg", svg: map(Quantity::Flow) },
        Picture {
            name: "fundamental.svg",
            svg: fundamental_diagram(recorder, &urban_driver(traffic), "Fundamental diagram"),
        },
        Picture { name: "service.svg", svg: service_chart(recorder, network, "Level of service") },
    ];
    if let Some(street) = &watched.street {
        pictures.push(Picture { name: "time-space.svg", svg: time_space_diagram(street, "Time and space") });
    }
    if let Some(film) = &watched.film {
        pictures.push(Picture { name: "junction.svg", svg: junction_film(film, network, "A junction") });
    }
    pictures
}
