//! Queue discharge: saturation flow and start-up lost time.

use super::streets::{CAR, Signalised, StopLine, across, inner_lane, is_green};
use super::{Effort, Figure, Figures, ValidationError};

/// Cars in the queue.
const QUEUE: usize = 22;
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

impl Discharge {
    pub(super) fn at_step(dt: f64) -> Result<Self, ValidationError> {
        let Signalised { mut traffic, .. } = Signalised::new(150.0, 90.0, 1)?;
        for _ in 0..QUEUE {
            traffic.insert(across(0, 2), CAR)?;
        }
        let lane = inner_lane(&traffic, 0);
        let (mut line, mut green) = (StopLine::new(lane), f64::NAN);
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
        let headways: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
        // The manual measures from the fourth; ours settle by the eighth.
        let saturation = (times[QUEUE] - times[10]) / (QUEUE - 10) as f64;
        let lost = headways[..4].iter().map(|headway| headway - saturation).sum();
        Ok(Self { flow: 3600.0 / saturation, lost, headways })
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
    let most = flows.iter().map(|flow| (flow / flows[1] - 1.0).abs()).fold(0.0, f64::max);
    figures.push(Figure::within("saturation flow changes with the step by", most, (0.0, 0.02), ""));
    Ok(figures)
}
