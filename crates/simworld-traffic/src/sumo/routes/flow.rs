//! Flows: vehicles that keep coming, and when those of any flow come.

use super::read::time;
use super::{SumoStop, SumoWay};
use crate::Arrivals;
use crate::sumo::SumoError;
use crate::sumo::xml::Element;

/// When those of a flow come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SumoTimes {
    /// When the first may come, s.
    pub begin: f64,
    /// When no more come, s.
    pub end: f64,
    /// How many come an hour.
    pub per_hour: f64,
    /// How they come.
    pub arrivals: Arrivals,
    /// At most so many.
    pub number: u64,
}

/// Vehicles that keep coming.
#[derive(Clone, Debug, PartialEq)]
pub struct SumoFlow {
    /// Its id; its vehicles are `id.0`, `id.1` and so on.
    pub id: String,
    /// Their type, if it names one.
    pub vehicle_type: Option<String>,
    /// When they come.
    pub times: SumoTimes,
    /// Their way.
    pub way: SumoWay,
    /// Their stops on the way, beside those of their route.
    pub stops: Vec<SumoStop>,
    /// The line that they are of; empty if none.
    pub line: String,
}

/// SUMO's default end of a flow, s: a day.
const DAY: f64 = 86_400.0;

impl SumoFlow {
    pub(super) fn of(element: &Element<'_>, way: SumoWay) -> Result<Self, SumoError> {
        Ok(Self {
            id: element.text("id")?,
            vehicle_type: element.get("type").map(std::borrow::Cow::into_owned),
            times: SumoTimes::of(element)?,
            way,
            stops: Vec::new(),
            line: element.get("line").unwrap_or_default().into_owned(),
        })
    }
}

impl SumoTimes {
    pub(super) fn of(element: &Element<'_>) -> Result<Self, SumoError> {
        let begin = time(element, "begin")?.unwrap_or(0.0);
        let end = time(element, "end")?;
        let number = element.index("number")?.map(|number| number as u64);
        let until = end.unwrap_or(DAY.max(begin));
        if until < begin {
            return Err(element.error("end", "is before begin"));
        }
        let (per_hour, arrivals) = rate(element, until - begin, number)?;
        // A number alone says when it ends.
        let end = if end.is_none() && number.is_some() { f64::MAX } else { until };
        Ok(Self { begin, end, per_hour, arrivals, number: number.unwrap_or(u64::MAX) })
    }

    /// The rate that a flow may have which is next to this one, an hour.
    pub(super) fn allowed_rate(&self) -> f64 {
        self.per_hour.clamp(RATES.0, RATES.1)
    }
}

/// The fewest and most an hour that a flow may bring.
const RATES: (f64, f64) = (1e-3, 1e4);

/// How many an hour, and how they come.
fn rate(element: &Element<'_>, span: f64, number: Option<u64>) -> Result<(f64, Arrivals), SumoError> {
    let positive = |name: &'static str, value: f64| {
        if value > 0.0 { Ok(value) } else { Err(element.error(name, "is not more than 0")) }
    };
    if let Some(text) = element.get("period")
        && let Some(rate) = text.trim().strip_prefix("exp(").and_then(|rest| rest.strip_suffix(')'))
    {
        let rate = rate.parse().ok().filter(|rate: &f64| rate.is_finite());
        let rate = rate.ok_or_else(|| element.error("period", "is no rate: give exp(number a second)"))?;
        return Ok((positive("period", rate)? * 3600.0, Arrivals::Poisson));
    }
    if let Some(period) = element.number("period")? {
        return Ok((3600.0 / positive("period", period)?, Arrivals::Uniform));
    }
    for name in ["vehsPerHour", "personsPerHour", "perHour"] {
        if let Some(rate) = element.number(name)? {
            return Ok((positive(name, rate)?, Arrivals::Uniform));
        }
    }
    if let Some(chance) = element.number("probability")? {
        return Ok((positive("probability", chance)?.min(1.0) * 3600.0, Arrivals::Poisson));
    }
    match number {
        Some(number) if number > 0 && span > 0.0 => Ok((number as f64 * 3600.0 / span, Arrivals::Uniform)),
        Some(0) => Ok((1.0, Arrivals::Uniform)),
        _ => Err(element.error("period", "is missing: give period, perHour, probability or number")),
    }
}
