//! Queue discharge: saturation flow, start-up lost time, jam density and the wave of starting.

use simworld_core::id::LaneId;

use super::streets::{CAR, Signalised, StopLine, across, empty, inner_lane, is_green, mean};
use super::{Effort, Figure, Figures, ValidationError};
use crate::vehicle::{CarFollowing, Idm, Leader, VehicleType, advance};
use crate::{Traffic, TrafficConfig};

/// Cars in the queue.
const QUEUE: usize = 22;
/// The speed limit of the street, m/s.
const LIMIT: f64 = 50.0 / 3.6;
/// Who is faster than this has started, m/s.
const STARTED: f64 = 0.5;
const MANUAL: &str = "Highway Capacity Manual: 1900 veh/h and lane, 2.0 s";

/// What a discharging queue shows.
pub(super) struct Discharge {
    /// Saturation flow, veh/h.
    pub(super) flow: f64,
    /// Start-up lost time, s.
    pub(super) lost: f64,
    /// Headways at the stop line, the first from the beginning of green, s.
    headways: Vec<f64>,
}

/// The queue as it stands at red, and how it starts.
#[derive(Default)]
struct Queue {
    /// Where each stands, m along the lane, the first first, with its number.
    stands: Vec<(f64, u32)>,
    /// When each starts, s.
    starts: Vec<f64>,
}

impl Queue {
    /// Takes up who stands on the lane.
    fn stand(&mut self, traffic: &Traffic, lane: LaneId) {
        let on_lane = traffic.stations().filter(|(_, track, ..)| *track == lane.0);
        self.stands = on_lane.map(|(id, _, s, _)| (s, id)).collect();
        self.stands.sort_by(|a, b| b.0.total_cmp(&a.0));
        self.starts = vec![f64::INFINITY; self.stands.len()];
    }

    /// Notes who starts in this step.
    fn look(&mut self, traffic: &Traffic) {
        for (id, ..) in traffic.stations().filter(|(.., v)| *v > STARTED) {
            if let Some(rank) = self.stands.iter().position(|(_, own)| *own == id) {
                self.starts[rank] = self.starts[rank].min(traffic.seconds());
            }
        }
    }

    /// The density between the second and the last but one, vehicles/km.
    fn jam_density(&self) -> f64 {
        let last = self.stands.len() - 2;
        1000.0 * (last - 1) as f64 / (self.stands[1].0 - self.stands[last].0)
    }

    /// How fast the start runs back from the second to the last but one, km/h.
    fn starting_wave(&self) -> f64 {
        let last = self.stands.len() - 2;
        3.6 * (self.stands[1].0 - self.stands[last].0) / (self.starts[last] - self.starts[1])
    }
}

/// The queue of perfect drivers before a red light and behind its green.
fn queue() -> Result<Queue, ValidationError> {
    let Signalised { mut traffic, .. } = Signalised::of(&empty(), 150.0, 90.0, 1)?;
    for _ in 0..QUEUE {
        traffic.insert(across(0, 2), CAR)?;
    }
    let (lane, mut queue, mut was_green) = (inner_lane(&traffic, 0), Queue::default(), false);
    while traffic.seconds() < 235.0
        && !queue.starts.iter().rev().nth(1).is_some_and(|start| start.is_finite())
    {
        traffic.step(0.1);
        let green = is_green(&traffic, lane);
        if green && !was_green {
            queue.stand(&traffic, lane);
        }
        if green {
            queue.look(&traffic);
        }
        was_green = green;
    }
    if queue.starts.len() < QUEUE / 2 || queue.starts[queue.starts.len() - 2].is_infinite() {
        let reason = format!("{} of {QUEUE} cars stood, and not all started", queue.starts.len());
        return Err(ValidationError::Nothing { measure: "queue discharge", reason });
    }
    Ok(queue)
}

impl Discharge {
    pub(super) fn at_step(dt: f64) -> Result<Self, ValidationError> {
        Self::of(&empty(), dt, 1, 0.0)
    }

    /// Of the cars of some settings, at a line so far beyond the end of the lane, m.
    fn of(config: &TrafficConfig, dt: f64, seed: u64, beyond: f64) -> Result<Self, ValidationError> {
        let Signalised { mut traffic, .. } = Signalised::of(config, 150.0, 90.0, seed)?;
        for _ in 0..QUEUE {
            traffic.insert(across(0, 2), CAR)?;
        }
        let lane = inner_lane(&traffic, 0);
        let (mut line, mut green) = (StopLine::new(lane), f64::NAN);
        line.beyond = beyond;
        while traffic.seconds() < 235.0 && line.passed.len() < QUEUE {
            traffic.step(dt);
            line.look(&traffic);
            if green.is_nan() && is_green(&traffic, lane) {
                green = traffic.seconds();
            }
        }
        let times: Vec<f64> = std::iter::once(green).chain(line.passed.iter().map(|pass| pass.1)).collect();
        if times.len() <= QUEUE {
            let reason = format!("{} of {QUEUE} cars passed", times.len() - 1);
            return Err(ValidationError::Nothing { measure: "queue discharge", reason });
        }
        Ok(Self::read(&times))
    }

    /// From the beginning of green and the times at which the cars pass.
    fn read(times: &[f64]) -> Self {
        let headways: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        // The manual measures from the fourth; ours settle by the eighth.
        let saturation = (times[QUEUE] - times[10]) / (QUEUE - 10) as f64;
        let lost = headways[..4].iter().map(|headway| headway - saturation).sum();
        Self { flow: 3600.0 / saturation, lost, headways }
    }

    /// The greatest change of a headway from one to the next from the eighth on, of the saturation headway.
    fn settled(&self) -> f64 {
        let changes = self.headways[7..].windows(2).map(|pair| (pair[1] - pair[0]).abs());
        changes.fold(0.0, f64::max) * self.flow / 3600.0
    }

    /// The greatest rise of a headway over the one before, from the second on, s.
    fn rise(&self) -> f64 {
        self.headways[1..8].windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max)
    }
}

pub(super) fn measure(_: Effort) -> Figures {
    let mut figures = Vec::new();
    let mut flows = Vec::new();
    for dt in [0.05, 0.1, 0.2] {
        let found = Discharge::at_step(dt)?;
        flows.push(found.flow);
        let name = |what: &str| format!("{what}, step {dt} s");
        figures.push(Figure::near(name("saturation flow"), found.flow, 1900.0, 0.05, "veh/h").cited(MANUAL));
        let lost = Figure::within(name("start-up lost time"), found.lost, (1.5, 2.5), "s");
        figures.push(lost.cited(MANUAL));
        figures.push(Figure::within(
            name("headways rise before the eighth by"),
            found.rise(),
            (0.0, 0.1),
            "s",
        ));
        figures.push(Figure::within(
            name("headways from the eighth on change by"),
            found.settled(),
            (0.0, 0.05),
            "",
        ));
    }
    let queue = queue()?;
    let length = empty().types[0].length + empty().types[0].driver.gap;
    let density = Figure::near("jam density", queue.jam_density(), 1000.0 / length, 0.03, "veh/km");
    figures.push(density.cited("the length of a car and the gap it keeps at rest"));
    let wave = Figure::within("speed of the starting wave", queue.starting_wave(), (15.0, 25.0), "km/h");
    figures.push(
        wave.cited("ours: fronts of jams move at 15 to 20 km/h, queues at lights dissolve somewhat faster"),
    );
    let most = flows.iter().map(|flow| (flow / flows[1] - 1.0).abs()).fold(0.0, f64::max);
    figures.push(Figure::within("saturation flow changes with the step by", most, (0.0, 0.02), ""));
    Ok(figures)
}

/// The car of SUMO's defaults: class `passenger`, model `Krauss`.
fn sumo_car() -> VehicleType {
    VehicleType {
        length: 5.0,
        speed_deviation: 0.1,
        driver: Idm { gap: 2.5, acceleration: 2.6, deceleration: 4.5, ..VehicleType::default().driver },
        model: CarFollowing::Krauss { sigma: 0.5 },
        ..empty().types[0].clone()
    }
}

/// The queue of a type without anything but the model: no lanes, no junction, no random numbers.
fn alone(car: &VehicleType, limit: f64, dt: f64) -> Discharge {
    let free = limit.min(car.driver.desired_speed);
    let step = car.length + car.driver.gap;
    let mut queue: Vec<(f64, f64, f64)> = (0..QUEUE).map(|rank| (-step * rank as f64, 0.0, 0.0)).collect();
    let (mut times, mut now) = (vec![0.0], 0.0);
    while times.len() <= QUEUE && now < 300.0 {
        let frozen = queue.clone();
        for (rank, car_now) in queue.iter_mut().enumerate() {
            let leader = rank.checked_sub(1).map(|before| {
                let (s, speed, acceleration) = frozen[before];
                Leader { gap: s - car.length - car_now.0, speed, acceleration }
            });
            let a = car.model.acceleration(&car.driver, car_now.1, free, leader, dt);
            let (v, way) = advance(car_now.1, a, dt);
            // The line is where the first stands, half a metre before it, as on the street.
            if car_now.0 <= 0.5 && car_now.0 + way > 0.5 {
                times.push(now + dt * (0.5 - car_now.0) / way);
            }
            *car_now = (car_now.0 + way, v, a);
        }
        now += dt;
    }
    Discharge::read(&times)
}

/// The other models: Krauss beside SUMO's, and each on a street beside itself alone.
pub(super) fn other_models(_: Effort) -> Figures {
    let mut figures = Vec::new();
    let config = |car: &VehicleType| TrafficConfig { types: vec![car.clone()], ..empty() };
    let sumo = config(&sumo_car());
    // SUMO's cars stand a metre before the line, ours half a metre.
    let run = |seed| Discharge::of(&sumo, 0.1, seed, 0.5);
    let runs: Vec<Discharge> = (1..=20).map(run).collect::<Result<_, _>>()?;
    let source = "SUMO 1.28, its own discharge of the same queue: 2169 ± 69 veh/h, 0.23 to 0.69 s";
    let flow = mean(runs.iter().map(|run| run.flow));
    let band = (2169.0 - 69.0, 2169.0 + 69.0);
    figures.push(Figure::within("saturation flow, SUMO's car by Krauss", flow, band, "veh/h").cited(source));
    let lost = mean(runs.iter().map(|run| run.lost));
    let lost = Figure::within("start-up lost time, SUMO's car by Krauss", lost, (0.23, 0.69), "s");
    figures.push(lost.cited(source));
    for (word, model) in
        [("Krauss", CarFollowing::Krauss { sigma: 0.0 }), ("ACC", CarFollowing::Acc { coolness: 0.99 })]
    {
        let car = VehicleType { model, ..empty().types[0].clone() };
        for dt in [0.05, 0.1, 0.2] {
            let (street, alone) = (Discharge::of(&config(&car), dt, 1, 0.0)?, alone(&car, LIMIT, dt));
            let name = format!("saturation flow by {word}, step {dt} s");
            figures.push(Figure::near(name, street.flow, alone.flow, 0.03, "veh/h").cited("the model alone"));
        }
    }
    Ok(figures)
}
